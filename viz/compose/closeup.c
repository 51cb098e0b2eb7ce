/* SPDX-License-Identifier: MIT */
/* closeup.c - the layer of the close-up.
 *
 * A close-up is a scene of its own, built from the same layers as the main scene. Its camera looks in the same
 * direction as the camera of the main scene, at the middle of the subject. It clips everything whose depth differs from
 * the subject's depth by more than half the close-up's longer side. The main scene gets a frame around the close-up,
 * and an outline of the enlarged area in the same colour. A short line points from the outline to the close-up; a line
 * that reached the frame would cross the scene. The close-up gets a scale bar. */
#include "closeup.h"
#include "number.h"
#include "scale_bar.h"

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

#define POINTER 8 /* the length of the pointer from the enlarged area towards the close-up, in picture units */

/* ---- The frame ----------------------------------------------------------------------------------------------- */

enum { BORDER_ID, GROUND_ID, REGION_ID, POINTER_ID = REGION_ID + 4, SCALE_ID, LEFT_OUT_ID = SCALE_ID + 4 };

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

/* Outline the enlarged area. Draw a pointer from the middle of a side towards the close-up. */
static void add_enlarged_area(scene *s, const double frame[4])
{
    double area[4];
    if (!find_enlarged_area(s, area))
        return;
    const double left = area[0], top = area[1], right = area[2], bottom = area[3];
    const double x = floor((left + right) / 2) + 0.5, y = floor((top + bottom) / 2) + 0.5;
    const bool beside = right <= frame[0];
    const double lines[][2][2] = {
        {{left, top}, {right, top}}, /* the outline's lines have the ids REGION_ID, REGION_ID + 1 ... */
        {{left, bottom}, {right, bottom}},
        {{left, top}, {left, bottom}},
        {{right, top}, {right, bottom}},
        /* the short line from the outline towards the close-up; its id is POINTER_ID */
        {{beside ? right : x, beside ? y : bottom},
         {beside ? fmin(right + POINTER * s->unit, frame[0]) : x,
          beside ? y : fmin(bottom + POINTER * s->unit, frame[1])}},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        scene_add_picture_line(s, REGION_ID + i, lines[i][0], lines[i][1],
                               make_role_style(LAYER_CLOSEUP, ROLE_TEXT, STROKE_SOLID, 1));
}

static void add_frame(scene *s)
{
    const scene *c = s->closeup;
    const int unit = s->unit, line = unit / 2 > 1 ? unit / 2 : 1, x = c->place[0], y = c->place[1];
    const int width = c->view.width, height = c->view.height;
    add_enlarged_area(s, (double[]){x - line, y - line, x + width + line, y + height + line});
    scene_add_rectangle(s, BORDER_ID, (int[]){x - line, y - line}, (int[]){width + 2 * line, height + 2 * line},
                        LAYER_CLOSEUP, ROLE_TEXT);
    scene_add_rectangle(s, GROUND_ID, c->place, (int[]){width, height}, LAYER_CLOSEUP, ROLE_BACKGROUND);
}

/* Add a scale: a bar, the length of the bar in world units, and the magnification. */
static void add_scale(scene *s)
{
    const int margin = SCALE_BAR_MARGIN * s->unit;
    char times[NUMBER_TEXT], words[SCENE_TEXT];
    snprintf(words, sizeof words, ", enlarged %sx", number_format(s->times, 6, times));
    scale_bar_add(s, LAYER_CLOSEUP, SCALE_ID, (const int[]){margin, s->view.height - margin}, s->view.width / 3.0,
                  words);
}

/* Write how many elements the budget leaves out of the close-up. */
static void add_label_of_left_out_elements(scene *s)
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
        add_label_of_left_out_elements(s);
    } else if (s->has_closeup) {
        add_frame(s);
    }
}

static void describe_closeup_element(description *d, const described_element *element)
{
    if (element->kind == SCENE_PANEL)
        append_text(d, element->id == BORDER_ID   ? "the close-up's frame"
                       : element->id == GROUND_ID ? "the background of the close-up"
                       : element->id > SCALE_ID && element->id < LEFT_OUT_ID
                           ? "the close-up's scale"
                           : "the background of a text in the close-up");
    else if (element->kind == SCENE_LABEL)
        append_text(d, element->id == SCALE_ID ? ", the close-up's scale"
                                               : ", the share of points and nodes that the close-up shows");
    else
        append_text(d, element->id < POINTER_ID ? "the outline of the area that the close-up shows"
                                                : "a pointer from the enlarged area to the close-up");
}

const layer_type layer_CLOSEUP = {.add = add_closeup, .describe = describe_closeup_element};
