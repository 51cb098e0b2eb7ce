/* SPDX-License-Identifier: MIT */
/* pair_look.h - finds why the two frames of a pair differ; used only in this folder. */
#ifndef EXPLAIN_PAIR_LOOK_H
#define EXPLAIN_PAIR_LOOK_H

#include "explain.h"
#include "frame_file.h"

/* A contradiction between a frame and its text chunks or its recording: it belongs to another session, tick or scene,
 * its pixels were changed, or a frame of a recording has no text chunks. */
typedef enum frame_fault { FAULT_NONE, FAULT_SESSION, FAULT_TICK, FAULT_SCENE, FAULT_PIXELS, FAULT_TEXTS } frame_fault;

/* The text chunks of both frames, and the faults that they show. */
typedef struct pair_look {
    frame_origin origins[2];
    bool has_texts[2]; /* the frame has these text chunks */
    frame_fault faults[2];
    bool same_scene;
} pair_look;

/* Read the text chunks of both frames; if a frame has them, decode it to check its digest. Thread-safe. */
pair_look pair_look_at(const explanation *e, const diff_pair *pair);

/* Find the cause of a pair that differs. Its text is null if neither recordings nor text chunks show a cause. */
bool pair_find_cause(const explanation *e, const diff_pair *pair, const pair_look *look, pair_cause *cause,
                     octreel_error *error);

/* A key that is equal for all pairs with the same cause; not for people. Null if there is none or memory runs out. The
 * caller frees it. */
char *pair_find_key(const explanation *e, const diff_pair *pair, const pair_look *look);

/* Print the sentence for two frames of the same scene, with the renderers if they are known. */
void pair_print_rendering(FILE *out, const explanation *e);

#endif
