/* SPDX-License-Identifier: MIT */
/* test_pick.c - the element that is visible at a sample, compared with the frame itself, with scenes of one element,
 * and with the places of boxes that the camera gives. */
#include "frames.h"
#include "golden_frames.h"
#include "layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t *pick(renderer *r, const scene *s)
{
    uint32_t *numbers = malloc(frame_samples(s) * sizeof *numbers);
    octreel_error error = {""};
    assert_non_null(numbers);
    if (!renderer_find_element_numbers(r, s, numbers, &error))
        fail_msg("%s", error.text);
    return numbers;
}

static scene scene_of(const golden_frame *frame)
{
    scene s;
    octreel_error error = {""};
    if (!golden_scene(frame, &s, &error))
        fail_msg("%s", error.text);
    return s;
}

/* ---- The frame ---------------------------------------------------------------------------------------------- */

static bool has_color_of(const scene *s, uint32_t number, uint8_t index)
{
    if (number == 0)
        return index == 0;
    const scene_style style = scene_element_head(s, scene_element_at(s, number)).style;
    return (index >= theme_color_index(style.role, 0) && index <= theme_color_index(style.role, THEME_SHADES - 1)) ||
           (index == 0 && style.stroke == STROKE_CUT);
}

static void every_sample_of_golden_frames_has_the_colour_of_its_element(void **state)
{
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        scene s = scene_of(&golden_frames[i]);
        renderer *r = open_renderer_for(&s);
        uint8_t *frame = draw(r, &s);
        uint32_t *numbers = pick(r, &s);
        size_t lit = 0;
        for (size_t at = 0; at < frame_samples(&s); at++) {
            lit += numbers[at] != 0;
            if (!has_color_of(&s, numbers[at], frame[at]))
                fail_msg("%s: sample %zu is %d, and element %u is seen there", golden_frames[i].name, at, frame[at],
                         (unsigned)numbers[at]);
        }
        assert_true(lit > 100);
        free(frame);
        free(numbers);
        renderer_close(r);
        scene_release(&s);
    }
}

static void picking_does_not_change_later_frames(void **state)
{
    (void)state;
    scene s = busy_scene(320, 180, CAMERA_FOLLOW);
    renderer *r = open_renderer_for(&s);
    uint8_t *before = draw(r, &s);
    free(pick(r, &s));
    uint8_t *after = draw(r, &s);
    assert_same_frame(before, after, &s);
    free(before);
    free(after);
    renderer_close(r);
    scene_release(&s);
}

/* ---- Elements alone ----------------------------------------------------------------------------------------- */

/* The same scene with only one element, which is not a box. */
static scene alone(const scene *s, scene_element element)
{
    scene one = *s;
    one.kept = NULL;
    memset(&one.boxes, 0, sizeof one.boxes);
    memset(&one.segments, 0, sizeof one.segments);
    memset(&one.markers, 0, sizeof one.markers);
    memset(&one.panels, 0, sizeof one.panels);
    memset(&one.labels, 0, sizeof one.labels);
    switch (element.kind) {
    case SCENE_SEGMENT:
        scene_add_segment(&one, s->segments.items[element.index]);
        break;
    case SCENE_MARKER:
        scene_add_marker(&one, s->markers.items[element.index]);
        break;
    case SCENE_PANEL:
        scene_add_panel(&one, s->panels.items[element.index]);
        break;
    default:
        scene_add_label(&one, s->labels.items[element.index]);
        break;
    }
    return one;
}

/* The test fails unless the element, drawn alone, has the same colour wherever it is visible. */
static void check_alone(renderer *r, const scene *s, const uint8_t *frame, const uint32_t *numbers, uint32_t number)
{
    scene one = alone(s, scene_element_at(s, number));
    uint8_t *drawn = draw(r, &one);
    for (size_t at = 0; at < frame_samples(s); at++)
        if (numbers[at] == number)
            assert_int_equal(drawn[at], frame[at]);
    free(drawn);
    scene_release(&one);
}

static void element_is_picked_only_where_it_is_visible(void **state)
{
    static const char *const names[] = {"collision", "aa", "diagram", "knearest", "radius", "range", "splits"};
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        bool wanted = false;
        for (size_t j = 0; j < sizeof names / sizeof names[0]; j++)
            wanted |= strcmp(golden_frames[i].name, names[j]) == 0;
        if (!wanted)
            continue;
        scene s = scene_of(&golden_frames[i]);
        renderer *r = open_renderer_for(&s);
        uint8_t *frame = draw(r, &s);
        uint32_t *numbers = pick(r, &s);
        const size_t all = s.boxes.count + s.segments.count + s.markers.count + s.panels.count + s.labels.count;
        bool *seen = calloc(all + 1, sizeof *seen);
        for (size_t at = 0; at < frame_samples(&s); at++)
            seen[numbers[at]] = true;
        for (uint32_t number = (uint32_t)s.boxes.count + 1; number <= all; number++)
            if (seen[number])
                check_alone(r, &s, frame, numbers, number);
        free(seen);
        free(frame);
        free(numbers);
        renderer_close(r);
        scene_release(&s);
    }
}

/* Their numbers need three bytes; each element is one pixel. */
static void hundred_thousand_elements_are_distinguished(void **state)
{
    enum { WIDTH = 400, HEIGHT = 300 };
    (void)state;
    const octree_box world = {{-1, -1, -1}, {1, 1, 1}};
    const view v = view_of(WIDTH, HEIGHT, CAMERA_TOP, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &world);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        scene_add_panel(&s, (scene_panel){.x = i % WIDTH,
                                          .y = i / WIDTH,
                                          .width = 1,
                                          .height = 1,
                                          .style = {.layer = LAYER_TEXT, .role = ROLE_PANEL}});
    renderer *r = open_renderer_for(&s);
    uint32_t *numbers = pick(r, &s);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const scene_element element = scene_element_at(&s, numbers[i]);
        assert_int_equal(element.kind, SCENE_PANEL);
        assert_int_equal(element.index, i);
    }
    free(numbers);
    renderer_close(r);
    scene_release(&s);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* The ends of a line in the picture, cut where it is behind the camera. False: it is entirely behind. */
static bool see_line(const scene *s, const double from[3], const double to[3], double a[2], double b[2])
{
    const camera *c = &s->camera;
    double seen[2][3];
    camera_transform(c, from, seen[0]);
    camera_transform(c, to, seen[1]);
    for (int end = 0; c->perspective && end < 2; end++) {
        double *near = seen[end], *other = seen[1 - end];
        if (near[2] >= c->near)
            continue;
        if (other[2] < c->near)
            return false;
        const double part = (c->near - near[2]) / (other[2] - near[2]);
        for (int i = 0; i < 3; i++)
            near[i] += part * (other[i] - near[i]);
    }
    camera_project(c, seen[0], a);
    camera_project(c, seen[1], b);
    return true;
}

/* The distance of a place in the picture from a line. */
static double distance_to_line(const scene *s, const double from[3], const double to[3], const double place[2])
{
    double a[2], b[2];
    if (!see_line(s, from, to, a, b))
        return INFINITY;
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, square = along[0] * along[0] + along[1] * along[1];
    double part = square > 0 ? ((place[0] - a[0]) * along[0] + (place[1] - a[1]) * along[1]) / square : 0;
    part = part < 0 ? 0 : part > 1 ? 1 : part;
    const double x = a[0] + part * along[0] - place[0], y = a[1] + part * along[1] - place[1];
    return sqrt(x * x + y * y);
}

/* The distance of a place in the picture from the nearest edge of a box. */
static double distance_to_box(const scene *s, const octree_box *box, const double place[2])
{
    double nearest = INFINITY;
    for (unsigned corner = 0; corner < 8; corner++) {
        for (unsigned axis = 0; axis < 3; axis++) {
            double from[3], to[3];
            if (corner >> axis & 1)
                continue;
            box_corner(box, corner, from);
            box_corner(box, corner | 1u << axis, to);
            nearest = fmin(nearest, distance_to_line(s, from, to, place));
        }
    }
    return nearest;
}

static void check_places_of_boxes(const scene *s)
{
    renderer *r = open_renderer_for(s);
    uint32_t *numbers = pick(r, s);
    const size_t samples = (size_t)s->view.aa, width = (size_t)s->view.width * samples;
    size_t boxes = 0;
    for (size_t at = 0; at < frame_samples(s); at++) {
        const scene_element element =
            numbers[at] ? scene_element_at(s, numbers[at]) : (scene_element){.kind = SCENE_LABEL};
        if (element.kind != SCENE_BOX)
            continue;
        const scene *own = scene_containing(s, element);
        const int *corner = element.in_closeup ? own->place : (const int[2]){0, 0};
        const double place[2] = {((double)(at % width) + 0.5) / (double)samples - corner[0],
                                 ((double)(at / width) + 0.5) / (double)samples - corner[1]};
        const scene_box *box = &own->boxes.items[element.index];
        const double off = distance_to_box(own, &box->box, place);
        if (off > 0.5 * box->style.width * own->unit + 1)
            fail_msg("box %zu is %g pixels from (%g, %g)", element.index, off, place[0], place[1]);
        boxes++;
    }
    assert_true(boxes > 100);
    free(numbers);
    renderer_close(r);
}

static void box_is_picked_only_at_its_edges(void **state)
{
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        scene s = scene_of(&golden_frames[i]);
        if (s.boxes.count)
            check_places_of_boxes(&s);
        scene_release(&s);
    }
}

static scene_box node_of(octree_address id, double x0, double x1, uint8_t depth)
{
    return (scene_box){.id = id,
                       .box = {{x0, -50, -50}, {x1, 50, 50}},
                       .depth = depth,
                       .style = {.layer = LAYER_NODES, .role = (uint8_t)theme_node_role(depth), .width = 1}};
}

/* The edges of a row of cells in one colour are merged into one stroke. Each of its pixels belongs to the cell at that
 * place, or to the whole row if that is a box, too. */
static void check_row(view_camera camera, bool within)
{
    enum { CELLS = 8, STEPS = 640 };
    const octree_box world = {{-100, -100, -100}, {100, 100, 100}};
    const view v = view_of(320, 240, camera, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &world);
    for (int i = 0; i < CELLS; i++)
        scene_add_box(&s, node_of((octree_address)(i + 1), -80 + 20 * i, -60 + 20 * i, 3));
    if (within)
        scene_add_box(&s, node_of(100, -80, 80, 2));
    renderer *r = open_renderer_for(&s);
    uint32_t *numbers = pick(r, &s);
    double depths[2][3]; /* depths of the upper edges along x; no other edge crosses the nearer one */
    camera_transform(&s.camera, (double[]){0, -50, 50}, depths[0]);
    camera_transform(&s.camera, (double[]){0, 50, 50}, depths[1]);
    const double y = depths[0][2] <= depths[1][2] ? -50 : 50;
    size_t checked = 0;
    for (int at = 0; at < CELLS * STEPS; at++) {
        double pixel[2];
        if (at % STEPS < STEPS / 8 || at % STEPS > STEPS * 7 / 8)
            continue; /* several edges meet in corners */
        const double x = -80 + 20.0 * at / STEPS, place[3] = {x, y, 50};
        pixel_of(&s, place, pixel);
        const double off[2] = {pixel[0] - floor(pixel[0]) - 0.5, pixel[1] - floor(pixel[1]) - 0.5};
        if (fabs(off[0]) > 0.2 || fabs(off[1]) > 0.2)
            continue; /* after rounding the line may draw the pixel beside it */
        if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= v.width || pixel[1] >= v.height)
            continue;
        const size_t sample = (size_t)pixel[1] * (size_t)v.width + (size_t)pixel[0];
        assert_true(numbers[sample] != 0);
        const scene_element element = scene_element_at(&s, numbers[sample]);
        assert_int_equal(element.kind, SCENE_BOX);
        if (scene_element_head(&s, element).id != (within ? 100u : (unsigned)at / STEPS + 1))
            fail_msg("camera %d: box %d at x = %g", (int)camera, (int)scene_element_head(&s, element).id, x);
        checked++;
    }
    assert_true(checked > 200);
    free(numbers);
    renderer_close(r);
    scene_release(&s);
}

static void pixels_of_a_merged_edge_belong_to_the_box_at_that_place(void **state)
{
    (void)state;
    check_row(CAMERA_FRONT, false);
    check_row(CAMERA_TOP, false);
    check_row(CAMERA_ORBIT, false);
    check_row(CAMERA_ISO, false);
}

static void shared_edge_belongs_to_the_shallowest_box(void **state)
{
    (void)state;
    check_row(CAMERA_FRONT, true);
    check_row(CAMERA_ORBIT, true);
}

/* ---- Numbers and refusals ----------------------------------------------------------------------------------- */

static void element_numbers_and_elements_map_both_ways(void **state)
{
    (void)state;
    scene s = busy_scene(320, 180, CAMERA_ISO);
    const size_t counts[SCENE_KINDS] = {s.boxes.count, s.segments.count, s.markers.count, s.panels.count,
                                        s.labels.count};
    uint32_t number = 0;
    for (scene_kind kind = SCENE_BOX; kind < SCENE_KINDS; kind++) {
        assert_true(counts[kind] > 0);
        for (size_t index = 0; index < counts[kind]; index++) {
            const scene_element element = scene_element_at(&s, ++number);
            assert_int_equal(element.kind, kind);
            assert_int_equal(element.index, index);
            assert_int_equal(scene_element_number(&s, element), number);
        }
    }
    scene_release(&s);
}

static void scene_of_another_size_is_refused(void **state)
{
    (void)state;
    scene s = busy_scene(320, 180, CAMERA_ISO);
    renderer *r = open_renderer(160, 90);
    uint32_t number;
    octreel_error error = {""};
    assert_false(renderer_find_element_numbers(r, &s, &number, &error));
    assert_non_null(strstr(error.text, "size"));
    renderer_close(r);
    scene_release(&s);
}

static void empty_scene_is_all_background(void **state)
{
    (void)state;
    const octree_box world = {{-1, -1, -1}, {1, 1, 1}};
    const view v = view_of(20, 10, CAMERA_TOP, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &world);
    renderer *r = open_renderer_for(&s);
    uint32_t *numbers = pick(r, &s);
    for (size_t i = 0; i < frame_samples(&s); i++)
        assert_int_equal(numbers[i], 0);
    free(numbers);
    renderer_close(r);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sample_of_golden_frames_has_the_colour_of_its_element),
        cmocka_unit_test(picking_does_not_change_later_frames),
        cmocka_unit_test(element_is_picked_only_where_it_is_visible),
        cmocka_unit_test(hundred_thousand_elements_are_distinguished),
        cmocka_unit_test(box_is_picked_only_at_its_edges),
        cmocka_unit_test(pixels_of_a_merged_edge_belong_to_the_box_at_that_place),
        cmocka_unit_test(shared_edge_belongs_to_the_shallowest_box),
        cmocka_unit_test(element_numbers_and_elements_map_both_ways),
        cmocka_unit_test(scene_of_another_size_is_refused),
        cmocka_unit_test(empty_scene_is_all_background),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
