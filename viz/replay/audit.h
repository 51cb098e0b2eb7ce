/* SPDX-License-Identifier: MIT */
/* audit.h - measures a foreign index. It replays a session whose queries carry the answers of the foreign index. For
 * each kind of query it counts the wrong answers and measures how wrong they are. */
#ifndef REPLAY_AUDIT_H
#define REPLAY_AUDIT_H

#include "error.h"
#include "octree/game.h"
#include "watcher.h"

#define AUDIT_WORST 3
#define AUDIT_POINTS 4

/* The kinds of answers: those of the queries, and the pairs of overlapping bodies that the index found at a tick. */
enum { AUDIT_PAIRS = OCTREE_QUERY_KINDS, AUDIT_KINDS };

/* The errors that an approximate index may make. `ratio`: a neighbour may be at most `ratio` times as far away as the
 * true neighbour of the same rank. `recall`: the answers of a query kind must name at least this share of all true
 * points; the other points may be missing, or farther neighbours may be named instead.
 *
 * These errors are wrong under any limits: unknown ids, points that are named twice, points that the query excludes,
 * points outside the query, too many neighbours, and invalid foreign nodes. */
typedef struct audit_limits {
    bool by_ratio, by_recall; /* the limits that are set; if both are false, every answer must be exact */
    double ratio, recall;
} audit_limits;

/* A wrong answer. */
typedef struct audit_case {
    uint64_t tick;
    size_t place; /* index of the answer among the answers of its tick in ticks.jsonl; SIZE_MAX for pairs */
    /* True: the wrong answer is within the limits when judged alone. Many such answers together may still violate the
     * recall limit. */
    bool allowed;
    octree_judgement made; /* the judgement of the answer; its lists of points are not kept */
    /* The first AUDIT_POINTS points that are missing in the answer, and the first AUDIT_POINTS points that are
     * extra. Not set for pairs. */
    octree_point missing[AUDIT_POINTS], extra[AUDIT_POINTS];
    /* The JSON object of ticks.jsonl with the query, the exact answer and the given answer, or with the pairs; owned by
     * this struct. */
    char *answer;
} audit_case;

/* The sums over the answers to one kind of query in one tick. The members mean the same as in audit_kind. */
typedef struct audit_tick {
    uint64_t tick, asked, wrong, expected, missing;
    double ratio; /* the largest ratio of a neighbour in these answers */
} audit_tick;

/* The sums over all answers to one kind of query, or over the pairs of all ticks. For pairs, "point" means a pair. */
typedef struct audit_kind {
    uint64_t asked, wrong; /* number of answers; number of wrong answers */
    /* `expected`: number of points in the exact answers; `missing`: number of these points that the foreign answers
     * lack; `extra`: number of points in the foreign answers that the exact answers lack. */
    uint64_t expected, missing, extra;
    /* Number of wrong answers by kind; an answer with several errors counts under its first error. */
    uint64_t wrong_by_kind[OCTREE_WRONG_KINDS];
    uint64_t on_boundary; /* wrong answers that would be right with other bounds of the query (open or closed) */
    uint64_t beyond;      /* wrong answers that violate the limits when judged alone */
    uint64_t first_wrong; /* the first tick with a wrong answer; set if `wrong` is not 0 */
    double *ratios;       /* the ratio of each answer to a neighbour query, ascending */
    size_t ratio_count, ratio_room;
    /* The worst wrong answers, the worst first; among equally bad answers, the earliest first. */
    audit_case worst[AUDIT_WORST];
    size_t worst_count;
    audit_tick *ticks; /* one entry for each tick with a query of this kind */
    size_t tick_count, tick_room;
} audit_kind;

/* The wrong foreign nodes of all ticks. A node that stays wrong for several ticks is counted once per tick. */
typedef struct audit_nodes {
    bool given; /* true: the session has foreign nodes */
    /* Number of wrong nodes, number of ticks with a wrong node, and the first tick with a wrong node. */
    uint64_t wrong, ticks, first_wrong;
    uint64_t wrong_by_kind[OCTREE_WRONG_NODE_KINDS];
    struct {
        bool known; /* false: no listed wrong node is of this kind; a tick lists only some of its wrong nodes */
        uint64_t tick;
        octree_wrong_node node;
    } first[OCTREE_WRONG_NODE_KINDS]; /* the first listed wrong node of each kind */
} audit_nodes;

typedef struct audit_report {
    audit_limits limits;
    audit_kind kinds[AUDIT_KINDS];
    audit_nodes nodes;
    uint64_t ticks, asked, wrong; /* number of ticks, of answers and of wrong answers */
} audit_report;

/* Replay the recording or session at a path and compare its foreign answers with the exact ones. Returns false with an
 * error on failure, and also if the session has no answers, foreign nodes or foreign pairs, or more than `max_ticks`
 * ticks (0: SESSION_MOST_PLAYED). Release the report after a failure too. `watch` may be null; its keep_going() is not
 * called. Cost: the time to play the session. Memory: 8 bytes per answer, and 48 bytes per tick and kind of query. */
bool audit_replay(const char *path, const audit_limits *limits, uint64_t max_ticks, const watcher *watch,
                  audit_report *report, octreel_error *error);
void audit_release(audit_report *report);

/* Returns the name and the other traits of a kind of answer. Of the traits of pairs, only the name is set. */
const octree_query_traits *audit_kind_about(int kind);

/* Returns a percentile of the ratios: the smallest stored ratio that at least the share `share` of all answers, such as
 * 0.99, does not exceed. Returns 1 if there are no answers. */
double audit_ratio_percentile(const audit_kind *kind, double share);

/* Return the recall: the share of the true points that the answers name. Return 1 if there are no true points. */
double audit_recall(const audit_kind *kind);
double audit_tick_recall(const audit_tick *tick);

/* Parse limits such as "ratio=1.01,recall=0.99". Either limit may be left out. Returns false with an error if the text
 * is invalid. */
bool audit_limits_parse(const char *text, audit_limits *limits, octreel_error *error);

/* audit_kind_passes() returns true if the answers to one kind of query are within the limits. audit_passes() returns
 * true if the answers to all kinds are within the limits and no foreign node is wrong. */
bool audit_kind_passes(const audit_kind *kind, const audit_limits *limits);
bool audit_passes(const audit_report *report);

#endif
