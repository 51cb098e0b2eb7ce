/* SPDX-License-Identifier: MIT */
/* cause_facts.h - the differences between two recordings as a list of facts. The first value of a fact is from the
 * reference, the second from the compared recording ("the frames").
 *
 * Each fact has a place. Most places are paths of members in a session file, in recording.json or in a line of
 * ticks.jsonl, such as "tree.capacity" or "edits". The following places are in no file:
 *
 *     nodes.split, nodes.merged   nodes that are inner nodes only in the frames, or only in the reference
 *     nodes.born, nodes.gone      nodes that exist only in the frames, or only in the reference
 *     tree.points                 points of the tree
 *     queries.visits              the numbers of foreign nodes that a query visited
 *     hit_from, visited, heat     values that are only drawn
 *
 * Values are JSON, as in the files. cause_words.h prints facts as sentences; cause_json.h writes them as JSON.
 */
#ifndef EXPLAIN_CAUSE_FACTS_H
#define EXPLAIN_CAUSE_FACTS_H

#include "cause_origins.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How the compared frames differ from the reference: another value, an additional value, a missing value, or the
 * same values in another order. */
typedef enum cause_change { CAUSE_OTHER, CAUSE_MORE, CAUSE_LESS, CAUSE_ORDER, CAUSE_CHANGES } cause_change;

#define CAUSE_NO_TICK UINT64_MAX
#define CAUSE_NO_ID UINT64_MAX

typedef struct cause_fact {
    uint64_t tick; /* the tick at which the values differ; CAUSE_NO_TICK: the values differ at all ticks */
    uint64_t id;   /* the id of the point that the fact is about; CAUSE_NO_ID: no point */
    json_t *a, *b; /* the value in the reference, the value in the frames; null: no value; both owned */
} cause_fact;

/* The largest number of facts that a group stores. Further facts are only counted. */
#define CAUSE_LISTED 8

#define CAUSE_QUERY 48

/* All facts with the same place, query and change. In one group, either every fact has a tick or no fact has a tick. */
typedef struct cause_group {
    char where[40];          /* the place of the facts */
    char query[CAUSE_QUERY]; /* the query whose answer the facts are about: "the range query"; else "" */
    cause_change change;
    uint64_t found;                  /* the number of all facts of the group */
    cause_fact listed[CAUSE_LISTED]; /* the first facts of the group */
} cause_group;

/* A list of facts in groups. A zeroed list is empty. */
typedef struct cause_facts {
    cause_group *groups; /* the groups, in the order in which their first facts were found; owned */
    size_t count, room;
    bool out_of_memory;    /* true: memory ran out, so the list is incomplete */
    cause_origins origins; /* the origins of all facts that have a tick */
} cause_facts;

/* Add a fact. `facts` takes ownership of the fact's references to its values. */
void cause_add_fact(cause_facts *facts, const char *where, const char *query, cause_change change, cause_fact fact);

/* Add a fact that holds for all ticks and is about neither a point nor a query. `facts` takes ownership of the
 * references to `a` and `b`. */
static inline void cause_add_whole(cause_facts *facts, const char *where, cause_change change, json_t *a, json_t *b)
{
    cause_add_fact(facts, where, "", change, (cause_fact){CAUSE_NO_TICK, CAUSE_NO_ID, a, b});
}

void cause_facts_release(cause_facts *facts);

/* Sort the groups: first the groups without a tick, then the others by their first tick. */
void cause_facts_sort(cause_facts *facts);

/* Return the stored facts that the frame of a tick can show: the facts of this tick and the facts without a tick.
 * Facts about the interval of frames and about the last tick are left out. The result borrows all memory from
 * `facts` except its array `groups`, which the caller frees. */
cause_facts cause_select_facts_of_tick(const cause_facts *facts, uint64_t tick);

/* Return whether cause_select_facts_of_tick() would return any fact. */
bool cause_has_facts_of_tick(const cause_facts *facts, uint64_t tick);

/* Return the group that has this place and this change and is not about a query. Return null if no such group
 * exists. */
const cause_group *cause_find_group(const cause_facts *facts, const char *where, cause_change change);

/* Return the number of facts that are stored in a group. */
static inline size_t cause_count_listed(const cause_group *group)
{
    return group->found < CAUSE_LISTED ? (size_t)group->found : CAUSE_LISTED;
}

#endif
