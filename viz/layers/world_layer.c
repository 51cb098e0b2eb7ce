/* SPDX-License-Identifier: MIT */
/* world_layer.c - the layer of the world. It shows the world's box, the view's slice and region, and axes with numbers
 * along the box that the camera frames.
 *
 * A zoomed picture shows only a part of the framed box, whose edges may lie outside the picture. So the axes of a view
 * with a zoom or a center run along a smaller box around the center: the framed box divided by the zoom. In the picture
 * the smaller box is as large as the framed box would be without zoom, so that there is as much room for numbers. A bar
 * shows the scale. */
#include "layer_type.h"
#include "layout.h"
#include "number.h"
#include "scale_bar.h"

#include <math.h>
#include <string.h>

/* Minimum distance between numbers on an axis that is horizontal in the picture, in picture units. */
#define TICK_SPACE 40
#define UPRIGHT_SPACE 2   /* minimum distance between numbers on a vertical axis, in lines of text */
#define MOST_TICKS 10     /* maximum number of intervals between numbers on an axis */
#define TICK_LENGTH 0.012 /* length of a tick mark, as a part of the box's longest side */
/* An axis is seen end on if its length in the picture is less than this part of the length that it would have if seen
 * from the side. */
#define END_ON_RATIO 0.1
#define DIGITS 9      /* significant digits of a printed number */
#define FIRST_ID 1000 /* the id of the first tick mark of the x axis */
/* rounding tolerance: a corner may lie this many pixels beyond the line of an edge on the outline */
#define OUTLINE 1e-3
/* When choose_edge() rates the edges for a horizontal axis, being low in the picture counts this many times as much as
 * being at its left. */
#define LOWEST 16
#define SCALE_ID 100
/* The part of the framed box that a zoomed picture of the follow camera shows. The other cameras show the whole box. */
#define FOLLOWED_PART 0.3
#define ROOM 40 /* weight of room for a number at one end of the edge when choose_edge() rates the edges */

/* The axes of one scene. In the number of a corner, bit i is set if the corner is at the upper end of axis i. */
typedef struct axes {
    scene *scene;
    octree_box box;       /* the box that the axes run along */
    double half[3];       /* half the extent of `box` on each axis, in unit coordinates */
    double corners[8][2]; /* pixel of each corner */
    bool whole;           /* true: all corners are in front of the camera */
    text_space words;     /* the part of the picture that labels already cover */
} axes;

/* The edge of the box that an axis runs along. */
typedef struct axis_edge {
    int axis;
    /* corner of the box at the lower end of the edge: bit i is set if the corner is at the upper end of axis i */
    unsigned corner;
    /* The unit vector in the picture that is normal to the edge and points away from the box. 0 if no edge lies on the
     * outline of the box. */
    double out[2];
} axis_edge;

static const scene_style axis_style = {.layer = LAYER_WORLD, .role = ROLE_FAINT, .width = 1};

/* Return the length in pixels that an axis would have if seen from the side, at the distance of the box's middle. The
 * length stays the same while the camera orbits. */
static double side_length(const axes *a, int axis)
{
    const camera *c = &a->scene->camera;
    double middle = 0;
    for (int i = 0; i < 3; i++)
        middle -= c->eye[i] * c->forward[i];
    return 2 * a->half[axis] * c->zoom / (c->perspective ? fmax(middle, c->near) : 1);
}

/* Return the distance between two neighbouring numbers on an axis, in world units. Return 0 if there is no room for
 * numbers, or if the numbers would need too many digits. */
static double choose_number_step(const axes *a, int axis)
{
    const double extent = a->box.max[axis] - a->box.min[axis];
    const double length = side_length(a, axis);
    const double space = axis == 2 ? UPRIGHT_SPACE * a->scene->text.line : TICK_SPACE * a->scene->unit;
    const double count = fmin(floor(length / space), MOST_TICKS);
    if (!(extent > 0) || !isfinite(extent) || count < 1)
        return 0;
    const double step = number_round_up_to_1_2_5(extent / count);
    const double largest = fmax(fabs(a->box.min[axis]), fabs(a->box.max[axis]));
    /* With a smaller step, the printed digits of two neighbouring numbers could be the same. */
    return step > 0 && largest / step < 1e8 ? step : 0;
}

/* ---- Choosing edges ------------------------------------------------------------------------------------------ */

/* Return whether an edge lies on the outline of the box: no corner of the box lies beyond the line through the pixel
 * `at` with the normal `out`. */
static bool is_on_outline(const axes *a, const double at[2], const double out[2])
{
    for (int i = 0; i < 8; i++)
        if ((a->corners[i][0] - at[0]) * out[0] + (a->corners[i][1] - at[1]) * out[1] > OUTLINE)
            return false;
    return true;
}

/* Return whether a number beside the end `at` of an edge fits into the space view. */
static bool has_room(const axes *a, const double at[2], const double out[2])
{
    const camera_window w = layout_space_area(a->scene);
    const double x = at[0] + out[0] * layout_count_number_letters(&a->box) * a->scene->text.width - w.x;
    const double y = at[1] + out[1] * 2 * a->scene->text.height - w.y;
    return x >= 0 && y >= 0 && x <= w.width && y <= w.height;
}

/* Choose the edge along which an axis runs. The edge lies on the outline of the box, so that numbers stand beside the
 * box and not on its contents. Each of the four parallel edges is rated, with the numbers on either side of it. Room
 * for numbers at the edge's ends counts most, then, for a level axis, a low position, and then a position at the left.
 * If the camera is inside the box, no edge lies on the outline, and the result is the edge at corner 0. */
static axis_edge choose_edge(const axes *a, int axis)
{
    axis_edge edge = {.axis = axis};
    double most = -INFINITY;
    for (unsigned i = 0; a->whole && i < 16; i++) {
        const unsigned corner = i / 2;
        const double *from = a->corners[corner], *to = a->corners[corner | 1u << axis];
        const double x = to[0] - from[0], y = to[1] - from[1], length = (i % 2 ? -1 : 1) * sqrt(x * x + y * y);
        const double out[2] = {y / length, -x / length};
        const double worth =
            (axis == 2 ? 0 : LOWEST) * out[1] - out[0] + ROOM * (has_room(a, from, out) + has_room(a, to, out));
        if (corner >> axis & 1 || !(worth > most) || !is_on_outline(a, from, out))
            continue;
        most = worth;
        edge.corner = corner;
        memcpy(edge.out, out, sizeof out);
    }
    return edge;
}

/* Return whether an axis gets neither a name nor numbers. The numbers of an axis that is seen end on would all be at
 * the same place. If no edge lies on the outline, the numbers would stand on the contents of the box. */
static bool is_axis_unlabelled(const axes *a, const axis_edge *e)
{
    const double *from = a->corners[e->corner], *to = a->corners[e->corner | 1u << e->axis];
    const double x = to[0] - from[0], y = to[1] - from[1];
    const bool inside = e->out[0] == 0 && e->out[1] == 0;
    return a->whole && (inside || sqrt(x * x + y * y) < side_length(a, e->axis) * END_ON_RATIO);
}

/* ---- Tick marks and axis names ------------------------------------------------------------------------------ */

/* Place a number beyond the end of its tick mark, on the side away from the edge. If the camera is inside the box, the
 * number continues the direction of the tick mark. Return false if there is no room. */
static bool place_number(axes *a, const axis_edge *e, double tick[2][3], scene_label *number)
{
    double from[2], pixel[2], out[2];
    const scene *s = a->scene;
    if (!camera_find_pixel(&s->camera, tick[0], from) || !camera_find_pixel(&s->camera, tick[1], pixel))
        return false;
    const double x = pixel[0] - from[0], y = pixel[1] - from[1], length = sqrt(x * x + y * y);
    out[0] = a->whole ? e->out[0] : x / length;
    out[1] = a->whole ? e->out[1] : y / length;
    const double reach =
        (fabs(out[0]) * (double)strlen(number->text) * s->text.width + fabs(out[1]) * s->text.height) / 2 + s->unit;
    for (int i = 0; i < 2; i++)
        pixel[i] += out[i] * reach;
    return text_space_reserve_text(&a->words, s, number->text, pixel, number->at);
}

/* Return the longest side of the axes' box, in world units. */
static double longest_side(const axes *a)
{
    return fmax(a->half[0], fmax(a->half[1], a->half[2])) * a->scene->camera.size / a->scene->camera.scale;
}

/* Add a tick mark that points away from the box. Add a number at the tick mark's end if there is room. */
static void add_tick(axes *a, const axis_edge *e, double at, uint64_t id)
{
    scene *s = a->scene;
    double ends[2][3];
    const double length = TICK_LENGTH * longest_side(a);
    box_corner(&a->box, e->corner, ends[0]);
    for (int i = 0; i < 3; i++)
        ends[1][i] = ends[0][i] + (e->corner >> i & 1 ? length : -length);
    ends[0][e->axis] = ends[1][e->axis] = at;
    char text[NUMBER_TEXT];
    scene_label number = scene_make_label(id, axis_style, "%s", number_format(at, DIGITS, text));
    scene_add_line(s, id, ends[0], ends[1], axis_style);
    number.style.stroke = STROKE_CUT;
    if (place_number(a, e, ends, &number))
        scene_add_label(s, number);
}

static void add_ticks(axes *a, const axis_edge *e)
{
    const int axis = e->axis;
    const double step = choose_number_step(a, axis);
    if (step == 0 || is_axis_unlabelled(a, e) || !isfinite(longest_side(a)))
        return;
    const double first = ceil(a->box.min[axis] / step), last = floor(a->box.max[axis] / step);
    for (double i = first; i <= last; i++) /* adding 0.0 turns -0 into 0 */
        add_tick(a, e, i * step + 0.0, (uint64_t)(axis + 1) * FIRST_ID + (uint64_t)(i - first));
}

/* Place the name of an axis, x, y or z, beyond the end of the axis. Return false if there is no room. */
static bool place_axis_name(axes *a, double ends[2][3], scene_label *letter)
{
    const scene *s = a->scene;
    double from[2], pixel[2], direction[2];
    if (!camera_find_pixel(&s->camera, ends[0], from) || !camera_find_pixel(&s->camera, ends[1], pixel))
        return false;
    for (int i = 0; i < 2; i++)
        direction[i] = pixel[i] - from[i];
    const double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
    for (int i = 0; i < 2; i++)
        pixel[i] += length > 0 ? direction[i] / length * s->text.height * 1.25 : 0;
    return text_space_reserve_text(&a->words, s, letter->text, pixel, letter->at);
}

/* Add the name of an axis, x, y or z, at the axis's end, unless is_axis_unlabelled() is true. Numbers do not cover the
 * name. If there is no room beyond the end, the name stands at the end itself. If `draws_edge` is true, also draw the
 * axis's edge; no other function draws the edges of a box that is not the world's box. */
static void add_axis(axes *a, const axis_edge *e, bool draws_edge)
{
    scene_label letter = scene_make_label((uint64_t)e->axis, axis_style, "%c", "xyz"[e->axis]);
    double ends[2][3];
    box_corner(&a->box, e->corner, ends[0]);
    box_corner(&a->box, e->corner | 1u << e->axis, ends[1]);
    if (draws_edge)
        scene_add_line(a->scene, (uint64_t)e->axis, ends[0], ends[1], axis_style);
    if (is_axis_unlabelled(a, e))
        return;
    letter.style.stroke = STROKE_CUT;
    letter.in_world = !place_axis_name(a, ends, &letter);
    if (letter.in_world)
        memcpy(letter.at, ends[1], sizeof letter.at);
    scene_add_label(a->scene, letter);
}

/* Replace the box of the axes by its part around the camera's center that a zoomed or moved picture shows. If the
 * center is far outside the box, take a box of this size around the center. */
static void narrow_to_picture(axes *a)
{
    const scene *s = a->scene;
    const double part = (s->camera.follows ? FOLLOWED_PART : 1) / s->view.zoom;
    for (int i = 0; i < 3; i++) {
        const double reach = (a->box.max[i] / 2 - a->box.min[i] / 2) * part;
        const double low = s->camera.center[i] - reach, high = s->camera.center[i] + reach;
        const bool outside = low >= a->box.max[i] || high <= a->box.min[i];
        a->box.min[i] = outside ? low : fmax(a->box.min[i], low);
        a->box.max[i] = outside ? high : fmin(a->box.max[i], high);
        a->half[i] = (a->box.max[i] * s->camera.scale - a->box.min[i] * s->camera.scale) / s->camera.size;
    }
}

/* Add a bar with a round length at the lower left of the space view. */
static void add_scale_bar(scene *s)
{
    const camera_window w = layout_space_area(s);
    const int margin = SCALE_BAR_MARGIN * s->unit;
    scale_bar_add(s, LAYER_WORLD, SCALE_ID, (const int[]){(int)w.x + margin, (int)(w.y + w.height) - margin},
                  w.width / 6, "");
}

/* Add three axes along edges of the box that the camera frames; in a zoomed picture, along edges of the visible part of
 * this box. Each axis has its name and, if the view shows text, tick marks with round numbers. The step between numbers
 * depends only on the box and the kind of camera, so that it stays the same while the camera orbits. */
static void add_axes(scene *s, const octree_box *world)
{
    const bool fitted = s->view.fit == FIT_BOX, zoomed = s->view.zoom > 1 || s->view.center.given,
               numbered = view_shows_layer(&s->view, LAYER_TEXT);
    axes a = {.scene = s, .box = fitted ? s->view.focus : *world, .whole = true};
    axis_edge edges[3];
    memcpy(a.half, s->camera.half, sizeof a.half);
    if (zoomed && numbered)
        add_scale_bar(s);
    if (zoomed)
        narrow_to_picture(&a);
    a.words = text_space_make(s);
    for (unsigned i = 0; i < 8; i++) {
        double at[3];
        box_corner(&a.box, i, at);
        a.whole &= camera_find_pixel(&s->camera, at, a.corners[i]);
    }
    for (int axis = 0; axis < 3; axis++) {
        edges[axis] = choose_edge(&a, axis);
        add_axis(&a, &edges[axis], fitted || zoomed);
    }
    for (int axis = 0; numbered && axis < 3; axis++)
        add_ticks(&a, &edges[axis]);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

enum { WORLD_ID, SLICE_ID, REGION_ID, WORLD_IDS };

static void add_world(scene *s, const layer_source *in, view_layer layer)
{
    const view_filter *f = &s->view.filter;
    const scene_style dashed = make_role_style(layer, ROLE_FAINT, STROKE_DASHED, 1);
    octree_box plane = in->world;
    scene_add_outline(s, WORLD_ID, &in->world, make_layer_style(layer, STROKE_SOLID, 1));
    if (f->slice) {
        plane.min[f->slice - 'x'] = plane.max[f->slice - 'x'] = f->slice_at;
        scene_add_outline(s, SLICE_ID, &plane, dashed);
    }
    if (f->by_region)
        scene_add_outline(s, REGION_ID, &f->region, dashed);
    add_axes(s, &in->world);
}

static void describe_world_element(description *d, const described_element *element)
{
    static const char *const boxes[WORLD_IDS] = {"the world", "the slice that the view shows",
                                                 "the region that the view shows"};
    if (element->kind == SCENE_BOX) {
        append_text(d, "%s", boxes[element->id]);
        append_box(d, ", box ", &element->box);
    } else if (element->id >= SCALE_ID && element->id < FIRST_ID) {
        append_text(d, element->kind == SCENE_LABEL ? ", the scale" : "the scale");
    } else if (element->kind == SCENE_SEGMENT && element->id < 3) {
        append_text(d, "the %c axis", "xyz"[element->id]);
    } else if (element->kind == SCENE_SEGMENT) {
        append_text(d, "a tick mark of an axis");
    } else {
        append_text(d, " of an axis");
    }
}

const layer_type layer_WORLD = {.add = add_world, .describe = describe_world_element};
