/* SPDX-License-Identifier: MIT */
/* about.h - checks the queries, shapes and foreign nodes that a program gives for a tick. `about` may be null, which is
 * valid. Private to this folder. */
#ifndef EMBED_ABOUT_H
#define EMBED_ABOUT_H

#include "octreel/recorder.h"

/* Check the queries, for a player of this kind, and the shapes. Errors: NULL_ARGUMENT, BAD_QUERY, BAD_SHAPE. */
octreel_status about_check(const octreel_tick_info *about, octree_player_kind player, octreel_error *error);

/* Check the foreign nodes. Errors: BAD_NODE, NO_MEMORY. */
octreel_status about_check_nodes(const octreel_tick_info *about, octreel_error *error);

#endif
