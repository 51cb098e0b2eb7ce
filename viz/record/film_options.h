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
    const point_values *values; /* of the session's points; may be null */
    renderer_choice renderer;
    uint64_t every; /* ticks 0, every, 2 * every ... get a frame; 0: no frames. ticks.jsonl has all ticks */
    /* A chunk: record only the ticks [first, last). last 0: all ticks; a value beyond the session stands for its end.
     * Chunks of one recording go into one folder, in any order or at the same time; join_chunks() completes it. */
    uint64_t first, last;
    /* The number of processes; 0 or 1: this process alone. The bytes do not depend on it. Jobs are started by fork(),
     * so the caller must not have drawn anything yet nor have threads. */
    unsigned jobs; /* at most FILM_MOST_JOBS and the number of frames */
    bool replace;  /* remove the recording in the folder once the first tick of this one is filmed; not with a chunk */
    bool resume;   /* complete this recording, part of which is in the folder; correct frames are kept */
    watcher watch; /* follows the recording of ticks, and may stop it */
} film_options;

/* The session's points, and how many of them tick 0 refused. */
typedef struct film_start {
    size_t points;        /* of the session */
    size_t outside, full; /* refused because they lie outside the world; because their leaf is full */
} film_start;

typedef struct film_summary {
    uint64_t ticks; /* recorded ticks, including tick 0; of a chunk, those of the chunk */
    uint64_t frames;
    uint64_t kept;        /* frames that resuming found correct and did not draw again */
    uint64_t gaps;        /* ticks without data, because they were refused */
    uint64_t left_out;    /* elements of all frames that could not be drawn: not finite, or too far away for doubles */
    uint64_t over_budget; /* frames that leave out elements beyond the view's budget */
    uint64_t below_lod;   /* frames that leave out elements smaller than the view's lod */
    unsigned beyond, small;              /* the kinds of elements left out, as bits LEFT_OUT_* of scene.h */
    uint64_t foreign_nodes;              /* ticks that show the nodes of a foreign index */
    uint64_t events[OCTREE_EVENT_KINDS]; /* the number of ticks with each event */
    uint64_t refusals;                   /* refused points, edits and steps */
    frame_checks checks;
    film_start start;
    uint64_t total; /* ticks to record: more than `ticks` if the recording was stopped */
} film_summary;

#endif
