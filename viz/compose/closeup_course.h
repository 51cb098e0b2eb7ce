/* SPDX-License-Identifier: MIT */
/* closeup_course.h - chooses for each tick the place that the close-up shows, and its magnification. */
#ifndef COMPOSE_CLOSEUP_COURSE_H
#define COMPOSE_CLOSEUP_COURSE_H

struct layer_source; /* defined in layer_type.h */

/* The state that closeup_course_update() keeps from tick to tick. All members are 0 before tick 0. */
typedef struct closeup_course {
    double reach;    /* half extent of the subject, in world units; set once; 0: not set yet */
    double place[3]; /* position in the world that the middle of the close-up shows */
} closeup_course;

/* Choose the place and the magnification of the close-up for the next tick of a game, or for a tree. The subjects of a
 * close-up are
 *   - in a game with a player: the player, its box and its step;
 *   - in a game without a player: the queries and the points that they found; in a tick without queries, the points
 *     that move and the nodes that split or merge. The close-up begins at the first tick in which such a subject
 *     appears small;
 *   - for a tree without a game: the requested node, the queries and the points that they found.
 * If the subjects are far apart, the close-up shows the first small subject (or the first subject, if none is small)
 * and the subjects that fit beside it. The close-up stays where it is if a tick changes nothing, or changes only things
 * that the close-up already shows. */
void closeup_course_update(closeup_course *course, const struct layer_source *in);

/* Return the magnification of the close-up, a round number. Return 0 if there is no close-up: the view has none, the
 * picture is too small, there is no subject, or the subject is large enough already. */
double closeup_magnification(const closeup_course *course, const struct layer_source *in);

#endif
