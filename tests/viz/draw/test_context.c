/* SPDX-License-Identifier: MIT */
/* test_context.c - all contexts draw the same pixels, also two at once, and only llvmpipe is accepted. */
#include "frames.h"
#include "json_table.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* The kinds that have a name. */
#define FIRST_KIND (DRAW_AUTO + 1)

static void need_both_kinds(void)
{
    if (draw_context_is_built(DRAW_OSMESA) && draw_context_is_built(DRAW_EGL))
        return;
    print_message("only one kind of context was built: nothing is compared\n");
    skip();
}

enum { REFUSED_WITH_REASON, REFUSED_WITHOUT, DRAWN_BY_LLVMPIPE, DRAWN_BY_ANOTHER };

/* Run in a child process, so that its environment can be changed and Mesa is loaded anew. */
static int open_under_softpipe(const renderer_choice *choice)
{
    int status = 0;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        octreel_error error = {""};
        setenv("GALLIUM_DRIVER", "softpipe", 1);
        renderer *r = renderer_open(16, 16, choice, &error);
        if (!r)
            _exit(strstr(error.text, "softpipe") && strstr(error.text, "llvmpipe") ? REFUSED_WITH_REASON
                                                                                   : REFUSED_WITHOUT);
        _exit(strncmp(renderer_describe(r).renderer, "llvmpipe", 8) == 0 ? DRAWN_BY_LLVMPIPE : DRAWN_BY_ANOTHER);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* If Mesa was built without softpipe, llvmpipe draws. */
static void driver_other_than_llvmpipe_is_refused_by_name(void **state)
{
    (void)state;
    for (int kind = DRAW_AUTO; kind < DRAW_CONTEXTS; kind++) {
        if (!draw_context_is_built((draw_context)kind))
            continue;
        const int said = open_under_softpipe(&(renderer_choice){.context = (draw_context)kind, .fill = DRAW_FILL_GL});
        assert_true(said == REFUSED_WITH_REASON || said == DRAWN_BY_LLVMPIPE);
    }
}

static void driver_other_than_llvmpipe_draws_with_any_renderer(void **state)
{
    (void)state;
    if (!draw_context_is_built(DRAW_EGL))
        skip();
    const int said =
        open_under_softpipe(&(renderer_choice){.context = DRAW_EGL, .fill = DRAW_FILL_GL, .any_renderer = true});
    assert_true(said == DRAWN_BY_ANOTHER || said == DRAWN_BY_LLVMPIPE);
    if (open_under_softpipe(&(renderer_choice){.context = DRAW_EGL, .fill = DRAW_FILL_GL}) == REFUSED_WITH_REASON)
        assert_int_equal(said, DRAWN_BY_ANOTHER);
}

static void context_names_survive_the_round_trip(void **state)
{
    (void)state;
    static const char *const names[DRAW_CONTEXTS] = {"auto", "osmesa", "egl"};
    for (int kind = 0; kind < DRAW_CONTEXTS; kind++) {
        assert_string_equal(draw_context_name(kind), names[kind]);
        assert_int_equal(json_find_name(draw_context_name, names[kind]), kind);
    }
    assert_null(draw_context_name(DRAW_CONTEXTS));
    assert_int_equal(json_find_name(draw_context_name, "glx"), -1);
    assert_int_equal(json_find_name(draw_context_name, ""), -1);
}

static void missing_context_is_refused_by_name(void **state)
{
    (void)state;
    assert_true(draw_context_is_built(DRAW_AUTO));
    for (int kind = FIRST_KIND; kind < DRAW_CONTEXTS; kind++) {
        const renderer_choice choice = {.context = (draw_context)kind, .fill = DRAW_FILL_GL};
        octreel_error error = {""};
        renderer *r = renderer_open(16, 16, &choice, &error);
        assert_int_equal(r != NULL, draw_context_is_built(choice.context));
        if (r)
            assert_string_equal(renderer_describe(r).context, draw_context_name(choice.context));
        else
            assert_non_null(strstr(error.text, draw_context_name(choice.context)));
        renderer_close(r);
    }
}

static void auto_uses_the_first_available_context(void **state)
{
    (void)state;
    int kind = FIRST_KIND;
    while (!draw_context_is_built((draw_context)kind))
        kind++;
    renderer *r = open_renderer_of(DRAW_AUTO, 16, 16);
    assert_string_equal(renderer_describe(r).context, draw_context_name(kind));
    renderer_close(r);
}

static void contexts_draw_the_same_bytes(void **state)
{
    (void)state;
    need_both_kinds();
    renderer *osmesa = open_renderer_of(DRAW_OSMESA, 640, 360);
    renderer *egl = open_renderer_of(DRAW_EGL, 640, 360);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        scene s = busy_scene(640, 360, (view_camera)kind);
        uint8_t *a = draw(osmesa, &s), *b = draw(egl, &s);
        assert_true(lit_pixels(a, &s) > 2000);
        assert_same_frame(a, b, &s);
        free(a);
        free(b);
        scene_release(&s);
    }
    renderer_close(osmesa);
    renderer_close(egl);
}

/* Without a graphics card, EGL chooses the processor, too. */
static void egl_draws_the_same_bytes_with_and_without_a_named_device(void **state)
{
    (void)state;
    const renderer_choice any = {.context = DRAW_EGL, .fill = DRAW_FILL_GL, .any_renderer = true};
    octreel_error error;
    if (!draw_context_is_built(DRAW_EGL))
        skip();
    renderer *r = renderer_open(320, 180, &any, &error);
    if (!r || strncmp(renderer_describe(r).renderer, "llvmpipe", 8) != 0) {
        renderer_close(r);
        skip();
    }
    scene s = busy_scene(320, 180, CAMERA_FOLLOW);
    uint8_t *a = draw(r, &s), *b = draw_once(&s);
    assert_same_frame(a, b, &s);
    free(a);
    free(b);
    scene_release(&s);
    renderer_close(r);
}

/* Two libraries of Mesa share one current context, but each keeps its own record of it. */
static void two_contexts_at_once_do_not_disturb_each_other(void **state)
{
    (void)state;
    need_both_kinds();
    scene small = busy_scene(160, 90, CAMERA_ISO), large = busy_scene(320, 180, CAMERA_ORBIT);
    uint8_t *small_alone = draw_once(&small), *large_alone = draw_once(&large);
    for (int first = FIRST_KIND; first < DRAW_CONTEXTS; first++) {
        const draw_context second = first == DRAW_OSMESA ? DRAW_EGL : DRAW_OSMESA;
        renderer *a = open_renderer_of((draw_context)first, 160, 90), *b = open_renderer_of(second, 320, 180);
        uint8_t *frames[4] = {draw(a, &small), draw(b, &large), draw(a, &small), NULL};
        assert_string_equal(renderer_describe(a).context, draw_context_name(first));
        renderer_close(a);
        frames[3] = draw(b, &large);
        renderer_close(b);
        for (int i = 0; i < 4; i++) {
            assert_same_frame(frames[i], i % 2 ? large_alone : small_alone, i % 2 ? &large : &small);
            free(frames[i]);
        }
    }
    free(small_alone);
    free(large_alone);
    scene_release(&small);
    scene_release(&large);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        /* Tests with child processes come first, because Mesa's threads do not survive a fork. */
        cmocka_unit_test(driver_other_than_llvmpipe_is_refused_by_name),
        cmocka_unit_test(driver_other_than_llvmpipe_draws_with_any_renderer),
        cmocka_unit_test(context_names_survive_the_round_trip),
        cmocka_unit_test(missing_context_is_refused_by_name),
        cmocka_unit_test(auto_uses_the_first_available_context),
        cmocka_unit_test(contexts_draw_the_same_bytes),
        cmocka_unit_test(egl_draws_the_same_bytes_with_and_without_a_named_device),
        cmocka_unit_test(two_contexts_at_once_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
