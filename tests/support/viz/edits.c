/* SPDX-License-Identifier: MIT */
/* edits.c - see edits.h. */
#define _XOPEN_SOURCE 700

#include "edits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "files.h"
#include "fixture.h"
#include "image_digest.h"
#include "png_chunks.h"
#include "png_read.h"
#include "png_write.h"
#include "recordings.h"
#include "theme.h"

/* Write a file of text anew, with `length` bytes at a place replaced. */
static void splice(const char *path, const char *text, size_t size, size_t at, size_t length, const char *to)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(text, 1, at, file);
    fputs(to, file);
    fwrite(text + at + length, 1, size - at - length, file);
    assert_int_equal(fclose(file), 0);
}

static void edit_from(const char *path, size_t start, size_t end, const char *from, const char *to)
{
    size_t size;
    char *text = file_read(path, &size);
    const char *found = strstr(text + start, from);
    if (found == NULL || (size_t)(found - text) + strlen(from) > end)
        fail_msg("%s does not hold \"%s\" there", path, from);
    splice(path, text, size, (size_t)(found - text), strlen(from), to);
    free(text);
}

void edit_file(const char *folder, const char *name, const char *from, const char *to)
{
    edit_from(place_below(folder, name).path, 0, SIZE_MAX, from, to);
}

/* Where a line begins, and the next one. */
static void find_line(const char *path, size_t line, size_t *start, size_t *end)
{
    char *text = file_read(path, NULL), *at = text;
    while (line-- > 0) {
        at = strchr(at, '\n');
        assert_non_null(at);
        at++;
    }
    *start = (size_t)(at - text);
    at = strchr(at, '\n');
    assert_non_null(at);
    *end = (size_t)(at - text) + 1;
    free(text);
}

void edit_line(const char *folder, size_t line, const char *from, const char *to)
{
    const place file = place_below(folder, "ticks.jsonl");
    size_t start, end;
    find_line(file.path, line, &start, &end);
    edit_from(file.path, start, end, from, to);
}

void replace_line(const char *folder, size_t line, const char *text)
{
    const place file = place_below(folder, "ticks.jsonl");
    size_t size, start, end;
    find_line(file.path, line, &start, &end);
    char *all = file_read(file.path, &size);
    splice(file.path, all, size, start, end - start, text);
    free(all);
}

char *copy_line(const char *folder, size_t line)
{
    const place file = place_below(folder, "ticks.jsonl");
    size_t start, end;
    find_line(file.path, line, &start, &end);
    char *all = file_read(file.path, NULL), *copy = strndup(all + start, end - start);
    assert_non_null(copy);
    free(all);
    return copy;
}

void set_file_size(const char *folder, const char *name, size_t size)
{
    assert_int_equal(truncate(place_below(folder, name).path, (off_t)size), 0);
}

void file_copy(const char *folder, const char *from, const char *to)
{
    size_t size;
    char *bytes = file_read(place_below(folder, from).path, &size);
    file_write(place_below(folder, to).path, bytes, size);
    free(bytes);
}

void change_pixel_of_frame(const char *folder, uint64_t tick, size_t pixel, bool as_drawn)
{
    static const char *const keywords[] = {"octreel-tick", "octreel-session", "octreel-scene", "octreel-pixels"};
    char values[4][32];
    image_text texts[4];
    octreel_error error;
    image frame;
    const place file = frame_place(folder, tick);
    assert_true(image_read_png(file.path, &frame, &error));
    for (int i = 0; i < 4; i++) {
        assert_true(image_read_text(file.path, keywords[i], values[i], sizeof values[i]));
        texts[i] = (image_text){keywords[i], values[i]};
    }
    frame.pixels[pixel] = theme_color_index(ROLE_TEXT, 0);
    if (as_drawn)
        image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&frame), values[3]);
    assert_true(image_write_png(&frame, file.path, texts, 4, &error));
    image_release(&frame);
}

void remove_texts_of_frame(const char *folder, uint64_t tick, bool spoilt)
{
    octreel_error error;
    image frame;
    const place file = frame_place(folder, tick);
    assert_true(image_read_png(file.path, &frame, &error));
    if (spoilt)
        frame.pixels[77] = theme_color_index(ROLE_TEXT, 0);
    assert_true(image_write_png(&frame, file.path, NULL, 0, &error));
    image_release(&frame);
}
