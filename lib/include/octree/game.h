/* SPDX-License-Identifier: MIT */
/* game.h - the game loop of the paper: a player moves through a bounded world of points, tick by tick.
 *
 * A session holds everything that a game is played from. Playing it twice gives the same ticks on every machine. Tick 0
 * is the state before any key. Order within a tick: edits, points that move by velocity, the player's step, the
 * collision test, the queries.
 *
 * A point may jump over the player, and the player over a point, in one tick. octree_player.sweep extends the collision
 * test to the whole way: a straight line at constant speed from the position stored at the end of one tick to the
 * position stored at the end of the next, for the player and for every body that its velocity or an edit moves. A body
 * that bounces also counts as moving straight. An inserted body starts where it is inserted. A step is tested on its
 * way even if it is then taken back.
 *
 * Keys: w/s = +y/-y, d/a = +x/-x, e/f = +z/-z, n asks for the nearest neighbour, . waits, q ends the session (it plays
 * no tick).
 */
#ifndef OCTREE_GAME_H
#define OCTREE_GAME_H

#include "octree/query.h"
#include "octree/sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point of the game. The velocity is in world units per tick. A body bounces off the bounds of the world. */
typedef struct octree_body {
    uint64_t id;
    double position[3];
    double velocity[3];
} octree_body;

/* What the player is. */
typedef enum octree_player_kind {
    OCTREE_PLAYER_KEYS, /* a point of the tree that is inserted first and moved by keys */
    OCTREE_PLAYER_BODY, /* the body with the player's id, while it exists. Edits and its velocity move it; keys do not,
                           and it is never taken back. Position and step of octree_player are not read */
    OCTREE_PLAYER_NONE, /* no player: nothing collides, keys do nothing, and the other members are not read */
} octree_player_kind;

typedef struct octree_player {
    octree_player_kind kind;
    uint64_t id;
    double position[3];
    double step;     /* the distance that one key moves, >= 0 */
    double box_size; /* the collision box is position +- box_size, >= 0 */
    bool
        sweep; /* test the whole way. If false, only the end of the step is tested, as in the paper: this misses nothing
                  only if player and point move at most 2 * box_size per tick relative to each other, along one axis */
} octree_player;

typedef enum octree_edit_kind { OCTREE_EDIT_INSERT, OCTREE_EDIT_REMOVE, OCTREE_EDIT_MOVE } octree_edit_kind;

/* A change to the points at the start of a tick >= 1. Ids identify bodies: within a game they are unique. */
typedef struct octree_edit {
    uint64_t tick;
    octree_edit_kind kind;
    octree_body body; /* REMOVE reads only the id. MOVE reads id and position and keeps the current velocity (as in
                         octree_tick.movers: reversed where the body has bounced) */
} octree_edit;

typedef enum octree_shape_kind {
    OCTREE_SHAPE_BOX,
    OCTREE_SHAPE_SEGMENT,
    OCTREE_SHAPE_POINT,
    OCTREE_SHAPE_LABEL,
    OCTREE_SHAPE_KINDS
} octree_shape_kind;

/* "box", "segment", "point", "label". Null for kind >= OCTREE_SHAPE_KINDS. */
const char *octree_shape_name(octree_shape_kind kind);

#define OCTREE_SHAPE_TEXT 47

/* A shape that is drawn at a tick, such as a wall or a goal. It is not in the tree, no query finds it, and it may lie
 * outside the world. */
typedef struct octree_shape {
    uint64_t tick; /* or OCTREE_EVERY_TICK */
    octree_shape_kind kind;
    double at[3];                 /* position of a point or label, start of a segment, lowest corner of a box */
    double to[3];                 /* end of a segment, highest corner of a box; not read for other kinds */
    char text[OCTREE_SHAPE_TEXT]; /* of a label: printable ASCII with its final zero; not read for other kinds */
} octree_shape;

#define OCTREE_GAP_TEXT 160

/* A tick without data: a program that records itself could not pass it on. Nothing is played, asked or shown in this
 * tick, whatever else the session holds for it. The next tick brings the changes made meanwhile, and the way of bodies
 * with a velocity. */
typedef struct octree_gap {
    uint64_t tick;
    char why[OCTREE_GAP_TEXT]; /* printable ASCII with its final zero, at least one character */
} octree_gap;

/* The seeds from which bodies were made, if they were. */
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
    bool known; /* false: the other members are not read */
} octree_sampled;

/* Everything that a game is played from. The game borrows it and its arrays: they must outlive the game. */
typedef struct octree_session {
    octree_def tree;
    octree_player player;
    const octree_body *bodies;
    size_t body_count;
    const char *keys;         /* a string with one key per tick, or null */
    uint64_t ticks;           /* the minimum number of ticks after tick 0; a tick without a key waits */
    uint64_t unplayed;        /* the number of ticks at the end that are not played because the session ended early */
    const octree_edit *edits; /* ascending by tick */
    size_t edit_count;
    const octree_query *queries; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t query_count;
    const octree_shape *shapes; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t shape_count;
    const octree_gap *gaps; /* ascending by tick, at most one per tick */
    size_t gap_count;
    const octree_foreign_tree *foreign; /* the foreign nodes; ascending by tick, at most one per tick */
    size_t foreign_count;
    octree_sampled sampled; /* the seeds of the bodies for session files; the game does not read it */
} octree_session;

/* The paper's session: world [-1000, 1000]^3, capacity 2, depth 5, eleven points, the player at the origin with step
 * 50 and box size 30, and keys that cause every event of a game. The arrays have static storage. */
octree_session octree_session_default(void);

/* The number of ticks after tick 0 that the session plays. */
uint64_t octree_session_length(const octree_session *session);

/* The session's gap at a tick, or null. Cost: O(log gaps). */
const octree_gap *octree_session_gap(const octree_session *session, uint64_t tick);

/* What a tick did: bits of octree_tick.events. */
typedef enum octree_event {
    OCTREE_EVENT_MOVED = 1,    /* the player made its step */
    OCTREE_EVENT_REFUSED = 2,  /* the step would leave the world, or a body or an edit was refused; see FULL */
    OCTREE_EVENT_COLLIDED = 4, /* points are in the player's box; a step that led there was taken back */
    OCTREE_EVENT_FULL = 8,     /* a full leaf: the player's step was taken back, or a body was refused */
    OCTREE_EVENT_SPLIT = 16,   /* leaves became inner nodes */
    OCTREE_EVENT_MERGED = 32,  /* inner nodes became leaves or disappeared */
    OCTREE_EVENT_WRONG = 64,   /* the answer of a foreign index is wrong, or its nodes are */
} octree_event;

#define OCTREE_EVENT_KINDS 7

/* The name of one event, such as "moved". Null unless exactly one known bit is set. */
const char *octree_event_name(octree_event event);

/* A refused point: one that the tree refused when it was loaded, edited, moved by its velocity or moved by the player's
 * step (full), or an edit of a point that does not exist. */
typedef struct octree_refusal {
    uint64_t id;
    octree_status why;
    double position[3]; /* where it was to go; 0 for an edit that removes */
} octree_refusal;

/* A node that the collision test or the queries of a tick visited or pruned. */
typedef struct octree_visit {
    octree_address node; /* in the tree at the time of the search: the collision test comes before the step, which may
                            merge nodes that the test visited */
    octree_trace_kind touch; /* the strongest of all searches: visited, then taken whole, then pruned */
    bool taken;              /* at least one search took it whole */
} octree_visit;

/* One tick. The game owns the arrays; they are valid until its next step. */
typedef struct octree_tick {
    uint64_t number;
    char key;          /* 0 at tick 0 */
    unsigned events;   /* bits of octree_event */
    bool has_player;   /* false: the next three positions are the player's last ones, or the center of the world */
    double player[3];  /* after the tick */
    double attempt[3]; /* where the collision test was made: the end of the step, even if it was taken back */
    bool swept;        /* the test covered the whole way from `from` to `attempt` */
    double from[3];    /* the player's position before the tick; an inserted body starts where it is inserted */
    const octree_point *hits; /* the points that collide, by id */
    size_t hit_count;
    const double (*hit_from)[3];    /* swept: the position of each hit before the tick; else null */
    octree_cost hit_cost;           /* of the collision test; with sweep its points include all bodies that moved */
    const octree_refusal *refusals; /* in the order in which they happened */
    size_t refusal_count;
    size_t edit_count;            /* the number of edits of the tick, refused ones included */
    octree_box edited;            /* the bounds of all inserted and moved positions; min > max if edits only remove. Not
                                     read if edit_count is 0 */
    const octree_address *splits; /* nodes that are inner now and were not at the tick before; in pre-order, none at
                                     tick 0 */
    size_t split_count;
    const octree_address *merges; /* nodes that were inner at the tick before and are not now; in pre-order */
    size_t merge_count;
    octree_stats stats;           /* octree_statistics() of the tree after the tick */
    uint64_t tree_digest;         /* octree_digest() of the tree after the tick */
    const octree_answer *answers; /* that of the key n first, then the session's queries in their order */
    size_t answer_count;
    unsigned asked;             /* bits 1 << octree_query_kind: the kinds asked at this tick or before */
    bool judged;                /* a foreign answer was judged at this tick or before */
    const octree_visit *visits; /* each node once, in pre-order */
    size_t visit_count;
    size_t touched[OCTREE_TRACE_KINDS]; /* the number of visits by octree_visit.touch */
    const octree_address *hit_leaves;   /* the leaves that hold a hit or a point of an answer; in pre-order */
    size_t hit_leaf_count;
    const octree_shape *shapes; /* those of this tick, then those of every tick */
    size_t shape_count;
    const octree_body *movers; /* the bodies with a velocity: their positions and current velocities, reversed where
                                  they bounced; the order is the same each time the session is played */
    size_t mover_count;
    octree_foreign_state foreign; /* the foreign nodes */
    const char *gap; /* the reason if the tick is a gap: the rest is as at the tick before, without events; else null */
} octree_tick;

typedef struct octree_game octree_game;

/* Start a session and play tick 0. Bodies that the tree refuses, or whose velocity is not finite (NOT_FINITE), are left
 * out and become refusals of tick 0. Errors: NULL_ARGUMENT; those of octree_create; NOT_FINITE, OUTSIDE, BAD_SIZE (the
 * player); DUPLICATE (two bodies with one id, or a body with the player's id); BAD_KEY; BAD_OPTION; BAD_ORDER;
 * NOT_FINITE, BAD_RANGE, BAD_SIZE (a query; infinite boxes are allowed); NOT_FINITE, BAD_RANGE, BAD_TEXT (a shape);
 * BAD_TEXT (a gap); those of octree_foreign_check; TOO_MANY (more bodies than a tree can hold); NO_MEMORY. *game is
 * then null. Cost: that of octree_insert_many, and about 90 bytes for each body during the call. */
octree_status octree_game_create(const octree_session *session, octree_game **game);
void octree_game_destroy(octree_game *game);

/* Play one tick with this key instead of the session's. Errors: NULL_ARGUMENT, BUSY (a visitor, tracer or
 * task of the game's tree is running), BAD_KEY (nothing is played); NO_MEMORY (the game must not be stepped again).
 * Cost: O(queries + v log v) for v visits; O(bodies) if a body has a velocity or with sweep; and if inner nodes
 * changed, 8 bytes for each inner node and the points near the changes, or all points after very many changes. */
octree_status octree_game_step(octree_game *game, char key);

/* The input of one tick, for sessions that are still being made. The ticks inside edits, queries, shapes, the gap and
 * the foreign nodes are not read. */
typedef struct octree_input {
    char key;                 /* '.' and 0 wait */
    const octree_edit *edits; /* in the order in which they are applied */
    size_t edit_count;
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_gap *gap;              /* the tick is a gap; null: it is not */
    const octree_foreign_tree *foreign; /* the foreign nodes from this tick on; null: as before */
} octree_input;

/* Play one tick with this input instead of the session's; the session's queries and shapes of every tick follow. The
 * result is the same as in a session that contains this input. The arrays are not needed after the call. Errors: those
 * of octree_game_step, BAD_OPTION, and those of octree_game_create for queries, shapes and foreign nodes (nothing is
 * played). A body whose position or velocity does not allow its edit is no error but a refusal of the tick. */
octree_status octree_game_play(octree_game *game, const octree_input *input);

/* Return what octree_game_play would return for this input, apart from its key. Cost: O(edits + queries + shapes), and
 * that of octree_foreign_check. */
octree_status octree_input_check(const octree_input *input);

/* Play the session's next tick. Errors: those of octree_game_step; NOT_FOUND when the session is over. */
octree_status octree_game_advance(octree_game *game);

/* Ask more queries at the end of the last played tick. Their answers follow the existing ones, and their visits and
 * leaves are added. Later ticks do not change. Errors: NULL_ARGUMENT and those of octree_query_check
 * (nothing is asked); NO_MEMORY (the tick must not be read nor the game stepped). Cost: that of the queries, and of
 * sorting all visits and leaves of the tick. */
octree_status octree_game_ask(octree_game *game, const octree_query *queries, size_t count);

/* True when the session has no further tick. */
bool octree_game_over(const octree_game *game);

/* The last played tick. */
const octree_tick *octree_game_tick(const octree_game *game);

/* The tree after the last played tick. The game owns it. */
const octree *octree_game_tree(const octree_game *game);

/* Store the point with this id after the last played tick. False if no point has it, or for null. Cost: O(1). */
bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point);

/* The session that was passed to octree_game_create. */
const octree_session *octree_game_session(const octree_game *game);

/* The largest initial speed of the session's bodies along one axis, in world units per tick; 0 if all are at rest, and
 * for null. Bodies whose velocity is not finite do not count. Cost: O(1). */
double octree_game_fastest(const octree_game *game);

#ifdef __cplusplus
}
#endif

#endif
