/* SPDX-License-Identifier: MIT */
/* verify.h - replays the session of a recording and checks that every tick and frame is identical.
 *
 * Facts, draw lists and pixels are compared tick by tick, up to the first tick that differs. GL draws the pixels,
 * whichever rasterizer drew the recorded ones. The compression of PNG files is not compared.
 */
#ifndef REPLAY_VERIFY_H
#define REPLAY_VERIFY_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "watcher.h"

#include <stdint.h>
#include <stdio.h>

/* The kinds of differences: the word in JSON, and the text after "tick 3 differs". */
#define VERIFY_KIND_MAP(X)                                                                                             \
    X(SESSION, "session", "")                   /* session.json is not the session that was recorded */                \
    X(VIEW, "view", " in its size")             /* recording.json does not fit the frames */                           \
    X(LINES, "lines", "")                       /* a line of ticks.jsonl is missing, torn or extra */                  \
    X(FACTS, "facts", " in what happened")      /* a member of the tick's line */                                      \
    X(SCENE, "scene", " in what is drawn")      /* the digest of its scene */                                          \
    X(FRAME, "frame", " in its frame")          /* a frame is missing, torn, wrong or extra */                         \
    X(PIXELS, "pixels", ", only in its pixels") /* the scene is the same, but the pixels differ */

typedef enum verify_kind {
#define VERIFY_ENUM(name, word, words) VERIFY_##name,
    VERIFY_KIND_MAP(VERIFY_ENUM)
#undef VERIFY_ENUM
        VERIFY_KINDS
} verify_kind;

typedef struct verify_finding {
    verify_kind kind;
    bool has_tick;
    uint64_t tick;  /* the first that differs */
    char fact[32];  /* of FACTS and SCENE: the member of the tick's line */
    char text[768]; /* one sentence */
} verify_finding;

/* At most one finding about the session, one about the first tick that differs, and one about extra files. */
#define VERIFY_MOST 3

typedef struct verify_report {
    size_t count; /* of findings; 0: identical */
    verify_finding findings[VERIFY_MOST];
    bool has_frames;        /* false: only ticks are compared, and nothing is drawn */
    uint64_t ticks, frames; /* identical ticks and frames, before the first difference */
    uint64_t gaps;          /* how many of these ticks are gaps, which are no difference */
    octree_gap first_gap;   /* set if there are gaps */
    uint64_t pixels;        /* VERIFY_PIXELS: the number of pixels that differ */
    char drawn_by[384];     /* describes the renderer in renderer.json; "" without frames */
    char drawn_now[384];    /* describes the renderer of this process; "" if nothing was drawn */
    const char *fill;       /* draw_fill_name() of the rasterizer of this process; "" likewise */
    octreel_error no_gl; /* why GL could not be loaded, so that integers filled them; "": GL was loaded or not needed */
} verify_report;

typedef struct verify_options {
    renderer_choice renderer; /* its `fill` is not read */
    watcher watch;            /* of the ticks; its keep_going() is not called */
} verify_options;

/* Verify the recording in a folder. False with an error where it cannot be read, played or drawn. */
bool verify_recording(const char *folder, const verify_options *options, verify_report *report, octreel_error *error);

/* Print one line for each finding or a line that the recording is identical; or one JSON object on one line. */
void verify_print(FILE *out, const char *folder, const verify_report *report, bool json);

#endif
