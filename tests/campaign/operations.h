/* SPDX-License-Identifier: MIT */
/* operations.h - all operations that a campaign performs on a tree. */
#ifndef CAMPAIGN_OPERATIONS_H
#define CAMPAIGN_OPERATIONS_H

#include "trial.h"

/* Run the operation once, with random arguments, on the tree and on the model. False: they differ, and trial.fault says
 * how. */
typedef bool operation(trial *t);

/* changes.c */
operation change_one, change_move, change_insert_many, change_remove_many, change_move_many, change_reworld,
    change_clear;

/* ask_places.c */
operation ask_find, ask_contains, ask_look;

/* ask_boxes.c */
operation ask_range, ask_range_stopped, ask_range_count, ask_range_collect, ask_range_collect_sorted, ask_collide,
    ask_collide_swept;

/* ask_neighbors.c */
operation ask_nearest, ask_nearest_k, ask_nearest_within, ask_nearest_batch, ask_radius;

#endif
