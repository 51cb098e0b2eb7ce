/* SPDX-License-Identifier: MIT */
/* world_layer.c - the world's box, the view's slice and region, and axes with numbers along the box that the camera
 * frames. */
#include "layer_type.h"
#include "layout.h"
#include "number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TICK_SPACE 44     /* units of the picture that a number takes at least */
#define MOST_TICKS 10     /* of one axis, about */
#define TICK_LENGTH 0.012 /* of the box's longest side */
#define END_ON 0.1        /* of its length seen from the side */
#define DIGITS 9          /* of a number */
#define FIRST_ID 1000     /* of the first axis's ticks */

/* The axes of one scene: the box that they run along, and the room that labels use. */
typedef struct axes {
    scene *scene;
    const octree_box *box;
    double middle[2]; /* the pixel of the box's middle: numbers stand on the other side of their ticks */
    text_space words;
} axes;

static const scene_style axis_style = {.layer = LAYER_WORLD, .role = ROLE_FAINT, .width = 1};

/* Pixels of an axis as seen from its side at the middle of the box: the same wherever an orbit has come to. */
static double side_length(const camera *c, int axis)
{
    double middle = 0;
    for (int i = 0; i < 3; i++)
        middle -= c->eye[i] * c->forward[i];
    return 2 * c->half[axis] * c->zoom / (c->perspective ? fmax(middle, c->near) : 1);
}

/* The distance between numbers; 0 when there is no room or they would need too many digits. */
static double step_of(const axes *a, int axis)
{
    const double extent = a->box->max[axis] - a->box->min[axis];
    const double length = side_length(&a->scene->camera, axis);
    const double count = fmin(floor(length / (TICK_SPACE * a->scene->unit)), MOST_TICKS);
    if (!(extent > 0) || !isfinite(extent) || count < 1)
        return 0;
    const double step = number_round_up(extent / count);
    const double largest = fmax(fabs(a->box->min[axis]), fabs(a->box->max[axis]));
    return step > 0 && largest / step < 1e8 ? step : 0; /* numbers must be told apart by their digits */
}

/* Beyond the end of a tick, as seen from the middle of the box. */
static bool place_number(axes *a, const double end[3], scene_label *number)
{
    double pixel[2], away[2];
    const int unit = a->scene->unit;
    if (!camera_pixel(&a->scene->camera, end, pixel))
        return false;
    for (int i = 0; i < 2; i++)
        away[i] = pixel[i] - a->middle[i];
    const double length = sqrt(away[0] * away[0] + away[1] * away[1]);
    const double reach[2] = {(double)strlen(number->text) * a->scene->text.width / 2 + unit,
                             a->scene->text.height / 2.0 + unit};
    for (int i = 0; i < 2; i++)
        pixel[i] += length > 0 ? away[i] / length * reach[i] : 0;
    return text_space_take(&a->words, a->scene, number->text, pixel, number->at);
}

/* A short line away from the box, and the number at its end where there is room. */
static void add_tick(axes *a, int axis, double at, uint64_t id)
{
    scene *s = a->scene;
    double from[3], to[3];
    const double length = TICK_LENGTH * (s->camera.size / s->camera.scale);
    for (int i = 0; i < 3; i++) {
        from[i] = i == axis ? at : a->box->min[i];
        to[i] = i == axis ? at : a->box->min[i] - length;
    }
    scene_label number = {.id = id, .style = axis_style};
    char text[NUMBER_TEXT];
    snprintf(number.text, sizeof number.text, "%s", number_text(at, DIGITS, text));
    scene_add_line(s, id, from, to, axis_style);
    number.style.stroke = STROKE_CUT;
    if (place_number(a, to, &number))
        scene_add_label(s, number);
}

/* An axis seen end on would have all its numbers at one place. */
static bool is_end_on(const axes *a, int axis)
{
    double end[3], pixels[2][2];
    memcpy(end, a->box->min, sizeof end);
    end[axis] = a->box->max[axis];
    if (!camera_pixel(&a->scene->camera, a->box->min, pixels[0]) || !camera_pixel(&a->scene->camera, end, pixels[1]))
        return false; /* the camera is beside it */
    const double x = pixels[1][0] - pixels[0][0], y = pixels[1][1] - pixels[0][1];
    return sqrt(x * x + y * y) < side_length(&a->scene->camera, axis) * END_ON;
}

static void add_ticks(axes *a, int axis)
{
    const double step = step_of(a, axis);
    if (step == 0 || is_end_on(a, axis))
        return;
    const double first = ceil(a->box->min[axis] / step), last = floor(a->box->max[axis] / step);
    for (double i = first; i <= last; i++) /* + 0.0: no minus zero */
        add_tick(a, axis, i * step + 0.0, (uint64_t)(axis + 1) * FIRST_ID + (uint64_t)(i - first));
}

/* Beyond the end of an axis, on the way from its start. False when there is no room. */
static bool place_letter(axes *a, const double end[3], scene_label *letter)
{
    const scene *s = a->scene;
    double from[2], pixel[2], way[2];
    if (!camera_pixel(&s->camera, a->box->min, from) || !camera_pixel(&s->camera, end, pixel))
        return false;
    for (int i = 0; i < 2; i++)
        way[i] = pixel[i] - from[i];
    const double length = sqrt(way[0] * way[0] + way[1] * way[1]);
    for (int i = 0; i < 2; i++)
        pixel[i] += length > 0 ? way[i] / length * s->text.height * 1.5 : 0;
    return text_space_take(&a->words, s, letter->text, pixel, letter->at);
}

/* The letter at the end of an axis that is not seen end on. Numbers do not cover it. Where there is no room beyond the
 * end, it stands beside it. */
static void add_letter(axes *a, int axis)
{
    if (is_end_on(a, axis))
        return;
    scene_label letter = {.id = (uint64_t)axis, .style = axis_style, .text = {(char)('x' + axis), 0}};
    double end[3];
    letter.style.stroke = STROKE_CUT;
    memcpy(end, a->box->min, sizeof end);
    end[axis] = a->box->max[axis];
    letter.in_world = !place_letter(a, end, &letter);
    if (letter.in_world)
        memcpy(letter.at, end, sizeof letter.at);
    scene_add_label(a->scene, letter);
}

/* If the box is not the world's, nothing else draws its edges. */
static void add_edge(axes *a, int axis)
{
    double end[3];
    memcpy(end, a->box->min, sizeof end);
    end[axis] = a->box->max[axis];
    scene_add_line(a->scene, (uint64_t)axis, a->box->min, end, axis_style);
}

/* Three axes from the lowest corner of the box that the camera frames, each with its letter, and ticks with round
 * numbers where text is shown. The numbers depend on the camera's kind and on the box, not on where an orbit has come
 * to. */
static void add_axes(scene *s, const octree_box *world)
{
    const bool fitted = s->view.fit == FIT_BOX;
    axes a = {.scene = s, .box = fitted ? &s->view.focus : world};
    double center[3];
    scene_box_middle(a.box, center);
    for (int axis = 0; axis < 3; axis++)
        add_letter(&a, axis);
    for (int axis = 0; fitted && axis < 3; axis++)
        add_edge(&a, axis);
    if (view_shows(&s->view, LAYER_TEXT) && camera_pixel(&s->camera, center, a.middle))
        for (int axis = 0; axis < 3; axis++)
            add_ticks(&a, axis);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

enum { WORLD_ID, SLICE_ID, REGION_ID, WORLD_IDS };

static void add_box(scene *s, uint64_t id, const octree_box *box, scene_style style)
{
    scene_add_box(s, (scene_box){.id = id, .box = *box, .style = style});
}

static void add(scene *s, const layer_source *in, view_layer own)
{
    const view_filter *f = &s->view.filter;
    const scene_style dashed = {.layer = (uint8_t)own, .role = ROLE_FAINT, .stroke = STROKE_DASHED, .width = 1};
    octree_box plane = in->world;
    add_box(s, WORLD_ID, &in->world, layer_style(own, STROKE_SOLID, 1));
    if (f->slice) {
        plane.min[f->slice - 'x'] = plane.max[f->slice - 'x'] = f->slice_at;
        add_box(s, SLICE_ID, &plane, dashed);
    }
    if (f->by_region)
        add_box(s, REGION_ID, &f->region, dashed);
    add_axes(s, &in->world);
}

static void describe(description *d, const described *element)
{
    static const char *const boxes[WORLD_IDS] = {"the world", "the slice that the view shows",
                                                 "the region that the view shows"};
    if (element->kind == SCENE_BOX) {
        say(d, "%s, box ", boxes[element->id]);
        say_box(d, &element->box);
    } else if (element->kind == SCENE_SEGMENT && element->id < 3) {
        say(d, "the %c axis", "xyz"[element->id]);
    } else if (element->kind == SCENE_SEGMENT) {
        say(d, "a mark of an axis");
    } else {
        say(d, " of an axis");
    }
}

const layer_type layer_WORLD = {.add = add, .describe = describe};
