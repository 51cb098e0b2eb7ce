/* SPDX-License-Identifier: MIT */
/* trial.h - one trial: a scene, a tree, and the model that says what the tree must hold and answer. */
#ifndef CAMPAIGN_TRIAL_H
#define CAMPAIGN_TRIAL_H

#include "counting_allocator.h"
#include "model.h"
#include "scenes.h"

enum { POINTS_AT_MOST = 1024, FAULT_TEXT = 1024 };

/* Whether a point belongs to an answer. */
typedef enum verdict { MUST_NOT, MAY, MUST } verdict;

/* What a visitor was called with. */
typedef struct gathered {
    octree_point points[POINTS_AT_MOST];
    size_t count;   /* calls; beyond the room they are only counted */
    uint64_t seals; /* the sum over the points: an order-free digest */
    size_t stop_at; /* the call that asks to stop; 0 is none */
} gathered;

typedef struct trial {
    uint64_t random; /* the generator's state */
    scene scene;
    uint64_t ids;      /* ids are below this */
    size_t population; /* how many points changes tend to */
    octree_def def;    /* at the start */
    model model;
    octree *tree;
    counting_allocator memory;
    octree_cost cost;
    verdict verdicts[POINTS_AT_MOST]; /* of the model's points */
    gathered found;
    octree_neighbor neighbors[POINTS_AT_MOST + 1];
    const char *operation; /* the last one's name */
    size_t answers;        /* points in the answers of the last operation, or changes it made */
    char fault[FAULT_TEXT];
} trial;

/* Make a tree of the scene that a seed gives: of kind `kind`, or of any for a kind that there is not. */
bool trial_begin(trial *t, uint64_t seed, size_t kind);

/* Compare the tree with the validator, with the model, and with a tree that is built anew. */
bool trial_audit(trial *t);

/* Destroy the tree; false when memory is left or came back wrongly. */
bool trial_end(trial *t);

/* Write down what is wrong. Always false, so that a caller can return it. */
bool trial_fail(trial *t, const char *format, ...);

/* Add to what was written down. Always false. */
bool trial_add(trial *t, const char *format, ...);

/* A random whole number below a limit, of this trial. */
size_t below(trial *t, size_t limit);

#endif
