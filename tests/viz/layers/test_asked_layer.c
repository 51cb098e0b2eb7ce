/* SPDX-License-Identifier: MIT */
/* test_asked_layer.c - tests that the node that `inspect --node` names is marked in the space view and named in the
 * legend. */
#include "scenes.h"

#include <stdio.h>
#include <string.h>

#include "brute.h"
#include "draw_list.h"

typedef struct asking {
    const octree *tree;
    view view;
    size_t small, large;
} asking;

static bool says(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* The layer has the node's box and nothing else, except a mark if the box is too small to be found. */
static octree_walk_order check_asked(const octree_node *node, void *context)
{
    asking *a = context;
    scene s = {0};
    char address[OCTREE_ADDRESS_TEXT], text[SCENE_TEXT];
    double middle[3];
    assert_true(tree_scene_build(&s, &a->view, a->tree, &(tree_subject){.title = "asked", .node = node->address}));
    const layer_counts found = count_layer(&s, LAYER_ASKED);
    const scene_box *box = find_only_box(&s, LAYER_ASKED, node->address);
    assert_true(same_box(&box->box, &node->box));
    assert_true(box->style.role == ROLE_PLAYER && box->style.width == 2);
    for (int i = 0; i < 3; i++)
        middle[i] = node->box.min[i] / 2 + node->box.max[i] / 2;
    const bool small = camera_box_size_in_pixels(&s.camera, &node->box) <= 24;
    assert_int_equal(count_markers_at(&s, LAYER_ASKED, node->address, middle), small);
    assert_true(found.boxes == 1 && found.markers == small && found.segments + found.labels + found.panels == 0);
    snprintf(text, sizeof text, "node %.42s", octree_address_format(node->address, address));
    text[21] = 0; /* no longer than the column */
    if (strlen(address) > 16)
        memcpy(text + 19, "..", 2);
    assert_true(says(&s, text));
    a->small += small;
    a->large += !small;
    scene_release(&s);
    return OCTREE_WALK_ON;
}

static void requested_node_is_marked_and_named(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 7, &world, 300);
    octree *tree = brute_tree(&points, world, 4, OCTREE_MAX_DEPTH);
    for (int camera = 0; camera < CAMERA_COUNT; camera++) {
        asking a = {.tree = tree, .view = view_of(640, 360, (view_camera)camera, VIEW_DEFAULT_LAYERS)};
        octree_walk(tree, check_asked, &a);
        assert_true(a.small > 10 && a.large > 10);
    }
    brute_free(&points);
    octree_destroy(tree);
}

static void nothing_is_marked_without_a_requested_node_or_its_layer(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 7, &world, 30);
    octree *tree = brute_tree(&points, world, 4, OCTREE_MAX_DEPTH);
    for (int i = 0; i < 3; i++) {
        view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        const tree_subject about = {.title = "asked", .node = i == 0 ? 0 : i == 1 ? OCTREE_ROOT : OCTREE_ROOT << 63};
        scene s = {0};
        v.layers &= i == 1 ? ~(1u << LAYER_ASKED) : VIEW_ALL_LAYERS;
        assert_true(tree_scene_build(&s, &v, tree, &about));
        const layer_counts found = count_layer(&s, LAYER_ASKED);
        assert_int_equal(found.boxes + found.segments + found.markers + found.labels, 0);
        assert_false(says(&s, "node root"));
        scene_release(&s);
    }
    brute_free(&points);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(requested_node_is_marked_and_named),
        cmocka_unit_test(nothing_is_marked_without_a_requested_node_or_its_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
