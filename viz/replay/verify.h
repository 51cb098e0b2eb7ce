/* SPDX-License-Identifier: MIT */
/* verify.h - replays the session of a recording and checks that every tick and frame is identical.
 *
 * The lines of ticks.jsonl, the digests of the scenes and the pixels are compared tick by tick, up to the first tick
 * that differs. GL draws the pixels, whichever rasterizer drew the recorded ones. The compression of the PNG files is
 * not compared. */
#ifndef REPLAY_VERIFY_H
#define REPLAY_VERIFY_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "watcher.h"

#include <stdint.h>
#include <stdio.h>

/* The kinds of differences. Each row has the name of a kind, its word in JSON, and the text that follows "tick 3
 * differs". */
#define VERIFY_KIND_MAP(X)                                                                                             \
    X(SESSION, "session", "")                   /* session.json is not the session whose digest the frames contain */  \
    X(VIEW, "view", " in its size")             /* the size in recording.json is not the size of the frames */         \
    X(LINES, "lines", "")                       /* a line of ticks.jsonl is missing, torn or extra */                  \
    X(FACTS, "facts", " in what happened")      /* a member of the tick's line in ticks.jsonl differs */               \
    X(SCENE, "scene", " in what is drawn")      /* the digest of the tick's scene differs */                           \
    X(FRAME, "frame", " in its frame")          /* a frame is missing, torn, wrong or extra */                         \
    X(PIXELS, "pixels", ", only in its pixels") /* the scene is the same, but its pixels differ */

typedef enum verify_kind {
#define VERIFY_ENUM(name, word, words) VERIFY_##name,
    VERIFY_KIND_MAP(VERIFY_ENUM)
#undef VERIFY_ENUM
        VERIFY_KINDS
} verify_kind;

typedef struct verify_finding {
    verify_kind kind;
    bool has_tick;
    uint64_t tick;  /* the first tick that differs */
    char fact[32];  /* for FACTS and SCENE: the name of the member of the tick's line that differs */
    char text[768]; /* the finding as one sentence */
} verify_finding;

/* The maximum number of findings: one about the session, one about the first tick that differs, and one about extra
 * files. */
#define VERIFY_MOST 3

typedef struct verify_report {
    size_t count; /* number of findings; 0: the recording is identical */
    verify_finding findings[VERIFY_MOST];
    bool has_frames;        /* false: the recording has no frames, so only ticks are compared and nothing is drawn */
    uint64_t ticks, frames; /* number of identical ticks and frames before the first difference */
    uint64_t gaps;          /* number of identical ticks that are gaps; a gap is not a difference */
    octree_gap first_gap;   /* the first gap; set if `gaps` is not 0 */
    uint64_t pixels;        /* VERIFY_PIXELS: the number of pixels that differ */
    char drawn_by[384];     /* describes the renderer in renderer.json; "" if the recording has no frames */
    char drawn_now[384];    /* describes the renderer of this process; "" if nothing was drawn */
    const char *fill;       /* draw_fill_name() of the rasterizer of this process; "" if nothing was drawn */
    /* Why GL could not be loaded, so that the integer rasterizer drew instead; "" if GL was loaded or not needed. */
    octreel_error no_gl;
} verify_report;

typedef struct verify_options {
    renderer_choice renderer; /* the renderer to open; the member `fill` is ignored */
    uint64_t max_ticks;       /* maximum number of ticks: a longer session is refused; 0: SESSION_MOST_PLAYED */
    /* The number of processes; 0: one per core, fewer for few frames. The report is the same for any number. Unless it
     * is 1, the caller must not have opened a renderer or started threads. */
    unsigned jobs;
    watcher watch; /* receives the progress in ticks; keep_going() of the watcher is not called */
} verify_options;

/* Verify the recording in a folder. Returns false with an error if the recording cannot be read, played or drawn. */
bool verify_recording(const char *folder, const verify_options *options, verify_report *report, octreel_error *error);

/* Print the report: one line for each finding, or one line that says that the recording is identical. With `json`,
 * print one JSON object on one line. */
void verify_print(FILE *out, const char *folder, const verify_report *report, bool json);

#endif
