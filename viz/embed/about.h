/* SPDX-License-Identifier: MIT */
/* about.h - whether files can have what a program says of a tick. `about` may be null. Private to this folder. */
#ifndef EMBED_ABOUT_H
#define EMBED_ABOUT_H

#include "octreel/recorder.h"

/* Its queries, with such a player, and shapes. Errors: NULL_ARGUMENT, BAD_QUERY, BAD_SHAPE. */
octreel_status about_check(const octreel_tick_info *about, octree_player_kind player, octreel_error *error);

/* Its nodes. Errors: BAD_NODE, NO_MEMORY. */
octreel_status about_check_nodes(const octreel_tick_info *about, octreel_error *error);

#endif
