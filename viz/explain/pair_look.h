/* SPDX-License-Identifier: MIT */
/* pair_look.h - finds why the two frames of a pair differ; used only in this folder. */
#ifndef EXPLAIN_PAIR_LOOK_H
#define EXPLAIN_PAIR_LOOK_H

#include "explain.h"
#include "frame_file.h"

/* How a frame contradicts its text chunks or the recording that contains it. In this order: no contradiction; the
 * frame is from another session, from another tick, or of another scene; its pixels were changed; it has no text
 * chunks, although it is in a recording. */
typedef enum frame_fault { FAULT_NONE, FAULT_SESSION, FAULT_TICK, FAULT_SCENE, FAULT_PIXELS, FAULT_TEXTS } frame_fault;

/* The text chunks of both frames, and the fault of each frame. */
typedef struct pair_look {
    frame_origin origins[2];
    bool has_texts[2]; /* true: the frame has the text chunks that Octreel writes */
    frame_fault faults[2];
    bool same_scene; /* true: the text chunks of both frames state the same scene digest */
} pair_look;

/* Read the text chunks of both frames. If a frame has text chunks, also decode the frame and check the digest of its
 * pixels. Thread-safe. */
pair_look pair_examine(const explanation *e, const diff_pair *pair);

/* Find the cause of a pair that differs. cause->text is null if neither the recordings nor the text chunks of the PNG
 * files show a cause. */
bool pair_find_cause(const explanation *e, const diff_pair *pair, const pair_look *look, pair_cause *cause,
                     octreel_error *error);

/* Return the key of a pair: a text that is equal for all pairs with the same cause and is not printed for people.
 * The caller frees the key. Return null if the pair has no key or memory runs out. */
char *pair_find_key(const explanation *e, const diff_pair *pair, const pair_look *look);

/* Print the sentence for two frames that show the same scene. If the renderers are known, the sentence names them. */
void pair_print_rendering(FILE *out, const explanation *e);

#endif
