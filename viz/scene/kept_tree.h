/* SPDX-License-Identifier: MIT */
/* kept_tree.h - what the subtrees of a tree look like in a scene, kept from one tick to the next: where the tree tells
 * that little has changed, those without a change need not be walked again. What is kept is what a walk of the whole
 * tree finds. */
#ifndef SCENE_KEPT_TREE_H
#define SCENE_KEPT_TREE_H

#include "octree/types.h"
#include "scene_digest.h"

/* Kept are the subtrees of so many points or fewer whose parents have more, and leaves. */
#define KEPT_POINTS 128

/* A tree of fewer points is walked as fast. */
#define KEPT_FEWEST 4096

/* What all of them have in common: with another look none can be used. */
typedef struct kept_look {
    view_coloring coloring;
    bool boxes, points; /* whether they are shown */
    size_t capacity;
    uint8_t point_width;
} kept_look;

typedef struct kept_node {
    scene_box box;
    uint64_t digest; /* of the box */
    uint32_t count;  /* nodes of its subtree, itself included */
} kept_node;

typedef struct kept_subtree {
    octree_address address;
    kept_node *nodes; /* from its root down, in the order of a walk; one block with the markers */
    scene_marker *markers;
    uint32_t node_count, marker_count;
    digest_run run;   /* of the markers, from 0 on */
    uint32_t thinned; /* points that the sieve drops; */
    uint32_t looser;  /* and those that one with a bit less keeps */
} kept_subtree;

typedef struct kept_list {
    kept_subtree *items;
    size_t count, room;
} kept_list;

/* Empty when zeroed. */
typedef struct kept_tree {
    kept_look look;
    uint64_t sieve;        /* of the points of all of them: node_boxes.h */
    kept_list now, before; /* in the order of a walk; while one goes on, `before` has those of the last one, */
    size_t met;            /* of which so many were met */
    octree_cursor mark;
    unsigned wait, patience; /* ticks until the tree is asked again; and how many that will be if it is in vain */
    uint64_t *touched;       /* places where the tree has changed, in the order of a walk */
    size_t touched_count, touched_room, next_touched;
    bool lost;         /* some of them */
    kept_subtree open; /* being collected, where it has an address */
    kept_node *nodes;  /* of it */
    size_t node_room, first_marker;
    digest_names names;
    digest_runs box_runs, marker_runs; /* what is known of the scene's digest */
} kept_tree;

void kept_tree_clear(kept_tree *k);
void kept_tree_release(kept_tree *k);

/* Before a walk: whether subtrees are to be kept, and those that are there can be used where they have not changed.
 * Where not, there are none. Cost: O(c log c) for c changes. */
bool kept_tree_begin(kept_tree *k, const octree *tree, const kept_look *look);

/* The subtree at an address, or null when it is not there as it was. Those who ask come in the order of a walk. It is
 * kept further on. */
const kept_subtree *kept_tree_find(kept_tree *k, octree_address address);

/* Collect a subtree, node by node, whose markers are the scene's next ones. False when there is no memory: then clear
 * all. */
void kept_tree_open(kept_tree *k, octree_address address, const scene *s);
bool kept_tree_add_node(kept_tree *k, const scene_box *box);
bool kept_tree_close(kept_tree *k, const scene *s);

/* Whether one is being collected that a node belongs to. */
bool kept_tree_collects(const kept_tree *k, const octree_node *node);

/* What is known of the digest of the scene's last elements: `run` is of those from `first` on. */
void kept_tree_add_run(digest_runs *runs, size_t first, digest_run run);
void kept_tree_forget_runs(kept_tree *k);

/* After the walk. */
void kept_tree_end(kept_tree *k);

#endif
