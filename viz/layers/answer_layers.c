/* SPDX-License-Identifier: MIT */
/* answer_layers.c - the layers that show a tick's queries: the region or the target of each query, and the points that
 * it found. */
#include "layer_type.h"
#include "layout.h"
#include "number.h"
#include "polytope.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FEW_MARKS 50
#define MANY_MARKS 500
#define BALL_CIRCLES 3   /* number of great circles that are drawn for a ball */
#define BALL_CHORDS 96   /* number of chords that are drawn for a circle */
#define NUMBERED_RANKS 9 /* the nearest 9 neighbours get a number, their rank */
#define NEIGHBOR_HALF 2  /* half the side of a neighbour's square, which no rank covers, in halves of a picture unit */

/* ---- All kinds of queries ----------------------------------------------------------------------------------- */

/* Return the element id of a part of an answer, such as the line to a neighbour. `place` is the answer's index in the
 * tick. Markers do not use these ids: the id of a marker is the id of its point. */
static uint64_t make_part_id(size_t place, size_t part)
{
    return (uint64_t)place << 32 | (uint64_t)part;
}

/* Mark the points of an answer. `half` is half the size of a marker, in halves of a picture unit. The markers of an
 * answer with many points are smaller, because large markers would hide more of the picture. */
static void mark_answer_points(scene *s, const octree_answer *answer, view_layer layer, scene_shape shape,
                               unsigned half)
{
    const unsigned size = answer->count <= FEW_MARKS ? half : answer->count <= MANY_MARKS ? half / 2 : 1;
    const scene_style style = make_layer_style(layer, STROKE_SOLID, size);
    for (size_t i = 0; i < answer->count; i++)
        scene_add_mark(s, answer->points[i].id, answer->points[i].position, shape, style);
}

/* Append a phrase such as "the box of the range query (answer 2 of 3)"; `what` is the noun, here "box". Return the
 * answer with the index `place`. */
static const octree_answer *append_query(description *d, const char *what, uint64_t place)
{
    const octree_answer *answer = &d->tick->answers[place];
    d->subject->query = place + 1;
    append_text(d, "the %s of the %s query", what, octree_query_name(answer->kind));
    if (d->tick->answer_count > 1)
        append_text(d, " (answer %" PRIu64 " of %zu)", place + 1, d->tick->answer_count);
    return answer;
}

static void append_found_count(description *d, const octree_answer *answer)
{
    append_text(d, ", %zu point%s found", answer->count, plural_ending(answer->count));
}

static void describe_neighbor(description *d, uint64_t place, uint64_t rank, const char *noun)
{
    const octree_answer *answer = append_query(d, "line", place);
    const octree_neighbor *neighbor = &answer->neighbors[rank];
    append_text(d, " to %s %" PRIu64, noun, rank + 1);
    describe_point(d, ": ", neighbor->point.id, neighbor->point.position);
    append_text(d, ", %s ", octree_query_about(answer->kind)->measure);
    append_number(d, "", neighbor->distance);
}

/* Write the ids of the points of an answer that consists of neighbours. */
static void write_neighbors(pen *p, const char *name, const octree_answer *answer)
{
    octree_point first[PEN_MOST_IDS];
    for (size_t i = 0; i < answer->count && i < PEN_MOST_IDS; i++)
        first[i] = answer->neighbors[i].point;
    write_ids(p, name, first, answer->count);
}

/* Write the only neighbour of an answer, and its distance or t between two texts. */
static void write_only_neighbor(pen *p, const char *name, const octree_answer *answer, const char *before,
                                const char *after)
{
    char id[SCENE_TEXT], value[NUMBER_TEXT];
    if (answer->count == 0) {
        write_row(p, name, "", "none");
        return;
    }
    number_format(answer->neighbors[0].distance, 6, value);
    snprintf(id, sizeof id, "#%" PRIu64, answer->neighbors[0].point.id);
    const bool fits = (int)strlen(id) <= detail_room(p, strlen(before) + strlen(value) + strlen(after));
    if (!fits)
        write_row(p, name, "", "%s", id);
    write_row(p, fits ? name : "", fits ? id : "", "%s%s%s", before, value, after);
}

/* ---- Range queries ------------------------------------------------------------------------------------------ */

static void add_range(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *answer = &in->answers[place];
    scene_add_outline(s, place, &answer->box, make_layer_style(layer, STROKE_DASHED, 1));
    mark_answer_points(s, answer, layer, SHAPE_FRAME, 5);
}

static void write_range(pen *p, const octree_answer *answer)
{
    write_ids(p, "range", answer->points, answer->count);
}

static void describe_range(description *d, const described_element *element)
{
    const octree_answer *answer = append_query(d, "box", element->id);
    append_box(d, ": ", &element->box);
    append_found_count(d, answer);
}

const layer_type layer_RANGE = {
    .add_answer = add_range,
    .write_answer = write_range,
    .legend = {.order = 120, .sign = SIGN_DASHES, .text = "range query", .drop_order = DROP_LATE},
    .describe = describe_range};

/* ---- Radius queries ----------------------------------------------------------------------------------------- */

/* Compute a corner of the polygon that approximates a great circle of the ball. The circle lies in the plane normal to
 * the axis `plane`. */
static void compute_circle_point(const octree_answer *ball, int plane, int part, double position[3])
{
    double cosine, sine;
    camera_compute_cosine_sine((double)part / BALL_CHORDS, &cosine, &sine);
    memcpy(position, ball->target, sizeof ball->target);
    position[(plane + 1) % 3] += ball->radius * cosine;
    position[(plane + 2) % 3] += ball->radius * sine;
}

static void add_circle(scene *s, const octree_answer *ball, size_t place, int plane, scene_style style)
{
    double from[3], to[3];
    compute_circle_point(ball, plane, 0, from);
    for (int i = 0; i < BALL_CHORDS; i++) {
        compute_circle_point(ball, plane, (i + 1) % BALL_CHORDS, to);
        scene_add_line(s, make_part_id(place, (size_t)(plane * BALL_CHORDS + i)), from, to, style);
        memcpy(from, to, sizeof from);
    }
}

static void add_ball(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *answer = &in->answers[place];
    const scene_style style = make_layer_style(layer, STROKE_SOLID, 1);
    for (int plane = 0; plane < BALL_CIRCLES; plane++)
        add_circle(s, answer, place, plane, style);
    mark_answer_points(s, answer, layer, SHAPE_LOZENGE, 8);
}

static void write_radius(pen *p, const octree_answer *answer)
{
    char radius[NUMBER_TEXT], found[SCENE_TEXT];
    const int room = detail_room(p, (size_t)snprintf(found, sizeof found, "%zu found", answer->count));
    format_number_within(answer->radius, room ? (size_t)room : 1, radius);
    write_row(p, "radius", radius, "%s", found);
}

static void describe_radius(description *d, const described_element *element)
{
    const octree_answer *answer = append_query(d, "ball", element->id >> 32);
    append_number(d, ": radius ", answer->radius);
    append_position(d, " about ", answer->target);
    append_found_count(d, answer);
}

const layer_type layer_RADIUS = {
    .add_answer = add_ball,
    .write_answer = write_radius,
    .legend = {.order = 130, .sign = SIGN_LINE, .text = "radius query", .drop_order = DROP_LATE},
    .describe = describe_radius};

/* ---- Frusta ------------------------------------------------------------------------------------------------- */

static void add_frustum(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *answer = &in->answers[place];
    polytope_edge edges[POLYTOPE_EDGES];
    const size_t count = polytope_find_edges(&in->world, &answer->frustum, edges);
    for (size_t i = 0; i < count; i++)
        scene_add_line(s, make_part_id(place, edges[i].planes[0] * POLYTOPE_PLANES + edges[i].planes[1]),
                       edges[i].ends[0], edges[i].ends[1], make_layer_style(layer, STROKE_SOLID, 2));
    mark_answer_points(s, answer, layer, SHAPE_FRAME, 5);
}

static void write_frustum(pen *p, const octree_answer *answer)
{
    write_ids(p, "frustum", answer->points, answer->count);
}

static void describe_frustum(description *d, const described_element *element)
{
    const octree_answer *answer = append_query(d, "edge", element->id >> 32);
    append_text(d, " of %zu half-space%s", answer->frustum.count, plural_ending(answer->frustum.count));
    append_found_count(d, answer);
}

const layer_type layer_FRUSTUM = {
    .add_answer = add_frustum,
    .write_answer = write_frustum,
    .legend = {.order = 125, .sign = SIGN_LINE, .text = "frustum query", .drop_order = DROP_LATE},
    .describe = describe_frustum};

/* ---- Queries for k nearest points --------------------------------------------------------------------------- */

/* Write the ranks of the first neighbours beside their places, on a background that hides points and lines behind the
 * rank. Lower ranks come first; if there is no free room beside a place, its rank is left out. */
static void add_ranks(scene *s, double places[NUMBERED_RANKS][3], size_t ranks, unsigned half, size_t place,
                      scene_style style)
{
    text_space words = text_space_make(s);
    for (size_t i = 0; i < ranks; i++)
        text_space_reserve_mark(&words, s, places[i], half);
    for (size_t i = 0; i < ranks; i++)
        text_space_add_label_beside(&words, s, scene_make_label(make_part_id(place, i), style, "%zu", i + 1), places[i],
                                    half);
}

static void add_knearest(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *answer = &in->answers[place];
    const scene_style style = make_layer_style(layer, STROKE_SOLID, 1);
    for (size_t i = 0; i < answer->count; i++)
        scene_add_line(s, make_part_id(place, i), answer->target, answer->neighbors[i].point.position, style);
    double ranked[NUMBERED_RANKS][3];
    const size_t ranks = answer->count < NUMBERED_RANKS ? answer->count : NUMBERED_RANKS;
    for (size_t i = 0; i < ranks; i++)
        memcpy(ranked[i], answer->neighbors[i].point.position, sizeof ranked[i]);
    add_ranks(s, ranked, ranks, NEIGHBOR_HALF, place, style);
}

static void write_knearest(pen *p, const octree_answer *answer)
{
    write_neighbors(p, "k nearest", answer);
}

static void describe_knearest(description *d, const described_element *element)
{
    if (element->kind == SCENE_LABEL)
        append_text(d, ", the rank of a neighbour");
    else if (element->kind == SCENE_PANEL)
        append_text(d, "the background of the rank of a neighbour");
    else
        describe_neighbor(d, element->id >> 32, element->id & UINT32_MAX, "neighbour");
}

const layer_type layer_KNEAREST = {
    .add_answer = add_knearest,
    .write_answer = write_knearest,
    .legend = {.order = 140, .sign = SIGN_LINE, .text = "k nearest", .drop_order = DROP_LATE},
    .describe = describe_knearest};

/* ---- Queries for the nearest point -------------------------------------------------------------------------- */

static void add_nearest(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *answer = &in->answers[place];
    for (size_t i = 0; i < answer->count; i++) {
        const octree_point *point = &answer->neighbors[i].point;
        scene_add_line(s, place, answer->target, point->position, make_layer_style(layer, STROKE_DASHED, 1));
        scene_add_mark(s, point->id, point->position, SHAPE_FRAME, make_layer_style(layer, STROKE_SOLID, 7));
    }
}

static void write_nearest(pen *p, const octree_answer *answer)
{
    write_only_neighbor(p, "nearest", answer, "", " away");
}

static void describe_nearest(description *d, const described_element *element)
{
    describe_neighbor(d, element->id, 0, "neighbour");
}

const layer_type layer_NEAREST = {
    .add_answer = add_nearest,
    .write_answer = write_nearest,
    .legend = {.order = 150, .sign = SIGN_DASHES, .text = "nearest point", .drop_order = DROP_LATE},
    .describe = describe_nearest};

/* ---- Rays --------------------------------------------------------------------------------------------------- */

/* The parts of a ray: the searched part, the part beyond the last of k hits, and a line from each hit to its point. */
enum { RAY_SEARCHED, RAY_BEYOND, RAY_HITS };

/* The parameter of a ray may be beyond the range of doubles. So the picture measures a ray by the coordinate on the
 * axis on which the ray is fastest: `way` is the parameter times this speed. */
static double find_ray_speed(const octree_answer *ray)
{
    return fmax(fmax(fabs(ray->direction[0]), fabs(ray->direction[1])), fabs(ray->direction[2]));
}

static void find_ray_position(const octree_answer *ray, double way, double position[3])
{
    const double speed = find_ray_speed(ray);
    for (int i = 0; i < 3; i++)
        position[i] = ray->target[i] + way * (ray->direction[i] / speed);
}

/* Return the way of a ray to a hit: to the hit point itself if the parameter is beyond the range of doubles. */
static double find_way_to_hit(const octree_answer *ray, size_t rank)
{
    const octree_neighbor *hit = &ray->neighbors[rank];
    const double speed = find_ray_speed(ray);
    if (isfinite(hit->distance * speed))
        return hit->distance * speed;
    for (int i = 0; i < 3; i++)
        if (fabs(ray->direction[i]) == speed)
            return fabs(hit->point.position[i] - ray->target[i]);
    return 0;
}

/* Return the way at which a ray leaves the world, or at which it ends before. A ray that starts outside the world and
 * moves away from it is drawn as long as the world. */
static double find_ray_end(const octree_answer *ray, const octree_box *world)
{
    const double speed = find_ray_speed(ray);
    double end = HUGE_VAL, longest = 0;
    for (int i = 0; i < 3; i++) {
        const double d = ray->direction[i] / speed, way = (d > 0 ? world->max : world->min)[i] - ray->target[i];
        end = d != 0 && way / d < end ? way / d : end;
        longest = fmax(longest, world->max[i] - world->min[i]);
    }
    end = end > 0 ? end : longest;
    return ray->length > 0 && ray->length * speed < end ? ray->length * speed : end;
}

/* Add the line of a ray: solid to the last of k hits, where the search ended, and dashed beyond. With fewer than k hits
 * the search went on to the end. */
static void add_ray_line(scene *s, const octree_answer *ray, const octree_box *world, size_t place, view_layer layer)
{
    const double end = find_ray_end(ray, world), last = ray->count ? find_way_to_hit(ray, ray->count - 1) : 0;
    const double searched = ray->count > 0 && ray->count == ray->k ? last : fmax(end, last);
    double middle[3], to[3];
    find_ray_position(ray, searched, middle);
    scene_add_line(s, make_part_id(place, RAY_SEARCHED), ray->target, middle, make_layer_style(layer, STROKE_ARROW, 3));
    if (searched >= end)
        return;
    find_ray_position(ray, end, to);
    scene_add_line(s, make_part_id(place, RAY_BEYOND), middle, to, make_layer_style(layer, STROKE_DASHED, 1));
}

static void add_ray(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *ray = &in->answers[place];
    const unsigned half = ray->count <= FEW_MARKS ? 6 : ray->count <= MANY_MARKS ? 3 : 1;
    double at[3], ranked[NUMBERED_RANKS][3];
    add_ray_line(s, ray, &in->world, place, layer);
    for (size_t i = 0; i < ray->count; i++) {
        const octree_point *point = &ray->neighbors[i].point;
        find_ray_position(ray, find_way_to_hit(ray, i), at);
        scene_add_line(s, make_part_id(place, RAY_HITS + i), at, point->position,
                       make_layer_style(layer, STROKE_SOLID, 1));
        scene_add_mark(s, point->id, at, SHAPE_DIAMOND, make_layer_style(layer, STROKE_SOLID, half));
        if (i < NUMBERED_RANKS)
            memcpy(ranked[i], at, sizeof at);
    }
    add_ranks(s, ranked, ray->count < NUMBERED_RANKS ? ray->count : NUMBERED_RANKS, half, place,
              make_layer_style(layer, STROKE_SOLID, 1));
}

static void write_ray(pen *p, const octree_answer *answer)
{
    if (answer->k == 1)
        write_only_neighbor(p, "ray", answer, "t ", "");
    else
        write_neighbors(p, "ray", answer);
}

static void describe_ray(description *d, const described_element *element)
{
    const uint64_t place = element->id >> 32, part = element->id & UINT32_MAX;
    if (element->kind == SCENE_LABEL) {
        append_text(d, ", the rank of a hit");
    } else if (element->kind == SCENE_PANEL) {
        append_text(d, "the background of the rank of a hit");
    } else if (part >= RAY_HITS) {
        describe_neighbor(d, place, part - RAY_HITS, "hit");
    } else {
        const octree_answer *answer = append_query(d, part == RAY_BEYOND ? "unsearched part" : "line", place);
        append_position(d, ": from ", answer->target);
        append_position(d, " in direction ", answer->direction);
        append_found_count(d, answer);
    }
}

const layer_type layer_RAY = {
    .add_answer = add_ray,
    .write_answer = write_ray,
    .legend = {.order = 152, .sign = SIGN_ARROW, .text = "ray query", .drop_order = DROP_LATE},
    .describe = describe_ray};

/* ---- Moving boxes ------------------------------------------------------------------------------------------- */

/* The parts of a moving box: its first, its last and its searched position, and the ways of its eight corners. */
enum { SWEEP_FIRST, SWEEP_LAST, SWEEP_SEARCHED, SWEEP_WAYS };

/* Returns the moving box at the parameter t. */
static octree_box find_moving_box(const octree_answer *sweep, double t)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        const double at = t == 1 ? sweep->to[i] : sweep->target[i] * (1 - t) + sweep->to[i] * t;
        box.min[i] = at - sweep->half[i];
        box.max[i] = at + sweep->half[i];
    }
    return box;
}

static void add_ways(scene *s, const octree_box *first, const octree_box *last, size_t place, scene_style style)
{
    double from[3], to[3];
    for (size_t corner = 0; corner < 8; corner++) {
        for (int i = 0; i < 3; i++) {
            from[i] = corner >> i & 1 ? first->max[i] : first->min[i];
            to[i] = corner >> i & 1 ? last->max[i] : last->min[i];
        }
        scene_add_line(s, make_part_id(place, SWEEP_WAYS + corner), from, to, style);
    }
}

/* With k hits, the search ended where the box hit the last of them. */
static void add_sweep(scene *s, const layer_source *in, size_t place, view_layer layer)
{
    const octree_answer *sweep = &in->answers[place];
    const octree_box first = find_moving_box(sweep, 0), last = find_moving_box(sweep, 1);
    const unsigned half = sweep->count <= FEW_MARKS ? 6 : sweep->count <= MANY_MARKS ? 3 : 1;
    const scene_style thin = make_layer_style(layer, STROKE_SOLID, 1);
    double ranked[NUMBERED_RANKS][3];
    const size_t ranks = sweep->count < NUMBERED_RANKS ? sweep->count : NUMBERED_RANKS;
    scene_add_outline(s, make_part_id(place, SWEEP_FIRST), &first, make_layer_style(layer, STROKE_SOLID, 2));
    scene_add_outline(s, make_part_id(place, SWEEP_LAST), &last, make_layer_style(layer, STROKE_DASHED, 1));
    add_ways(s, &first, &last, place, make_layer_style(layer, STROKE_DASHED, 1));
    if (sweep->count > 0 && sweep->count == sweep->k) {
        const octree_box searched = find_moving_box(sweep, sweep->neighbors[sweep->count - 1].distance);
        scene_add_outline(s, make_part_id(place, SWEEP_SEARCHED), &searched, make_layer_style(layer, STROKE_SOLID, 2));
    }
    for (size_t i = 0; i < sweep->count; i++)
        scene_add_mark(s, sweep->neighbors[i].point.id, sweep->neighbors[i].point.position, SHAPE_DIAMOND,
                       make_layer_style(layer, STROKE_SOLID, half));
    for (size_t i = 0; i < ranks; i++)
        memcpy(ranked[i], sweep->neighbors[i].point.position, sizeof ranked[i]);
    add_ranks(s, ranked, ranks, half, place, thin);
}

static void write_sweep(pen *p, const octree_answer *answer)
{
    if (answer->k == 1)
        write_only_neighbor(p, "sweep", answer, "t ", "");
    else
        write_neighbors(p, "sweep", answer);
}

static void describe_sweep(description *d, const described_element *element)
{
    static const char *const parts[] = {"first position", "last position", "searched end"};
    const uint64_t place = element->id >> 32, part = element->id & UINT32_MAX;
    if (element->kind == SCENE_LABEL) {
        append_text(d, ", the rank of a hit");
    } else if (element->kind == SCENE_PANEL) {
        append_text(d, "the background of the rank of a hit");
    } else {
        const octree_answer *answer = append_query(d, part < SWEEP_WAYS ? parts[part] : "way of a corner", place);
        append_position(d, ": from ", answer->target);
        append_position(d, " to ", answer->to);
        append_found_count(d, answer);
    }
}

const layer_type layer_SWEEP = {
    .add_answer = add_sweep,
    .write_answer = write_sweep,
    .legend = {.order = 153, .sign = SIGN_DASHES, .text = "sweep query", .drop_order = DROP_LATE},
    .describe = describe_sweep};
