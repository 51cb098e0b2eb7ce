/* SPDX-License-Identifier: MIT */
/* session_variant.h - compares a small session with a changed copy, and checks the headline of the difference. */
#ifndef SESSION_VARIANT_H
#define SESSION_VARIANT_H

#include "octree/game.h"
#include "point_values.h"

/* The words for sessions whose ticks are equal. */
#define SAME_TICKS "the ticks that both sides have are equal"

/* A session that a test may change in any part. */
typedef struct variant {
    octree_session session;
    octree_game_body bodies[16];
    octree_edit edits[8];
    octree_query queries[4];
    octree_shape shapes[8];
    point_values values; /* released when they have been compared */
} variant;

/* The test fails unless this headline describes the difference between the small session and its changed copy. */
void assert_change_headline(void change(variant *v), const char *expected);

/* assert_change_headline(), after `prepare` (may be null) has changed both sessions. */
void assert_change_headline_from(void prepare(variant *v), void change(variant *v), const char *expected);

#endif
