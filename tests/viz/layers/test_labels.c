/* SPDX-License-Identifier: MIT */
/* test_labels.c - tests the addresses on nodes: correct, at their nodes, not overlapping, and left out only for a
 * reason. */
#include "scenes.h"
#include "brute.h"
#include "layout.h"

#include <stdio.h>
#include <string.h>

static octree *clustered(size_t count)
{
    const octree_box world = cube(-1000, 1000);
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 7, &world, count);
    octree *tree = brute_tree(&points, world, 4, 21);
    brute_free(&points);
    return tree;
}

static view labelled(view_camera camera)
{
    view v = view_of(1280, 720, camera, VIEW_ALL_LAYERS);
    v.labels = true;
    return v;
}

static const scene_label *label_of(const scene *s, uint64_t id)
{
    const scene_label *found = NULL;
    for (size_t i = 0; i < s->labels.count; i++) {
        if (s->labels.items[i].style.layer != LAYER_NODES || s->labels.items[i].id != id)
            continue;
        assert_null(found);
        found = &s->labels.items[i];
    }
    return found;
}

/* Compute a node's address from the root down, from the octant of its parent that each cell is. */
static void path_of(octree_address address, char *text)
{
    const octree_box world = cube(-1000, 1000);
    strcpy(text, address == 1 ? "root" : "");
    for (unsigned depth = octree_address_depth(address); depth-- > 0;) {
        const octree_box child = octree_cell_box(&world, address >> 3 * depth);
        const octree_box parent = octree_cell_box(&world, address >> 3 * (depth + 1));
        unsigned octant = 0;
        for (int axis = 0; axis < 3; axis++)
            octant = octant << 1 | (child.min[axis] > parent.min[axis]);
        snprintf(text + strlen(text), 4, "%s%u", text[0] ? "/" : "", octant);
    }
}

/* The room of a text, in pixels: left, top, right, bottom. */
typedef struct room {
    double left, top, right, bottom;
} room;

static room room_of(const scene *s, const char *text, double x, double y)
{
    return (room){x, y, x + (double)strlen(text) * s->text.width, y + s->text.height};
}

static bool overlap(const room *a, const room *b, double slack)
{
    return a->left < b->right + slack && b->left < a->right + slack && a->top < b->bottom + slack &&
           b->top < a->bottom + slack;
}

/* A label may be missing only for a reason: the box is too small, outside the picture, or another label is there. */
static bool has_no_room(const scene *s, const scene_box *box, const char *path)
{
    const double width = (double)strlen(path) * s->text.width, height = s->text.height, slack = 3 * s->unit;
    double middle[3], pixel[2], seen[3];
    for (int i = 0; i < 3; i++)
        middle[i] = (box->box.min[i] + box->box.max[i]) / 2;
    camera_transform(&s->camera, middle, seen);
    if ((s->camera.perspective && seen[2] < s->camera.near) ||
        camera_box_size_in_pixels(&s->camera, &box->box) < width + slack * 3)
        return true;
    camera_project(&s->camera, seen, pixel);
    const room wanted = room_of(s, path, pixel[0] - width / 2, pixel[1] - height / 2);
    if (wanted.left < layout_panel_width(&s->view) + slack || wanted.top < slack ||
        wanted.right > s->view.width - slack || wanted.bottom > s->view.height - slack)
        return true;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const room other = room_of(s, label->text, label->at[0], label->at[1]);
        if (!label->in_world && overlap(&wanted, &other, slack))
            return true;
    }
    return false;
}

static void check_label(const scene *s, const scene_box *box, const scene_label *label)
{
    double middle[3], pixel[2];
    for (int i = 0; i < 3; i++)
        middle[i] = (box->box.min[i] + box->box.max[i]) / 2;
    pixel_of(s, middle, pixel);
    const room taken = room_of(s, label->text, label->at[0], label->at[1]);
    assert_true(taken.left <= pixel[0] && pixel[0] <= taken.right && taken.top <= pixel[1] && pixel[1] <= taken.bottom);
    assert_true(taken.left >= layout_panel_width(&s->view) && taken.right <= s->view.width &&
                taken.bottom <= s->view.height);
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *other = &s->labels.items[i];
        const room theirs = room_of(s, other->text, other->at[0], other->at[1]);
        assert_true(other == label || other->in_world || !overlap(&taken, &theirs, 0));
    }
}

static bool has_ground(const scene *s, const scene_label *label)
{
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        if (panel->style.layer == LAYER_NODES && panel->id == label->id)
            return panel->x <= label->at[0] && panel->y <= label->at[1];
    }
    return false;
}

static bool has_text(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* Returns the number of labels. */
static size_t check_labels(const octree *tree, const view *v)
{
    scene s = {0};
    size_t labels = 0, nodes = 0, grounds = 0;
    build_tree(&s, v, tree, "labels");
    for (size_t i = 0; i < s.boxes.count; i++) {
        const scene_box *box = &s.boxes.items[i];
        if (box->style.layer != LAYER_NODES)
            continue;
        char path[64];
        const scene_label *label = label_of(&s, box->id);
        path_of(box->id, path);
        nodes++;
        if (!label) {
            assert_true(has_no_room(&s, box, path));
            continue;
        }
        assert_string_equal(label->text, path);
        check_label(&s, box, label);
        assert_true(has_ground(&s, label));
        labels++;
    }
    for (size_t i = 0; i < s.panels.count; i++)
        grounds += s.panels.items[i].style.layer == LAYER_NODES;
    char text[SCENE_TEXT];
    snprintf(text, sizeof text, "%zu of %zu fit", labels, nodes);
    assert_int_equal(has_text(&s, text), labels < nodes);
    assert_true(s.tally.labels == labels && grounds == labels);
    scene_release(&s);
    return labels;
}

static void every_node_with_room_is_labelled_with_its_address(void **state)
{
    (void)state;
    octree *tree = clustered(600);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        view v = labelled((view_camera)kind);
        assert_true(check_labels(tree, &v) >= 8);
        v.filter.leaves = true;
        check_labels(tree, &v);
        v.lod = 100;
        v.filter = (view_filter){.slice = 'y', .slice_at = 400};
        check_labels(tree, &v);
    }
    octree_destroy(tree);
}

static void panel_has_no_label_count_when_all_labels_fit(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1000, 1000), 1, 21, OCTREE_GROW);
    insert_all(tree, (const double[][3]){{500, 500, 500}, {-500, -500, -500}}, 2);
    const view v = labelled(CAMERA_ISO);
    assert_int_equal(check_labels(tree, &v), 3);
    octree_destroy(tree);
}

static void labels_are_off_by_default(void **state)
{
    (void)state;
    octree *tree = clustered(50);
    view v = labelled(CAMERA_ISO);
    scene s = {0};
    v.layers &= ~(1u << LAYER_NODES);
    build_tree(&s, &v, tree, "none");
    assert_int_equal(s.tally.labels, 0);
    assert_false(has_text(&s, "root"));
    v = view_make_default();
    build_tree(&s, &v, tree, "none");
    assert_false(has_text(&s, "root"));
    scene_release(&s);
    octree_destroy(tree);
}

/* A label of a shape is drawn even without room. */
static void labels_of_shapes_do_not_overlap(void **state)
{
    (void)state;
    enum { LABELS = 5 };
    octree_shape shapes[LABELS] = {{.at = {0, 0, 0}, .text = "one"},
                                   {.at = {1, 0, 0}, .text = "two, near it"},
                                   {.at = {990, 990, 0}, .text = "a long one, at the very edge of the world"},
                                   {.at = {-990, -1000, 0}, .text = "at an axis"},
                                   {.at = {0, 1, 0}, .text = "three"}};
    octree_session session = small_session(NULL, 0);
    session.tree.world = cube(-1000, 1000);
    session.shapes = shapes;
    session.shape_count = LABELS;
    for (int i = 0; i < LABELS; i++) {
        shapes[i].kind = OCTREE_SHAPE_LABEL;
        shapes[i].tick = OCTREE_EVERY_TICK;
    }
    octree_game *game = start_game(&session);
    for (int small = 0; small < 2; small++) {
        const view v = view_of(small ? 64 : 1280, small ? 48 : 720, CAMERA_TOP, VIEW_DEFAULT_LAYERS);
        scene s = {0};
        build_tick(&s, &v, game);
        size_t found = 0;
        for (size_t i = 0; i < s.labels.count; i++) {
            const scene_label *label = &s.labels.items[i];
            const room own = room_of(&s, label->text, label->at[0], label->at[1]);
            found += label->style.layer == LAYER_SHAPES;
            for (size_t k = 0; label->style.layer == LAYER_SHAPES && !label->in_world && k < s.labels.count; k++) {
                const scene_label *other = &s.labels.items[k];
                const room theirs = room_of(&s, other->text, other->at[0], other->at[1]);
                assert_true(k == i || other->in_world || other->style.layer != LAYER_SHAPES ||
                            !overlap(&own, &theirs, 0));
            }
            assert_true(label->style.layer != LAYER_SHAPES || small || !label->in_world);
        }
        assert_int_equal(found, LABELS);
        scene_release(&s);
    }
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_node_with_room_is_labelled_with_its_address),
        cmocka_unit_test(panel_has_no_label_count_when_all_labels_fit),
        cmocka_unit_test(labels_are_off_by_default),
        cmocka_unit_test(labels_of_shapes_do_not_overlap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
