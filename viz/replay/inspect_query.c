/* inspect_query.c - see inspect_query.h: asking. */
#include "inspect_query.h"
#include "grow.h"

#include <stdlib.h>
#include <string.h>

/* ---- Points ------------------------------------------------------------------------------------------------- */

typedef struct found {
    octree_point *points;
    size_t count, room;
    bool no_memory;
} found;

static bool take_point(const octree_point *point, void *context)
{
    found *f = context;
    octree_point *grown = grow_by_one(f->points, f->count, &f->room, 64, sizeof *grown);
    f->no_memory = !grown;
    if (!grown)
        return false;
    f->points = grown;
    f->points[f->count++] = *point;
    return true;
}

/* Those of a box or a ball, by id. */
static octree_status find_points(const octree *tree, octree_answer *answer, const octree_search *how)
{
    found f = {0};
    octree_status status = answer->kind == OCTREE_QUERY_RADIUS
                               ? octree_radius(tree, answer->target, answer->radius, how, take_point, &f)
                               : octree_range_search(tree, &answer->box, how, take_point, &f);
    if (f.count)
        qsort(f.points, f.count, sizeof *f.points, octree_compare_points);
    answer->points = f.points;
    answer->count = f.count;
    return f.no_memory ? OCTREE_NO_MEMORY : status;
}

/* ---- Neighbours --------------------------------------------------------------------------------------------- */

/* The k nearest points, or all where there are fewer. */
static octree_status find_nearest(const octree *tree, const double target[3], size_t k, const octree_search *how,
                                  octree_neighbor **neighbors, size_t *count)
{
    const size_t most = k < octree_count(tree) ? k : octree_count(tree);
    *neighbors = malloc((most ? most : 1) * sizeof **neighbors);
    return *neighbors ? octree_nearest_k(tree, target, most, how, *neighbors, count) : OCTREE_NO_MEMORY;
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

static octree_answer pose(const octree_query *query)
{
    octree_answer answer = {.kind = query->kind, .box = query->box, .radius = query->radius};
    answer.k = query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k;
    memcpy(answer.target, query->target, sizeof answer.target);
    return answer;
}

static octree_status ask(const octree *tree, const octree_query *query, inspect_answers *result)
{
    octree_answer *answer = &result->answers[result->count];
    octree_neighbor **distances = &result->distances[result->count];
    const octree_search how = {.cost = &result->costs[result->count]};
    *answer = pose(query);
    result->count++; /* what is found belongs to the result from here on */
    if (query->kind == OCTREE_QUERY_RANGE)
        return find_points(tree, answer, &how);
    if (query->kind == OCTREE_QUERY_RADIUS) {
        size_t ignored; /* the nearest points, as many as the ball holds, are those of the ball */
        const octree_status status = find_points(tree, answer, &how);
        return status ? status : find_nearest(tree, answer->target, answer->count, NULL, distances, &ignored);
    }
    const octree_status status = find_nearest(tree, answer->target, answer->k, &how, distances, &answer->count);
    answer->neighbors = *distances;
    return status;
}

bool inspect_ask(const octree *tree, const octree_query *queries, size_t count, inspect_answers *result,
                 octreel_error *error)
{
    const size_t room = count ? count : 1;
    *result = (inspect_answers){.answers = calloc(room, sizeof *result->answers),
                                .distances = calloc(room, sizeof *result->distances),
                                .costs = calloc(room, sizeof *result->costs)};
    octree_status status = result->answers && result->distances && result->costs ? OCTREE_OK : OCTREE_NO_MEMORY;
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = ask(tree, &queries[i], result);
    if (status == OCTREE_OK)
        return true;
    inspect_answers_release(result);
    return error_set(error, "the tree cannot be asked: %s", octree_status_text(status));
}

void inspect_answers_release(inspect_answers *answers)
{
    for (size_t i = 0; i < answers->count; i++) {
        free((octree_point *)answers->answers[i].points);
        free(answers->distances[i]);
    }
    free(answers->answers);
    free(answers->distances);
    free(answers->costs);
    *answers = (inspect_answers){0};
}
