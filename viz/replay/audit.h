/* SPDX-License-Identifier: MIT */
/* audit.h - measures a foreign index: replays a session whose queries carry the answers of the foreign index, and
 * counts for each kind of query how many answers are wrong and how wrong they are. */
#ifndef REPLAY_AUDIT_H
#define REPLAY_AUDIT_H

#include "error.h"
#include "octree/game.h"
#include "watcher.h"

#define AUDIT_WORST 3
#define AUDIT_POINTS 4

/* The errors that an approximate index may make. `ratio`: a neighbour may be at most `ratio` times as far away as the
 * true neighbour of its rank. `recall`: points may be missing, and farther neighbours named instead, as long as the
 * answers of a kind name at least this share of all true points. Always wrong are unknown ids, points named twice,
 * points that the query excludes, points outside the query, too many neighbours, and invalid foreign nodes. */
typedef struct audit_limits {
    bool by_ratio, by_recall; /* which limits apply; none: every answer must be exact */
    double ratio, recall;
} audit_limits;

/* A wrong answer. */
typedef struct audit_case {
    uint64_t tick;
    size_t place;          /* index among the answers of its tick in ticks.jsonl */
    bool allowed;          /* within the limits by itself; many such answers may still violate the recall */
    octree_judgement made; /* without its lists of points */
    octree_point missing[AUDIT_POINTS], extra[AUDIT_POINTS]; /* the first AUDIT_POINTS of each */
    char *answer; /* query, exact answer and given answer, as the JSON object in ticks.jsonl; owned */
} audit_case;

/* The answers to one kind of query in one tick. */
typedef struct audit_tick {
    uint64_t tick, asked, wrong, expected, missing;
    double ratio; /* the largest ratio of a neighbour */
} audit_tick;

/* The answers to one kind of query. */
typedef struct audit_kind {
    uint64_t asked, wrong;
    uint64_t expected, missing; /* points of the exact answers, and how many of them were missing */
    uint64_t extra;
    uint64_t wrong_by_kind[OCTREE_WRONG_KINDS]; /* answers by the first thing that is wrong with them */
    uint64_t beyond;                            /* wrong answers that violate the limits by themselves */
    uint64_t first_wrong;                       /* the first tick with a wrong answer, if there is one */
    double *ratios;                             /* the ratio of each neighbour answer, ascending */
    size_t ratio_count, ratio_room;
    audit_case worst[AUDIT_WORST]; /* worst first, then earliest first */
    size_t worst_count;
    audit_tick *ticks; /* the ticks with such a query */
    size_t tick_count, tick_room;
} audit_kind;

/* Wrong foreign nodes, counted again in every tick. */
typedef struct audit_nodes {
    bool given;
    uint64_t wrong, ticks, first_wrong; /* wrong nodes, the number of ticks with wrong nodes, the first such tick */
    uint64_t wrong_by_kind[OCTREE_WRONG_NODE_KINDS];
    struct {
        bool known; /* false also if the wrong node was counted but not listed in its tick */
        uint64_t tick;
        octree_wrong_node node;
    } first[OCTREE_WRONG_NODE_KINDS]; /* the first listed wrong node of each kind */
} audit_nodes;

typedef struct audit_report {
    audit_limits limits;
    audit_kind kinds[OCTREE_QUERY_KINDS];
    audit_nodes nodes;
    uint64_t ticks, asked, wrong;
} audit_report;

/* Replay the recording or session at a path and compare its answers with the exact ones. Returns false with an error on
 * failure, and also if the session has neither answers nor foreign nodes. Release the report in any case. `watch`
 * may be null, and its keep_going() is not called. Cost: that of playing the session; 8 bytes per answer, and 48 bytes
 * per tick and kind of query. */
bool audit_read(const char *path, const audit_limits *limits, const watcher *watch, audit_report *report,
                octreel_error *error);
void audit_release(audit_report *report);

/* Returns the ratio that a share of all answers, such as 0.99, does not exceed; 1 if there are none. */
double audit_ratio(const audit_kind *kind, double share);

/* Returns the share of the true points that was named; 1 if there are no true points. */
double audit_recall(const audit_kind *kind);
double audit_tick_recall(const audit_tick *tick);

/* Parse "ratio=1.01,recall=0.99" or one of the two. False with an error. */
bool audit_limits_parse(const char *text, audit_limits *limits, octreel_error *error);

/* True if one kind of query is within the limits; and if all kinds are, and no foreign node is wrong. */
bool audit_kind_passes(const audit_kind *kind, const audit_limits *limits);
bool audit_passes(const audit_report *report);

#endif
