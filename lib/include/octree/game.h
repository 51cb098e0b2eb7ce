/* SPDX-License-Identifier: MIT */
/* game.h - the paper's game loop: a player moves through a bounded world of points, tick by tick.
 *
 * A session is all that is needed to play; playing it twice gives the same ticks on every machine. Tick 0 is the
 * state before any key. The order within a tick: edits, points that move by velocity, the player's step, the
 * collision test, the queries.
 *
 * A point may jump over the player, and the player over a point, in one tick. With octree_player.sweep the collision
 * test covers the whole way: straight, at constant speed, from the place that is stored at the end of a tick to that at
 * the end of the next, for the player and for every body that is moved, by its velocity, by an edit or by both. A body
 * that bounces is taken along the straight line too; one that is inserted begins where it is put. A step is tested on
 * its way there whether or not it is taken back.
 *
 * Keys: w/s = +y/-y, d/a = +x/-x, e/f = +z/-z, n names the nearest neighbour, . waits, q ends the session (no tick is
 * played for it).
 */
#ifndef OCTREE_GAME_H
#define OCTREE_GAME_H

#include "octree/foreign.h"
#include "octree/octree.h"
#include "octree/sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point of the game. Velocity is in units a tick; a body that meets the world's bounds bounces. */
typedef struct octree_body {
    uint64_t id;
    double position[3];
    double velocity[3];
} octree_body;

/* Who the player is. */
typedef enum octree_player_kind {
    OCTREE_PLAYER_KEYS, /* a point of the tree like the others, inserted first, which the keys move */
    OCTREE_PLAYER_BODY, /* the body with its id, while there is one: edits and its velocity move it, keys do not, and
                           nothing is taken back. Its position and step are not read */
    OCTREE_PLAYER_NONE, /* nobody: nothing collides, keys do nothing, and the rest of the player is not read */
} octree_player_kind;

typedef struct octree_player {
    octree_player_kind kind;
    uint64_t id;
    double position[3];
    double step;     /* distance of one key, >= 0 */
    double box_size; /* the collision box is position +- box_size, >= 0 */
    bool sweep; /* test the whole way. Without, as in the paper, the step's end alone: sure to miss nothing only where
                   player and point move relative to each other by at most 2 * box_size a tick, along one axis */
} octree_player;

typedef enum octree_edit_kind { OCTREE_EDIT_INSERT, OCTREE_EDIT_REMOVE, OCTREE_EDIT_MOVE } octree_edit_kind;

/* A change to the points at the start of a tick >= 1. Ids name bodies: in a game an id is unique. */
typedef struct octree_edit {
    uint64_t tick;
    octree_edit_kind kind;
    octree_body body; /* remove reads the id alone; move reads id and position, and keeps the velocity: that of
                         octree_tick.movers, turned where the body has bounced */
} octree_edit;

/* The members of octree_query that a kind reads, as bits. */
typedef enum octree_query_member {
    OCTREE_QUERY_HAS_BOX = 1,
    OCTREE_QUERY_HAS_TARGET = 2,
    OCTREE_QUERY_HAS_K = 4,
    OCTREE_QUERY_HAS_RADIUS = 8, /* with the target: a closed ball. Another shape takes a bit of its own */
} octree_query_member;

/* One line per kind of query: its name, the members it reads, which of them bears the kind's name in session files,
 * whether it is answered with neighbours (else with points), and its meaning. A new kind is a line here and its
 * function ask_NAME() in lib/src/game/queries.c. To see it: a row of viz/scene/layer.h with the kind's name and its
 * layer_type in viz/layers; to ask it by octreel inspect: a row of viz/cli/query_options.c. */
#define OCTREE_QUERY_MAP(X)                                                                                            \
    X(RANGE, range, OCTREE_QUERY_HAS_BOX, OCTREE_QUERY_HAS_BOX, false, "the points in a box")                          \
    X(NEAREST, nearest, OCTREE_QUERY_HAS_TARGET, OCTREE_QUERY_HAS_TARGET, true, "the point nearest to a place")        \
    X(KNEAREST, knearest, OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_K, OCTREE_QUERY_HAS_K, true,                      \
      "the k points nearest to a place")                                                                               \
    X(RADIUS, radius, OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_RADIUS, OCTREE_QUERY_HAS_RADIUS, false,               \
      "the points in a ball")

typedef enum octree_query_kind {
#define OCTREE_QUERY_ENUM(kind, name, members, named_by, neighbors, words) OCTREE_QUERY_##kind,
    OCTREE_QUERY_MAP(OCTREE_QUERY_ENUM)
#undef OCTREE_QUERY_ENUM
        OCTREE_QUERY_KINDS
} octree_query_kind;

/* A line of OCTREE_QUERY_MAP. */
typedef struct octree_query_traits {
    const char *name;             /* as in session files and ticks.jsonl, such as "range" */
    unsigned members;             /* bits of octree_query_member */
    octree_query_member named_by; /* in a session file, the member whose key is the kind's name */
    bool neighbors;               /* octree_answer.neighbors is the result, else octree_answer.points */
    const char *words;            /* for people, such as "the points in a box" */
} octree_query_traits;

/* Static storage. Null from OCTREE_QUERY_KINDS on. */
const octree_query_traits *octree_query_about(octree_query_kind kind);

/* The name in octree_query_about(kind). Null from OCTREE_QUERY_KINDS on. */
const char *octree_query_name(octree_query_kind kind);

#define OCTREE_EVERY_TICK UINT64_MAX

/* A question asked at the end of a tick, of the tree as it then is. The player is no neighbour of itself; boxes and
 * balls have it as they have every other point. What is asked at the player is not asked in a tick without one. */
typedef struct octree_query {
    uint64_t tick; /* or OCTREE_EVERY_TICK */
    octree_query_kind kind;
    bool at_player;   /* the box is relative to the player; the target is the player */
    octree_box box;   /* range */
    double target[3]; /* nearest, k nearest, and the ball's centre; unless at_player */
    size_t k;         /* k nearest: how many; where there are fewer, all */
    double radius;    /* of the closed ball, >= 0 */
    octree_skip skip; /* points that no answer has, of whatever kind, in place of the player: COINCIDENT with the
                         target, which a box has not; NONE leaves it at that */
    uint64_t skip_id; /* read under OCTREE_SKIP_ID alone */
    double epsilon; /* as that of octree_search: finite, >= 0, a ratio for neighbours and a length for a box or ball */
    bool answered;  /* a program answered it: a game judges that by the true answer, and its own then has no epsilon */
    octree_precision precision; /* answered: what the program promises, and within epsilon */
    const uint64_t *answer;     /* answered: the ids that it named, in any order; null for none */
    size_t answer_count;
    octree_ids met[OCTREE_MET_KINDS]; /* the program's own nodes that it met, by their ids, and how. Pruned ones are
                                         judged by the true answer, precision and epsilon as an answer is */
} octree_query;

typedef enum octree_shape_kind {
    OCTREE_SHAPE_BOX,
    OCTREE_SHAPE_SEGMENT,
    OCTREE_SHAPE_POINT,
    OCTREE_SHAPE_LABEL,
    OCTREE_SHAPE_KINDS
} octree_shape_kind;

/* "box", "segment", "point", "label". Null from OCTREE_SHAPE_KINDS on. */
const char *octree_shape_name(octree_shape_kind kind);

#define OCTREE_SHAPE_TEXT 47

/* Something that is shown at a tick beside the points. It is in no tree, no question meets it, and it may lie outside
 * the world: what is not the game's own, such as walls and goals. */
typedef struct octree_shape {
    uint64_t tick; /* or OCTREE_EVERY_TICK */
    octree_shape_kind kind;
    double at[3];                 /* the place of a point or label, a segment's beginning, a box's lowest corner */
    double to[3];                 /* a segment's end, a box's highest corner; else not read */
    char text[OCTREE_SHAPE_TEXT]; /* of a label: printable ASCII, with its final zero; else not read */
} octree_shape;

#define OCTREE_GAP_TEXT 160

/* A tick of which nothing is known: a program that records itself could not hand it over. Nothing is played in it, and
 * nothing asked or shown, whatever else there is for it; what changed meanwhile comes with the next tick, as
 * does the way of bodies that have a velocity. */
typedef struct octree_gap {
    uint64_t tick;
    char why[OCTREE_GAP_TEXT]; /* printable ASCII, one character at least, with its final zero */
} octree_gap;

/* How bodies were made, where that was by seeds. */
typedef struct octree_sampled {
    struct {
        octree_sample_kind kind;
        uint64_t count, seed;
    } points; /* octree_sample() in the world */
    struct {
        double speed;
        uint64_t seed;
    } velocities; /* within +-speed on each axis */
    bool by_points, by_velocities;
    bool known; /* false: nothing else of it is read */
} octree_sampled;

/* All that is needed to play. It is borrowed, with its arrays: they must outlive the game. */
typedef struct octree_session {
    octree_def tree;
    octree_player player;
    const octree_body *bodies;
    size_t body_count;
    const char *keys;         /* one a tick; null or a string */
    uint64_t ticks;           /* ticks after tick 0 to play at least; keys that are missing are waits */
    uint64_t unplayed;        /* the last so many of these ticks are not played: the session broke off */
    const octree_edit *edits; /* ascending by tick */
    size_t edit_count;
    const octree_query *queries; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t query_count;
    const octree_shape *shapes; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t shape_count;
    const octree_gap *gaps; /* ascending by tick, one a tick at most */
    size_t gap_count;
    const octree_foreign_tree *foreign; /* the program's own tree; ascending by tick, one a tick at most */
    size_t foreign_count;
    octree_sampled sampled; /* what session files say of the bodies beside listing them; the game does not read it */
} octree_session;

/* The paper's session: world [-1000, 1000]^3, capacity 2, depth 5, eleven points, the player at the origin with step
 * 50 and box size 30, and a flight that meets everything a game can do. Arrays in static storage. */
octree_session octree_session_default(void);

/* Ticks after tick 0 that the session plays. */
uint64_t octree_session_length(const octree_session *session);

/* The session's gap at a tick; null where that is none. Cost: O(log gaps). */
const octree_gap *octree_session_gap(const octree_session *session, uint64_t tick);

/* What a tick did: bits of octree_tick.events. */
typedef enum octree_event {
    OCTREE_EVENT_MOVED = 1,    /* the player's step was made */
    OCTREE_EVENT_REFUSED = 2,  /* the step would leave the world; a body or an edit was refused, but for a full leaf */
    OCTREE_EVENT_COLLIDED = 4, /* points in the player's box; a step that led there was taken back */
    OCTREE_EVENT_FULL = 8,     /* a leaf was full: the player's step was taken back, or a body was refused */
    OCTREE_EVENT_SPLIT = 16,   /* nodes became inner nodes */
    OCTREE_EVENT_MERGED = 32,  /* nodes ceased to be inner nodes */
    OCTREE_EVENT_WRONG = 64,   /* a program's answer to a query was wrong, or the nodes of its tree are */
} octree_event;

#define OCTREE_EVENT_KINDS 7

/* The name of one event, such as "moved". Null for all else: for none, for several, for an unknown bit. */
const char *octree_event_name(octree_event event);

/* What was not done: a point that the tree did not take at load, by an edit, by its own motion, or by the player's step
 * (full), and an edit of a point that is not there. */
typedef struct octree_refusal {
    uint64_t id;
    octree_status why;
    double position[3]; /* where it was to go; 0 for an edit that removes */
} octree_refusal;

/* What is wrong with a program's answer: the first of these that is. */
typedef enum octree_fault {
    OCTREE_FAULT_NONE,
    OCTREE_FAULT_UNKNOWN,   /* it names an id that no point has at that tick: of one that was removed, perhaps */
    OCTREE_FAULT_DUPLICATE, /* it names a point twice */
    OCTREE_FAULT_SKIPPED,   /* it names a point that the query leaves out */
    OCTREE_FAULT_COUNT,     /* neighbours: they are more or fewer than k, or than there are */
    OCTREE_FAULT_FARTHER,   /* neighbours: one is farther than the true one of its rank */
    OCTREE_FAULT_MISSED,    /* box, ball: a point in it is not named */
    OCTREE_FAULT_EXTRA,     /* box, ball: a point is named that is outside */
    OCTREE_FAULTS
} octree_fault;

/* "none", "unknown", "duplicate", "skipped", "count", "farther", "missed", "extra". Null from OCTREE_FAULTS on. */
const char *octree_fault_name(octree_fault fault);

/* A program's answer, judged by the true one. Points in a box or ball are compared one by one. Neighbours are ranked by
 * their distances, whatever their order in the answer, and compared rank by rank: at the same real distance any point
 * is right. All of that is decided by the real numbers. With epsilon a box is moved out by it, a ball's radius is the
 * sum rounded up, and a neighbour is wrong where it is surely more than 1 + epsilon times as far as the true one:
 * within 2^-46 of that ratio none is accused. What no promise allows is then listed, and what is missing by the true
 * answer. */
typedef struct octree_judgement {
    bool judged; /* false: no program answered, and all else is 0 */
    octree_fault fault;
    uint64_t fault_id;     /* UNKNOWN, DUPLICATE, SKIPPED: the lowest such id */
    const uint64_t *given; /* the ids that the program named, as it did */
    size_t given_count;
    size_t expected;            /* points of the true answer */
    const octree_point *missed; /* points of the true answer that no answer may lack; boxes, balls: by id, neighbours:
                                   by distance */
    size_t missed_count;        /* recall is 1 - missed_count / expected */
    const octree_point *extra;  /* points that were named and no answer may have, by id or distance; not those of
                                   UNKNOWN and SKIPPED */
    size_t extra_count;
    size_t rank;  /* neighbours: the first that is wrong, the nearest is 1; 0: none */
    double ratio; /* neighbours: how many times as far as the true one of its rank one of those named is, at worst; 1
                     where all are as near, infinite where the true one is at the target, or none is named at all */
} octree_judgement;

typedef struct octree_answer {
    octree_query_kind kind;
    bool by_key;      /* asked by n */
    octree_box box;   /* range: as asked, in world coordinates */
    double target[3]; /* nearest, k nearest, and the ball's centre: as asked */
    size_t k;         /* k nearest: as asked; nearest: 1 */
    double radius;    /* radius: as asked */
    octree_skip skip; /* as asked, with its id and epsilon; NONE for what leaves out the player alone */
    uint64_t skip_id;
    double epsilon;
    const octree_point *points;       /* range, radius: the result, by id */
    const octree_neighbor *neighbors; /* nearest, k nearest: the result, by distance and then by id */
    size_t count;                     /* of points or neighbours; nearest: 0 or 1 */
    octree_cost cost;
    octree_precision precision;
    octree_judgement judgement; /* in a game, of a query that was answered */
} octree_answer;

/* Whether a query can be asked. Errors: NULL_ARGUMENT, also for ids that are not there; BAD_OPTION for its kind and
 * precision, and for its skip where there is none such or no target to coincide with; NOT_FINITE (of a box: NaN),
 * BAD_RANGE, BAD_SIZE and FLOAT_MODE for epsilon and the members that its kind reads; BAD_SIZE for a node that it met
 * with an id from OCTREE_NODE_ID_LIMIT on. Its tick is not read. */
octree_status octree_query_check(const octree_query *query);

/* Answer a query outside of a game. `player` is the place that at_player refers to, and may be null where that is
 * false; `how` may be null; where the query has no skip or no epsilon, that of `how` decides which points are
 * neighbours, and how near to the truth the answer is. What a program answered is not judged. The cost is that of
 * answer->cost, and how->cost is not read. Release the answer with octree_answer_release. Errors: those of
 * octree_query_check, and NULL_ARGUMENT, NO_MEMORY and what octree_range_search says of `how`; the answer is then
 * empty. The memory is the tree's allocator's, which must then be safe to use from this thread. */
octree_status octree_query_answer(const octree *tree, const octree_query *query, const double player[3],
                                  const octree_search *how, octree_answer *answer);
void octree_answer_release(const octree *tree, octree_answer *answer);

/* A node that a tick's questions met: its collision test and its queries. */
typedef struct octree_visit {
    octree_address node; /* of the tree as it was when it was asked: the collision test comes before the step, which may
                            merge what the test has visited */
    octree_touch touch;  /* where several met it, the strongest: visited, then taken whole, then pruned */
    bool taken;          /* one of them took it whole, whatever the others did */
} octree_visit;

/* One tick. The arrays are owned by the game and valid until its next step. */
typedef struct octree_tick {
    uint64_t number;
    char key;          /* 0 at tick 0 */
    unsigned events;   /* bits of octree_event */
    bool has_player;   /* false: the next three places are those where one was last, or else the world's middle */
    double player[3];  /* after the tick */
    double attempt[3]; /* where the collision test was made: the step's end, taken back or not */
    bool swept;        /* the test was made all the way from `from` to `attempt` */
    double from[3];    /* where the player was before the tick; a body that was inserted, where it was put */
    const octree_point *hits; /* what the collision test found, by id */
    size_t hit_count;
    const double (*hit_from)[3];    /* swept: where each hit was before the tick; else null */
    octree_cost hit_cost;           /* of the collision test; swept, bodies that moved are points compared one by one */
    const octree_refusal *refusals; /* in the order they happened */
    size_t refusal_count;
    size_t edit_count;            /* the edits of the tick, those that were refused too */
    octree_box edited;            /* around where these put bodies; min above max where they only remove some. Read
                                     where there are any */
    const octree_address *splits; /* inner now and not at the tick before; in pre-order, none at tick 0 */
    size_t split_count;
    const octree_address *merges; /* inner at the tick before and not now; in pre-order */
    size_t merge_count;
    octree_stats stats;           /* of the tree after the tick: what octree_statistics() says of it */
    uint64_t tree_digest;         /* and octree_digest() */
    const octree_answer *answers; /* n first, then the session's queries in their order */
    size_t answer_count;
    unsigned asked;             /* bits 1 << octree_query_kind: what was asked up to this tick */
    bool judged;                /* a program's answer was judged in this tick or before */
    const octree_visit *visits; /* each node once, in pre-order */
    size_t visit_count;
    size_t touched[OCTREE_TOUCH_KINDS]; /* how many of them were met in each way */
    const octree_address *hit_leaves;   /* the leaves that hold a hit or a point of an answer; in pre-order */
    size_t hit_leaf_count;
    const octree_shape *shapes; /* of this tick, and then those of every tick */
    size_t shape_count;
    const octree_body *movers; /* bodies with a velocity: where they are, and how they go on, turned where they bounced;
                                  in an order that is the same whenever the session is played */
    size_t mover_count;
    octree_foreign_state foreign; /* the program's own tree */
    const char *gap; /* why nothing is known of the tick: all else is then as it was, and nothing happened; else null */
} octree_tick;

typedef struct octree_game octree_game;

/* Start a session and play tick 0. Bodies that the tree refuses, and those whose velocity is not finite (NOT_FINITE),
 * are not in the game, and are refusals of tick 0.
 * Errors: NULL_ARGUMENT; those of octree_create; for the player NOT_FINITE, OUTSIDE, BAD_SIZE; DUPLICATE (two bodies
 * with one id, or a body with the player's); BAD_KEY; BAD_OPTION; BAD_ORDER; for a query NOT_FINITE (of a box: NaN),
 * BAD_RANGE, BAD_SIZE; for a shape NOT_FINITE, BAD_RANGE, BAD_TEXT; for a gap BAD_TEXT; for foreign nodes those of
 * octree_foreign_check; TOO_MANY (bodies for one tree); NO_MEMORY. *game is then null. Cost: one restructuring, as
 * octree_insert_many, with some ninety bytes a body while it runs. */
octree_status octree_game_create(const octree_session *session, octree_game **game);
void octree_game_destroy(octree_game *game);

/* Play one tick with this key, whatever the session's keys say. Errors: NULL_ARGUMENT, FLOAT_MODE and BAD_KEY, of which
 * nothing is played; NO_MEMORY, after which the game must not be stepped again. Cost: O(queries +
 * v log v for v visits; all bodies, where any has a velocity and when swept; and where the tree changed its inner
 * nodes, at 8 bytes each, and some hundred points about each change, or, of very many changes, all points). */
octree_status octree_game_step(octree_game *game, char key);

/* What happens in a tick: for games whose session is being made. The ticks that edits, queries, shapes, a gap
 * and foreign nodes name are not read. */
typedef struct octree_input {
    char key;                 /* '.' and 0 wait */
    const octree_edit *edits; /* in the order in which they are made */
    size_t edit_count;
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_gap *gap;              /* nothing is known of the tick; null: it is a tick like others */
    const octree_foreign_tree *foreign; /* the program's own tree from this tick on; null: as before */
} octree_input;

/* Play one tick with this, whatever the session says of it; what the session asks and shows at every tick comes after
 * it. The arrays are not needed afterwards. It is the same tick as in a session that has all this. Errors: those of
 * octree_game_step; BAD_OPTION, and for a query, a shape or foreign nodes those of octree_game_create, of which nothing
 * is played. A body that cannot be inserted or moved, for its place or its velocity, is no error: it is a refusal of
 * the tick. */
octree_status octree_game_play(octree_game *game, const octree_input *input);

/* What octree_game_play would say of this input, its key apart. Cost: O(edits + queries + shapes), and that of
 * octree_foreign_check. */
octree_status octree_input_check(const octree_input *input);

/* Play the session's next tick. Errors: as octree_game_step, and NOT_FOUND when the session is over. */
octree_status octree_game_advance(octree_game *game);

/* Ask more about the tick that was played last, as though the session had asked it at the end of that tick: the answers
 * come after those that are there, and the visits and leaves take in theirs. What is played next is the same as
 * without. Errors: NULL_ARGUMENT, FLOAT_MODE, and those of octree_query_check, of which nothing is asked; NO_MEMORY,
 * after which the tick must not be read, nor the game stepped. Cost: that of the queries, and of the tick's visits and
 * leaves. */
octree_status octree_game_ask(octree_game *game, const octree_query *queries, size_t count);

/* True when the session has no further tick. */
bool octree_game_over(const octree_game *game);

/* The tick that was played last. */
const octree_tick *octree_game_tick(const octree_game *game);

/* The tree as it is after that tick. Owned by the game. */
const octree *octree_game_tree(const octree_game *game);

/* The point that has an id after that tick. False where there is none, and for null. Cost: O(1). */
bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point);

/* The session as it was given. */
const octree_session *octree_game_session(const octree_game *game);

/* The greatest speed along one axis that a body of the session begins with, in world units a tick; 0 where all are at
 * rest, and for null. Velocities that are refused, since they are not finite, do not count. Cost: O(1). */
double octree_game_fastest(const octree_game *game);

#ifdef __cplusplus
}
#endif

#endif
