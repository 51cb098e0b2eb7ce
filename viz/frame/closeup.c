/* SPDX-License-Identifier: MIT */
/* closeup.c - the layer of the close-up: a scene of its own in the direction of view of the world, with the player
 * always in its middle, and cut off as far before and behind it as beside it. In the picture stand its frame and the
 * rectangle that it shows, in itself a scale. Without a player it shows what is asked.
 *
 * The close-up follows the player step by step: kept still until the player leaves it, it would jump by as much as it
 * shows. */
#include "closeup.h"
#include "array.h"
#include "number.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SMALL (32.0 / 720)  /* of the height of the picture: what appears larger needs no close-up, */
#define WANTED (68.0 / 720) /* and a close-up makes it about so large */
#define MOST_TIMES 1e6      /* as --zoom */

/* ---- What it shows ------------------------------------------------------------------------------------------ */

static void widen(octree_box *box, const double from[3], const double to[3])
{
    for (int i = 0; i < 3; i++) {
        box->min[i] = fmin(box->min[i], from[i]);
        box->max[i] = fmax(box->max[i], to[i]);
    }
}

static const octree_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static bool is_empty(const octree_box *box)
{
    return !(box->min[0] <= box->max[0]);
}

static void widen_by_ball(octree_box *box, const double center[3], double radius)
{
    double from[3], to[3];
    for (int i = 0; i < 3; i++) {
        from[i] = center[i] - radius;
        to[i] = center[i] + radius;
    }
    widen(box, from, to);
}

/* What the session asks at tick 0, which is known at every tick. */
static octree_box asked_first(const octree_session *session)
{
    octree_box box = nothing;
    for (size_t i = 0; i < session->query_count; i++) {
        const octree_query *query = &session->queries[i];
        if (query->at_player || (query->tick != 0 && query->tick != OCTREE_EVERY_TICK))
            continue;
        if (query->kind == OCTREE_QUERY_RANGE)
            widen(&box, query->box.min, query->box.max);
        else
            widen_by_ball(&box, query->target, query->kind == OCTREE_QUERY_RADIUS ? query->radius : 0);
    }
    return box;
}

/* What a tick asks; where that is nothing, what it splits and merges. */
static octree_box happens(const layer_source *in)
{
    octree_box box = nothing;
    const octree_tick *tick = in->tick;
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_answer *answer = &tick->answers[i];
        if (answer->kind == OCTREE_QUERY_RANGE)
            widen(&box, answer->box.min, answer->box.max);
        else
            widen_by_ball(&box, answer->target, answer->kind == OCTREE_QUERY_RADIUS ? answer->radius : 0);
    }
    for (size_t i = 0; tick->answer_count == 0 && i < tick->split_count + tick->merge_count; i++) {
        const bool splits = i < tick->split_count;
        const octree_box cell =
            octree_cell_box(&in->world, splits ? tick->splits[i] : tick->merges[i - tick->split_count]);
        widen(&box, cell.min, cell.max);
    }
    return box;
}

/* Half the extent of what is to be seen: of the player's box, or of its step where that is longer, since a close-up is
 * of no use to one that leaves it at once. */
static double reach_of(const octree_session *session)
{
    double reach = 0;
    if (session->player.kind != OCTREE_PLAYER_NONE)
        return fmax(session->player.box_size, session->player.step / 2);
    const octree_box box = asked_first(session);
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, box.max[i] / 2 - box.min[i] / 2);
    return reach;
}

static void place_of(const layer_source *in, double place[3])
{
    const octree_box now = happens(in), first = asked_first(in->session);
    if (in->session->player.kind != OCTREE_PLAYER_NONE)
        memcpy(place, in->tick->player, sizeof in->tick->player);
    else
        scene_box_middle(is_empty(&now) ? &first : &now, place);
    for (int i = 0; i < 3; i++) /* a box that is asked for may be infinite */
        place[i] = fmin(fmax(place[i], in->world.min[i]), in->world.max[i]);
}

/* The greatest of 1, 2, 3, 4, 5, 6 and 8 times a power of ten that is at most `limit`, which is at least 1. */
static double round_down(double limit)
{
    static const double steps[] = {8, 6, 5, 4, 3, 2, 1};
    double power = 1;
    while (power * 10 <= limit)
        power *= 10;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        if (steps[i] * power <= limit)
            return steps[i] * power;
    return power;
}

/* The camera is that of tick 0, since an orbit does not show everything at the same size at every tick. */
double closeup_times(const scene *s, const layer_source *in)
{
    const view *v = &s->view;
    scene with = {.view = *v, .unit = s->unit, .text = s->text, .has_closeup = true};
    if (!v->closeup || !in->game || layout_closeup(v).width == 0)
        return 0;
    const camera c = camera_make(v, layout_camera(&with), &in->world, in->session->player.position, 0);
    const double part = 2 * reach_of(in->session) / camera_pixel_length(&c) / view_height_in_wide(v);
    return part > 0 && part < SMALL ? round_down(fmin(WANTED / part, MOST_TIMES)) : 0;
}

/* ---- Its scene ---------------------------------------------------------------------------------------------- */

/* The box in the world around all that the close-up may show: a view's filter leaves out whole branches by it. */
static octree_box region_of(const camera *c, const view *v)
{
    octree_box box;
    const double pixel = camera_pixel_length(c), deep = (c->far_depth - c->distance) * (c->size / 2 / c->scale);
    const double widest = c->perspective ? c->far_depth / c->distance : 1;
    for (int i = 0; i < 3; i++) {
        const double reach = (fabs(c->right[i]) * v->width + fabs(c->up[i]) * v->height) / 2 * pixel * widest +
                             fabs(c->forward[i]) * deep;
        box.min[i] = fmax(c->center[i] - reach, -DBL_MAX);
        box.max[i] = fmin(c->center[i] + reach, DBL_MAX);
    }
    return box;
}

static void narrow(view_filter *f, const octree_box *region)
{
    const octree_box before = f->region;
    f->region = *region;
    for (int i = 0; f->by_region && i < 3; i++) {
        f->region.min[i] = fmax(before.min[i], region->min[i]);
        f->region.max[i] = fmin(before.max[i], region->max[i]);
    }
    f->by_region = true;
}

/* As large a part as it has of the picture. */
static uint64_t part_of_budget(const view *v, double pixels)
{
    const double part = (double)v->budget * (pixels / v->width / v->height);
    return v->budget && part < 1 ? 1 : (uint64_t)part;
}

bool closeup_begin(scene *s, const layer_source *in, double times, layer_source *close)
{
    const camera_window w = layout_closeup(&s->view);
    s->closeup = s->closeup ? s->closeup : calloc(1, sizeof *s->closeup);
    if (!s->closeup)
        return false;
    scene *c = s->closeup;
    double place[3];
    place_of(in, place);
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
    c->view.budget = part_of_budget(&s->view, w.width * w.height);
    c->view.layers &= ~(1u << LAYER_WORLD | 1u << LAYER_TEXT);
    c->camera = camera_close_up(&s->camera, (camera_window){0, 0, w.width, w.height}, place, times);
    const octree_box region = region_of(&c->camera, &c->view);
    narrow(&c->view.filter, &region);
    *close = *in;
    close->view = &c->view;
    return true;
}

/* ---- Its frame ---------------------------------------------------------------------------------------------- */

enum {
    BORDER_ID,
    GROUND_ID,
    REGION_ID,
    LEADER_ID = REGION_ID + 4,
    SCALE_ID = LEADER_ID + 2,
    LEFT_OUT_ID = SCALE_ID + 3
};

/* A rectangle of the picture: left, top, right, bottom. */
typedef struct rectangle {
    double side[4];
} rectangle;

static void add_flat(scene *s, uint64_t id, double x0, double y0, double x1, double y1, unsigned role)
{
    scene_add_segment(s, (scene_segment){.id = id,
                                         .in_picture = true,
                                         .ends = {{x0, y0}, {x1, y1}},
                                         .style = {.layer = LAYER_CLOSEUP, .role = (uint8_t)role, .width = 1}});
}

/* What the close-up shows, in the picture, as far as it is in the space of the world, and never too small to be seen;
 * false where it is not. */
static bool find_region(const scene *s, rectangle *r)
{
    const camera *c = &s->closeup->camera;
    const view *v = &s->closeup->view;
    const camera_window w = layout_space(s);
    double seen[3], pixel[2];
    camera_transform(&s->camera, c->center, seen);
    if (!camera_pixel(&s->camera, c->center, pixel))
        return false;
    const double smaller = s->closeup->times * (c->perspective ? seen[2] / c->distance : 1);
    const double half[2] = {fmax(v->width / smaller / 2, 2 * s->unit), fmax(v->height / smaller / 2, 2 * s->unit)};
    const double low[2] = {w.x, w.y}, high[2] = {w.x + w.width - 1, w.y + w.height - 1};
    for (int i = 0; i < 2; i++) {
        r->side[i] = fmax(floor(pixel[i] - half[i]), low[i]) + 0.5;
        r->side[i + 2] = fmin(floor(pixel[i] + half[i]), high[i]) + 0.5;
    }
    return r->side[0] < r->side[2] && r->side[1] < r->side[3];
}

/* The rectangle, and lines from its corners to those of the close-up that are nearest. */
static void add_region(scene *s, const rectangle *frame)
{
    rectangle r;
    if (!find_region(s, &r))
        return;
    const double *at = r.side, *to = frame->side;
    add_flat(s, REGION_ID, at[0], at[1], at[2], at[1], ROLE_FAINT);
    add_flat(s, REGION_ID + 1, at[0], at[3], at[2], at[3], ROLE_FAINT);
    add_flat(s, REGION_ID + 2, at[0], at[1], at[0], at[3], ROLE_FAINT);
    add_flat(s, REGION_ID + 3, at[2], at[1], at[2], at[3], ROLE_FAINT);
    const bool beside = at[2] <= to[0];
    add_flat(s, LEADER_ID, at[beside ? 2 : 0], at[beside ? 1 : 3], to[0], to[1], ROLE_FAINT);
    add_flat(s, LEADER_ID + 1, at[2], at[3], to[beside ? 0 : 2], to[beside ? 3 : 1], ROLE_FAINT);
}

static void add_frame(scene *s)
{
    const scene *c = s->closeup;
    const int unit = s->unit, line = unit / 2 > 1 ? unit / 2 : 1, x = c->place[0], y = c->place[1];
    const int width = c->view.width, height = c->view.height;
    const rectangle frame = {{x - line, y - line, x + width + line, y + height + line}};
    add_region(s, &frame);
    scene_add_rectangle(s, BORDER_ID, (int[]){x - line, y - line}, (int[]){width + 2 * line, height + 2 * line},
                        LAYER_CLOSEUP, ROLE_FAINT);
    scene_add_rectangle(s, GROUND_ID, c->place, (int[]){width, height}, LAYER_CLOSEUP, ROLE_BACKGROUND);
}

/* A length of 1, 2 or 5 times a power of ten that takes at most `limit`; 0 where doubles end. */
static double round_length(double limit)
{
    double power = 1;
    while (power > limit)
        power /= 10;
    while (power > 0 && power * 10 <= limit)
        power *= 10;
    return limit >= 5 * power ? 5 * power : limit >= 2 * power ? 2 * power : power;
}

/* A bar, its length in the world, and how many times as large all is. */
static void add_scale(scene *s)
{
    const int unit = s->unit, margin = 6 * unit;
    const double pixel = camera_pixel_length(&s->camera), length = round_length(s->view.width / 3.0 * pixel);
    const double x = margin + 0.5, y = s->view.height - margin + 0.5, end = x + floor(length / pixel), rise = 3 * unit;
    char number[NUMBER_TEXT], times[NUMBER_TEXT];
    scene_label label = {.id = SCALE_ID,
                         .style = {.layer = LAYER_CLOSEUP, .role = ROLE_TEXT, .width = 1},
                         .at = {margin, s->view.height - margin - s->text.height - 3 * unit}};
    if (!(length > 0) || !isfinite(end))
        return;
    snprintf(label.text, sizeof label.text, "%s, enlarged %sx", number_text(length, 6, number),
             number_text(s->times, 6, times));
    const int wide = (int)fmax(end - margin, (double)strlen(label.text) * s->text.width);
    scene_add_rectangle(s, SCALE_ID, (int[]){margin - unit, (int)label.at[1] - unit},
                        (int[]){wide + 2 * unit, s->view.height - margin + 2 * unit - (int)label.at[1] + unit},
                        LAYER_CLOSEUP, ROLE_BACKGROUND);
    add_flat(s, SCALE_ID, x, y, end, y, ROLE_TEXT);
    add_flat(s, SCALE_ID + 1, x, y - rise, x, y + 1, ROLE_TEXT);
    add_flat(s, SCALE_ID + 2, end, y - rise, end, y + 1, ROLE_TEXT);
    scene_add_label(s, label);
}

/* What the budget leaves out. */
static void add_left_out(scene *s)
{
    const scene_tally *t = &s->tally;
    scene_label label = {.id = LEFT_OUT_ID,
                         .style = {.layer = LAYER_CLOSEUP, .role = ROLE_WARNING, .width = 1},
                         .at = {6 * s->unit, 6 * s->unit}};
    char *text = label.text;
    if (t->thinned)
        snprintf(text, sizeof label.text, "1 in %" PRIu64 " points", t->one_in);
    else if (t->arrows.thinned)
        snprintf(text, sizeof label.text, "1 in %" PRIu64 " arrows", t->arrows.one_in);
    const size_t length = strlen(text);
    if (t->beyond)
        snprintf(text + length, sizeof label.text - length, "%sdepth 0 to %d", length ? ", " : "", t->deepest);
    if (text[0])
        text_add_on_ground(s, &label, ROLE_BACKGROUND);
}

static void add(scene *s, const layer_source *in, view_layer own)
{
    (void)in, (void)own;
    if (s->times > 0) {
        add_scale(s);
        add_left_out(s);
    } else if (s->has_closeup) {
        add_frame(s);
    }
}

static void describe(description *d, const described *element)
{
    if (element->kind == SCENE_PANEL)
        say(d, element->id == BORDER_ID   ? "the close-up's frame"
               : element->id == GROUND_ID ? "the ground of the close-up"
                                          : "the ground of letters of the close-up");
    else if (element->kind == SCENE_LABEL)
        say(d, element->id == SCALE_ID ? ", the close-up's scale" : ", what the close-up shows of all");
    else if (element->id < LEADER_ID)
        say(d, "the frame of what the close-up shows");
    else
        say(d, element->id < SCALE_ID ? "a line from there to the close-up" : "the close-up's scale");
}

const layer_type layer_CLOSEUP = {.add = add, .describe = describe};
