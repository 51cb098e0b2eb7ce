/* answer_layers.c - see answer_layers.h. */
#include "answer_layers.h"
#include "element_ids.h"
#include "layer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FEW_MARKS 50
#define MANY_MARKS 500

static void add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style)
{
    scene_segment line = {.id = id, .style = style};
    memcpy(line.ends[0], from, sizeof line.ends[0]);
    memcpy(line.ends[1], to, sizeof line.ends[1]);
    scene_add_segment(s, line);
}

/* A marker on a point; `half` is half its size. */
static void mark(scene *s, const octree_point *point, scene_style style, scene_shape shape, uint8_t half)
{
    scene_marker marker = {.id = point->id, .style = style, .shape = (uint8_t)shape};
    marker.style.width = half;
    memcpy(marker.at, point->position, sizeof marker.at);
    scene_add_marker(s, marker);
}

/* Smaller where there are many: they would hide each other, and what they lie on. */
static void mark_points(scene *s, const octree_answer *answer, scene_style style, scene_shape shape, uint8_t half)
{
    const uint8_t size = answer->count <= FEW_MARKS ? half : answer->count <= MANY_MARKS ? half / 2 : 1;
    for (size_t i = 0; i < answer->count; i++)
        mark(s, &answer->points[i], style, shape, size);
}

static void add_range(scene *s, const octree_answer *answer, size_t place)
{
    const scene_style style = layer_style(LAYER_RANGE, STROKE_DASHED, 1);
    scene_add_box(s, (scene_box){.id = place, .box = answer->box, .style = style});
    mark_points(s, answer, style, SHAPE_FRAME, 5);
}

/* The point at a part of the way round the circle about a centre that does not leave the plane of two axes. */
static void point_on_circle(const octree_answer *ball, int plane, int part, double position[3])
{
    double cosine, sine;
    camera_turn((double)part / BALL_CHORDS, &cosine, &sine);
    memcpy(position, ball->target, sizeof ball->target);
    position[(plane + 1) % 3] += ball->radius * cosine;
    position[(plane + 2) % 3] += ball->radius * sine;
}

static void add_circle(scene *s, const octree_answer *ball, size_t place, int plane, scene_style style)
{
    double from[3], to[3];
    point_on_circle(ball, plane, 0, from);
    for (int i = 0; i < BALL_CHORDS; i++) {
        point_on_circle(ball, plane, (i + 1) % BALL_CHORDS, to);
        add_line(s, answer_part_id(place, (size_t)(plane * BALL_CHORDS + i)), from, to, style);
        memcpy(from, to, sizeof from);
    }
}

static void add_ball(scene *s, const octree_answer *answer, size_t place)
{
    const scene_style style = layer_style(LAYER_RADIUS, STROKE_SOLID, 1);
    for (int plane = 0; plane < BALL_CIRCLES; plane++)
        add_circle(s, answer, place, plane, style);
    mark_points(s, answer, style, SHAPE_LOZENGE, 8);
}

static void add_nearest(scene *s, const octree_answer *answer, size_t place)
{
    const scene_style style = layer_style(LAYER_NEAREST, STROKE_DASHED, 1);
    for (size_t i = 0; i < answer->count; i++) {
        add_line(s, place, answer->target, answer->neighbors[i].point.position, style);
        mark(s, &answer->neighbors[i].point, style, SHAPE_FRAME, 7);
    }
}

/* Units that a digit takes, and its distance from the next. */
#define DIGIT_WIDTH 8
#define DIGIT_HEIGHT 9

/* True when a number beside this place would cover one of those beside earlier places. */
static bool is_crowded(const scene *s, double pixels[][2], size_t earlier)
{
    bool crowded = false;
    for (size_t i = 0; i < earlier; i++)
        crowded |= fabs(pixels[i][0] - pixels[earlier][0]) < DIGIT_WIDTH * s->unit &&
                   fabs(pixels[i][1] - pixels[earlier][1]) < DIGIT_HEIGHT * s->unit;
    return crowded;
}

/* The ranks of the first few, each beside its neighbour; where two would overlap, that of the nearer alone. */
static void add_ranks(scene *s, const octree_answer *answer, size_t place, scene_style style)
{
    double pixels[NUMBERED_RANKS][2], seen[3];
    size_t numbered = 0;
    for (size_t i = 0; i < answer->count && i < NUMBERED_RANKS; i++) {
        scene_label rank = {.id = answer_part_id(place, i), .in_world = true, .style = style};
        memcpy(rank.at, answer->neighbors[i].point.position, sizeof rank.at);
        camera_transform(&s->camera, rank.at, seen);
        if (s->camera.perspective && seen[2] < s->camera.near)
            continue; /* behind the eye */
        camera_project(&s->camera, seen, pixels[numbered]);
        if (is_crowded(s, pixels, numbered))
            continue;
        numbered++;
        snprintf(rank.text, sizeof rank.text, " %zu", i + 1); /* the blank keeps clear of a marker */
        scene_add_label(s, rank);
    }
}

static void add_knearest(scene *s, const octree_answer *answer, size_t place)
{
    const scene_style style = layer_style(LAYER_KNEAREST, STROKE_SOLID, 1);
    for (size_t i = 0; i < answer->count; i++)
        add_line(s, answer_part_id(place, i), answer->target, answer->neighbors[i].point.position, style);
    add_ranks(s, answer, place, style);
}

view_layer answer_layer(octree_query_kind kind)
{
    static const view_layer layers[OCTREE_QUERY_KINDS] = {
        [OCTREE_QUERY_RANGE] = LAYER_RANGE,
        [OCTREE_QUERY_NEAREST] = LAYER_NEAREST,
        [OCTREE_QUERY_KNEAREST] = LAYER_KNEAREST,
        [OCTREE_QUERY_RADIUS] = LAYER_RADIUS,
    };
    return layers[kind];
}

void add_answers(scene *s, const octree_answer *answers, size_t count)
{
    static void (*const adders[OCTREE_QUERY_KINDS])(scene *, const octree_answer *, size_t) = {
        [OCTREE_QUERY_RANGE] = add_range,
        [OCTREE_QUERY_NEAREST] = add_nearest,
        [OCTREE_QUERY_KNEAREST] = add_knearest,
        [OCTREE_QUERY_RADIUS] = add_ball,
    };
    for (size_t i = 0; i < count; i++)
        adders[answers[i].kind](s, &answers[i], i);
}
