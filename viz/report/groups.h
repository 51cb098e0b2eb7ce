/* SPDX-License-Identifier: MIT */
/* groups.h - groups the frames that differ for the same cause, so that a report lists the cause once and shows the
 * first frame only. */
#ifndef REPORT_GROUPS_H
#define REPORT_GROUPS_H

#include "explain.h"

#define GROUP_NONE SIZE_MAX

typedef struct frame_group {
    size_t first, count; /* the index of the first pair, and the number of pairs */
} frame_group;

/* The groups of all pairs that are listed (diff_is_listed()). */
typedef struct frame_groups {
    frame_group *groups; /* in the order of their first pairs; owned */
    size_t count;
    size_t *of; /* the group of each pair, or GROUP_NONE; owned */
} frame_groups;

/* Group the pairs by the keys of their causes. A pair without a key is a group of its own; with `each` every pair is.
 * Return false if memory runs out; release the groups in any case. */
bool frame_groups_make(frame_groups *g, const diff_result *result, const explanation *why, bool each,
                       octreel_error *error);
void frame_groups_release(frame_groups *g);

/* Whether a pair is the first of its group: only that one is drawn and explained. */
bool frame_groups_shows(const frame_groups *g, size_t pair);

/* The number of groups whose frames differ or cannot be read. */
size_t frame_groups_count_unlike(const frame_groups *g, const diff_result *result);

/* Print the frames of a group as runs of consecutive frames: "ticks 1 to 39", or "a.png, c.png to f.png". At most
 * GROUP_RUNS runs are printed, then the number of remaining frames. `others`: leave out the first frame. */
#define GROUP_RUNS 4
void frame_group_print(FILE *out, const frame_groups *g, const diff_result *result, size_t group, bool others);

#endif
