/* SPDX-License-Identifier: MIT */
/* session_variant.h - a small session, the same with one change, and the line that says in what they differ. */
#ifndef SESSION_VARIANT_H
#define SESSION_VARIANT_H

#include "octree/game.h"
#include "point_values.h"

/* Where nothing that happens differs. */
#define SAME_TICKS "the same happens in all ticks that both have"

/* A session that a test may change in any part. */
typedef struct variant {
    octree_session session;
    octree_body bodies[16];
    octree_edit edits[8];
    octree_query queries[4];
    octree_shape shapes[8];
    point_values values; /* released when they have been compared */
} variant;

/* The headline of the causes of a session and the same with one change is this. */
void assert_says(void change(variant *v), const char *expected);

/* The same; what `prepare` does, where it is not null, is done to both before. */
void assert_says_of(void prepare(variant *v), void change(variant *v), const char *expected);

#endif
