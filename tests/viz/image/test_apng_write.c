/* SPDX-License-Identifier: MIT */
/* test_apng_write.c - an animated PNG, decoded by another decoder, has the pixels and durations that were added, in the
 * smallest rectangles; a failed write leaves no file. */
#include "apng_read.h"
#include "apng_write.h"
#include "color_table.h"
#include "files.h"
#include "fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 61, HEIGHT = 37, PIXELS = WIDTH * HEIGHT, FRAMES = 12 };

/* Random numbers, the same on every machine. */
static unsigned draw(unsigned *seed, unsigned below)
{
    *seed = *seed * 1103515245u + 12345u;
    return (*seed >> 16) % below;
}

/* A picture, changed in a random rectangle. */
static void change(uint8_t *rgb, unsigned *seed, unsigned colors)
{
    const unsigned left = draw(seed, WIDTH), top = draw(seed, HEIGHT), right = left + draw(seed, WIDTH - left),
                   bottom = top + draw(seed, HEIGHT - top);
    for (unsigned y = top; y <= bottom; y++)
        for (unsigned x = left; x <= right; x++)
            if (draw(seed, 4) == 0) {
                const unsigned color = draw(seed, colors);
                uint8_t *to = rgb + 3 * (y * WIDTH + x);
                to[0] = (uint8_t)color;
                to[1] = (uint8_t)(color / 256 * 40);
                to[2] = 7;
            }
}

typedef struct pictures {
    uint8_t rgb[FRAMES][3 * PIXELS];
} pictures;

static pictures *make_pictures(unsigned colors)
{
    unsigned seed = colors;
    pictures *p = calloc(1, sizeof *p);
    assert_non_null(p);
    for (unsigned i = 0; i < PIXELS; i++) /* all colours occur in the first picture */
        p->rgb[0][3 * i] = (uint8_t)(i % colors), p->rgb[0][3 * i + 1] = (uint8_t)(i % colors / 256 * 40),
                      p->rgb[0][3 * i + 2] = 7;
    for (int i = 1; i < FRAMES; i++) {
        memcpy(p->rgb[i], p->rgb[i - 1], sizeof p->rgb[i]);
        if (i != 5) /* picture 5 repeats picture 4 */
            change(p->rgb[i], &seed, colors);
    }
    return p;
}

static void write_film(const pictures *p, const char *path)
{
    static uint8_t indices[PIXELS];
    color_table *table = calloc(1, sizeof *table);
    octreel_error error = {""};
    assert_non_null(table);
    for (int i = 0; i < FRAMES; i++)
        color_table_add(table, p->rgb[i], PIXELS);
    const apng_description about = {WIDTH, HEIGHT, table->is_full ? NULL : &table->palette, FRAMES, 15};
    apng_writer *w = apng_writer_open(path, &about, &error);
    assert_non_null(w);
    for (int i = 0; i < FRAMES; i++) {
        if (!table->is_full)
            color_table_find(table, p->rgb[i], PIXELS, indices);
        assert_true(apng_writer_add(w, table->is_full ? p->rgb[i] : indices, (uint16_t)(i == 3 ? APNG_LONGEST : i + 1),
                                    &error));
    }
    assert_true(apng_writer_close(w, &error));
    free(table);
}

/* The test fails unless the rectangle is the smallest that has all changed pixels. */
static void assert_smallest(const apng_frame *f, const uint8_t *before, const uint8_t *now)
{
    int left = WIDTH, top = HEIGHT, right = 0, bottom = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (memcmp(before + 3 * (y * WIDTH + x), now + 3 * (y * WIDTH + x), 3) != 0) {
                left = x < left ? x : left;
                right = x >= right ? x + 1 : right;
                top = y < top ? y : top;
                bottom = y + 1;
            }
    if (bottom == 0)
        left = top = 0, right = bottom = 1;
    assert_int_equal(f->left, left);
    assert_int_equal(f->top, top);
    assert_int_equal(f->width, right - left);
    assert_int_equal(f->height, bottom - top);
}

static void decoded_frames_are_those_that_were_added(void **state)
{
    static const unsigned colors[] = {1, 2, 9, 255, 256, 257, 1500};
    const place path = place_in(*state, "film.png"), again = place_in(*state, "again.png");
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        pictures *p = make_pictures(colors[i]);
        write_film(p, path.path);
        write_film(p, again.path);
        assert_same_files(path.path, again.path);
        apng_film film = apng_read(path.path);
        assert_int_equal(film.count, FRAMES);
        assert_int_equal(film.plays, 0);
        /* a palette with room has a transparent colour */
        assert_int_equal(film.colors, colors[i] > 256 ? 0 : colors[i] + (colors[i] < 256));
        bool over = false;
        for (size_t j = 0; j < FRAMES; j++) {
            assert_memory_equal(film.frames[j].rgb, p->rgb[j], sizeof p->rgb[j]);
            assert_int_equal(film.frames[j].shown, j == 3 ? APNG_LONGEST : j + 1);
            assert_int_equal(film.frames[j].rate, 15);
            over = over || film.frames[j].over;
            if (j > 0)
                assert_smallest(&film.frames[j], p->rgb[j - 1], p->rgb[j]);
        }
        assert_int_equal(over, colors[i] > 1 && colors[i] < 256);
        apng_release(&film);
        free(p);
    }
}

static void full_disk_is_an_error_and_leaves_no_file(void **state)
{
    const place path = place_in(*state, "film.png");
    pictures *p = make_pictures(1500);
    const apng_description about = {WIDTH, HEIGHT, NULL, FRAMES, 15};
    size_t size;
    write_film(p, path.path);
    free(file_read(path.path, &size));
    assert_int_equal(remove(path.path), 0);
    /* The first limit stops the header, later ones a frame of the film. */
    for (size_t limit = 0; limit < size; limit = limit * 2 + 10) {
        octreel_error error = {""};
        bool ok = true;
        apng_writer *w = apng_writer_open(path.path, &about, &error);
        assert_non_null(w);
        limit_file_size(limit);
        for (int i = 0; ok && i < FRAMES; i++)
            ok = apng_writer_add(w, p->rgb[i], 1, &error);
        ok = ok ? apng_writer_close(w, &error) : apng_writer_discard(w);
        limit_file_size(SIZE_MAX);
        assert_false(ok);
        assert_non_null(strstr(error.text, path.path));
        assert_non_null(strstr(error.text, "cannot be written: File too large"));
        assert_int_equal(temp_folder_count(*state), 0);
    }
    free(p);
}

static void folder_in_place_of_the_file_is_an_error(void **state)
{
    const apng_description about = {WIDTH, HEIGHT, NULL, FRAMES, 15};
    const temp_folder *own = *state;
    octreel_error error = {""};
    assert_null(apng_writer_open(place_below(own->name, "absent/film.png").path, &about, &error));
    assert_non_null(strstr(error.text, "cannot be written"));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(decoded_frames_are_those_that_were_added),
        IN_FOLDER(full_disk_is_an_error_and_leaves_no_file),
        IN_FOLDER(folder_in_place_of_the_file_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
