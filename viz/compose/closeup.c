/* SPDX-License-Identifier: MIT */
/* closeup.c - the layer of the close-up.
 *
 * A close-up is a scene of its own, built from the same layers as the main scene. Its camera looks in the same
 * direction as the camera of the main scene, at the middle of the subject. It cuts off everything that is farther in
 * front of or behind the subject than the close-up reaches to its sides. The main scene gets a frame around the
 * close-up, an outline of the enlarged area, and lines from the area to the frame. The close-up gets a scale. */
#include "closeup.h"
#include "number.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The scene of the close-up ------------------------------------------------------------------------------- */

/* Return a box in the world that contains everything that the close-up can show. The box becomes part of the view's
 * filter, so that branches of the tree outside the box are skipped. */
static octree_box find_visible_box(const camera *c, const view *v)
{
    octree_box box;
    const double pixel = camera_world_length_of_pixel(c),
                 deep = (c->far_depth - c->distance) * (c->size / 2 / c->scale);
    const double widest = c->perspective ? c->far_depth / c->distance : 1;
    for (int i = 0; i < 3; i++) {
        const double reach = (fabs(c->right[i]) * v->width + fabs(c->up[i]) * v->height) / 2 * pixel * widest +
                             fabs(c->forward[i]) * deep;
        box.min[i] = fmax(c->center[i] - reach, -DBL_MAX);
        box.max[i] = fmin(c->center[i] + reach, DBL_MAX);
    }
    return box;
}

static void narrow_region(view_filter *f, const octree_box *region)
{
    for (int i = 0; i < 3; i++) {
        f->region.min[i] = f->by_region ? fmax(f->region.min[i], region->min[i]) : region->min[i];
        f->region.max[i] = f->by_region ? fmin(f->region.max[i], region->max[i]) : region->max[i];
    }
    f->by_region = true;
}

bool closeup_begin(scene *s, const layer_source *in, const double place[3], double times, layer_source *close)
{
    const camera_window w = layout_closeup_area(&s->view);
    const double budget = (double)s->view.budget * (w.width * w.height / s->view.width / s->view.height);
    s->closeup = s->closeup ? s->closeup : calloc(1, sizeof *s->closeup);
    if (!s->closeup)
        return false;
    scene *c = s->closeup;
    scene_clear(c);
    c->times = times;
    c->unit = s->unit;
    c->text = s->text;
    c->place[0] = (int)w.x;
    c->place[1] = (int)w.y;
    c->view = s->view;
    c->view.width = (int)w.width;
    c->view.height = (int)w.height;
    c->view.diagram = DIAGRAM_NONE;
    /* The close-up gets a part of the budget: the fraction of the picture's pixels that the close-up covers. */
    c->view.budget = s->view.budget && budget < 1 ? 1 : (uint64_t)budget;
    c->view.layers &= ~(1u << LAYER_WORLD | 1u << LAYER_TEXT);
    c->camera = camera_make_close_up(&s->camera, (camera_window){0, 0, w.width, w.height}, place, times);
    const octree_box region = find_visible_box(&c->camera, &c->view);
    narrow_region(&c->view.filter, &region);
    *close = *in;
    close->view = &c->view;
    return true;
}

/* ---- The frame ----------------------------------------------------------------------------------------------- */

enum {
    BORDER_ID,
    GROUND_ID,
    REGION_ID,
    LEADER_ID = REGION_ID + 4,
    SCALE_ID = LEADER_ID + 2,
    LEFT_OUT_ID = SCALE_ID + 3
};

/* Find the area of the picture that the close-up enlarges. sides[] becomes its left, top, right and bottom in pixels.
 * The area is cut at the edges of the space view, and is always large enough to be visible. Return false if the area
 * lies outside the space view. */
static bool find_enlarged_area(const scene *s, double sides[4])
{
    const camera *c = &s->closeup->camera;
    const view *v = &s->closeup->view;
    const camera_window w = layout_space_area(s);
    double seen[3], pixel[2];
    camera_transform(&s->camera, c->center, seen);
    if (!camera_find_pixel(&s->camera, c->center, pixel))
        return false;
    const double smaller = s->closeup->times * (c->perspective ? seen[2] / c->distance : 1);
    const double half[2] = {fmax(v->width / smaller / 2, 2 * s->unit), fmax(v->height / smaller / 2, 2 * s->unit)};
    const double low[2] = {w.x, w.y}, high[2] = {w.x + w.width - 1, w.y + w.height - 1};
    for (int i = 0; i < 2; i++) {
        sides[i] = fmax(floor(pixel[i] - half[i]), low[i]) + 0.5;
        sides[i + 2] = fmin(floor(pixel[i] + half[i]), high[i]) + 0.5;
    }
    return sides[0] < sides[2] && sides[1] < sides[3];
}

/* Outline the enlarged area. Draw lines from two of its corners to the nearest corners of the close-up's frame. */
static void add_enlarged_area(scene *s, const double frame[4])
{
    double area[4];
    if (!find_enlarged_area(s, area))
        return;
    const double left = area[0], top = area[1], right = area[2], bottom = area[3];
    const bool beside = right <= frame[0];
    const double lines[][2][2] = {
        {{left, top}, {right, top}}, /* the outline's lines have the ids REGION_ID, REGION_ID + 1 ... */
        {{left, bottom}, {right, bottom}},
        {{left, top}, {left, bottom}},
        {{right, top}, {right, bottom}},
        /* the lines to the frame have the ids LEADER_ID, LEADER_ID + 1 ... */
        {{beside ? right : left, beside ? top : bottom}, {frame[0], frame[1]}},
        {{right, bottom}, {beside ? frame[0] : frame[2], beside ? frame[3] : frame[1]}},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        scene_add_picture_line(s, REGION_ID + i, lines[i][0], lines[i][1],
                               make_role_style(LAYER_CLOSEUP, ROLE_FAINT, STROKE_SOLID, 1));
}

static void add_frame(scene *s)
{
    const scene *c = s->closeup;
    const int unit = s->unit, line = unit / 2 > 1 ? unit / 2 : 1, x = c->place[0], y = c->place[1];
    const int width = c->view.width, height = c->view.height;
    add_enlarged_area(s, (double[]){x - line, y - line, x + width + line, y + height + line});
    scene_add_rectangle(s, BORDER_ID, (int[]){x - line, y - line}, (int[]){width + 2 * line, height + 2 * line},
                        LAYER_CLOSEUP, ROLE_FAINT);
    scene_add_rectangle(s, GROUND_ID, c->place, (int[]){width, height}, LAYER_CLOSEUP, ROLE_BACKGROUND);
}

/* Return the largest length of the form 1, 2 or 5 times a power of ten that is not above `limit`. Return 0 if that
 * length is too small for a double. */
static double round_down_scale_length(double limit)
{
    double power = 1;
    while (power > limit)
        power /= 10;
    while (power > 0 && power * 10 <= limit)
        power *= 10;
    return limit >= 5 * power ? 5 * power : limit >= 2 * power ? 2 * power : power;
}

/* Remove the labels that a rectangle would cover completely or in part, and the backgrounds of these labels. */
static void drop_covered_labels(scene *s, const int corner[2], const int size[2])
{
    size_t kept = 0;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const double right = label->at[0] + (double)strlen(label->text) * s->text.width;
        const bool apart = right < corner[0] || label->at[0] > corner[0] + size[0] ||
                           label->at[1] + s->text.height < corner[1] || label->at[1] > corner[1] + size[1];
        if (label->in_world || apart) {
            s->labels.items[kept++] = *label;
            continue;
        }
        for (size_t k = 0; k < s->panels.count; k++)
            if (s->panels.items[k].id == label->id && s->panels.items[k].style.layer == label->style.layer)
                s->panels.items[k].width = 0;
    }
    s->labels.count = kept;
}

/* Add a scale: a bar, the length of the bar in world units, and the magnification. */
static void add_scale(scene *s)
{
    const int unit = s->unit, margin = 6 * unit;
    const double pixel = camera_world_length_of_pixel(&s->camera),
                 length = round_down_scale_length(s->view.width / 3.0 * pixel);
    const double x = margin + 0.5, y = s->view.height - margin + 0.5, end = x + floor(length / pixel), rise = 3 * unit;
    char number[NUMBER_TEXT], times[NUMBER_TEXT];
    if (!(length > 0) || !isfinite(end))
        return;
    scene_label label =
        scene_make_label(SCALE_ID, make_role_style(LAYER_CLOSEUP, ROLE_TEXT, STROKE_SOLID, 1), "%s, enlarged %sx",
                         number_format(length, 6, number), number_format(s->times, 6, times));
    label.at[0] = margin;
    label.at[1] = s->view.height - margin - s->text.height - 3 * unit;
    const int wide = (int)fmax(end - margin, (double)strlen(label.text) * s->text.width);
    const int corner[2] = {margin - unit, (int)label.at[1] - unit};
    const int size[2] = {wide + 2 * unit, s->view.height - margin + 2 * unit - (int)label.at[1] + unit};
    drop_covered_labels(s, corner, size);
    scene_add_rectangle(s, SCALE_ID, corner, size, LAYER_CLOSEUP, ROLE_BACKGROUND);
    const double lines[][2][2] = {{{x, y}, {end, y}}, {{x, y - rise}, {x, y + 1}}, {{end, y - rise}, {end, y + 1}}};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        scene_add_picture_line(s, SCALE_ID + i, lines[i][0], lines[i][1], label.style);
    scene_add_label(s, label);
}

/* Write how many elements the budget leaves out of the close-up. */
static void add_left_out(scene *s)
{
    const scene_tally *t = &s->tally;
    scene_label label =
        scene_make_label(LEFT_OUT_ID, make_role_style(LAYER_CLOSEUP, ROLE_WARNING, STROKE_SOLID, 1), "");
    char *text = label.text;
    label.at[0] = label.at[1] = 6 * s->unit;
    if (t->thinned)
        snprintf(text, sizeof label.text, "1 in %" PRIu64 " points", t->one_in);
    else if (t->arrows.thinned)
        snprintf(text, sizeof label.text, "1 in %" PRIu64 " arrows", t->arrows.one_in);
    const size_t length = strlen(text);
    if (t->beyond)
        snprintf(text + length, sizeof label.text - length, "%sdepth 0 to %d", length ? ", " : "", t->deepest);
    if (text[0])
        scene_add_label_on_ground(s, &label, ROLE_BACKGROUND);
}

static void add_closeup(scene *s, const layer_source *in, view_layer layer)
{
    (void)in, (void)layer;
    if (s->times > 0) {
        add_scale(s);
        add_left_out(s);
    } else if (s->has_closeup) {
        add_frame(s);
    }
}

static void describe_closeup_element(description *d, const described_element *element)
{
    if (element->kind == SCENE_PANEL)
        append_text(d, element->id == BORDER_ID   ? "the close-up's frame"
                       : element->id == GROUND_ID ? "the background of the close-up"
                                                  : "the background of a text in the close-up");
    else if (element->kind == SCENE_LABEL)
        append_text(d, element->id == SCALE_ID ? ", the close-up's scale"
                                               : ", the share of points and nodes that the close-up shows");
    else if (element->id < LEADER_ID)
        append_text(d, "the outline of the area that the close-up shows");
    else
        append_text(d,
                    element->id < SCALE_ID ? "a line from the enlarged area to the close-up" : "the close-up's scale");
}

const layer_type layer_CLOSEUP = {.add = add_closeup, .describe = describe_closeup_element};
