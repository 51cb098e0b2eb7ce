/* SPDX-License-Identifier: MIT */
/* test_draw_memory.c - if the n-th allocation fails while drawing, for n = 0, 1, 2 ..., nothing is drawn and the error
 * says why, or the picture is the same as with all memory. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

#include "failing_memory.h"
#include "frames.h"
#include "golden_frames.h"

enum { SIDE = 24 };

/* A function of the renderer with a result of `size` bytes. */
typedef bool work(renderer *r, const scene *s, void *bytes, octreel_error *error);

static bool draw_it(renderer *r, const scene *s, void *bytes, octreel_error *error)
{
    return renderer_draw_scene(r, s, bytes, error);
}

static bool pick_it(renderer *r, const scene *s, void *bytes, octreel_error *error)
{
    return renderer_find_element_numbers(r, s, bytes, error);
}

static bool mask_it(renderer *r, const scene *s, void *bytes, octreel_error *error)
{
    return renderer_find_layer_mask(r, s, 1u << LAYER_NODES, bytes, error);
}

/* Find the numbers of the elements in the middle of the picture. */
static bool ask_it(renderer *r, const scene *s, void *bytes, octreel_error *error)
{
    draw_covers list = {0};
    const bool done = renderer_list_pixel_covers(r, s, s->view.width / 2, s->view.height / 2, &list, error);
    for (size_t i = 0; done && i < list.count && i < SIDE; i++)
        ((uint32_t *)bytes)[i] = list.items[i].number;
    draw_covers_release(&list);
    return done;
}

static renderer *open_memory(const scene *s)
{
    octreel_error error;
    const int samples = s->view.aa;
    renderer *r = renderer_open(s->view.width * samples, s->view.height * samples, &(renderer_choice){0}, &error);
    assert_non_null(r);
    return r;
}

/* A new renderer for each n, so that nothing is left from the last run. */
static void assert_all_or_nothing(work *w, const scene *s)
{
    const size_t size = frame_samples(s) * sizeof(uint32_t);
    uint8_t *whole = calloc(1, size), *some = calloc(1, size);
    octreel_error error;
    assert_true(whole && some);
    renderer *r = open_memory(s);
    assert_true(w(r, s, whole, &error));
    renderer_close(r);
    bool failed = true;
    for (long count = 0; failed; count++) {
        memset(some, 0, size);
        r = open_memory(s);
        fail_allocations_after(count);
        const bool done = w(r, s, some, &error);
        failed = memory_has_failed();
        renderer_close(r);
        assert_int_equal(done, !failed);
        if (done)
            assert_memory_equal(some, whole, size);
        else
            assert_non_null(strstr(error.text, "memory"));
    }
    free(some);
    free(whole);
}

static void picture_is_whole_or_missing_if_an_allocation_fails(void **state)
{
    static const char *const names[] = {"default",        "closeup", "aa",       "painted",
                                        "painted_leaves", "diagram", "clustered"};
    static work *const works[] = {draw_it, pick_it, mask_it, ask_it};
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++)
        for (size_t name = 0; name < sizeof names / sizeof *names; name++)
            if (strcmp(golden_frames[i].name, names[name]) == 0) {
                scene s;
                octreel_error error;
                assert_true(golden_scene(&golden_frames[i], &s, &error));
                for (size_t w = 0; w < sizeof works / sizeof *works; w++)
                    assert_all_or_nothing(works[w], &s);
                scene_release(&s);
            }
}

static void renderer_opens_or_reports_the_reason_if_an_allocation_fails(void **state)
{
    static const renderer_choice choices[] = {{.fill = DRAW_FILL_INTEGERS}, {.fill = DRAW_FILL_GL}};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        bool failed = true;
        for (long count = 0; failed; count++) {
            octreel_error error = {""};
            fail_allocations_after(count);
            renderer *r = renderer_open(SIDE, SIDE, &choices[i], &error);
            failed = memory_has_failed();
            assert_true(r || (failed && strstr(error.text, "memory")));
            if (r)
                renderer_close(r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_is_whole_or_missing_if_an_allocation_fails),
        cmocka_unit_test(renderer_opens_or_reports_the_reason_if_an_allocation_fails),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fail_one_allocation();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
