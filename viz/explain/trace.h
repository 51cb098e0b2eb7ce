/* SPDX-License-Identifier: MIT */
/* trace.h - the pixels in which two frames of a tick differ, traced to the elements that are drawn there. */
#ifndef EXPLAIN_TRACE_H
#define EXPLAIN_TRACE_H

#include "diff.h"
#include "pixel.h"
#include "layer.h"
#include "octree/game.h"
#include "recorded.h"
#include "tick_scene.h"

#include <stdio.h>

/* What some of the pixels show, on one side or both. Nodes that are there because one above them split, or that are
 * gone because it merged, count as that one. */
typedef struct trace_part {
    int layer;   /* view_layer; TRACE_BACKGROUND: nothing is drawn there on either side */
    uint64_t id; /* of a node in LAYER_NODES or a point in LAYER_POINTS; else 0 */
    uint64_t pixels;
} trace_part;

#define TRACE_BACKGROUND (LAYER_DIAGRAM + 1)

/* A zeroed one is of no frames. */
typedef struct trace {
    bool made;
    trace_part *parts; /* the largest first, none twice; owned */
    size_t count;
    uint64_t pixels; /* of all parts */
} trace;

/* Two games that are drawn while they are played. A zeroed one has not begun. */
typedef struct tracer {
    tick_history histories[2];
    scene scenes[2];
    renderer *renderer; /* opened for the first frame that is traced */
    char untraced[256]; /* a sentence: why nothing can be drawn; else "" */
} tracer;

void tracer_close(tracer *t);

/* To be called at each tick: what its history holds adds up over ticks. */
bool tracer_add_tick(tracer *t, const recorded sides[2], const octree_game *const games[2], octreel_error *error);

/* Trace the pair, compared with these options, of the tick at which the games are. Nothing is traced where a frame does
 * not show the scene of its tick or cannot be read, where sizes differ, or where nothing can be drawn: that is no
 * error. */
bool tracer_trace(tracer *t, const recorded sides[2], const octree_game *const games[2], const diff_pair *pair,
                  const diff_options *options, trace *made, octreel_error *error);

/* "node 0/3/7", "point 12", "text". */
void trace_print_part(FILE *out, const trace_part *part);

/* "312 pixels: 180 of node 0/3/7, 90 of point 12, 42 of text"; of many parts the first so many, and
 * text last of them. */
#define TRACE_TOLD 5
void trace_print(FILE *out, const trace *t);

#endif
