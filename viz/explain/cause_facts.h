/* SPDX-License-Identifier: MIT */
/* cause_facts.h - in what two recordings differ, as a list of facts. Of two values the first is the reference's.
 *
 * A fact says where: the path of a member of a session file, of recording.json or of a line of ticks.jsonl, such as
 * "tree.capacity" or "edits"; or, of what only the trees tell, "nodes.split", "nodes.merged", "nodes.born",
 * "nodes.gone" and "tree.points"; "queries.visits" are the nodes that a program says its query met, by their numbers;
 * "velocities", "hit_from", "visited" and "heat" are what is drawn and in no file. Values are JSON as in those files. A
 * fact is data; cause_words.h makes sentences of it, and cause_json.h JSON.
 */
#ifndef EXPLAIN_CAUSE_FACTS_H
#define EXPLAIN_CAUSE_FACTS_H

#include "cause_origins.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the second side has: another value, an additional one, one less, the same ones in another order. */
typedef enum cause_change { CAUSE_OTHER, CAUSE_MORE, CAUSE_LESS, CAUSE_ORDER } cause_change;

const char *cause_change_name(cause_change change);

#define CAUSE_NO_TICK UINT64_MAX
#define CAUSE_NO_ID UINT64_MAX

typedef struct cause_fact {
    uint64_t tick; /* in which it is, where the session says so; CAUSE_NO_TICK: in all of them */
    uint64_t id;   /* of a point; CAUSE_NO_ID: it is about none */
    json_t *a, *b; /* null: there is none; referenced */
} cause_fact;

/* So many of a group are listed; the others are counted. */
#define CAUSE_LISTED 8

#define CAUSE_QUERY 48

/* All facts of the same kind, and either all about a tick each or none. */
typedef struct cause_group {
    char where[40];
    char query[CAUSE_QUERY]; /* of facts about an answer: "the range query"; else "" */
    cause_change change;
    uint64_t found;
    cause_fact listed[CAUSE_LISTED];
} cause_group;

/* A zeroed one is empty. */
typedef struct cause_facts {
    cause_group *groups; /* in the order in which they were found */
    size_t count, room;
    bool out_of_memory;    /* the list is not whole */
    cause_origins origins; /* the ticks of all facts that are about one */
} cause_facts;

/* Add a fact, which refers to its values. */
void cause_add(cause_facts *facts, const char *where, const char *query, cause_change change, cause_fact fact);
void cause_facts_release(cause_facts *facts);

/* Put groups about all ticks first, and then the others by the first tick that they are about. */
void cause_facts_sort(cause_facts *facts);

/* The facts that can show in the frame of a tick, of those listed: about all ticks, but for the interval of frames and
 * the last tick, or about this one. They refer to `facts`; free the groups alone. And whether there are any. */
cause_facts cause_facts_shown(const cause_facts *facts, uint64_t tick);
bool cause_facts_show(const cause_facts *facts, uint64_t tick);

/* The group of these facts, or null. */
const cause_group *cause_group_of(const cause_facts *facts, const char *where, cause_change change);

static inline size_t cause_listed(const cause_group *group)
{
    return group->found < CAUSE_LISTED ? (size_t)group->found : CAUSE_LISTED;
}

#endif
