/* axes.c - see axes.h. */
#include "axes.h"
#include "layer.h"
#include "number.h"
#include "text_space.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TICK_SPACE 44     /* units of the picture that a number takes at least */
#define MOST_TICKS 10     /* of one axis, about */
#define TICK_LENGTH 0.012 /* of the box's longest side */
#define END_ON 0.1        /* of its length seen from the side */
#define DIGITS 9          /* of a number */
#define FIRST_ID 1000     /* of the first axis's ticks */

/* The axes of one scene: the box that they run along, and where words are already. */
typedef struct axes {
    scene *scene;
    const octree_box *box;
    double middle[2]; /* the pixel of the box's middle: numbers stand on the other side of their ticks */
    text_space words;
} axes;

static const scene_style axis_style = {.layer = LAYER_WORLD, .role = ROLE_FAINT, .width = 1};

/* The smallest of 1, 2 and 5 times a power of ten that is at least `limit`; 0 where doubles end, at either side. */
static double round_up(double limit)
{
    double power = 1;
    while (power > limit)
        power /= 10;
    while (power > 0 && isfinite(power) && power * 10 <= limit)
        power *= 10;
    const double steps[] = {power, 2 * power, 5 * power, 10 * power};
    for (int i = 0; i < 4; i++)
        if (steps[i] >= limit && isfinite(steps[i]))
            return steps[i];
    return 0;
}

/* Pixels of an axis as seen from its side at the middle of the box: the same wherever an orbit has come to. */
static double side_length(const camera *c, int axis)
{
    double middle = 0;
    for (int i = 0; i < 3; i++)
        middle -= c->eye[i] * c->forward[i];
    return 2 * c->half[axis] * c->zoom / (c->perspective ? fmax(middle, c->near) : 1);
}

/* The distance between numbers; 0 where there is room for none, or none is short enough. */
static double step_of(const axes *a, int axis)
{
    const double extent = a->box->max[axis] - a->box->min[axis];
    const double length = side_length(&a->scene->camera, axis);
    const double count = fmin(floor(length / (TICK_SPACE * a->scene->unit)), MOST_TICKS);
    if (!(extent > 0) || !isfinite(extent) || count < 1)
        return 0;
    const double step = round_up(extent / count);
    const double largest = fmax(fabs(a->box->min[axis]), fabs(a->box->max[axis]));
    return step > 0 && largest / step < 1e8 ? step : 0; /* numbers must be told apart by their digits */
}

/* Beyond the end of a tick, as seen from the middle of the box. */
static bool place_number(axes *a, const double end[3], scene_label *number)
{
    double pixel[2], away[2];
    const int unit = a->scene->unit;
    if (!text_place(a->scene, end, pixel))
        return false;
    for (int i = 0; i < 2; i++)
        away[i] = pixel[i] - a->middle[i];
    const double length = sqrt(away[0] * away[0] + away[1] * away[1]);
    const double reach[2] = {(double)strlen(number->text) * TEXT_LETTER * unit / 2 + unit,
                             TEXT_HEIGHT * unit / 2.0 + unit};
    for (int i = 0; i < 2; i++)
        pixel[i] += length > 0 ? away[i] / length * reach[i] : 0;
    return text_space_take(&a->words, a->scene, number->text, pixel, number->at);
}

/* A short line away from the box, and the number at its end where there is room. */
static void add_tick(axes *a, int axis, double at, uint64_t id)
{
    scene *s = a->scene;
    scene_segment line = {.id = id, .style = axis_style};
    const double length = TICK_LENGTH * (s->camera.size / s->camera.scale);
    for (int i = 0; i < 3; i++) {
        line.ends[0][i] = i == axis ? at : a->box->min[i];
        line.ends[1][i] = i == axis ? at : a->box->min[i] - length;
    }
    scene_label number = {.id = id, .style = axis_style};
    char text[NUMBER_TEXT];
    snprintf(number.text, sizeof number.text, "%s", number_text(at, DIGITS, text));
    scene_add_segment(s, line);
    if (place_number(a, line.ends[1], &number)) {
        text_add_ground(s, &number, ROLE_BACKGROUND);
        scene_add_label(s, number);
    }
}

/* An axis that is seen end on would have all of its numbers at one place. */
static bool is_end_on(const axes *a, int axis)
{
    double end[3], pixels[2][2];
    memcpy(end, a->box->min, sizeof end);
    end[axis] = a->box->max[axis];
    if (!text_place(a->scene, a->box->min, pixels[0]) || !text_place(a->scene, end, pixels[1]))
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

/* The letter at the end of an axis, whose way must be seen to be named. Numbers keep away from it. */
static void add_letter(axes *a, int axis)
{
    if (is_end_on(a, axis))
        return;
    scene_label letter = {.id = (uint64_t)axis, .in_world = true, .style = axis_style, .text = {(char)('x' + axis), 0}};
    double pixel[2], corner[2];
    memcpy(letter.at, a->box->min, sizeof letter.at);
    letter.at[axis] = a->box->max[axis];
    scene_add_label(a->scene, letter);
    if (text_place(a->scene, letter.at, pixel)) {
        pixel[0] += 6 * a->scene->unit; /* where draw puts it */
        text_space_take(&a->words, a->scene, letter.text, pixel, corner);
    }
}

/* Where the box is not the world's, its edges are not drawn otherwise. */
static void add_line(axes *a, int axis)
{
    scene_segment line = {.id = (uint64_t)axis, .style = axis_style};
    memcpy(line.ends[0], a->box->min, sizeof line.ends[0]);
    memcpy(line.ends[1], a->box->min, sizeof line.ends[1]);
    line.ends[1][axis] = a->box->max[axis];
    scene_add_segment(a->scene, line);
}

void add_axes(scene *s, const octree_box *world)
{
    const bool fitted = s->view.fit == FIT_BOX;
    axes a = {.scene = s, .box = fitted ? &s->view.focus : world};
    double center[3];
    for (int i = 0; i < 3; i++)
        center[i] = a.box->min[i] / 2 + a.box->max[i] / 2;
    for (int axis = 0; axis < 3; axis++)
        add_letter(&a, axis);
    for (int axis = 0; fitted && axis < 3; axis++)
        add_line(&a, axis);
    if (view_shows(&s->view, LAYER_TEXT) && text_place(s, center, a.middle))
        for (int axis = 0; axis < 3; axis++)
            add_ticks(&a, axis);
}
