/* SPDX-License-Identifier: MIT */
/* pair_look.h - why the frames of one pair differ. For this folder. */
#ifndef EXPLAIN_PAIR_LOOK_H
#define EXPLAIN_PAIR_LOOK_H

#include "explain.h"
#include "frame_file.h"

/* What is wrong with a frame by what its text chunks say: it is not the one that its recording made for this tick, was
 * changed after it was drawn, or, in a recording, says nothing. */
typedef enum frame_fault { FAULT_NONE, FAULT_SESSION, FAULT_TICK, FAULT_SCENE, FAULT_PIXELS, FAULT_TEXTS } frame_fault;

/* What both frames say of themselves in their text chunks. */
typedef struct pair_look {
    frame_origin of[2];
    bool told[2]; /* the frame says it */
    frame_fault faults[2];
    bool same_scene;
} pair_look;

/* Look at both; frames that say it are decoded. Any number of pairs at the same time. */
pair_look pair_look_at(const explanation *e, const diff_pair *pair);

/* Find the cause of a pair that differs. Its text is null where neither recordings nor text chunks in the frames tell
 * one. */
bool pair_find_cause(const explanation *e, const diff_pair *pair, const pair_look *look, pair_cause *cause,
                     octreel_error *error);

/* What is the same in all pairs that differ for one cause, for the program alone; null where nothing tells, or there is
 * no memory. The caller frees it. */
char *pair_find_key(const explanation *e, const diff_pair *pair, const pair_look *look);

/* The sentence for frames of the same scene: who drew them, where that is known. */
void pair_print_rendering(FILE *out, const explanation *e);

#endif
