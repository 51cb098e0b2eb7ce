/* SPDX-License-Identifier: MIT */
/* kept_tree.h - a cache of the scene elements of subtrees, kept from one picture to the next.
 *
 * The problem: drawing a tick walks the whole tree, although most ticks change few points, and a moving camera changes
 * none.
 *
 * The idea: keep the boxes and markers that the walk produced, and their digests, for small subtrees. A subtree is kept
 * if it is a leaf, or if it has at most KEPT_POINTS points and its parent has more.
 *
 * Before the next walk, the tree's change log lists the changed positions. The positions become keys, sorted in the
 * order of the walk (depth first, by octant). During the walk, one index moves through these keys and another through
 * the kept subtrees. Both indices only move forward. A kept subtree is unchanged if no key lies inside it. An unchanged
 * subtree is copied; a changed subtree is walked and kept again. The scene is the same with and without the cache.
 *
 * The cost: O(c log c) to sort c changes, and the walk of the nodes above the kept subtrees. The change log also costs
 * the tree time and memory. If there are too many changes, the cache is emptied, and the log is not used for a number
 * of ticks, which about doubles with each failure. */
#ifndef SCENE_KEPT_TREE_H
#define SCENE_KEPT_TREE_H

#include "array.h"
#include "octree/types.h"
#include "point_values.h"
#include "scene_digest.h"

/* The maximum number of points of a kept subtree. A subtree that is a single leaf may have more. */
#define KEPT_POINTS 128

/* The minimum number of points of a tree whose subtrees are cached. A smaller tree is walked as fast without the
 * cache. */
#define KEPT_FEWEST 4096

/* The options that determine how a subtree is drawn. A change of any option empties the cache. */
typedef struct kept_look {
    view_coloring coloring;
    bool boxes, points; /* boxes: true if the view shows boxes of nodes; points: true if the view shows points */
    bool paints;        /* true: the points have colours of their own, which the next three members determine */
    view_point_color point_color;
    point_scale scale;
    const point_values *values;
    size_t capacity;
    uint8_t point_width;
} kept_look;

typedef struct kept_node {
    scene_box box;
    uint64_t digest; /* the digest of the box */
    uint32_t count;  /* the number of nodes in the node's subtree, the node included */
} kept_node;

typedef struct kept_subtree {
    octree_address address;
    /* nodes of the subtree in the order of the walk, root first; owned, in one block of memory with the markers */
    kept_node *nodes;
    scene_marker *markers;
    uint32_t node_count, marker_count;
    digest_run run;   /* the digest of the subtree's markers: `first` is 0, and `end` is the number of markers */
    uint32_t thinned; /* the number of points of the subtree that the sieve drops */
    uint32_t looser;  /* the number of points of the subtree that a sieve with one bit fewer would keep */
} kept_subtree;

typedef ARRAY(kept_subtree) kept_list;

/* The cache. A zeroed struct is empty. */
typedef struct kept_tree {
    kept_look look;
    uint64_t sieve;        /* the sieve that selected the points of the subtrees; node_boxes.h explains sieves */
    kept_list now, before; /* the subtrees of this walk and of the previous walk, each list in the order of the walk */
    size_t passed;         /* the number of subtrees in `before` that the walk has passed */
    octree_cursor cursor;  /* the position in the tree's change log */
    /* `wait`: the number of ticks until the change log is read again; `backoff`: the length of the last such wait */
    unsigned wait, backoff;
    uint64_t state;     /* the state of the tree in the last walk, as passed to kept_tree_begin_walk(); 0: unknown */
    const octree *tree; /* the tree whose changes are being read */
    uint64_t *changed;  /* the keys of changed positions, sorted */
    size_t changed_count, changed_room, next_changed;
    bool lost;         /* true: `changed` is incomplete, because there were too many changes or memory ran out */
    kept_subtree open; /* the subtree that is being collected; its address is 0 if there is none */
    kept_node *nodes;  /* the nodes of `open` so far */
    size_t node_room, first_marker;
    digest_names names;
    digest_runs box_runs, marker_runs; /* known digests of runs of the scene's boxes and markers, for scene_digest() */
} kept_tree;

/* Empty the cache. Its arrays are not freed. */
void kept_tree_clear(kept_tree *k);

/* Free all memory and zero the struct. */
void kept_tree_release(kept_tree *k);

/* Begin a walk. If this function returns true, the walk calls kept_tree_find_subtree() for each subtree that may be
 * kept. If it returns false, the cache is empty, and the walk must not use the cache. `state` is a number that names
 * the tree's state and differs whenever the tree does; 0: unknown. If the state is the same as in the last walk, the
 * change log is not read. Cost: O(c log c) for c changes. */
bool kept_tree_begin_walk(kept_tree *k, const octree *tree, const kept_look *look, uint64_t state);

/* Returns a number that names a state or a change log. No other call in this process returns the same number. The
 * number is never 0. */
uint64_t kept_tree_make_unique_name(void);

/* Find the kept subtree at an address, and keep it for the next walk. Returns null if the subtree has changed or was
 * not kept. Calls must come in the order of the walk. */
const kept_subtree *kept_tree_find_subtree(kept_tree *k, octree_address address);

/* Collect a subtree for the cache: begin the subtree, add its nodes in the order of the walk, and end the subtree.
 * Markers that are appended to the scene between these two calls belong to the subtree. Returns false if memory runs
 * out; the caller then clears the cache. */
void kept_tree_begin_subtree(kept_tree *k, octree_address address, const scene *s);
bool kept_tree_add_node(kept_tree *k, const scene_box *box);
bool kept_tree_end_subtree(kept_tree *k, const scene *s);

/* Returns whether a node belongs to the subtree that is being collected. */
bool kept_tree_is_collecting(const kept_tree *k, const octree_node *node);

/* Record the digest of a run of elements that were copied to the scene. The first copied element has the index
 * `first`. */
void kept_tree_add_run(digest_runs *runs, size_t first, digest_run run);

/* Forget all recorded digests of runs, because the indices of the scene's elements have changed. */
void kept_tree_remove_runs(kept_tree *k);

/* End the walk. Free the subtrees of the previous walk that this walk did not find. */
void kept_tree_end_walk(kept_tree *k);

#endif
