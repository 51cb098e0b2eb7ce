/* SPDX-License-Identifier: MIT */
/* trace.h - finds the elements that are drawn at the pixels in which two frames of a tick differ. */
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

/* A part of a scene, with the number of differing pixels at which it is drawn. A part is a node, a point, or all
 * elements of another layer. If the two trees differ in a node, the pixels of all nodes below are counted for this
 * node. */
typedef struct trace_part {
    int layer;   /* the view_layer of the part; TRACE_BACKGROUND: neither frame shows an element at these pixels */
    uint64_t id; /* in the layer LAYER_NODES, a node's address; in LAYER_POINTS, a point's id; else 0 */
    uint64_t pixels;
} trace_part;

#define TRACE_BACKGROUND (LAYER_DIAGRAM + 1)

/* The parts drawn at the differing pixels of a pair of frames. A zeroed trace has no parts. */
typedef struct trace {
    bool made;         /* true: the pair was traced */
    trace_part *parts; /* each part once, in descending order of pixels; owned */
    size_t count;
    uint64_t pixels; /* the sum of the pixels of all parts */
} trace;

/* The state while two games are played and their frames are traced. A zeroed tracer is ready for the first tick. */
typedef struct tracer {
    tick_history histories[2];
    scene scenes[2];
    renderer *renderer; /* opened when the first pair of frames is traced */
    char untraced[256]; /* a sentence that says why nothing is traced; "" if frames are traced */
} tracer;

void tracer_close(tracer *t);

/* Add the current tick of both games to the histories, from which heat and close-ups are drawn. Call this at every
 * tick. */
bool tracer_add_tick(tracer *t, const recorded sides[2], const octree_game *const games[2], octreel_error *error);

/* Trace the pair of frames of the games' current tick. If the frames cannot be traced, this is no error: a frame may
 * be unreadable or not show the scene of its tick, the sizes may differ, or no renderer can be opened. */
bool tracer_trace(tracer *t, const recorded sides[2], const octree_game *const games[2], const diff_pair *pair,
                  const diff_options *options, trace *made, octreel_error *error);

/* Return the name of a part: "node 0/3/7", "point 12" or "text". The name may be stored in `text`. */
#define TRACE_TEXT (OCTREE_ADDRESS_TEXT + sizeof "node ")
const char *trace_part_text(const trace_part *part, char text[TRACE_TEXT]);

/* Print the TRACE_PRINTED largest parts. Text is printed last: "312 pixels: 180 of node 0/3/7, 90 of point 12, 42 of
 * text". */
#define TRACE_PRINTED 5
void trace_print(FILE *out, const trace *t);

#endif
