/* SPDX-License-Identifier: MIT */
/* test_cli_context.c - --context and --fill choose the renderer; a machine without OpenGL gets an error with a remedy,
 * and a renderer other than llvmpipe draws only with --any-renderer. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "renderer.h"
#include "files.h"
#include "fixture.h"
#include "tick_lines.h"

#define FILM "record --keys wd --size 64x36"

static void need_contexts(bool osmesa, bool egl)
{
    if ((draw_context_is_built(DRAW_OSMESA) || !osmesa) && (draw_context_is_built(DRAW_EGL) || !egl))
        return;
    print_message("octreel was built without a context that this test needs\n");
    skip();
}

/* The test fails unless renderer.json contains this text. */
static void assert_renderer(const place *folder, const char *member, const char *expected)
{
    char *text = file_read(place_below(folder->path, "renderer.json").path, NULL);
    json_t *object = json_read(text);
    const char *found = json_string_value(json_member(object, member));
    if (strncmp(found, expected, strlen(expected)) != 0)
        fail_msg("renderer.json says \"%s\"", found);
    json_decref(object);
    free(text);
}

/* Record with the setting, and compare the renderer and the frames. */
static void assert_drawn_by(const command_setting *setting, const char *options, const place *folder,
                            const char *member, const char *expected)
{
    command_result result = run_octreel(setting, FILM " %s -o %s", options, folder->path);
    assert_done(&result);
    command_release(&result);
    assert_renderer(folder, member, expected);
}

static void assert_not_drawn(const command_setting *setting, const char *options, const place *folder, const char *part)
{
    command_result result = run_octreel(setting, FILM " %s -o %s", options, folder->path);
    assert_trouble(&result, part);
    assert_false(file_exists(folder->path));
}

static void every_context_records_and_is_named_in_the_recording(void **state)
{
    for (int kind = DRAW_AUTO + 1; kind < DRAW_CONTEXTS; kind++) {
        const char *name = draw_context_name(kind);
        const place folder = place_in(*state, name);
        char option[32];
        snprintf(option, sizeof option, "--fill gl --context %s", name);
        if (draw_context_is_built((draw_context)kind))
            assert_drawn_by(NULL, option, &folder, "context", name);
        else
            assert_not_drawn(NULL, option, &folder, name);
    }
}

static void version_names_every_context(void **state)
{
    (void)state;
    command_result result = run_octreel(NULL, "--version");
    assert_done(&result);
    for (int kind = DRAW_AUTO + 1; kind < DRAW_CONTEXTS; kind++) {
        char line[32];
        snprintf(line, sizeof line, "\n%s: llvmpipe", draw_context_name(kind));
        assert_int_equal(strstr(result.out, line) != NULL, draw_context_is_built((draw_context)kind));
    }
    command_release(&result);
}

static void inspect_draws_with_every_context(void **state)
{
    need_contexts(false, true);
    const place cloud = place_in(*state, "points.txt"), a = place_in(*state, "a.png"), b = place_in(*state, "b.png");
    file_write_text(cloud.path, "1 2 3\n-4 5 6\n7 8 -9\n");
    command_result result = run_octreel(NULL, "inspect %s -o %s", cloud.path, a.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "inspect %s -o %s --context egl", cloud.path, b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_files(a.path, b.path);
    result = run_octreel(NULL, "inspect %s -o %s --context glx", cloud.path, b.path);
    assert_trouble(&result, "auto, osmesa, egl");
}

static void invalid_and_contradicting_renderer_options_are_refused(void **state)
{
    const place folder = place_in(*state, "film");
    assert_not_drawn(NULL, "--context glx", &folder, "--context: unknown value \"glx\"; choose from auto, osmesa, egl");
    assert_not_drawn(NULL, "--any-renderer", &folder, "--context egl");
    assert_not_drawn(NULL, "--context egl --fill integers", &folder, "loads no OpenGL");
    assert_not_drawn(NULL, "--any-renderer --context osmesa", &folder, "--context egl");
}

/* Create a folder in which these libraries are broken files. Returns the setting that makes the program find them. */
static const char *hide_libraries(const temp_folder *own, const char *const *names, char setting[96])
{
    for (; *names; names++)
        file_write_text(place_in(own, *names).path, "");
    snprintf(setting, 96, "LD_LIBRARY_PATH=%s", own->name);
    return setting;
}

static void egl_draws_if_osmesa_cannot_be_loaded(void **state)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so", NULL};
    need_contexts(true, true);
    char path[96];
    const command_setting without = {.environment = {hide_libraries(*state, names, path)}};
    const place other = place_in(*state, "other");
    for (int jobs = 1; jobs <= 2; jobs++) {
        const place folder = place_in(*state, jobs == 1 ? "film" : "film2");
        command_result result = run_octreel(&without, FILM " --fill gl --jobs %d -o %s", jobs, folder.path);
        assert_int_equal(result.status, 0);
        assert_ptr_equal(strstr(result.err, "octreel: drawing with egl, because osmesa does not work: OSMesa, "),
                         result.err);
        assert_string_equal(strchr(result.err, '\n'), "\n"); /* once */
        command_release(&result);
        assert_renderer(&folder, "context", "egl");
    }
    assert_not_drawn(&without, "--fill gl --context osmesa", &other, "libosmesa6");
}

/* Record without GL: a note says why no frame was checked, and the frames are the same bytes. */
static void assert_unchecked(const command_setting *setting, const char *options, const temp_folder *own,
                             const char *name, const char *reason)
{
    const place folder = place_in(own, name), plain = place_in(own, "plain");
    if (!file_exists(plain.path))
        assert_drawn_by(NULL, "--fill integers", &plain, "fill", "integers");
    command_result result = run_octreel(setting, FILM " %s -o %s", options, folder.path);
    assert_int_equal(result.status, 0);
    assert_ptr_equal(strstr(result.err, "octreel: no frame was checked: "), result.err);
    if (!strstr(result.err, reason) || strstr(result.out, "checked"))
        fail_msg("%s%s", result.err, result.out);
    command_release(&result);
    assert_same_folders(plain.path, folder.path, "renderer.json");
}

static void error_without_gl_libraries_names_the_packages(void **state)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so", "libEGL.so.1", "libEGL.so", NULL};
    char path[96];
    const command_setting without = {.environment = {hide_libraries(*state, names, path)}};
    const place folder = place_in(*state, "film");
    const char *first = draw_context_is_built(DRAW_OSMESA) ? "libosmesa6" : "libegl1",
               *egl = draw_context_is_built(DRAW_EGL) ? "libegl1" : "egl";
    assert_not_drawn(&without, "--fill gl", &folder, first);
    assert_not_drawn(&without, "--fill gl --context egl", &folder, egl);
    assert_unchecked(&without, "", *state, "auto", first);
    assert_unchecked(&without, "--jobs 2", *state, "jobs", first);
    assert_unchecked(&without, "--context egl", *state, "egl", egl);
    command_result result = run_octreel(&without, "--version");
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.out, first));
    command_release(&result);
}

static void egl_without_a_driver_is_an_error(void **state)
{
    need_contexts(false, true);
    const temp_folder *own = *state;
    char path[96];
    snprintf(path, sizeof path, "__EGL_VENDOR_LIBRARY_DIRS=%s", own->name);
    const command_setting bare = {.environment = {path}};
    const place folder = place_in(own, "film");
    assert_not_drawn(&bare, "--fill gl --context egl", &folder, "EGL cannot create an OpenGL context");
}

static const command_setting softpipe = {.environment = {"GALLIUM_DRIVER=softpipe"}};

static void renderer_other_than_llvmpipe_is_refused(void **state)
{
    const place folder = place_in(*state, "film");
    assert_not_drawn(&softpipe, "--fill gl", &folder, "softpipe");
    assert_unchecked(&softpipe, "", *state, "soft", "softpipe");
    for (int kind = DRAW_AUTO + 1; kind < DRAW_CONTEXTS; kind++) {
        char option[32];
        snprintf(option, sizeof option, "--fill gl --context %s", draw_context_name(kind));
        assert_not_drawn(&softpipe, option, &folder,
                         draw_context_is_built((draw_context)kind) ? "only llvmpipe" : "without the");
    }
}

static void any_renderer_option_allows_other_renderers(void **state)
{
    need_contexts(false, true);
    const place folder = place_in(*state, "film");
    assert_drawn_by(&softpipe, "--context egl --any-renderer", &folder, "renderer", "softpipe");
    char *text = file_read(place_below(folder.path, "renderer.json").path, NULL);
    assert_non_null(strstr(text, "\"fill\": \"gl\"")); /* GL draws every frame */
    free(text);
}

static void integers_and_gl_record_the_same_bytes(void **state)
{
    const place plain = place_in(*state, "plain"), integers = place_in(*state, "integers"), gl = place_in(*state, "gl");
    assert_drawn_by(NULL, "", &plain, "fill", "integers");
    assert_drawn_by(NULL, "--fill integers", &integers, "fill", "integers");
    assert_drawn_by(NULL, "--fill gl", &gl, "fill", "gl");
    assert_same_folders(plain.path, integers.path, "renderer.json");
    assert_same_folders(plain.path, gl.path, "renderer.json"); /* recording.json is the same, too */
}

static void inspect_draws_with_both_rasterizers(void **state)
{
    const place cloud = place_in(*state, "c.txt"), one = place_in(*state, "one.png"), two = place_in(*state, "two.png");
    file_write_text(cloud.path, "1 2 3\n4 5 6\n7 8 1\n");
    command_result result = run_octreel(NULL, "inspect %s --size 64x36 -o %s", cloud.path, one.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "inspect %s --size 64x36 --fill gl -o %s", cloud.path, two.path);
    assert_done(&result);
    command_release(&result);
    assert_same_files(one.path, two.path);
    result = run_octreel(NULL, "inspect %s --fill gl", cloud.path);
    assert_trouble(&result, "--fill changes the picture, but no picture is drawn");
}

static void unknown_fill_is_refused(void **state)
{
    const place folder = place_in(*state, "film");
    assert_not_drawn(NULL, "--fill GL", &folder,
                     "--fill: unknown value \"GL\", did you mean gl? choose from integers, checked, gl");
    assert_not_drawn(NULL, "--fill ''", &folder, "choose from integers, checked, gl");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_context_records_and_is_named_in_the_recording),
        cmocka_unit_test(version_names_every_context),
        IN_FOLDER(inspect_draws_with_every_context),
        IN_FOLDER(invalid_and_contradicting_renderer_options_are_refused),
        IN_FOLDER(egl_draws_if_osmesa_cannot_be_loaded),
        IN_FOLDER(error_without_gl_libraries_names_the_packages),
        IN_FOLDER(egl_without_a_driver_is_an_error),
        IN_FOLDER(renderer_other_than_llvmpipe_is_refused),
        IN_FOLDER(any_renderer_option_allows_other_renderers),
        IN_FOLDER(integers_and_gl_record_the_same_bytes),
        IN_FOLDER(inspect_draws_with_both_rasterizers),
        IN_FOLDER(unknown_fill_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
