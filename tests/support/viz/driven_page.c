/* SPDX-License-Identifier: MIT */
/* driven_page.c - see driven_page.h. */
#include "driven_page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "browser.h"
#include "files.h"
#include "fixture.h"
#include "pick.h"
#include "png_read.h"
#include "recordings.h"
#include "tick_lines.h"

bool page_has_module(const char *page)
{
    char *text = file_read(page, NULL);
    const bool plays = strstr(text, "id=\"module\"></script>") == NULL;
    free(text);
    return plays;
}

void skip_without_playing_page(const char *page)
{
    skip_without_browser();
    if (page_has_module(page))
        return;
    print_message("octreel was built without WebAssembly: its pages do not play\n");
    skip();
}

char *run_scripts_in_page(const temp_folder *own, const char *page, const char *const scripts[])
{
    place places[4];
    const char *paths[5] = {places[0].path};
    size_t count = 1;
    places[0] = place_below(OCTREEL_DRIVES, "drive.js");
    for (size_t i = 0; scripts[i]; i++, count++) {
        assert_true(count < 4);
        snprintf(places[count].path, sizeof places[count].path, "%s%s",
                 strchr(scripts[i], '/') ? "" : OCTREEL_DRIVES "/", scripts[i]);
        paths[count] = places[count].path;
    }
    return browser_drive_all(own, page, paths);
}

char *run_scripts_in_playing_page(const temp_folder *own, const char *page, const char *const scripts[])
{
    return is_browser_installed() && page_has_module(page) ? run_scripts_in_page(own, page, scripts) : NULL;
}

place write_given_script(const temp_folder *own, const json_t *given)
{
    const place path = place_in(own, "given.js");
    char *text = json_dumps(given, JSON_COMPACT | JSON_ENSURE_ASCII);
    FILE *file = fopen(path.path, "w");
    assert_non_null(text);
    assert_non_null(file);
    fputs("const given = ", file);
    for (const char *at = text; *at; at++)
        fputs(*at == '<' ? "\\u003c" : (char[]){*at, 0}, file);
    fputs(";\n", file);
    assert_int_equal(fclose(file), 0);
    free(text);
    return path;
}

/* ---- Ticks -------------------------------------------------------------------------------------------------- */

uint32_t compute_png_digest(const char *path)
{
    octreel_error error;
    image frame;
    uint32_t digest = 0x811c9dc5;
    if (!image_read_png(path, &frame, &error))
        fail_msg("%s", error.text);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            const image_color color = image_color_at(&frame, x, y);
            const uint8_t bytes[] = {color.r, color.g, color.b, 255};
            for (int i = 0; i < 4; i++)
                digest = (digest ^ bytes[i]) * 0x01000193;
        }
    image_release(&frame);
    return digest;
}

typedef struct expectation {
    const char *said, *name, *folder;
    bool some; /* ticks may be missing */
} expectation;

/* A gap has facts and no picture. */
static void assert_tick_is(const char *told, json_t *line, const char *folder, size_t number)
{
    char expected[32];
    const json_t *scene = json_object_get(line, "scene");
    json_t *facts = json_read(strchr(strchr(told, ' ') + 1, ' '));
    if (scene) {
        snprintf(expected, sizeof expected, "%s %08x ", json_string_value(scene),
                 compute_png_digest(frame_place(folder, number).path));
        if (strncmp(told, expected, strlen(expected)) != 0)
            fail_msg("%s, tick %zu: \"%.*s\" and not \"%s\"", folder, number, (int)strlen(expected), told, expected);
    }
    json_object_del(line, "scene");
    json_object_del(line, "frame");
    if (!json_equal(facts, line))
        fail_msg("%s, tick %zu: %s", folder, number, told);
    json_decref(facts);
}

static void assert_tick_said(const char *line, size_t number, void *context)
{
    const expectation *e = context;
    char what[64], sought[80];
    snprintf(what, sizeof what, "%s %zu", e->name, number);
    snprintf(sought, sizeof sought, "\n%s\t", what);
    if (e->some && !strstr(e->said, sought))
        return;
    json_t *tick = json_read(line);
    char *told = find_reported_value(e->said, what);
    assert_tick_is(told, tick, e->folder, number);
    free(told);
    json_decref(tick);
}

void assert_reported_ticks(const char *said, const char *name, const char *folder, size_t count, bool some)
{
    expectation e = {said, name, folder, some};
    assert_int_equal(for_each_line(folder, assert_tick_said, &e), count);
}

/* ---- Clicks ------------------------------------------------------------------------------------------------- */

void assert_reported_pick(const char *said, const char *frame, int x, int y, int radius)
{
    octreel_error error;
    pick found;
    char *text;
    size_t size;
    if (!pick_frame(frame, &(pick_options){.x = x, .y = y, .radius = radius}, &found, &error))
        fail_msg("%s", error.text);
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    pick_print(out, &found, true);
    assert_int_equal(fclose(out), 0);
    text[strcspn(text, "\n")] = 0;
    assert_string_equal(strstr(said, "\"tick\""), strstr(text, "\"tick\""));
    pick_release(&found);
    free(text);
}
