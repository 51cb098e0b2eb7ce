/* SPDX-License-Identifier: MIT */
/* test_glyphs.c - the letters made from this machine's fonts are the same as on every machine, whichever release of
 * Spleen it has. */
#include "fixture.h"
#include "frames.h"
#include "glyphs.h"
#include "lettering.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MOST_SIDE = 32 };

/* Draw the rectangles of a letter; the test fails if two of them overlap. */
static void fill_letter(const glyph_set *set, unsigned letter, uint8_t pixels[MOST_SIDE * MOST_SIDE])
{
    memset(pixels, 0, MOST_SIDE * MOST_SIDE);
    for (unsigned i = set->first[letter]; i < set->first[letter + 1]; i++) {
        const glyph_part *part = &set->parts[i];
        assert_true(part->width > 0 && part->height > 0);
        assert_true(part->x + part->width <= set->width && part->y + part->height <= set->height);
        for (int y = part->y; y < part->y + part->height; y++)
            for (int x = part->x; x < part->x + part->width; x++)
                assert_int_equal(pixels[y * set->width + x]++, 0);
    }
}

/* The CRC-32 of all letters of a face: one byte for each pixel, 0 or 1, letter by letter and row by row. */
static unsigned long digest_of(const glyph_set *set)
{
    unsigned long digest = crc32(0, NULL, 0);
    for (unsigned letter = 0; letter < GLYPH_COUNT; letter++) {
        uint8_t pixels[MOST_SIDE * MOST_SIDE];
        fill_letter(set, letter, pixels);
        digest = crc32(digest, pixels, (uInt)set->width * set->height);
    }
    return digest;
}

static void every_face_has_the_letters_of_spleen(void **state)
{
    (void)state;
    static const struct {
        uint8_t width, height;
        unsigned long digest;
    } faces[] = {
        {5, 8, 0x7ccb3540}, {6, 12, 0x47666a7c}, {8, 16, 0xbc18ce}, {12, 24, 0xd639b4b2}, {16, 32, 0x1dc550f6}};
    for (int i = 0; i < FACE_COUNT; i++) {
        assert_int_equal(glyph_sets[i].width, faces[i].width);
        assert_int_equal(glyph_sets[i].height, faces[i].height);
        assert_int_equal(glyph_sets[i].first[1], 0); /* the blank */
        assert_int_equal(digest_of(&glyph_sets[i]), faces[i].digest);
    }
}

static const char every_letter[] = "The quick brown fox, 0123456789! (#~)";

/* In a scene, each pixel of a letter is a square of whole pixels, with anti-aliasing and without. */
static void letters_are_drawn_in_whole_pixels(void **state)
{
    (void)state;
    static const int sizes[][2] = {{320, 180}, {640, 360}, {1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}};
    const octree_box world = cube(-1, 1);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        view v = view_of(sizes[i][0], sizes[i][1], CAMERA_ISO, VIEW_ALL_LAYERS);
        v.aa = i % 2 ? 2 : 1;
        scene s = empty_scene(&v, &world);
        scene_label label = {.at = {3, 5}, .style = {.layer = LAYER_TEXT, .role = ROLE_TEXT, .width = 1 + i % 2}};
        strcpy(label.text, every_letter);
        scene_add_label(&s, label);
        const lettering *l = scene_label_lettering(&s, &label);
        const size_t width = (size_t)(v.width * v.aa);
        uint8_t *drawn = draw_once(&s);
        for (size_t letter = 0; letter < strlen(every_letter); letter++) {
            uint8_t pixels[MOST_SIDE * MOST_SIDE];
            fill_letter(&glyph_sets[l->face], (unsigned)(every_letter[letter] - GLYPH_FIRST), pixels);
            for (int y = 0; y < l->height * v.aa; y++)
                for (int x = 0; x < l->width * v.aa; x++) {
                    const size_t across = (size_t)((3 + (int)letter * l->width) * v.aa + x),
                                 down = (size_t)(5 * v.aa + y);
                    const int pixel = l->multiple * v.aa;
                    const bool set = pixels[y / pixel * glyph_sets[l->face].width + x / pixel];
                    if (across < width)
                        assert_int_equal(drawn[down * width + across],
                                         theme_color_index(set ? ROLE_TEXT : ROLE_BACKGROUND, 0));
                }
        }
        free(drawn);
        scene_release(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_face_has_the_letters_of_spleen),
        cmocka_unit_test(letters_are_drawn_in_whole_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
