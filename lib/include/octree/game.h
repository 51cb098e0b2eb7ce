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

#include "octree/query.h"
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

/* A node that a tick's questions met: its collision test and its queries. */
typedef struct octree_visit {
    octree_address node; /* of the tree as it was when it was asked: the collision test comes before the step, which may
                            merge what the test has visited */
    octree_trace_kind touch; /* where several met it, the strongest: visited, then taken whole, then pruned */
    bool taken;              /* one of them took it whole, whatever the others did */
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
    size_t touched[OCTREE_TRACE_KINDS]; /* how many of them were met in each way */
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
