/* SPDX-License-Identifier: MIT */
/* recorded.h - a recording that is explained: its session and view, and whether its files agree with them. */
#ifndef EXPLAIN_RECORDED_H
#define EXPLAIN_RECORDED_H

#include "cause_compare.h"
#include "replay.h"
#include "side.h"
#include "verify_line.h"

#define RECORDED_WARNINGS 2
#define RECORDED_WHO 384

typedef struct recorded {
    const diff_side *side;
    replay replay;   /* read, and not played */
    uint64_t filmed; /* the digest of the session that its first frame says it is of */
    cause_view view;
    line_reader lines;
    bool reading;     /* nothing is wrong with the lines so far */
    uint64_t *scenes; /* of the lines read so far, one a tick: the digests of the scenes of their frames; 0: none */
    size_t scene_count, scene_room;
    char drawn_by[RECORDED_WHO];       /* from renderer.json */
    char *warnings[RECORDED_WARNINGS]; /* sentences about files that do not fit its session; owned */
    size_t warning_count;
} recorded;

/* Read it, all but its frames. False with an error when something is not there or cannot be read. *r is to be closed
 * in any case. */
bool recorded_open(recorded *r, const diff_side *side, octreel_error *error);
void recorded_close(recorded *r);

/* Read the lines of the tick at which two games of their sessions are, and compare them with what happened in it. What
 * does not fit, or is missing, becomes a warning. `differs`: the games do at this tick. */
bool recorded_check_tick(recorded sides[2], const octree_game *const games[2], bool differs, octreel_error *error);

/* The digest of a tick's scene by its line; 0 where that tells none, or was not read. */
uint64_t recorded_scene(const recorded *r, uint64_t tick);

#endif
