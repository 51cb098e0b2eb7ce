/* SPDX-License-Identifier: MIT */
/* inspect_answers.h - queries that the tree of a cloud answers, and what each answer cost. */
#ifndef REPLAY_INSPECT_ANSWERS_H
#define REPLAY_INSPECT_ANSWERS_H

#include "error.h"
#include "octree/game.h"

#include <stdio.h>

/* The answers to some queries, in their order. */
typedef struct inspect_answers {
    const octree *tree;
    octree_answer *answers; /* as a tick of a game has them */
    octree_answer *nearest; /* where the answer is points about a target: the same points as neighbours; else empty */
    size_t count;
} inspect_answers;

/* Ask a tree. Every point counts, and queries may reach beyond the world. False with an error where a query does not
 * fit or there is no memory; nothing is then to be released. */
bool inspect_ask(const octree *tree, const octree_query *queries, size_t count, inspect_answers *result,
                 octreel_error *error);
void inspect_answers_release(inspect_answers *answers);

/* Print the answers: for people, the first LIST_LINES points of each, or as one JSON object on one line. `name` is what
 * the cloud is called there. */
void inspect_print_answers(const inspect_answers *answers, const char *name, bool json, FILE *out);

#endif
