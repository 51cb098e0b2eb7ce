/* SPDX-License-Identifier: MIT */
/* about.h - checks the queries, shapes and foreign nodes that a program passes for a tick. A null `about` means that
 * the tick has none of these. Private to viz/embed. */
#ifndef EMBED_ABOUT_H
#define EMBED_ABOUT_H

#include "octreel/recorder.h"

/* Check the queries and the shapes. `player` is the recorder's kind of player, because a query at the player needs one.
 * Errors: NULL_ARGUMENT, BAD_QUERY, BAD_SHAPE. */
octreel_status tick_info_check(const octreel_tick_info *about, octree_player_kind player, octreel_error *error);

/* Check the foreign nodes. Errors: BAD_NODE, NO_MEMORY. */
octreel_status tick_info_check_nodes(const octreel_tick_info *about, octreel_error *error);

#endif
