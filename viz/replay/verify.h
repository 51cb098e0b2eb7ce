/* verify.h - a recording is played again: is it what its session makes?
 *
 * What happened, the draw lists and the pixels are compared tick by tick, up to the first tick that differs. How a
 * frame is compressed is not compared: the same pixels are the same frame.
 */
#ifndef RECORD_VERIFY_H
#define RECORD_VERIFY_H

#include "renderer.h"
#include "folder.h"

#include <stdint.h>
#include <stdio.h>

/* In what a recording differs from what its session makes, and the word for it. */
#define VERIFY_KIND_MAP(X)                                                                                             \
    X(SESSION, "session") /* session.json is not the file that was filmed */                                           \
    X(VIEW, "view")       /* recording.json is not about these frames */                                               \
    X(LINES, "lines")     /* ticks.jsonl lacks a line, has a torn one, or one too many */                              \
    X(FACTS, "facts")     /* what happened */                                                                          \
    X(SCENE, "scene")     /* what is drawn */                                                                          \
    X(FRAME, "frame")     /* a frame is missing, torn, of something else, changed, or one too many */                  \
    X(PIXELS, "pixels")   /* only how it was drawn */

typedef enum verify_kind {
#define VERIFY_ENUM(name, word) VERIFY_##name,
    VERIFY_KIND_MAP(VERIFY_ENUM)
#undef VERIFY_ENUM
        VERIFY_KINDS
} verify_kind;

typedef struct verify_finding {
    verify_kind kind;
    bool has_tick;
    uint64_t tick;  /* the first that differs */
    char fact[32];  /* of FACTS and SCENE: the member of the tick's line; else "" */
    char text[768]; /* one sentence */
} verify_finding;

/* The session, the first tick that differs, and frames that are too many: at most one finding of each. */
#define VERIFY_MOST 3

typedef struct verify_report {
    size_t count; /* of findings; none: identical */
    verify_finding findings[VERIFY_MOST];
    uint64_t ticks, frames; /* that are the same, up to the first that differs */
    uint64_t pixels;        /* of PIXELS: how many differ */
    char drawn_by[384];     /* who drew the recording, as renderer.json tells */
    char drawn_now[384];    /* "" where nothing was drawn */
} verify_report;

typedef struct verify_options {
    renderer_choice renderer;
    void (*progress)(uint64_t done, uint64_t total, void *context); /* after each tick; may be null */
    void *context;
} verify_options;

/* Verify the recording in a folder. False, and a sentence, when it cannot be: there is none, it cannot be read or
 * played, or nothing draws it. */
bool verify_recording(const char *folder, const verify_options *options, verify_report *report, octreel_error *error);

/* A line for each finding, or that it is identical, for people; or one JSON object on one line. */
void verify_print(FILE *out, const char *folder, const verify_report *report, bool json);

#endif
