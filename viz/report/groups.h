/* SPDX-License-Identifier: MIT */
/* groups.h - frames that differ for one cause are told once: a group has them all, and its first shows it. */
#ifndef REPORT_GROUPS_H
#define REPORT_GROUPS_H

#include "explain.h"

#define GROUP_NONE SIZE_MAX

typedef struct frame_group {
    size_t first, count; /* a pair, and how many there are */
} frame_group;

/* All pairs that are listed: those that are not the same without forgiveness. */
typedef struct frame_groups {
    frame_group *groups; /* in the order of their first pairs; owned */
    size_t count;
    size_t *of; /* the group of each pair, or GROUP_NONE; owned */
} frame_groups;

/* Frames are of one group where their cause has the same key; those that have none are each of one of their own, and
 * with `each` all are. To be released in any case; false when there is no memory. */
bool frame_groups_make(frame_groups *g, const diff_result *result, const explanation *why, bool each,
                       octreel_error *error);
void frame_groups_release(frame_groups *g);

/* Whether a pair is the first of its group, which is drawn and explained. */
bool frame_groups_shows(const frame_groups *g, size_t pair);

/* Groups of frames that differ or cannot be read. */
size_t frame_groups_count_unlike(const frame_groups *g, const diff_result *result);

/* The frames of a group, without its first if that is asked for, in runs of frames that follow each other: "ticks 1 to
 * 39", or by their names, "a.png, c.png to f.png". At most GROUP_RUNS of them, then how many more. */
#define GROUP_RUNS 4
void frame_group_print(FILE *out, const frame_groups *g, const diff_result *result, size_t group, bool others);

#endif
