/* inspect_answer.c - what a tree of a cloud answered: for people, and as JSON. */
#include "inspect_query.h"
#include "json_write.h"
#include "number.h"

#include <inttypes.h>

/* The answers and the i-th of them. */
typedef struct told {
    const octree_answer *answer;
    const octree_neighbor *distances; /* null for boxes */
    const octree_cost *cost;
    octree_box world;
} told;

static told tell(const octree *tree, const inspect_answers *answers, size_t i)
{
    const octree_answer *answer = &answers->answers[i];
    const octree_neighbor *distances = answer->neighbors ? answer->neighbors : answers->nearest[i].neighbors;
    return (told){answer, distances, &answer->cost, octree_definition(tree).world};
}

/* The i-th point of an answer: by distance, or of a box by id. */
static const octree_point *point_at(const told *t, size_t i)
{
    return t->distances ? &t->distances[i].point : &t->answer->points[i];
}

/* ---- What deserves a word ----------------------------------------------------------------------------------- */

static bool is_outside(const octree_box *world, const double position[3])
{
    for (int i = 0; i < 3; i++)
        if (position[i] < world->min[i] || position[i] > world->max[i])
            return true;
    return false;
}

/* Whether a box, which may be larger than the doubles, has nothing in common with the world. */
static bool misses(const octree_box *world, const double center[3], double radius)
{
    for (int i = 0; i < 3; i++)
        if (center[i] + radius < world->min[i] || center[i] - radius > world->max[i])
            return true;
    return false;
}

static bool box_misses(const octree_box *world, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < world->min[i] || box->min[i] > world->max[i])
            return true;
    return false;
}

/* Null when there is nothing to say. */
static const char *note_of(const told *t)
{
    const octree_answer *answer = t->answer;
    switch (answer->kind) {
    case OCTREE_QUERY_RANGE:
        return box_misses(&t->world, &answer->box) ? "the box lies outside the world" : NULL;
    case OCTREE_QUERY_RADIUS:
        return misses(&t->world, answer->target, answer->radius) ? "the ball lies outside the world"
               : is_outside(&t->world, answer->target)           ? "the centre lies outside the world"
                                                                 : NULL;
    default:
        return answer->count == 0 && answer->k > 0     ? "the tree holds no points"
               : answer->count < answer->k             ? "the tree holds no more points"
               : is_outside(&t->world, answer->target) ? "the place lies outside the world"
                                                       : NULL;
    }
}

/* ---- For people --------------------------------------------------------------------------------------------- */

static void print_numbers(FILE *out, const double *values, size_t count)
{
    char text[NUMBER_TEXT];
    for (size_t i = 0; i < count; i++) {
        number_print(values[i], text);
        fprintf(out, " %s", text);
    }
}

static void print_question(const octree_answer *answer, FILE *out)
{
    if (answer->kind == OCTREE_QUERY_RANGE) {
        fputs("range", out);
        print_numbers(out, answer->box.min, 3);
        fputs("  to ", out);
        print_numbers(out, answer->box.max, 3);
        return;
    }
    if (answer->kind == OCTREE_QUERY_RADIUS) {
        fputs("radius", out);
        print_numbers(out, &answer->radius, 1);
        fputs(" about", out);
    } else if (answer->kind == OCTREE_QUERY_KNEAREST) {
        fprintf(out, "%zu nearest to", answer->k);
    } else {
        fputs("nearest to", out);
    }
    print_numbers(out, answer->target, 3);
}

static void print_answer(const told *t, FILE *out)
{
    const char *note = note_of(t);
    print_question(t->answer, out);
    fprintf(out, ": %zu found\n", t->answer->count);
    if (note)
        fprintf(out, "  note: %s\n", note);
    for (size_t i = 0; i < t->answer->count; i++) {
        const octree_point *point = point_at(t, i);
        fprintf(out, "  %" PRIu64 ":", point->id);
        print_numbers(out, point->position, 3);
        if (t->distances) {
            fputs("  at", out);
            print_numbers(out, &t->distances[i].distance, 1);
        }
        fputc('\n', out);
    }
    fprintf(out,
            "  cost: %" PRIu64 " nodes visited, %" PRIu64 " of them leaves; %" PRIu64 " points compared; %" PRIu64
            " nodes pruned\n",
            t->cost->nodes, t->cost->leaves, t->cost->points, t->cost->pruned);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_question(json_writer *w, const octree_answer *answer)
{
    json_write_key(w, "query");
    json_write_string(w, octree_query_name(answer->kind));
    if (answer->kind == OCTREE_QUERY_RANGE) {
        json_member_vector(w, "min", answer->box.min);
        json_member_vector(w, "max", answer->box.max);
    } else if (answer->kind == OCTREE_QUERY_RADIUS) {
        json_member_vector(w, "center", answer->target);
        json_write_key(w, "radius");
        json_write_number(w, answer->radius);
    } else {
        json_member_vector(w, "target", answer->target);
        json_member_integer(w, "k", answer->k);
    }
}

static void write_points(json_writer *w, const told *t)
{
    json_member_integer(w, "found", t->answer->count);
    json_write_key(w, "points");
    json_write_begin_array(w);
    for (size_t i = 0; i < t->answer->count; i++) {
        json_write_begin_object(w);
        json_member_integer(w, "id", point_at(t, i)->id);
        json_member_vector(w, "position", point_at(t, i)->position);
        if (t->distances) {
            json_write_key(w, "distance");
            json_write_number(w, t->distances[i].distance);
        }
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_answer(json_writer *w, const told *t)
{
    const char *note = note_of(t);
    json_write_begin_object(w);
    write_question(w, t->answer);
    write_points(w, t);
    if (note) {
        json_write_key(w, "note");
        json_write_string(w, note);
    }
    json_write_key(w, "cost");
    json_write_begin_object(w);
    json_member_integer(w, "nodes", t->cost->nodes);
    json_member_integer(w, "leaves", t->cost->leaves);
    json_member_integer(w, "points", t->cost->points);
    json_member_integer(w, "pruned", t->cost->pruned);
    json_write_end_object(w);
    json_write_end_object(w);
}

static void write_answers(const octree *tree, const inspect_answers *answers, const char *name, FILE *out)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_key(w, "cloud");
    json_write_string(w, name);
    json_write_key(w, "answers");
    json_write_begin_array(w);
    for (size_t i = 0; i < answers->count; i++) {
        const told t = tell(tree, answers, i);
        write_answer(w, &t);
    }
    json_write_end_array(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

void inspect_print_answers(const octree *tree, const inspect_answers *answers, const char *name, bool json, FILE *out)
{
    if (json) {
        write_answers(tree, answers, name, out);
        return;
    }
    fprintf(out, "%s\n", name);
    for (size_t i = 0; i < answers->count; i++) {
        const told t = tell(tree, answers, i);
        print_answer(&t, out);
    }
}
