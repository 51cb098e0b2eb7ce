/* SPDX-License-Identifier: MIT */
/* inspect_answers.h - answers queries with the tree of a point cloud, and prints the answers with their cost. */
#ifndef REPLAY_INSPECT_ANSWERS_H
#define REPLAY_INSPECT_ANSWERS_H

#include "error.h"
#include "octree/game.h"

#include <math.h>
#include <stdio.h>

/* The answers to a list of queries, in the order of the queries. */
typedef struct inspect_answers {
    const octree *tree;
    octree_answer *answers; /* the answers, in the form that the answers of a game's tick have */
    /* nearest[i]: if answer i answers a radius query, its points sorted by distance; otherwise empty. */
    octree_answer *nearest;
    size_t count;
} inspect_answers;

/* The thickness of a ray for which the user gave none. */
#define INSPECT_ANY_THICKNESS NAN

/* Give each ray with INSPECT_ANY_THICKNESS one that suits the tree: about the distance of neighbouring points. Without
 * it, rays would hit no points. */
void inspect_fill_queries(const octree *tree, octree_query *queries, size_t count);

/* Answer a list of queries. The region of a query may extend beyond the world. If a query is invalid or memory runs
 * out, returns false with an error; there is then nothing to release. */
bool inspect_ask(const octree *tree, const octree_query *queries, size_t count, inspect_answers *result,
                 octreel_error *error);
void inspect_answers_release(inspect_answers *answers);

/* Print the answers as text, with the first LIST_LINES points of each answer, or as one JSON object on one line. `name`
 * is printed as the name of the cloud. */
void inspect_print_answers(const inspect_answers *answers, const char *name, bool json, FILE *out);

#endif
