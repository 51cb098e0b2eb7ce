/* cause_facts.h - why two recordings differ, as a list of facts. Of two values the first is the reference's.
 *
 * A fact is data; cause_words.h makes sentences of it, and cause_json.h JSON.
 */
#ifndef DIFF_CAUSE_FACTS_H
#define DIFF_CAUSE_FACTS_H

#include "cause_value.h"
#include "layer.h"
#include "octree/game.h"

/* Each kind of fact and its name in JSON. */
#define CAUSE_KIND_MAP(X)                                                                                              \
    /* What a session is made of. */                                                                                   \
    X(OPTION, "option")           /* name, values */                                                                   \
    X(LENGTH, "length")           /* the last tick: values */                                                          \
    X(START_MORE, "start_more")   /* a point at the start: id, place */                                                \
    X(START_LESS, "start_less")   /* id, place */                                                                      \
    X(START_MOVED, "start_moved") /* id, places */                                                                     \
    X(VELOCITY, "velocity")       /* of a point at the start: id, velocities */                                        \
    X(START_ORDER, "start_order") /* the same points at the start in another order */                                  \
    X(KEY, "key")                 /* of a tick: tick, values */                                                        \
    X(EDIT_MORE, "edit_more")     /* tick, name (insert, remove, move), id, place */                                   \
    X(EDIT_LESS, "edit_less")     /* the same */                                                                       \
    X(EDIT_OTHER, "edit_other")   /* leads elsewhere: tick, name, id, places */                                        \
    X(EDIT_SPEED, "edit_speed")   /* an insertion with another velocity: tick, name, id, velocities */                 \
    X(EDIT_ORDER, "edit_order")   /* the same edits of a tick in another order: tick */                                \
    X(QUERY_MORE, "query_more")   /* tick where it is not asked at every one, name (its kind) */                       \
    X(QUERY_LESS, "query_less")   /* the same */                                                                       \
    X(QUERY_OTHER, "query_other") /* the same */                                                                       \
    X(SHAPE_MORE, "shape_more")   /* tick where it is not shown at every one, name (its kind), value: place or text */ \
    X(SHAPE_LESS, "shape_less")   /* the same */                                                                       \
    X(SHAPE_OTHER, "shape_other") /* the same, values */                                                               \
    /* How it is looked at. */                                                                                         \
    X(VIEW, "view")             /* name, values */                                                                     \
    X(LAYER_MORE, "layer_more") /* name */                                                                             \
    X(LAYER_LESS, "layer_less") /* name */                                                                             \
    /* What happened in a tick. */                                                                                     \
    X(NODE_SPLIT, "node_split")     /* an inner node that was a leaf: node */                                          \
    X(NODE_MERGED, "node_merged")   /* and the other way round */                                                      \
    X(NODE_BORN, "node_born")       /* in an octant of an inner node that was not occupied: node */                    \
    X(NODE_GONE, "node_gone")       /* and the other way round */                                                      \
    X(POINT_MORE, "point_more")     /* id, place */                                                                    \
    X(POINT_LESS, "point_less")     /* id, place */                                                                    \
    X(POINT_MOVED, "point_moved")   /* id, places */                                                                   \
    X(PRESSED, "pressed")           /* the key: values */                                                              \
    X(PLAYER, "player")             /* where it is: places, or nowhere */                                              \
    X(ATTEMPT, "attempt")           /* where it tried to go: places */                                                 \
    X(WAY, "way")                   /* it, or what it hit, came from elsewhere */                                      \
    X(EVENT_MORE, "event_more")     /* name */                                                                         \
    X(EVENT_LESS, "event_less")     /* name */                                                                         \
    X(HIT_MORE, "hit_more")         /* of the collision test: id */                                                    \
    X(HIT_LESS, "hit_less")         /* id */                                                                           \
    X(ANSWER, "answer")             /* finds others: query, name, gained and lost */                                   \
    X(NEAREST, "nearest")           /* finds another nearest point: query, name, values */                             \
    X(ANSWER_MORE, "answer_more")   /* query, name */                                                                  \
    X(ANSWER_LESS, "answer_less")   /* query, name */                                                                  \
    X(ANSWER_PLACE, "answer_place") /* asked elsewhere, or finds the same at other places: query, name */              \
    X(REFUSAL_MORE, "refusal_more") /* id, name (why) */                                                               \
    X(REFUSAL_LESS, "refusal_less") /* id, name (why) */                                                               \
    X(SPLITS_NOW, "splits_now")     /* at this tick, and not so in the reference: node */                              \
    X(NOT_NOW, "not_now")           /* neither splits nor merges at this tick, as in the reference: node */            \
    X(MERGES_NOW, "merges_now")     /* node */                                                                         \
    X(VISITS, "visits")             /* its questions met other nodes: values, how many */                              \
    X(COST, "cost")                 /* they compared other points: values, how many */                                 \
    X(HEAT, "heat")                 /* what ticks before it have left is shown, and differs */

typedef enum cause_kind {
#define CAUSE_KIND_ENUM(name, text) CAUSE_##name,
    CAUSE_KIND_MAP(CAUSE_KIND_ENUM)
#undef CAUSE_KIND_ENUM
        CAUSE_KINDS
} cause_kind;

const char *cause_kind_name(cause_kind kind);

#define CAUSE_NO_TICK UINT64_MAX

/* What a kind does not name is zero. */
typedef struct cause_fact {
    cause_kind kind;
    uint64_t tick;    /* of a key, an edit, a query or a shape; CAUSE_NO_TICK: of all */
    const char *name; /* in static storage */
    uint64_t id;      /* of a point */
    octree_address node;
    size_t query;        /* the place among the answers of the tick */
    bool only;           /* it is the only answer of its kind */
    size_t gained, lost; /* results */
    cause_value a, b;
} cause_fact;

/* So many of a kind are listed; the others are counted. */
#define CAUSE_LISTED 8

/* A zeroed one is empty. */
typedef struct cause_facts {
    cause_fact *facts; /* in the order in which they were found */
    size_t count, room;
    uint64_t found[CAUSE_KINDS]; /* all of them, listed or not */
    bool out_of_memory;          /* set by cause_add(): the list is not whole */
} cause_facts;

void cause_add(cause_facts *facts, cause_fact fact);

/* A value that has a name. */
typedef struct cause_option {
    const char *name;
    cause_value value;
} cause_option;

/* Add a fact of this kind for each value of `b` that differs from the one in the same place of `a`. */
void cause_add_options(cause_facts *facts, cause_kind kind, const cause_option *a, const cause_option *b, size_t count);

void cause_facts_release(cause_facts *facts);

/* Whether there is any. */
bool cause_any(const cause_facts *facts);

#endif
