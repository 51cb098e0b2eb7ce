/* SPDX-License-Identifier: MIT */
/* verify.h - plays a recording again and compares it with what its session makes.
 *
 * The facts, the draw lists and the pixels are compared tick by tick, up to the first tick that differs. GL alone draws
 * the pixels, whatever filled the recorded ones. How a frame is compressed is not compared.
 */
#ifndef REPLAY_VERIFY_H
#define REPLAY_VERIFY_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"

#include <stdint.h>
#include <stdio.h>

/* What differs from what the session makes: the word for it in JSON, and what "tick 3 differs" is followed by. */
#define VERIFY_KIND_MAP(X)                                                                                             \
    X(SESSION, "session", "")                   /* session.json is not the file that was filmed */                     \
    X(VIEW, "view", " in its size")             /* recording.json is not about these frames */                         \
    X(LINES, "lines", "")                       /* ticks.jsonl lacks a line, has a torn one, or one too many */        \
    X(FACTS, "facts", " in what happened")      /* a member of the tick's line */                                      \
    X(SCENE, "scene", " in what is drawn")      /* the digest of its scene */                                          \
    X(FRAME, "frame", " in its frame")          /* a frame is missing, torn, of something else, or one too many */     \
    X(PIXELS, "pixels", ", only in its pixels") /* the scene is the same, and its picture is not */

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

/* At most one finding each about the session, the first tick that differs, and files that are too many. */
#define VERIFY_MOST 3

typedef struct verify_report {
    size_t count; /* of findings; 0: identical */
    verify_finding findings[VERIFY_MOST];
    bool has_frames;        /* else the ticks alone are compared, and nothing is drawn */
    uint64_t ticks, frames; /* that are the same, before the first that differs */
    uint64_t gaps;          /* of those ticks: nothing is known of them, which is no difference */
    octree_gap first_gap;   /* where there are any */
    uint64_t pixels;        /* of PIXELS: how many differ */
    char drawn_by[384];     /* the renderer of the recording, as renderer.json has it; "" without frames */
    char drawn_now[384];    /* the renderer of this process; "" where nothing was drawn */
    const char *fill;       /* draw_fill_name() of what filled its pixels; "" likewise */
    octreel_error no_gl; /* why GL could not be loaded, so that integers filled them; "": GL was loaded or not needed */
} verify_report;

typedef struct verify_options {
    renderer_choice renderer;                                       /* its fill is not asked for */
    void (*progress)(uint64_t done, uint64_t total, void *context); /* after each tick; may be null */
    void *context;
} verify_options;

/* Verify the recording in a folder. False with an error where it cannot be read, played or drawn. */
bool verify_recording(const char *folder, const verify_options *options, verify_report *report, octreel_error *error);

/* Print a line for each finding, or that the recording is identical; or one JSON object on one line. */
void verify_print(FILE *out, const char *folder, const verify_report *report, bool json);

#endif
