/* SPDX-License-Identifier: MIT */
/* film_options.h - how a session is filmed, and what came of it. */
#ifndef RECORD_FILM_OPTIONS_H
#define RECORD_FILM_OPTIONS_H

#include "frame_checks.h"
#include "octree/game.h"
#include "point_values.h"
#include "view.h"

#define FILM_MOST_JOBS 256

typedef struct film_options {
    const char *folder;
    view view;
    const point_values *values; /* of the points that are filmed; may be null */
    renderer_choice renderer;
    uint64_t every; /* film ticks 0, every, 2 * every ...; 0: none, and nothing is drawn. ticks.jsonl has all ticks */
    /* A chunk: the ticks [first, last) alone; last 0 is all of them, and beyond the end is the end. Chunks of one
     * recording go into one folder, in any order or at the same time; see join.h for what makes it whole. */
    uint64_t first, last;
    /* Processes that film; 0 or 1 is this one alone, and the bytes are the same. More are started by fork(), which a
     * process may only ask for that has drawn nothing yet and has no threads. */
    unsigned jobs; /* at most FILM_MOST_JOBS, and one a frame */
    bool replace;  /* remove the recording that the folder holds once the first tick of this one is filmed; no chunk */
    bool resume;   /* complete what the folder holds of this recording: frames that are there and right are kept */
    void (*progress)(uint64_t done, uint64_t total, void *context); /* after each tick; may be null */
    bool (*keep_going)(void *context);                              /* called between ticks: false stops; may be null */
    void *context;
} film_options;

/* Points of the session that tick 0 refused. */
typedef struct film_start {
    size_t points;        /* of the session */
    size_t outside, full; /* refused outside the world; by a full leaf */
} film_start;

typedef struct film_summary {
    uint64_t ticks; /* tick 0 included; of a chunk, its own */
    uint64_t frames;
    uint64_t kept;          /* of these: they were there and right, and were not filmed again */
    uint64_t gaps;          /* ticks of which nothing is known */
    uint64_t left_out;      /* elements of all frames that could not be drawn: not finite, or too far off for doubles */
    uint64_t over_budget;   /* frames that leave out what is beyond the view's budget */
    uint64_t below_lod;     /* frames that leave out what appears smaller than the view's lod */
    unsigned beyond, small; /* what these leave out, as bits of scene.h */
    uint64_t program_nodes; /* ticks by which a program has said nodes of its own */
    uint64_t events[OCTREE_EVENT_KINDS]; /* ticks that had each event */
    uint64_t refusals;                   /* of points, edits and steps in these ticks */
    frame_checks checks;
    film_start start; /* of a session */
    uint64_t total;   /* ticks that were to be filmed: more than `ticks` where it was stopped */
} film_summary;

#endif
