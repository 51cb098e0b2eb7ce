/* SPDX-License-Identifier: MIT */
/* test_scene_digest.c - different draw lists have different digests, and only the list determines the digest. */
#include "scenes.h"

#include <string.h>

/* One element of each kind. */
static scene one_of_each(void)
{
    const view v = view_of(320, 180, CAMERA_ORBIT, VIEW_ALL_LAYERS);
    const octree_box box = {{1, 2, 3}, {4, 5, 6}};
    const scene_style style = {.layer = LAYER_NODES, .role = ROLE_NODE, .stroke = STROKE_DASHED, .width = 3};
    scene s = empty_scene(&v, &box);
    scene_add_box(&s, (scene_box){.id = 1, .box = box, .style = style, .depth = 2});
    scene_add_segment(&s, (scene_segment){.id = 2, .ends = {{1, 2, 3}, {4, 5, 6}}, .style = style});
    scene_add_marker(&s, (scene_marker){.id = 3, .at = {1, 2, 3}, .style = style, .shape = SHAPE_FRAME});
    scene_add_label(&s, (scene_label){.id = 4, .at = {1, 2, 3}, .text = "four", .style = style});
    scene_add_panel(&s, (scene_panel){.id = 5, .x = 1, .y = 2, .width = 3, .height = 4, .style = style});
    return s;
}

/* Change a member, compute the digest, and restore the member. */
static void assert_member_counts(const scene *s, void *member, size_t size, const void *other)
{
    unsigned char kept[sizeof(double)];
    const uint64_t before = scene_digest(s);
    memcpy(kept, member, size);
    memcpy(member, other, size);
    assert_true(scene_digest(s) != before);
    memcpy(member, kept, size);
    assert_true(scene_digest(s) == before);
}

static void assert_doubles_count(const scene *s, double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        assert_member_counts(s, &numbers[i], sizeof *numbers, &(double){next_up(numbers[i])});
        assert_member_counts(s, &numbers[i], sizeof *numbers, &(double){-numbers[i] - 1});
    }
}

static void assert_int_counts(const scene *s, int *number)
{
    assert_member_counts(s, number, sizeof *number, &(int){*number + 1});
    assert_member_counts(s, number, sizeof *number, &(int){-*number - 1});
}

static void assert_byte_counts(const scene *s, uint8_t *byte)
{
    assert_member_counts(s, byte, 1, &(uint8_t){(uint8_t)(*byte ^ 1)});
    assert_member_counts(s, byte, 1, &(uint8_t){(uint8_t)(*byte ^ 128)});
}

static void assert_named_counts(const scene *s, uint64_t *id, scene_style *style)
{
    assert_member_counts(s, id, sizeof *id, &(uint64_t){*id ^ 1});
    assert_member_counts(s, id, sizeof *id, &(uint64_t){*id ^ UINT64_C(1) << 63});
    assert_member_counts(s, &style->layer, 1, &(uint8_t){LAYER_DIAGRAM});
    assert_member_counts(s, &style->role, 1, &(uint8_t){ROLE_RANGE});
    assert_byte_counts(s, &style->stroke);
    assert_byte_counts(s, &style->width);
}

static void every_member_of_every_element_counts(void **state)
{
    (void)state;
    scene s = one_of_each();
    scene_box *box = s.boxes.items;
    assert_named_counts(&s, &box->id, &box->style);
    assert_doubles_count(&s, box->box.min, 3);
    assert_doubles_count(&s, box->box.max, 3);
    assert_byte_counts(&s, &box->depth);
    scene_segment *segment = s.segments.items;
    assert_named_counts(&s, &segment->id, &segment->style);
    assert_doubles_count(&s, segment->ends[0], 3);
    assert_doubles_count(&s, segment->ends[1], 3);
    assert_member_counts(&s, &segment->in_picture, sizeof segment->in_picture, &(bool){true});
    scene_marker *marker = s.markers.items;
    assert_named_counts(&s, &marker->id, &marker->style);
    assert_doubles_count(&s, marker->at, 3);
    assert_byte_counts(&s, &marker->shape);
    scene_label *label = s.labels.items;
    assert_named_counts(&s, &label->id, &label->style);
    assert_doubles_count(&s, label->at, 3);
    assert_member_counts(&s, &label->in_world, sizeof label->in_world, &(bool){true});
    for (size_t i = 0; i <= strlen(label->text); i++)
        assert_member_counts(&s, &label->text[i], 1, "x");
    scene_panel *panel = s.panels.items;
    assert_named_counts(&s, &panel->id, &panel->style);
    assert_int_counts(&s, &panel->x);
    assert_int_counts(&s, &panel->y);
    assert_int_counts(&s, &panel->width);
    assert_int_counts(&s, &panel->height);
    scene_release(&s);
}

static void every_number_of_the_camera_and_the_size_count(void **state)
{
    (void)state;
    scene s = one_of_each();
    camera *c = &s.camera;
    assert_doubles_count(&s, c->origin, 3);
    assert_doubles_count(&s, c->half, 3);
    assert_doubles_count(&s, &c->scale, 1);
    assert_doubles_count(&s, &c->size, 1);
    assert_doubles_count(&s, c->right, 3);
    assert_doubles_count(&s, c->up, 3);
    assert_doubles_count(&s, c->forward, 3);
    assert_doubles_count(&s, c->eye, 3);
    assert_doubles_count(&s, &c->zoom, 1);
    assert_doubles_count(&s, c->middle, 2);
    assert_doubles_count(&s, &c->near, 1);
    assert_doubles_count(&s, &c->near_depth, 1);
    assert_doubles_count(&s, &c->far_depth, 1);
    assert_member_counts(&s, &c->perspective, sizeof c->perspective, &(bool){!c->perspective});
    assert_int_counts(&s, &s.view.width);
    assert_int_counts(&s, &s.view.height);
    assert_int_counts(&s, &s.unit);
    assert_int_counts(&s, &s.text.multiple);
    assert_int_counts(&s, &s.title.multiple);
    assert_member_counts(&s, &s.text.face, sizeof s.text.face, &(text_face){FACE_16X32});
    assert_member_counts(&s, &s.title.face, sizeof s.title.face, &(text_face){FACE_5X8});
    scene_release(&s);
}

static void the_order_and_the_number_of_elements_count(void **state)
{
    (void)state;
    scene s = one_of_each();
    scene_box second = s.boxes.items[0];
    const uint64_t one = scene_digest(&s);
    scene_add_box(&s, second);
    const uint64_t two_alike = scene_digest(&s);
    s.boxes.items[1].id = 9;
    const uint64_t last = scene_digest(&s);
    s.boxes.items[1] = s.boxes.items[0];
    s.boxes.items[0].id = 9;
    const uint64_t first = scene_digest(&s);
    assert_true(one != two_alike && two_alike != last && last != first);
    scene_release(&s);
}

static void a_box_is_not_a_segment_between_its_corners(void **state)
{
    (void)state;
    const octree_box box = cube(-1, 1);
    const view v = view_make_default();
    scene a = empty_scene(&v, &box), b = empty_scene(&v, &box);
    scene_add_box(&a, (scene_box){.id = 1, .box = box});
    scene_add_segment(&b, (scene_segment){.id = 1, .ends = {{-1, -1, -1}, {1, 1, 1}}});
    assert_true(scene_digest(&a) != scene_digest(&b));
    scene_release(&a);
    scene_release(&b);
}

static void memory_and_the_sign_of_zero_do_not_count(void **state)
{
    (void)state;
    scene s = one_of_each(), fresh = one_of_each();
    for (int i = 0; i < 1000; i++)
        scene_add_box(&s, s.boxes.items[0]);
    s.boxes.count = 1;
    memset(s.labels.items[0].text + 5, 'x', SCENE_TEXT - 6); /* after the end of the text */
    assert_true(scene_digest(&s) == scene_digest(&fresh));
    s.markers.items[0].at[0] = 0.0;
    fresh.markers.items[0].at[0] = -0.0;
    assert_true(scene_digest(&s) == scene_digest(&fresh));
    scene_release(&s);
    scene_release(&fresh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_member_of_every_element_counts),
        cmocka_unit_test(every_number_of_the_camera_and_the_size_count),
        cmocka_unit_test(the_order_and_the_number_of_elements_count),
        cmocka_unit_test(a_box_is_not_a_segment_between_its_corners),
        cmocka_unit_test(memory_and_the_sign_of_zero_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
