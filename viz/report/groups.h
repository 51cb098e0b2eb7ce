/* SPDX-License-Identifier: MIT */
/* groups.h - groups the frames that differ for the same cause, so that a report lists the cause once and shows the
 * first frame only; and prints the sentences that all reports share. */
#ifndef REPORT_GROUPS_H
#define REPORT_GROUPS_H

#include "explain.h"

#define GROUP_NONE SIZE_MAX

/* Frames that differ for the same cause. Its texts name frames as runs of consecutive frames: "ticks 1 to 39", or
 * "a.png, c.png to f.png". After GROUP_RUNS runs the number of remaining frames follows. */
#define GROUP_RUNS 4
typedef struct frame_group {
    size_t first, last, count; /* the indices of the first and the last pair, and the number of pairs */
    const char *cause;      /* the sentence of the explanation for the first pair, or null; owned by the explanation */
    const char *line;       /* the name of the first pair and how it differs: diff_print_pair() */
    const char *difference; /* the same without the name: diff_print_difference() */
    const char *frames;     /* the names of all frames */
    const char *others;     /* the names of all frames except the first; "" if there is only one */
} frame_group;

/* The groups of all pairs that are listed (diff_is_listed()). */
typedef struct frame_groups {
    frame_group *groups; /* in the order of their first pairs; owned */
    size_t count;
    size_t *of;            /* the group of each pair, or GROUP_NONE; owned */
    const char *verdict;   /* diff_print_verdict(), with the verdict of the explanation */
    const char *tolerance; /* diff_print_tolerance() */
    char *sentences;       /* the memory of all texts; owned */
} frame_groups;

/* Group the pairs by the keys of their causes. A pair without a key is a group of its own; with `each` every pair is.
 * Return false if memory runs out; release the groups in any case. */
bool frame_groups_make(frame_groups *g, const diff_result *result, const explanation *why, bool each,
                       octreel_error *error);
void frame_groups_release(frame_groups *g);

/* Whether a pair is the first of its group: only the first pair is drawn and explained. */
bool frame_groups_is_first(const frame_groups *g, size_t pair);

/* Whether the frames of a group differ or cannot be read, and the number of such groups. */
bool frame_group_fails(const frame_group *group, const diff_result *result);
size_t frame_groups_count_failing(const frame_groups *g, const diff_result *result);

#endif
