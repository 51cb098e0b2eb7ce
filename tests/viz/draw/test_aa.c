/* SPDX-License-Identifier: MIT */
/* test_aa.c - anti-aliasing: each pixel is the mean of its samples, letters stay crisp, and the size of pictures is
 * limited. */
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "frames.h"
#include "images.h"
#include "layer.h"
#include "picture.h"
#include "recordings.h"
#include "tick_lines.h"
#include "ticks_write.h"
#include "image_digest.h"
#include "png_chunks.h"

/* ---- The box filter ----------------------------------------------------------------------------------------- */

static image random_samples(int width, int height, uint64_t *random)
{
    image made;
    assert_true(image_create(&made, width, height, 1));
    made.palette.count = 256;
    for (int i = 0; i < 256; i++)
        made.palette.colors[i] = (image_color){(uint8_t)(i * 7), (uint8_t)(255 - i), (uint8_t)(i * i)};
    for (int i = 0; i < width * height; i++) /* also runs of one colour */
        made.pixels[i] = (uint8_t)(random_below(random, 3) ? (i ? made.pixels[i - 1] : 9) : random_below(random, 256));
    return made;
}

static uint8_t mean(const image *from, int x, int y, int factor, int channel)
{
    double sum = 0;
    for (int i = 0; i < factor * factor; i++) {
        const image_color color = image_color_at(from, x * factor + i % factor, y * factor + i / factor);
        sum += channel == 0 ? color.r : channel == 1 ? color.g : color.b;
    }
    return (uint8_t)(sum / (factor * factor) + 0.5);
}

static void each_pixel_is_the_mean_of_its_samples_rounded_to_the_nearest(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int factor = 1; factor <= 5; factor++) {
        image from = random_samples(factor * 23, factor * 9, &random), small;
        assert_true(image_create(&small, 23, 9, 3) && image_shrink(&from, NULL, factor, &small));
        for (int y = 0; y < 9; y++) {
            for (int x = 0; x < 23; x++) {
                const uint8_t expected[3] = {mean(&from, x, y, factor, 0), mean(&from, x, y, factor, 1),
                                             mean(&from, x, y, factor, 2)};
                const image_color color = image_color_at(&small, x, y);
                assert_true(color.r == expected[0] && color.g == expected[1] && color.b == expected[2]);
            }
        }
        image_release(&small);
        image_release(&from);
    }
}

static void images_of_unfitting_sizes_are_not_reduced(void **state)
{
    (void)state;
    static const struct {
        int width, height, channels, factor;
    } rows[] = {{6, 5, 3, 3}, {6, 5, 1, 2}, {5, 5, 3, 2}, {6, 6, 3, 2}, {12, 10, 3, 0}, {12, 10, 3, -1}, {1, 1, 3, 17}};
    uint64_t random = 4;
    image from = random_samples(12, 10, &random), small;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_true(image_create(&small, rows[i].width, rows[i].height, rows[i].channels));
        assert_false(image_shrink(&from, NULL, rows[i].factor, &small));
        for (int j = 0; j < rows[i].width * rows[i].height * rows[i].channels; j++)
            assert_int_equal(small.pixels[j], 0);
        image_release(&small);
    }
    assert_true(image_create(&small, 6, 5, 3));
    assert_false(image_shrink(&small, NULL, 1, &small)); /* indexed images cannot be reduced */
    image_release(&small);
    image_release(&from);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

static scene tick_scene_of(int width, int height, int aa, unsigned layers)
{
    const octree_session session = octree_session_default();
    view v = view_of(width, height, CAMERA_ORBIT, layers);
    octree_game *game = start_game(&session);
    scene s = {0};
    v.aa = aa;
    for (int tick = 0; tick < 60; tick++)
        play_tick(game);
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    return s;
}

static image picture_of(const scene *s)
{
    picture p;
    octreel_error error = {""};
    if (!picture_open(&p, &s->view, &(renderer_choice){0}, &error) || !picture_draw(&p, s, &error))
        fail_msg("%s", error.text);
    const image drawn = p.frame;
    p.frame.pixels = NULL;
    picture_close(&p);
    return drawn;
}

/* The samples of lines and letters equal the pixels of a picture enlarged by the same factor; for letters if both use
 * the same face. */
static void samples_equal_the_pixels_of_a_larger_picture(void **state)
{
    (void)state;
    enum { LINES = 1 << LAYER_NODES | 1 << LAYER_RANGE };
    static const struct {
        int width, height, aa;
        unsigned layers;
    } cases[] = {{1280, 720, 2, LINES}, {1280, 720, 4, LINES}, {1920, 1080, 2, 1u << LAYER_TEXT}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const int width = cases[i].width, height = cases[i].height, aa = cases[i].aa;
        scene small = tick_scene_of(width, height, aa, cases[i].layers);
        scene large = tick_scene_of(width * aa, height * aa, 1, cases[i].layers);
        small.markers.count = large.markers.count =
            0; /* a marker with an odd number of pixels has another centre when enlarged */
        image drawn = picture_of(&small), samples = picture_of(&large), expected;
        assert_true(image_create(&expected, width, height, 3) && image_shrink(&samples, NULL, aa, &expected));
        const image_difference difference = image_compare(&expected, &drawn);
        assert_true(image_has_no_difference(&difference));
        assert_int_equal(drawn.channels, 3);
        scene_release(&small);
        scene_release(&large);
        image_release(&drawn);
        image_release(&samples);
        image_release(&expected);
    }
}

static void anti_aliasing_leaves_letters_and_panels_crisp(void **state)
{
    (void)state;
    static const int sizes[][2] = {{640, 360}, {1280, 720}, {320, 180}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        scene plain = tick_scene_of(sizes[i][0], sizes[i][1], 1, 1u << LAYER_TEXT);
        image without = picture_of(&plain);
        for (int aa = 2; aa <= 4; aa += 2) {
            scene fine = tick_scene_of(sizes[i][0], sizes[i][1], aa, 1u << LAYER_TEXT);
            image with = picture_of(&fine);
            const image_difference difference = image_compare(&without, &with);
            assert_true(image_has_no_difference(&difference));
            image_release(&with);
            scene_release(&fine);
        }
        image_release(&without);
        scene_release(&plain);
    }
}

/* The sum of brightness above the background. */
static double light_of(const image *drawn)
{
    const theme_color ground = theme_color_at(0);
    double sum = 0;
    for (int i = 0; i < drawn->width * drawn->height; i++) {
        const image_color color = image_color_at(drawn, i % drawn->width, i / drawn->width);
        sum += color.r - ground.r + color.g - ground.g + color.b - ground.b;
    }
    return sum;
}

static void anti_aliasing_keeps_the_size_of_lines_and_markers(void **state)
{
    (void)state;
    static const unsigned layers[] = {LAYER_NODES, LAYER_POINTS, LAYER_PLAYER, LAYER_BOX};
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++) {
        scene plain = tick_scene_of(640, 360, 1, 1u << layers[i]);
        image without = picture_of(&plain);
        for (int aa = 2; aa <= 4; aa += 2) {
            scene fine = tick_scene_of(640, 360, aa, 1u << layers[i]);
            image with = picture_of(&fine);
            const double ratio = light_of(&with) / light_of(&without);
            assert_true(ratio > 0.9 && ratio < 1.1);
            image_release(&with);
            scene_release(&fine);
        }
        image_release(&without);
        scene_release(&plain);
    }
}

/* Sampling belongs to the picture, not to the scene. */
static void anti_aliasing_does_not_change_the_scene(void **state)
{
    (void)state;
    scene plain = tick_scene_of(640, 360, 1, VIEW_ALL_LAYERS), fine = tick_scene_of(640, 360, 4, VIEW_ALL_LAYERS);
    assert_true(scene_digest(&plain) == scene_digest(&fine));
    scene_release(&plain);
    scene_release(&fine);
}

static void pictures_with_too_many_samples_are_refused(void **state)
{
    (void)state;
    enum { LINES = 1 << LAYER_NODES | 1 << LAYER_RANGE };
    static const struct {
        int width, height, aa;
        const char *part;
    } rows[] = {
        {8193, 1, 2,
         "8193 x 1 pixels is too large for 2 x 2 samples per pixel: width and height must each be 1 to 8192 pixels"},
        {1, 4097, 4, "1 to 4096"},
        {16384, 16384, 4, "16384 x 16384"},
        {INT32_MAX, INT32_MAX, 2, "1 to 8192"},
        {0, 5, 2, "1 to"},
        {64, 64, 3, "anti-aliasing must be 1, 2 or 4, not 3"},
        {64, 64, 1000, "anti-aliasing must be 1, 2 or 4, not 1000"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        picture p;
        octreel_error error = {""};
        view v = view_of(rows[i].width, rows[i].height, CAMERA_ISO, VIEW_ALL_LAYERS);
        v.aa = rows[i].aa;
        assert_false(picture_open(&p, &v, &(renderer_choice){0}, &error));
        assert_non_null(strstr(error.text, rows[i].part));
    }
}

static void largest_picture_with_samples_is_drawn_to_its_edges(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    const scene_style style = {.layer = LAYER_TEXT, .role = ROLE_TEXT};
    view v = view_of(4096, 2, CAMERA_ISO, VIEW_ALL_LAYERS);
    v.aa = 4;
    scene s = empty_scene(&v, &world);
    scene_add_panel(&s, (scene_panel){.x = 4095, .y = 1, .width = 1, .height = 1, .style = style});
    image drawn = picture_of(&s);
    const image_color last = image_color_at(&drawn, 4095, 1), before = image_color_at(&drawn, 4094, 1);
    const theme_color text = theme_color_at(theme_color_index(ROLE_TEXT, 0)), ground = theme_color_at(0);
    assert_memory_equal(&last, &text, 3);
    assert_memory_equal(&before, &ground, 3);
    image_release(&drawn);
    scene_release(&s);
}

/* ---- The program -------------------------------------------------------------------------------------------- */

static void anti_aliased_frames_are_rgb_and_carry_their_digests(void **state)
{
    const place film = place_in(*state, "film"), frame = place_below(film.path, "frame_000000.png");
    command_result result = run_octreel(NULL, "record --keys w --size 160x90 --aa 2 -o %s", film.path);
    assert_done(&result);
    command_release(&result);
    image drawn = assert_read(frame.path);
    char text[64], expected[IMAGE_DIGEST_TEXT];
    assert_true(image_read_text(frame.path, "octreel-pixels", text, sizeof text));
    assert_string_equal(text, image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&drawn), expected));
    image_release(&drawn);
    size_t size;
    char *bytes = file_read(frame.path, &size);
    assert_true(size > 26 && bytes[25] == 2); /* IHDR has the colour type RGB */
    free(bytes);
}

static void invalid_aa_options_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {
        {"--aa 3", "1, 2 or 4"},
        {"--aa=", "1, 2 or 4"},
        {"--aa 22", "1, 2 or 4"},
        {"--aa 2 --size 16384x16384", "1 to 8192"},
        {"--aa 4 --size 4097x16", "1 to 4096"},
    };
    const place film = place_in(*state, "film");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "record -o %s %s", film.path, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists(film.path));
    }
}

static void processor_without_vector_instructions_draws_the_same_bytes(void **state)
{
    static const command_setting poor = {.environment = {"GALLIUM_OVERRIDE_CPU_CAPS=nosse", "LP_NUM_THREADS=0"}};
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    command_result result = run_octreel(NULL, "record --camera orbit --every 90 --aa 4 --size 160x90 -o %s", a.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(&poor, "record --fill gl --camera orbit --every 90 --aa 4 --size 160x90 -o %s", b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(a.path, b.path, "renderer.json");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pixel_is_the_mean_of_its_samples_rounded_to_the_nearest),
        cmocka_unit_test(images_of_unfitting_sizes_are_not_reduced),
        cmocka_unit_test(samples_equal_the_pixels_of_a_larger_picture),
        cmocka_unit_test(anti_aliasing_leaves_letters_and_panels_crisp),
        cmocka_unit_test(anti_aliasing_keeps_the_size_of_lines_and_markers),
        cmocka_unit_test(anti_aliasing_does_not_change_the_scene),
        cmocka_unit_test(pictures_with_too_many_samples_are_refused),
        cmocka_unit_test(largest_picture_with_samples_is_drawn_to_its_edges),
        IN_FOLDER(anti_aliased_frames_are_rgb_and_carry_their_digests),
        IN_FOLDER(invalid_aa_options_are_refused_in_one_sentence),
        IN_FOLDER(processor_without_vector_instructions_draws_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
