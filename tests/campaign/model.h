/* SPDX-License-Identifier: MIT */
/* model.h - the model of a tree, which says what the tree must hold and refuse: a list of points, and the paper's rule
 * of full leaves. */
#ifndef CAMPAIGN_MODEL_H
#define CAMPAIGN_MODEL_H

#include "octree/octree.h"

typedef struct model {
    octree_def def; /* the current definition */
    octree_point *points;
    octree_address *cells; /* of each point: the smallest cell of a leaf there; 0: no leaf refuses points */
    uint64_t *seals;       /* of each point: a digest of its bits */
    size_t count, room;
} model;

/* No such point. */
#define MODEL_NONE SIZE_MAX

void model_begin(model *m, const octree_def *def);
void model_end(model *m);

/* Apply the change to the model if the library must accept it. Returns the status that the library must return. */
octree_status model_insert(model *m, const double at[3], uint64_t id);
octree_status model_remove(model *m, const double at[3], uint64_t id);
octree_status model_move(model *m, const double from[3], uint64_t id, const double to[3]);
octree_status model_reworld(model *m, const octree_box *world);
void model_clear(model *m);

/* The index of a pair, compared as numbers; and the index of a point with exactly the same bits. Or MODEL_NONE. */
size_t model_find(const model *m, const double at[3], uint64_t id);
size_t model_find_bits(const model *m, const octree_point *point);

/* NOT_FINITE, OUTSIDE or OK. */
octree_status model_check(const model *m, const double at[3]);

/* The order of "sorted" results: by id, then by position. */
int model_order(const octree_point *a, const octree_point *b);

/* A digest of a point's bits. */
uint64_t model_seal(const octree_point *point);

#endif
