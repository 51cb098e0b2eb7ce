/* inspect_query.c - see inspect_query.h: asking. */
#include "inspect_query.h"

#include <stdlib.h>

/* The points found about a target, with their distances: they are the nearest points, as many as were found. */
static octree_status find_distances(const octree *tree, const octree_query *query, size_t count, octree_answer *nearest)
{
    octree_query by_distance = *query;
    by_distance.kind = OCTREE_QUERY_KNEAREST;
    by_distance.k = count;
    return octree_query_answer(tree, &by_distance, NULL, NULL, nearest);
}

static octree_status ask(const octree *tree, const octree_query *query, inspect_answers *result)
{
    octree_answer *answer = &result->answers[result->count], *nearest = &result->nearest[result->count];
    result->count++; /* what is found belongs to the result from here on */
    octree_status status = octree_query_answer(tree, query, NULL, NULL, answer);
    const octree_query_traits *about = octree_query_about(query->kind);
    if (status == OCTREE_OK && !about->neighbors && about->members & OCTREE_QUERY_HAS_TARGET)
        status = find_distances(tree, query, answer->count, nearest);
    return status;
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
        status = ask(tree, &queries[i], result);
    if (status == OCTREE_OK)
        return true;
    inspect_answers_release(result);
    return error_set(error, "the tree cannot be asked: %s", octree_status_text(status));
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
