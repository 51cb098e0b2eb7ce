/* SPDX-License-Identifier: MIT */
/* test_layer_mask.c - the mask of layers covers the pixels at which elements of these layers are visible. */
#include "frames.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>

static uint8_t *mask_of(renderer *r, const scene *s, unsigned layers)
{
    octreel_error error = {""};
    const size_t size = (size_t)s->view.width * (size_t)s->view.height;
    uint8_t *mask = malloc(size);
    assert_non_null(mask);
    memset(mask, 255, size);
    if (!renderer_find_layer_mask(r, s, layers, mask, &error))
        fail_msg("%s", error.text);
    return mask;
}

/* A tick of the default session with every layer and the diagram. */
static scene layered_scene(view_camera camera, int aa)
{
    const octree_session session = session_with_all_layers();
    octree_game *game;
    view v = view_of(480, 270, camera, VIEW_ALL_LAYERS);
    scene s = {.refused = 0};
    v.aa = aa;
    v.labels = true;
    v.diagram = DIAGRAM_BESIDE;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    for (int tick = 0; tick < 5; tick++)
        play_tick(game);
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    return s;
}

/* The pixel of a sample. */
static size_t pixel_of_sample(const scene *s, size_t sample)
{
    const size_t side = (size_t)s->view.aa, width = (size_t)s->view.width * side;
    return sample / width / side * (size_t)s->view.width + sample % width / side;
}

/* The test fails unless the mask of a layer covers the samples at which its elements are visible. */
static void check_against_elements(const scene *s, const uint32_t *numbers, unsigned layers, const uint8_t *mask)
{
    const size_t size = (size_t)s->view.width * (size_t)s->view.height;
    uint8_t *expected = calloc(size, 1);
    assert_non_null(expected);
    for (size_t i = 0; i < frame_samples(s); i++)
        if (numbers[i])
            expected[pixel_of_sample(s, i)] |=
                layers >> scene_element_head(s, scene_element_at(s, numbers[i])).style.layer & 1;
    assert_memory_equal(mask, expected, size);
    free(expected);
}

static void mask_covers_visible_elements_of_its_layers(void **state)
{
    (void)state;
    for (int camera = 0; camera < CAMERA_COUNT; camera++) {
        const scene s = layered_scene((view_camera)camera, 1 << camera % 3);
        octreel_error error = {""};
        renderer *r = open_renderer_for(&s);
        uint32_t *numbers = malloc(frame_samples(&s) * sizeof *numbers);
        assert_true(renderer_find_element_numbers(r, &s, numbers, &error));
        for (unsigned layer = 0; layer <= LAYER_DIAGRAM; layer++) {
            const unsigned layers = 1u << layer | 1u << LAYER_PLAYER;
            uint8_t *mask = mask_of(r, &s, layers);
            check_against_elements(&s, numbers, layers, mask);
            free(mask);
        }
        free(numbers);
        renderer_close(r);
        scene_release((scene *)&s);
    }
}

/* Remove the elements of a layer. */
#define LEAVE_OUT(array, unwanted)                                                                                     \
    do {                                                                                                               \
        size_t kept = 0;                                                                                               \
        for (size_t i = 0; i < (array).count; i++)                                                                     \
            if ((array).items[i].style.layer != (unwanted))                                                            \
                (array).items[kept++] = (array).items[i];                                                              \
        (array).count = kept;                                                                                          \
    } while (0)

static void leave_out(scene *s, unsigned layer)
{
    LEAVE_OUT(s->boxes, layer);
    LEAVE_OUT(s->segments, layer);
    LEAVE_OUT(s->markers, layer);
    LEAVE_OUT(s->panels, layer);
    LEAVE_OUT(s->labels, layer);
}

/* The number of samples that a layer changes; the test fails unless all of them are in its mask. */
static size_t check_layer(renderer *r, unsigned layer, int aa)
{
    scene s = layered_scene(CAMERA_ISO, aa);
    uint8_t *mask = mask_of(r, &s, 1u << layer), *with = draw(r, &s);
    size_t changed = 0;
    leave_out(&s, layer);
    uint8_t *without = draw(r, &s);
    for (size_t i = 0; i < frame_samples(&s); i++) {
        changed += with[i] != without[i];
        assert_true(with[i] == without[i] || mask[pixel_of_sample(&s, i)] == 1);
    }
    free(mask);
    free(with);
    free(without);
    scene_release(&s);
    return changed;
}

static void frame_without_a_layer_differs_only_inside_the_mask(void **state)
{
    (void)state;
    for (int aa = 1; aa <= 4; aa *= 2) {
        renderer *r = open_renderer(480 * aa, 270 * aa);
        size_t changed = 0;
        for (unsigned layer = 0; layer <= LAYER_DIAGRAM; layer++)
            changed += check_layer(r, layer, aa);
        assert_true(changed > 10000);
        renderer_close(r);
    }
}

static void scene_of_another_size_is_refused(void **state)
{
    (void)state;
    scene s = layered_scene(CAMERA_TOP, 2);
    octreel_error error = {""};
    uint8_t mask[1];
    renderer *r = open_renderer(64, 64);
    assert_false(renderer_find_layer_mask(r, &s, 1, mask, &error));
    assert_non_null(strstr(error.text, "size"));
    renderer_close(r);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mask_covers_visible_elements_of_its_layers),
        cmocka_unit_test(frame_without_a_layer_differs_only_inside_the_mask),
        cmocka_unit_test(scene_of_another_size_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
