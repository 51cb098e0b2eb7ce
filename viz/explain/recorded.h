/* SPDX-License-Identifier: MIT */
/* recorded.h - opens a recording that is to be explained. The session and the view are read. Other files of the
 * recording that do not agree with the session become warnings. */
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
    replay replay;           /* the recording, which is read but not played */
    uint64_t frames_session; /* the digest of the session, as stated in the text chunks of the first frame */
    cause_view view;
    line_reader lines;
    bool reading;     /* true: the lines of ticks.jsonl are read; false after the first wrong line */
    uint64_t *scenes; /* scenes[i]: the digest of the scene as stated in the line of tick i; 0: the line states no
                         digest; owned */
    size_t scene_count, scene_room;
    char drawn_by[RECORDED_WHO];            /* the renderer that drew the frames, from renderer.json */
    char warnings[RECORDED_WARNINGS][1024]; /* sentences about files that do not agree with the session */
    size_t warning_count;
} recorded;

/* Read all files of a recording except its frames. Return false with an error if a file is missing or unreadable.
 * The caller closes *r in any case. */
bool recorded_open(recorded *r, const diff_side *side, octreel_error *error);
void recorded_close(recorded *r);

/* Read one line of each recording's ticks.jsonl and compare it with the current tick of the recording's game. A
 * wrong or missing line becomes a warning. `differs` is true if the two games differ at this tick. Return false with
 * an error if memory runs out. */
bool recorded_check_tick(recorded sides[2], const octree_game *const games[2], bool differs, octreel_error *error);

/* Return the digest of a tick's scene as stated in ticks.jsonl. Return 0 if the line states no digest or was not
 * read. */
uint64_t recorded_scene_digest(const recorded *r, uint64_t tick);

#endif
