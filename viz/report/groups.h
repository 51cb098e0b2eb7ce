/* SPDX-License-Identifier: MIT */
/* groups.h - groups the frames that differ for the same cause. A report then lists the cause once and shows only the
 * first frame. This file also prints the sentences that all reports share. */
#ifndef REPORT_GROUPS_H
#define REPORT_GROUPS_H

#include "explain.h"

#define GROUP_NONE SIZE_MAX

/* A group: frames that differ for the same cause. A text that names its frames joins consecutive frames to ranges:
 * "ticks 1 to 39", or "a.png, c.png to f.png". After GROUP_RUNS ranges, only the number of remaining frames is
 * printed. */
#define GROUP_RUNS 4
typedef struct frame_group {
    size_t first, last, count; /* the indices of the group's first and last pair, and the number of its pairs */
    const char *cause;         /* the explanation's sentence for the first pair, or null; owned by the explanation */
    const char *line; /* the name of the first pair and how its two frames differ, as diff_print_pair() prints it */
    const char *difference; /* how the two frames of the first pair differ, without the name of the pair, as
                               diff_print_difference() prints it */
    const char *frames;     /* the names of all frames of the group */
    const char *others;     /* the names of all frames except the first; "" if the group has only one frame */
} frame_group;

/* All pairs that reports list (see diff_is_listed()), in groups. */
typedef struct frame_groups {
    frame_group *groups; /* the groups, in the order of their first pairs; owned */
    size_t count;
    size_t *of;            /* of[i]: the index of the group of pair i, or GROUP_NONE if pair i is in no group; owned */
    const char *verdict;   /* the verdict of the explanation, as diff_print_verdict() prints it */
    const char *tolerance; /* the tolerance, as diff_print_tolerance() prints it */
    char *sentences;       /* the memory that all texts of the groups point into; owned */
} frame_groups;

/* Group the pairs by the keys of their causes. A pair without a key is a group of its own. With `each`, every pair
 * is a group of its own. Return false with an error if memory runs out. The caller releases the groups in any case. */
bool frame_groups_make(frame_groups *g, const diff_result *result, const explanation *why, bool each,
                       octreel_error *error);
void frame_groups_release(frame_groups *g);

/* Return whether a pair is the first of its group. Only first pairs are drawn and explained. */
bool frame_groups_is_first(const frame_groups *g, size_t pair);

/* frame_group_fails() returns whether the frames of a group differ or cannot be read. frame_groups_count_failing()
 * returns the number of such groups. */
bool frame_group_fails(const frame_group *group, const diff_result *result);
size_t frame_groups_count_failing(const frame_groups *g, const diff_result *result);

#endif
