/* SPDX-License-Identifier: MIT */
/* closeup_course.h - where the close-ups of a recording are, tick by tick, and how many times as large they show it. */
#ifndef FRAME_CLOSEUP_COURSE_H
#define FRAME_CLOSEUP_COURSE_H

struct layer_source; /* layer_type.h */

/* All zero: before tick 0. */
typedef struct closeup_course {
    double times;    /* 0: nothing was to be enlarged so far. Else a round number, the same from then on */
    double place[3]; /* what is in the middle; in the world */
} closeup_course;

/* Go on to a tick, or to a tree. There is a close-up of
 *   the player, where its box or its step appears small;
 *   without a player, what is asked and found, or, of a tick that asks nothing, what it moves, splits and merges, from
 * the first tick on in which that appears small;
 *   of a tree, the node that is asked for, and what is asked and found.
 * Of things far apart it shows the first, of those that are small if any is, and what is seen together with that.
 * While it shows what a tick changes, and in a tick without any of it, it stays where it was. It is none where the view
 * wants none, or where the picture is too small. */
void closeup_follow(closeup_course *course, const struct layer_source *in);

#endif
