/* SPDX-License-Identifier: MIT */
/* audit.h - the verdict on a program's own index: a session whose queries carry answers is played, and for each kind of
 * query it is counted how many were wrong, and by how much.
 */
#ifndef REPLAY_AUDIT_H
#define REPLAY_AUDIT_H

#include "error.h"
#include "octree/game.h"

#define AUDIT_WORST 3
#define AUDIT_POINTS 4

/* How wrong the answers of a kind may be. `ratio` allows neighbours that are farther, as long as none is more than so
 * many times as far as the true one of its rank; `recall` allows points that are missed, as long as so much of all true
 * points is named, and the farther neighbours that are named for them. Nothing allows ids that no point has, points
 * that are named twice, left out or outside, nor more neighbours than there are, nor faults of nodes. */
typedef struct audit_limits {
    bool by_ratio, by_recall; /* neither: every answer must be right */
    double ratio, recall;
} audit_limits;

/* A wrong answer. */
typedef struct audit_case {
    uint64_t tick;
    size_t place;                                           /* among the answers of its tick, as in ticks.jsonl */
    bool allowed;                                           /* by itself: too many of them may be beyond a recall */
    octree_judgement made;                                  /* without its lists */
    octree_point missed[AUDIT_POINTS], extra[AUDIT_POINTS]; /* the first of them */
    char *answer; /* what was asked, found and answered: the object of ticks.jsonl */
} audit_case;

/* The answers to a kind of query in one tick. */
typedef struct audit_tick {
    uint64_t tick, asked, wrong, expected, missed;
    double ratio; /* neighbours: the worst */
} audit_tick;

/* The answers to one kind of query. */
typedef struct audit_kind {
    uint64_t asked, wrong;
    uint64_t expected, missed; /* points of the true answers, and those of them that were missed */
    uint64_t extra;
    uint64_t faults[OCTREE_WRONG_KINDS]; /* answers, by what is wrong first */
    uint64_t beyond;                     /* wrong answers that the limits do not allow by themselves */
    uint64_t first_wrong;                /* tick; where one is wrong */
    double *ratios;                      /* neighbours: of each answer, ascending */
    size_t ratio_count, ratio_room;
    audit_case
        worst[AUDIT_WORST]; /* the worst first: those beyond, what nothing allows, by judgement_is_worse(), by time */
    size_t worst_count;
    audit_tick *ticks; /* in which it was asked */
    size_t tick_count, tick_room;
} audit_kind;

/* The foreign nodes: what is proved wrong with them is counted at every tick. */
typedef struct audit_nodes {
    bool given;
    uint64_t faults, ticks, first_wrong; /* in so many ticks, from this one on */
    uint64_t kinds[OCTREE_WRONG_NODE_KINDS];
    struct {
        bool known; /* that of a kind may be among those that a tick counts and does not list */
        uint64_t tick;
        octree_wrong_node fault;
    } first[OCTREE_WRONG_NODE_KINDS]; /* of each kind */
} audit_nodes;

typedef struct audit_report {
    audit_limits limits;
    audit_kind kinds[OCTREE_QUERY_KINDS];
    audit_nodes nodes;
    uint64_t ticks, asked, wrong;
} audit_report;

/* Play a recording, by its folder, or a session, by its file, and judge it by the limits. False with an error, also
 * where no query of it carries an answer and no nodes are said. Release the report in any case. `progress` may be null.
 * Cost: that of playing; 8 bytes an answer, and 48 a tick and kind. */
typedef void audit_progress(uint64_t done, uint64_t total, void *context);
bool audit_read(const char *path, const audit_limits *limits, audit_progress *progress, void *context,
                audit_report *report, octreel_error *error);
void audit_release(audit_report *report);

/* What `share` of the ratios do not exceed; 1 where there are none. */
double audit_ratio(const audit_kind *kind, double share);

/* Of the points of the true answers, the share that was named; 1 where there are none. */
double audit_recall(const audit_kind *kind);
double audit_tick_recall(const audit_tick *tick);

/* "ratio=1.01,recall=0.99", or one of them. False with an error that says what fits. */
bool audit_limits_parse(const char *text, audit_limits *limits, octreel_error *error);

/* Whether a kind is within the limits that it was read with; and all kinds, with nothing wrong about nodes. */
bool audit_kind_passes(const audit_kind *kind, const audit_limits *limits);
bool audit_passes(const audit_report *report);

#endif
