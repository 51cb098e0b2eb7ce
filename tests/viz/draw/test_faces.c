/* SPDX-License-Identifier: MIT */
/* test_faces.c - the build's program that turns fonts into rectangles: fonts of both versions, releases of Spleen,
 * and files that are not fonts. */
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "glyphs.h"
#include "lettering.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GLYPHS = 256, HEIGHT = 4, HEADER = 32, MOST_HEIGHT = 24, ROOM = HEADER + GLYPHS * 2 * MOST_HEIGHT };

typedef struct font {
    unsigned char bytes[ROOM];
    size_t size;
} font;

static void put(font *f, size_t at, unsigned value)
{
    for (int i = 0; i < 4; i++)
        f->bytes[at + (size_t)i] = (unsigned char)(value >> 8 * i);
}

/* Version 1: letters of 8 x 4 pixels. The first letter has a rectangle of 4 x 2 and a separate pixel. */
static font make_first(void)
{
    font f = {.bytes = {0x36, 0x04, 0, HEIGHT}, .size = 4 + GLYPHS * HEIGHT};
    unsigned char *letter = f.bytes + 4 + GLYPH_FIRST * HEIGHT;
    letter[0] = letter[1] = 0xf0;
    letter[3] = 0x01;
    return f;
}

/* Version 2: empty letters of 12 pixels in width. */
static font make_empty(unsigned height)
{
    font f = {.bytes = {0x72, 0xb5, 0x4a, 0x86}, .size = HEADER + GLYPHS * 2 * height};
    put(&f, 8, HEADER);
    put(&f, 16, GLYPHS);
    put(&f, 20, 2 * height);
    put(&f, 24, height);
    put(&f, 28, 12);
    return f;
}

/* Letters of 12 x 4. The first letter has a line across the border between two bytes. */
static font make_second(void)
{
    font f = make_empty(HEIGHT);
    unsigned char *letter = f.bytes + HEADER + GLYPH_FIRST * 2 * HEIGHT;
    letter[2] = 0x03;
    letter[3] = 0xc0;
    return f;
}

static command_result convert(const temp_folder *own, const font *f)
{
    const place in = place_in(own, "font.psf"), out = place_in(own, "glyphs.c");
    file_write(in.path, f->bytes, f->size);
    return run_script("'%s' %s %s", OCTREEL_FACES_CONVERT, out.path, in.path);
}

static void assert_converted(const temp_folder *own, const font *f, const char *parts, const char *set)
{
    command_result made = convert(own, f);
    assert_done(&made);
    command_release(&made);
    char *text = file_read(place_in(own, "glyphs.c").path, NULL);
    assert_non_null(strstr(text, parts));
    assert_non_null(strstr(text, set));
    free(text);
}

static void letters_are_split_into_the_largest_rectangles_first(void **state)
{
    const font first = make_first(), second = make_second();
    assert_converted(*state, &first, "parts_0[] = {\n{0, 0, 4, 2},\n{7, 3, 1, 1},\n};\n", "{8, 4, parts_0, {0, 2, 2,");
    assert_converted(*state, &second, "parts_0[] = {\n{6, 1, 4, 1},\n};\n", "{12, 4, parts_0, {0, 1, 1,");
}

static unsigned char *find_rows(font *f, char letter)
{
    return f->bytes + HEADER + (unsigned char)letter * 2 * MOST_HEIGHT;
}

/* Letters of 12 x 24 as the frames have them. */
static font make_spleen(void)
{
    const glyph_set *set = &glyph_sets[FACE_12X24];
    font f = make_empty(MOST_HEIGHT);
    for (unsigned i = 0; i < GLYPH_COUNT; i++)
        for (const glyph_part *p = set->parts + set->first[i]; p < set->parts + set->first[i + 1]; p++)
            for (int y = p->y; y < p->y + p->height; y++)
                for (int x = p->x; x < p->x + p->width; x++)
                    find_rows(&f, (char)(GLYPH_FIRST + i))[2 * y + x / 8] |= 128 >> x % 8;
    return f;
}

/* Moves a letter to the left by a pixel, as Spleen 2.2 does with two letters. */
static void move_left(font *f, char letter)
{
    unsigned char *rows = find_rows(f, letter);
    for (int i = 0; i < 2 * MOST_HEIGHT; i++)
        rows[i] = (unsigned char)(rows[i] << 1 | (i % 2 ? 0 : rows[i + 1] >> 7));
}

static void letters_are_the_same_with_every_release_of_spleen(void **state)
{
    const font old = make_spleen();
    font new = old;
    move_left(&new, '<');
    move_left(&new, '}');
    command_result made = convert(*state, &old);
    assert_done(&made);
    command_release(&made);
    char *text = file_read(place_in(*state, "glyphs.c").path, NULL);
    assert_converted(*state, &new, text, "parts_0");
    free(text);
}

static void assert_refused(const temp_folder *own, const font *f, const char *why)
{
    command_result made = convert(own, f);
    assert_int_equal(made.status, 2);
    assert_contains(made.err, why);
    command_release(&made);
}

static void letters_that_frames_do_not_have_are_refused(void **state)
{
    font f = make_spleen();
    move_left(&f, '>');
    assert_refused(*state, &f,
                   "font.psf has glyphs that differ from those in Octreel's frames; download Spleen 2.1.0 from");
}

static void files_that_are_not_fonts_are_refused(void **state)
{
    static const struct {
        size_t at, size; /* 0: do not change the size */
        unsigned value;
        const char *why;
    } rows[] = {
        {0, 0, 0, "is not a console font"},        {28, 0, 17, "larger than 16 x 32 pixels"},
        {24, 0, 33, "larger than 16 x 32 pixels"}, {20, 0, 9, "larger than 16 x 32 pixels"},
        {16, 0, 127 - 32, "is truncated"},         {8, 0, ROOM + 1, "is truncated"},
        {16, 0, GLYPHS + 1, "is truncated"},       {28, HEADER - 1, 12, "is not a console font"},
        {28, 3, 12, "is not a console font"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        font f = make_second();
        put(&f, rows[i].at, rows[i].value);
        f.size = rows[i].size ? rows[i].size : f.size;
        assert_refused(*state, &f, rows[i].why);
    }
    font f = make_first();
    f.bytes[2] = 1; /* a flag for 512 letters */
    assert_refused(*state, &f, "is truncated");
}

/* A size of zero must not cause a division by zero. */
static void letters_without_pixels_are_refused(void **state)
{
    font f = make_second();
    put(&f, 20, 0);
    put(&f, 24, 0);
    assert_refused(*state, &f, "larger than 16 x 32 pixels");
    f = make_first();
    f.bytes[3] = 0;
    assert_refused(*state, &f, "larger than 16 x 32 pixels");
}

static void assert_fails(const char *arguments, const char *why)
{
    command_result made = run_script("'%s' %s", OCTREEL_FACES_CONVERT, arguments);
    assert_int_equal(made.status, 2);
    assert_contains(made.err, why);
    command_release(&made);
}

static void unreadable_and_unwritable_files_are_named(void **state)
{
    const font f = make_first();
    const place in = place_in(*state, "font.psf"), out = place_in(*state, "glyphs.c");
    char arguments[3000];
    file_write(in.path, f.bytes, f.size);
    snprintf(arguments, sizeof arguments, "%s %s.gone", out.path, in.path);
    assert_fails(arguments, "font.psf.gone cannot be read");
    snprintf(arguments, sizeof arguments, "%s/below %s", in.path, in.path);
    assert_fails(arguments, "below cannot be written");
    snprintf(arguments, sizeof arguments, "/dev/full %s", in.path);
    assert_fails(arguments, "/dev/full cannot be written");
    assert_fails(out.path, "expected an output file");
    assert_fails("", "expected an output file");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(letters_are_split_into_the_largest_rectangles_first),
        TEST(letters_are_the_same_with_every_release_of_spleen),
        TEST(letters_that_frames_do_not_have_are_refused),
        TEST(files_that_are_not_fonts_are_refused),
        TEST(letters_without_pixels_are_refused),
        TEST(unreadable_and_unwritable_files_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
