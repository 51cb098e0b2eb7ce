/* SPDX-License-Identifier: MIT */
/* recorded.h - a recording that is explained: its session, its view, and whether its other files agree with them. */
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
    replay replay;           /* read but not played */
    uint64_t frames_session; /* the digest of the session in the text chunks of the first frame */
    cause_view view;
    line_reader lines;
    bool reading;     /* no line so far is wrong, so the next one is read */
    uint64_t *scenes; /* the digest of the scene for each line read so far, one a tick; 0: the line has none */
    size_t scene_count, scene_room;
    char drawn_by[RECORDED_WHO];            /* from renderer.json */
    char warnings[RECORDED_WARNINGS][1024]; /* sentences about files that do not agree with the session */
    size_t warning_count;
} recorded;

/* Read all files of a recording except its frames. Return false with an error if one is missing or unreadable. Close *r
 * in any case. */
bool recorded_open(recorded *r, const diff_side *side, octreel_error *error);
void recorded_close(recorded *r);

/* Read the next line of ticks.jsonl of both recordings and compare it with the current tick of their games. A wrong or
 * missing line becomes a warning. `differs`: the two games differ at this tick. */
bool recorded_check_tick(recorded sides[2], const octree_game *const games[2], bool differs, octreel_error *error);

/* The digest of a tick's scene in ticks.jsonl; 0 if the line has none or was not read. */
uint64_t recorded_scene(const recorded *r, uint64_t tick);

#endif
