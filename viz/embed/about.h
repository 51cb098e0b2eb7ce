/* SPDX-License-Identifier: MIT */
/* about.h - checks the queries, shapes, foreign nodes and foreign pairs that a program passes for a tick. A null
 * `about` means that the tick has none of these. Private to viz/embed. */
#ifndef EMBED_ABOUT_H
#define EMBED_ABOUT_H

#include "octreel/recorder.h"

/* Check the queries, the shapes and the foreign pairs. `player` is the recorder's kind of player, because a query at
 * the player needs one. Errors: NULL_ARGUMENT, BAD_QUERY, BAD_SHAPE, BAD_PAIR, BAD_ID (of a pair). */
octreel_status tick_info_check(const octreel_tick_info *about, octree_player_kind player, octreel_error *error);

/* Check the foreign nodes. Errors: BAD_NODE, NO_MEMORY. */
octreel_status tick_info_check_nodes(const octreel_tick_info *about, octreel_error *error);

#endif
