/* SPDX-License-Identifier: MIT */
/* test_picture_file.c - a picture's file is opaque, has no gamma, and contains the drawn pixels. */
#include <string.h>

#include "files.h"
#include "fixture.h"
#include "images.h"
#include "picture.h"
#include "png_by_hand.h"
#include "scenes.h"

/* Draw a busy scene with this number of samples, write it, and leave it open. */
static picture write_picture(int samples, const char *path)
{
    picture p;
    octreel_error error = {""};
    scene s = busy_scene(320, 180, CAMERA_ORBIT);
    s.view.aa = samples;
    const image_text text = {"octreel-tick", "30"};
    if (!picture_open(&p, &s.view, &(renderer_choice){0}, &error) || !picture_draw(&p, &s, &error) ||
        !image_write_png(&p.frame, path, &text, 1, &error))
        fail_msg("%s", error.text);
    scene_release(&s);
    return p;
}

static void decoded_pixels_equal_the_drawn_pixels(void **state)
{
    const place file = place_in(*state, "frame.png");
    for (int samples = 1; samples <= 4; samples *= 2) {
        picture p = write_picture(samples, file.path);
        image read = assert_read_rgb(file.path);
        size_t lit = 0;
        for (size_t i = 0; i < 320 * 180; i++) {
            const uint8_t *drawn = p.frame.pixels + (samples > 1 ? 3 * i : i);
            const theme_color color =
                samples > 1 ? (theme_color){drawn[0], drawn[1], drawn[2]} : theme_color_at(*drawn);
            const uint8_t expected[3] = {color.r, color.g, color.b};
            assert_memory_equal(read.pixels + 3 * i, expected, 3);
            lit += memcmp(expected, read.pixels, 3) != 0;
        }
        assert_true(lit > 1000);
        image_release(&read);
        picture_close(&p);
    }
}

/* No alpha, and no gamma, profile or date that could change a colour or a byte. */
static void file_is_opaque_and_has_no_colour_profile(void **state)
{
    static const char allowed[] = "IHDR PLTE tEXt IDAT IEND";
    static png_bytes bytes;
    const place file = place_in(*state, "frame.png");
    for (int samples = 1; samples <= 2; samples++) {
        picture p = write_picture(samples, file.path);
        picture_close(&p);
        png_bytes_load(&bytes, file.path);
        const png_chunk header = png_chunk_of(&bytes, "IHDR");
        assert_int_equal(header.data[8], 8);
        assert_int_equal(header.data[9], samples > 1 ? 2 : 3); /* RGB, or a palette */
        for (size_t at = 8; at < bytes.size;) {
            const png_chunk chunk = png_chunk_at(&bytes, at);
            if (strstr(allowed, chunk.type) == NULL)
                fail_msg("there is a chunk %s", chunk.type);
            at = chunk.next;
        }
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(decoded_pixels_equal_the_drawn_pixels),
        IN_FOLDER(file_is_opaque_and_has_no_colour_profile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
