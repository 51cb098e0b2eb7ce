/* SPDX-License-Identifier: MIT */
/* closeup_course.h - decides tick by tick which place the close-up of a recording shows, and how much it enlarges. */
#ifndef COMPOSE_CLOSEUP_COURSE_H
#define COMPOSE_CLOSEUP_COURSE_H

struct layer_source; /* layer_type.h */

/* The state from tick to tick. All zero before tick 0. */
typedef struct closeup_course {
    double reach;    /* half the extent of the subject, in world units; fixed once known; 0: not yet known */
    double place[3]; /* the middle of the close-up, in the world */
} closeup_course;

/* Move the course to the next tick of a game, or to a tree. A close-up shows
 *   with a player: the player, its box and its step;
 *   without a player: the queries and the points that they found or, in a tick without queries, the points that move
 *     and the nodes that split and merge. It begins at the first tick in which these appear small in the view;
 *   for a tree alone: the requested node, the queries and the points that they found.
 * If these subjects are far apart, it shows the first small one (or the first, if none is small) and the subjects that
 * fit beside it. It stays where it is while a tick does nothing, or changes only things that it already shows. */
void closeup_follow(closeup_course *course, const struct layer_source *in);

/* Return how many times the close-up enlarges, a round number. 0 means no close-up: the view wants none, the picture is
 * too small, there is no subject, or the subject is large enough already. */
double closeup_magnification(const closeup_course *course, const struct layer_source *in);

#endif
