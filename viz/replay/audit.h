/* SPDX-License-Identifier: MIT */
/* audit.h - the verdict on a program's own index: a session whose queries carry answers is played, and for each kind of
 * query it is counted how many were wrong, and by how much.
 */
#ifndef REPLAY_AUDIT_H
#define REPLAY_AUDIT_H

#include "error.h"
#include "octree/game.h"

#include <stdio.h>

#define AUDIT_WORST 3

/* A wrong answer. */
typedef struct audit_case {
    uint64_t tick;
    size_t place; /* among the answers of its tick, as in ticks.jsonl */
    octree_fault fault;
    uint64_t fault_id;
    size_t rank;
    double ratio;
    size_t missed, extra;
    char *answer; /* what was asked, found and answered: the object of ticks.jsonl */
} audit_case;

/* The answers to one kind of query. */
typedef struct audit_kind {
    uint64_t asked, wrong;
    uint64_t expected, missed; /* points of the true answers, and those of them that were missed */
    uint64_t extra;
    uint64_t first_wrong; /* tick; where one is wrong */
    double *ratios;       /* neighbours: of each answer, ascending */
    size_t ratio_count, ratio_room;
    audit_case worst[AUDIT_WORST]; /* the worst first: by ratio, then by points missed and extra, then by time */
    size_t worst_count;
} audit_kind;

typedef struct audit_report {
    audit_kind kinds[OCTREE_QUERY_KINDS];
    uint64_t ticks, asked, wrong;
} audit_report;

/* Play a recording, by its folder, or a session, by its file. False with an error, also where no query of it carries an
 * answer. Release the report in any case. `progress` may be null. Cost: that of playing; 8 bytes an answer. */
typedef void audit_progress(uint64_t done, uint64_t total, void *context);
bool audit_read(const char *path, audit_progress *progress, void *context, audit_report *report, octreel_error *error);
void audit_release(audit_report *report);

/* What `share` of the ratios do not exceed; 1 where there are none. */
double audit_ratio(const audit_kind *kind, double share);

/* Of the points of the true answers, the share that was named; 1 where there are none. */
double audit_recall(const audit_kind *kind);

/* Print the verdict on `path`. Errors stay with the stream. */
void audit_print(FILE *out, const char *path, const audit_report *report, bool json);

#endif
