/* SPDX-License-Identifier: MIT */
/* trace.h - traces the pixels in which two frames of a tick differ to the elements that are drawn there. */
#ifndef EXPLAIN_TRACE_H
#define EXPLAIN_TRACE_H

#include "diff.h"
#include "pixel.h"
#include "layer.h"
#include "octree/game.h"
#include "octree/octree.h"
#include "recorded.h"
#include "tick_scene.h"

#include <stdio.h>

/* An element, or all elements of a layer, and the number of differing pixels at which it is drawn. Nodes below a node
 * in which the trees differ count for that node. */
typedef struct trace_part {
    int layer;   /* a view_layer, or TRACE_BACKGROUND: nothing is drawn there on either side */
    uint64_t id; /* the node in LAYER_NODES or the point in LAYER_POINTS; else 0 */
    uint64_t pixels;
} trace_part;

#define TRACE_BACKGROUND (LAYER_DIAGRAM + 1)

/* Zeroed: empty. */
typedef struct trace {
    bool made;
    trace_part *parts; /* distinct, in descending order of pixels; owned */
    size_t count;
    uint64_t pixels; /* the sum over all parts */
} trace;

/* Draws two games while they are played. Zeroed: before the first tick. */
typedef struct tracer {
    tick_history histories[2];
    scene scenes[2];
    renderer *renderer; /* opened for the first frame that is traced */
    char untraced[256]; /* a sentence that says why nothing is traced; else "" */
} tracer;

void tracer_close(tracer *t);

/* Add a tick to the histories (heat and close-ups). Call it at every tick. */
bool tracer_add_tick(tracer *t, const recorded sides[2], const octree_game *const games[2], octreel_error *error);

/* Trace the pair of frames of the games' current tick. It is no error if nothing can be traced: a frame is unreadable
 * or does not show the scene of its tick, sizes differ, or no renderer can be opened. */
bool tracer_trace(tracer *t, const recorded sides[2], const octree_game *const games[2], const diff_pair *pair,
                  const diff_options *options, trace *made, octreel_error *error);

/* "node 0/3/7", "point 12" or "text"; it may be stored in `text`. */
#define TRACE_TEXT (OCTREE_ADDRESS_TEXT + sizeof "node ")
const char *trace_part_text(const trace_part *part, char text[TRACE_TEXT]);

/* Print "312 pixels: 180 of node 0/3/7, 90 of point 12, 42 of text": the TRACE_PRINTED largest parts, text last. */
#define TRACE_PRINTED 5
void trace_print(FILE *out, const trace *t);

#endif
