/* SPDX-License-Identifier: MIT */
/* pair_look.h - finds why the two frames of a pair differ; used only in this folder. */
#ifndef EXPLAIN_PAIR_LOOK_H
#define EXPLAIN_PAIR_LOOK_H

#include "explain.h"
#include "frame_file.h"

/* How a frame contradicts its text chunks or its recording. The frame belongs to another session, to another tick or
 * to another scene; its pixels were changed; or it is part of a recording but has no text chunks. */
typedef enum frame_fault { FAULT_NONE, FAULT_SESSION, FAULT_TICK, FAULT_SCENE, FAULT_PIXELS, FAULT_TEXTS } frame_fault;

/* The text chunks of both frames, and the fault of each frame. */
typedef struct pair_look {
    frame_origin origins[2];
    bool has_texts[2]; /* the frame has the text chunks of Octreel */
    frame_fault faults[2];
    bool same_scene;
} pair_look;

/* Read the text chunks of both frames. Decode a frame that has text chunks, to check the digest of its pixels.
 * Thread-safe. */
pair_look pair_examine(const explanation *e, const diff_pair *pair);

/* Find the cause of a pair that differs. cause->text is null if neither recordings nor text chunks show a cause. */
bool pair_find_cause(const explanation *e, const diff_pair *pair, const pair_look *look, pair_cause *cause,
                     octreel_error *error);

/* Return a key: a text, not printed for people, that is equal for all pairs with the same cause. The caller frees
 * it. Return null if the pair has no key or memory runs out. */
char *pair_find_key(const explanation *e, const diff_pair *pair, const pair_look *look);

/* Print the sentence for two frames that show the same scene. If the renderers are known, the sentence names them. */
void pair_print_rendering(FILE *out, const explanation *e);

#endif
