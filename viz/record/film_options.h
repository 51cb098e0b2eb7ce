/* SPDX-License-Identifier: MIT */
/* film_options.h - the options of a recording, and its summary. */
#ifndef RECORD_FILM_OPTIONS_H
#define RECORD_FILM_OPTIONS_H

#include "frame_checks.h"
#include "octree/game.h"
#include "point_values.h"
#include "view.h"
#include "watcher.h"

#define FILM_MOST_JOBS 256

typedef struct film_options {
    const char *folder;
    view view;
    const point_values *values; /* values of the session's points; may be null */
    renderer_choice renderer;
    uint64_t every; /* ticks 0, every, 2 * every ... get a frame; 0: no frames. ticks.jsonl has all ticks in any case */
    /* A chunk: only the ticks first to last - 1 are recorded. If `last` is 0 or greater than the number of ticks, the
     * chunk ends with the session. All chunks of a recording go into the same folder, in any order or at the same time.
     * join_chunks() then completes the recording. */
    uint64_t first, last;
    /* Maximum number of ticks: a longer session is refused; 0: SESSION_MOST_PLAYED; ignored by live recordings. */
    uint64_t max_ticks;
    /* The number of processes that record, at most FILM_MOST_JOBS; a recording uses at most one process per frame. 0
     * and 1: only the calling process records. The written files are the same for any number of processes. Jobs are
     * started by fork(), so the caller must not have opened a renderer or started threads. */
    unsigned jobs;
    /* Remove the old recording in the folder once tick 0 of the new recording is filmed; not allowed for a chunk. */
    bool replace;
    bool resume;   /* complete the partial recording in the folder; correct frames that exist are kept */
    watcher watch; /* called after each tick; may stop the recording */
} film_options;

/* The number of points in the session, and the numbers of points that tick 0 refused. */
typedef struct film_start {
    size_t points;        /* all points of the session */
    size_t outside, full; /* points refused outside the world; points refused because their leaf is full */
} film_start;

typedef struct film_summary {
    uint64_t ticks; /* number of recorded ticks, including tick 0; for a chunk, only the ticks of the chunk */
    uint64_t frames;
    uint64_t kept; /* with `resume`: frames that were not drawn again, because they existed and were correct */
    uint64_t gaps; /* ticks that are gaps: their content is unknown, so they have no frame and no data */
    /* Number of elements, over all frames, that could not be drawn because a coordinate is not finite or overflows a
     * double. */
    uint64_t left_out;
    uint64_t over_budget; /* frames that lack elements because of the view's budget */
    uint64_t below_lod;   /* frames that lack elements that are smaller than the view's lod */
    /* The kinds of elements that were left out, as bits LEFT_OUT_* of scene.h: `beyond` because of the view's budget,
     * `small` because of its lod. */
    unsigned beyond, small;
    uint64_t foreign_nodes;              /* ticks that show the nodes of a foreign index */
    uint64_t events[OCTREE_EVENT_KINDS]; /* the number of ticks with each event */
    uint64_t refusals;                   /* number of refused points, edits and steps */
    frame_checks checks;
    film_start start;
    uint64_t total; /* number of ticks to record; if the recording was stopped, `ticks` is smaller */
} film_summary;

#endif
