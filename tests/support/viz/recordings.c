/* SPDX-License-Identifier: MIT */
/* recordings.c - see recordings.h. */
#include "recordings.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "fixture.h"
#include "frame_file.h"
#include "png_by_hand.h"
#include "session_file.h"
#include "theme.h"
#include "tick_lines.h"
#include "recording_file.h"

film_options small_film(const char *folder)
{
    film_options options = {.folder = folder, .view = view_make_default(), .every = 1};
    options.view.width = SMALL_WIDTH;
    options.view.height = SMALL_HEIGHT;
    return options;
}

octree_session short_session(const char *keys)
{
    octree_session session = octree_session_default();
    session.keys = keys;
    return session;
}

film_options chunk_of(film_options options, uint64_t first, uint64_t last)
{
    options.first = first;
    options.last = last;
    return options;
}

static bool count_down(void *context)
{
    uint64_t *left = context;
    return *left > 0 && --*left > 0;
}

film_options stopped_after(film_options options, uint64_t *ticks)
{
    options.watch.keep_going = count_down;
    options.watch.context = ticks;
    return options;
}

place frame_place(const char *folder, uint64_t tick)
{
    char name[FRAME_NAME];
    return place_below(folder, frame_print_name(tick, name));
}

film_summary assert_filmed(const octree_session *session, const film_options *options)
{
    film_summary summary;
    octreel_error error = {""};
    if (!film_session(session, options, &summary, &error))
        fail_msg("%s", error.text);
    return summary;
}

image assert_whole_frame(const char *path, int width, int height)
{
    static png_bytes file;
    image frame;
    octreel_error error;
    png_bytes_load(&file, path);
    const png_chunk header = png_chunk_of(&file, "IHDR"), palette = png_chunk_of(&file, "PLTE");
    assert_int_equal(png_u32_at(header.data), width);
    assert_int_equal(png_u32_at(header.data + 4), height);
    assert_int_equal(header.data[8], 8);
    assert_int_equal(header.data[9], 3);
    assert_int_equal(palette.size, 3 * THEME_COLORS);
    if (!image_read_png(path, &frame, &error))
        fail_msg("%s", error.text);
    assert_int_equal(frame.width, width);
    assert_int_equal(frame.height, height);
    return frame;
}

size_t for_each_line(const char *folder, void (*visit)(const char *line, size_t number, void *context), void *context)
{
    char *text = file_read(place_below(folder, "ticks.jsonl").path, NULL);
    size_t number = 0;
    for (char *line = text, *end; (end = strchr(line, '\n')) != NULL; line = end + 1, number++) {
        *end = '\0';
        if (visit)
            visit(line, number, context);
    }
    free(text);
    return number;
}

void assert_noted_lines(const char *folder, void (*note)(const char *line, size_t number, void *text),
                        const char *expected)
{
    char noted[64] = "";
    for_each_line(folder, note, noted);
    assert_string_equal(noted, expected);
}

static void parse_line(const char *line, size_t number, void *context)
{
    json_t *object = json_read(line);
    (void)context;
    assert_whole_number(json_member(object, "tick"), number);
    json_decref(object);
}

static void assert_whole_file(const char *folder, const char *name)
{
    const place file = place_below(folder, name);
    if (strstr(name, ".part") != NULL)
        fail_msg("%s is left over", file.path);
    if (strncmp(name, "frame_", 6) == 0) {
        image frame = assert_whole_frame(file.path, SMALL_WIDTH, SMALL_HEIGHT);
        image_release(&frame);
    } else if (strcmp(name, "ticks.jsonl") == 0) {
        for_each_line(folder, parse_line, NULL);
    } else if (strcmp(name, "session.json") == 0) {
        session_file session;
        octreel_error error;
        if (!session_read(file.path, &session, &error))
            fail_msg("%s", error.text);
        session_release(&session);
    } else if (strcmp(name, "index.html") == 0) {
        char *text = file_read(file.path, NULL);
        assert_non_null(strstr(text, "</html>\n"));
        free(text);
    } else {
        char *text = file_read(file.path, NULL);
        json_decref(json_read(text));
        free(text);
    }
}

void assert_nothing_half_written(const char *folder)
{
    listing names = folder_list(folder);
    for (size_t i = 0; i < names.count; i++)
        assert_whole_file(folder, names.names[i]);
    listing_release(&names);
}
