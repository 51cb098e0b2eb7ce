/* SPDX-License-Identifier: MIT */
/* closeup_course.h - where the close-ups of a recording are, tick by tick, and how many times as large they show it. */
#ifndef COMPOSE_CLOSEUP_COURSE_H
#define COMPOSE_CLOSEUP_COURSE_H

struct layer_source; /* layer_type.h */

/* All zero: before tick 0. */
typedef struct closeup_course {
    double reach;    /* half the extent of what is to be enlarged: the same once it is known; 0: it is not */
    double place[3]; /* what is in the middle; in the world */
} closeup_course;

/* Go on to a tick, or to a tree. A close-up shows
 *   the player, its box and its step;
 *   without a player, what is asked and found, or, in a tick that asks nothing, what it moves, splits and merges: from
 * the first tick on in which that appears small in the view;
 *   of a tree, the node that is asked for, and what is asked and found.
 * Of things far apart it shows the first, of those that are small if any is, and what is seen together with that.
 * While a tick does nothing, or changes only what it shows, it stays where it was. */
void closeup_follow(closeup_course *course, const struct layer_source *in);

/* How many times as large a close-up shows what it is of, a round number; 0 where there is none: the view wants none,
 * the picture is too small, there is nothing to look at, or it is large enough already. */
double closeup_magnification(const closeup_course *course, const struct layer_source *in);

#endif
