/* inspect_query.h - what a tree of a cloud answers to queries, and what it looked at for that. */
#ifndef RECORD_INSPECT_QUERY_H
#define RECORD_INSPECT_QUERY_H

#include "folder.h"
#include "octree/game.h"

/* The answers to some queries, in their order. */
typedef struct inspect_answers {
    const octree *tree;
    octree_answer *answers; /* as a tick of a game has them */
    octree_answer *nearest; /* of points about a target: the same points as neighbours; else empty */
    size_t count;
} inspect_answers;

/* Ask a tree. Every point counts, and queries may reach beyond the world. False, and a sentence, when a query does not
 * fit or there is no memory; nothing is then to be released. */
bool inspect_ask(const octree *tree, const octree_query *queries, size_t count, inspect_answers *result,
                 octreel_error *error);
void inspect_answers_release(inspect_answers *answers);

/* The answers for people, or as one JSON object on one line. `name` is the cloud's. */
void inspect_print_answers(const octree *tree, const inspect_answers *answers, const char *name, bool json, FILE *out);

#endif
