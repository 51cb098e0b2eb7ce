/* SPDX-License-Identifier: MIT */
/* inspect_answers.c - queries the tree of a cloud and prints the answers. The tables of octree/query.h say which
 * members each kind of query has. */
#include "inspect_answers.h"
#include "inspect.h"
#include "json_write.h"
#include "number.h"
#include "octree/octree.h"
#include "text.h"
#include "ticks_write.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NOTE_TEXT 80

/* ---- Asking ------------------------------------------------------------------------------------------------- */

/* Returns true if the query is a ball: it has a target, a radius and bounds, and nothing else. */
static bool is_ball(octree_query_kind kind)
{
    return octree_query_about(kind)->members ==
           (OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_RADIUS | OCTREE_QUERY_HAS_BOUNDS);
}

/* Find the distances of the `count` points in a ball. A radius query returns no distances, so the `count` nearest
 * neighbours of the ball's center are found: these neighbours are the same points. */
static octree_status find_distances(const octree *tree, const octree_query *query, size_t count, octree_answer *nearest)
{
    octree_query by_distance = *query;
    by_distance.kind = OCTREE_QUERY_KNEAREST;
    by_distance.k = count;
    return octree_query_answer(tree, &by_distance, NULL, NULL, nearest);
}

static octree_status answer_query(const octree *tree, const octree_query *query, inspect_answers *result)
{
    octree_answer *answer = &result->answers[result->count], *nearest = &result->nearest[result->count];
    result->count++; /* count the answer now, so that inspect_answers_release() frees it also after an error */
    octree_status status = octree_query_answer(tree, query, NULL, NULL, answer);
    if (status == OCTREE_OK && is_ball(query->kind))
        status = find_distances(tree, query, answer->count, nearest);
    return status;
}

/* Returns the distance of neighbouring points if the points of a leaf lie on a surface, rounded up. The leaf has the
 * median depth and the mean number of points. */
static double find_default_thickness(const octree *tree)
{
    octree_stats stats;
    double half = 0; /* half the longest side of the world; the whole side could overflow */
    if (octree_statistics(tree, &stats) != OCTREE_OK || stats.points == 0)
        return 0;
    const octree_box world = octree_definition(tree).world;
    for (int i = 0; i < 3; i++)
        half = fmax(half, world.max[i] / 2 - world.min[i] / 2);
    unsigned depth = 0;
    for (size_t count = stats.leaves_at_depth[0]; count * 2 < stats.leaves; count += stats.leaves_at_depth[depth])
        depth++;
    const double points = (double)stats.points / (double)stats.leaves;
    return number_round_up_to_1_2_5(ldexp(half, 1 - (int)depth) / sqrt(points));
}

void inspect_fill_queries(const octree *tree, octree_query *queries, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (octree_query_about(queries[i].kind)->members & OCTREE_QUERY_HAS_THICKNESS && isnan(queries[i].thickness))
            queries[i].thickness = find_default_thickness(tree);
        else if (isnan(queries[i].thickness))
            queries[i].thickness = 0;
}

bool inspect_ask(const octree *tree, const octree_query *queries, size_t count, inspect_answers *result,
                 octreel_error *error)
{
    const size_t room = count ? count : 1;
    *result = (inspect_answers){.tree = tree,
                                .answers = calloc(room, sizeof *result->answers),
                                .nearest = calloc(room, sizeof *result->nearest)};
    octree_status status = result->answers && result->nearest ? OCTREE_OK : OCTREE_NO_MEMORY;
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = answer_query(tree, &queries[i], result);
    if (status == OCTREE_OK)
        return true;
    inspect_answers_release(result);
    return error_set(error, "the query cannot be answered: %s", octree_status_text(status));
}

void inspect_answers_release(inspect_answers *answers)
{
    for (size_t i = 0; i < answers->count; i++) {
        octree_answer_release(answers->tree, &answers->answers[i]);
        octree_answer_release(answers->tree, &answers->nearest[i]);
    }
    free(answers->answers);
    free(answers->nearest);
    *answers = (inspect_answers){0};
}

/* ---- Printing ----------------------------------------------------------------------------------------------- */

/* An answer to print, with the data that printing needs. */
typedef struct shown_answer {
    const octree_answer *answer;
    const octree_query_traits *about;
    const octree_neighbor *neighbors; /* the points with their distances; null if the query has no distances */
    octree_box world;
} shown_answer;

/* Returns true for rays and moving boxes. */
static bool is_cast(const octree_query_traits *about)
{
    return about->members & (OCTREE_QUERY_HAS_DIRECTION | OCTREE_QUERY_HAS_TO);
}

static shown_answer make_shown_answer(const inspect_answers *answers, size_t i)
{
    const octree_answer *answer = &answers->answers[i];
    return (shown_answer){answer, octree_query_about(answer->kind),
                          answer->neighbors ? answer->neighbors : answers->nearest[i].neighbors,
                          octree_definition(answers->tree).world};
}

/* Returns the i-th point of an answer. Points are sorted by distance, or by id if the query has no distances. */
static const octree_point *point_at(const shown_answer *shown, size_t i)
{
    return shown->neighbors ? &shown->neighbors[i].point : &shown->answer->points[i];
}

static const double *distance_at(const shown_answer *shown, size_t i)
{
    return shown->neighbors ? &shown->neighbors[i].distance : NULL;
}

/* Returns true if a box and the world have no point in common. */
static bool is_outside(const octree_box *world, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (box->max[i] < world->min[i] || box->min[i] > world->max[i])
            return true;
    return false;
}

/* Write the reason why an answer has fewer points than the user may expect. Returns false if there is no such reason.
 */
static bool describe_answer_note(const shown_answer *shown, char note[NOTE_TEXT])
{
    const octree_answer *answer = shown->answer;
    octree_box bound, target;
    memcpy(target.min, answer->target, sizeof target.min);
    memcpy(target.max, answer->target, sizeof target.max);
    *note = 0;
    if (is_cast(shown->about))
        snprintf(note, answer->count == 0 ? NOTE_TEXT : 1, "the %s hits no point; a thicker %s may",
                 shown->about->region, shown->about->region);
    else if (shown->about->neighbors && answer->count < answer->k)
        snprintf(note, NOTE_TEXT, "the tree holds no %spoints", answer->count == 0 ? "" : "more ");
    else if (octree_answer_bound(answer, &bound) && is_outside(&shown->world, &bound))
        snprintf(note, NOTE_TEXT, "the %s lies outside the world", shown->about->region);
    else if (shown->about->members & OCTREE_QUERY_HAS_TARGET && is_outside(&shown->world, &target))
        snprintf(note, NOTE_TEXT, "the %s lies outside the world", shown->about->neighbors ? "place" : "centre");
    return *note != 0;
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* Print the normal and the offset of each half-space. */
static void print_frustum(const octree_frustum *frustum, FILE *out)
{
    for (size_t i = 0; i < frustum->count; i++) {
        fputs(i == 0 ? "" : ",", out);
        inspect_print_numbers(frustum->half_spaces[i].normal, 3, out);
        fputs(" <=", out);
        inspect_print_numbers(&frustum->half_spaces[i].offset, 1, out);
    }
}

static void print_member(const shown_answer *shown, const octree_query_member_traits *member, FILE *out)
{
    const char *value = (const char *)shown->answer + member->in_answer;
    switch (member->type) {
    case OCTREE_MEMBER_BOX:
        inspect_print_numbers(((const octree_box *)value)->min, 3, out);
        fputs("  to ", out);
        inspect_print_numbers(((const octree_box *)value)->max, 3, out);
        break;
    case OCTREE_MEMBER_POSITION:
        fprintf(out, " %s",
                member->bit == OCTREE_QUERY_HAS_TO ? "to"
                : is_cast(shown->about)            ? "from"
                : shown->about->neighbors          ? "to"
                                                   : "about");
        inspect_print_numbers((const double *)value, 3, out);
        break;
    case OCTREE_MEMBER_DIRECTION:
        fputs(" in direction", out);
        inspect_print_numbers((const double *)value, 3, out);
        break;
    case OCTREE_MEMBER_LENGTH:
        if (member->optional && *(const double *)value == 0)
            break;
        if (member->optional)
            fprintf(out, ", %s", member->key);
        inspect_print_numbers((const double *)value, 1, out);
        break;
    case OCTREE_MEMBER_BOUNDS:
        if (*(const octree_bounds *)value != OCTREE_BOUNDS_CLOSED)
            fprintf(out, ", %s bounds", octree_bounds_name(*(const octree_bounds *)value));
        break;
    case OCTREE_MEMBER_FRUSTUM:
        print_frustum((const octree_frustum *)value, out);
        break;
    case OCTREE_MEMBER_EXTENTS:
        fprintf(out, ", half extents");
        inspect_print_numbers((const double *)value, 3, out);
        break;
    case OCTREE_MEMBER_COUNT: /* a count is printed at the start of the question */
        break;
    }
}

/* Print a query: "range MIN to MAX", "radius R about PLACE", "nearest to PLACE", "8 nearest to PLACE" or "first 8 hits
 * of the ray in direction D from PLACE". The member that gives the query kind its name comes first. */
static void print_question(const shown_answer *shown, FILE *out)
{
    const octree_query_traits *about = shown->about;
    if (is_cast(about) && shown->answer->k == 1)
        fprintf(out, "first hit of the %s", about->region);
    else if (is_cast(about))
        fprintf(out, "first %zu hits of the %s", shown->answer->k, about->region);
    else if (about->members & OCTREE_QUERY_HAS_K)
        fprintf(out, "%zu nearest", shown->answer->k);
    else
        fputs(about->name, out);
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
            const octree_query_member_traits *member = octree_query_member_at(i);
            if (about->members & member->bit && (member->bit != about->named_by) == pass)
                print_member(shown, member, out);
        }
}

static void print_answer(const shown_answer *shown, FILE *out)
{
    char note[NOTE_TEXT];
    const octree_cost *cost = &shown->answer->cost;
    print_question(shown, out);
    fprintf(out, ": %zu found\n", shown->answer->count);
    if (describe_answer_note(shown, note))
        fprintf(out, "  note: %s\n", note);
    for (size_t i = 0; i < shown->answer->count && i < LIST_LINES; i++)
        inspect_print_point(point_at(shown, i), is_cast(shown->about) ? shown->about->measure : "at",
                            distance_at(shown, i), out);
    print_remaining_count(out, shown->answer->count, LIST_LINES, "--json lists all");
    fprintf(out,
            "  cost: %" PRIu64 " node%s visited (%" PRIu64 " %s); %" PRIu64 " point%s compared; %" PRIu64
            " node%s pruned, %" PRIu64 " taken whole\n",
            cost->nodes, plural_ending(cost->nodes), cost->leaves, cost->leaves == 1 ? "leaf" : "leaves", cost->points,
            plural_ending(cost->points), cost->pruned, plural_ending(cost->pruned), cost->taken);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_points(json_writer *w, const shown_answer *shown)
{
    json_write_integer_member(w, "found", shown->answer->count);
    json_begin_array_member(w, "points");
    for (size_t i = 0; i < shown->answer->count; i++)
        inspect_write_point(w, point_at(shown, i), shown->about->measure, distance_at(shown, i));
    json_write_end_array(w);
}

static void write_answer(json_writer *w, const shown_answer *shown)
{
    char note[NOTE_TEXT];
    json_write_begin_object(w);
    json_write_text_member(w, "query", shown->about->name);
    tick_write_query_parameters(w, shown->answer);
    if (shown->about->neighbors && !(shown->about->members & OCTREE_QUERY_HAS_K))
        json_write_integer_member(w, "k", shown->answer->k);
    write_points(w, shown);
    if (describe_answer_note(shown, note))
        json_write_text_member(w, "note", note);
    json_begin_object_member(w, "cost");
    json_write_integer_member(w, "nodes", shown->answer->cost.nodes);
    json_write_integer_member(w, "leaves", shown->answer->cost.leaves);
    json_write_integer_member(w, "points", shown->answer->cost.points);
    json_write_integer_member(w, "pruned", shown->answer->cost.pruned);
    json_write_integer_member(w, "taken", shown->answer->cost.taken);
    json_write_end_object(w);
    json_write_end_object(w);
}

void inspect_print_answers(const inspect_answers *answers, const char *name, bool json, FILE *out)
{
    json_writer writer = {.out = out}, *w = &writer;
    if (json) {
        json_write_begin_object(w);
        json_write_text_member(w, "cloud", name);
        json_begin_array_member(w, "answers");
    } else {
        inspect_print_name(name, out);
    }
    for (size_t i = 0; i < answers->count; i++) {
        const shown_answer shown = make_shown_answer(answers, i);
        if (json)
            write_answer(w, &shown);
        else
            print_answer(&shown, out);
    }
    if (json) {
        json_write_end_array(w);
        json_write_end_object(w);
        json_write_end_line(w);
    }
}
