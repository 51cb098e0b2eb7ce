/* SPDX-License-Identifier: MIT */
/* game.h - the game loop of the paper: a player moves through a bounded world of points, tick by tick.
 *
 * A session is the complete input of a game. The same session gives the same ticks on every machine. Tick 0 is the
 * state before any key. Order within a tick: edits, points that move by velocity, the player's step, the collision
 * test, the queries.
 *
 * Without sweep, the collision test looks only at the positions at the end of a tick. So a point and the player may
 * jump over each other in one tick. With octree_player.sweep the test covers the whole way of the player and of every
 * body that its velocity or an edit moves. The way is a straight line at constant speed, from the position stored at
 * the end of one tick to the position stored at the end of the next, even for a body that bounces. An inserted body
 * starts at the position of its insertion. The way of a step is tested even if the step is then taken back.
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

/* How the player is defined. */
typedef enum octree_player_kind {
    OCTREE_PLAYER_KEYS, /* the player is a point of the tree; the game inserts it first, and keys move it */
    OCTREE_PLAYER_BODY, /* the player is the body that has the player's id, while this body exists. Edits and its
                           velocity move it; keys do not. The game never takes its moves back. Position and step of
                           octree_player are not read */
    OCTREE_PLAYER_NONE, /* there is no player: nothing collides, keys do nothing, and the other members are not read */
} octree_player_kind;

typedef struct octree_player {
    octree_player_kind kind;
    uint64_t id;
    double position[3];
    double step;     /* the distance that the player moves for one key, >= 0 */
    double box_size; /* the collision box is position +- box_size on each axis; >= 0 */
    bool sweep; /* true: the collision test covers the whole way of the tick. false: only the end of the step is tested,
                   as in the paper. The short test misses nothing only if player and point move along one axis, at most
                   2 * box_size per tick relative to each other */
} octree_player;

typedef enum octree_edit_kind { OCTREE_EDIT_INSERT, OCTREE_EDIT_REMOVE, OCTREE_EDIT_MOVE } octree_edit_kind;

/* A change of the bodies at the start of a tick >= 1. The id identifies the body; within a game ids are unique. */
typedef struct octree_edit {
    uint64_t tick;
    octree_edit_kind kind;
    octree_body body; /* REMOVE reads only the id. MOVE reads id and position; the body keeps its current velocity,
                         which is reversed if the body has bounced (as in octree_tick.movers) */
} octree_edit;

typedef enum octree_shape_kind {
    OCTREE_SHAPE_BOX,
    OCTREE_SHAPE_SEGMENT,
    OCTREE_SHAPE_POINT,
    OCTREE_SHAPE_LABEL,
    OCTREE_SHAPE_KINDS
} octree_shape_kind;

/* The name of a shape: "box", "segment", "point" or "label". Null for kind >= OCTREE_SHAPE_KINDS. */
const char *octree_shape_name(octree_shape_kind kind);

#define OCTREE_SHAPE_TEXT 47

/* A shape that is drawn at a tick, such as a wall or a goal. A shape is not in the tree, and queries do not find it. It
 * may lie outside the world. */
typedef struct octree_shape {
    uint64_t tick; /* a tick number, or OCTREE_EVERY_TICK */
    octree_shape_kind kind;
    double at[3];                 /* position of a point or label, start of a segment, lowest corner of a box */
    double to[3];                 /* end of a segment, highest corner of a box; not read for other kinds */
    char text[OCTREE_SHAPE_TEXT]; /* a label's text: printable ASCII with its final zero; not read for other kinds */
} octree_shape;

#define OCTREE_GAP_TEXT 160

/* A tick for which the session has no data, because the recording program lost it. In this tick nothing is played,
 * asked or shown, even if the session holds edits or queries for it. The next tick brings the changes made meanwhile.
 * In that tick bodies with a velocity also make the way that they missed. */
typedef struct octree_gap {
    uint64_t tick;
    char why[OCTREE_GAP_TEXT]; /* the reason of the gap: printable ASCII with its final zero, at least one character */
} octree_gap;

/* The seeds from which random bodies were made. Session files store these seeds in place of the bodies. */
typedef struct octree_sampled {
    struct {
        octree_sample_kind kind;
        uint64_t count, seed;
    } points; /* the arguments of octree_sample(), with the world as its box */
    struct {
        double speed;
        uint64_t seed;
    } velocities; /* each component is a random number within +-speed */
    bool by_points, by_velocities;
    bool known; /* false: the bodies were not made from seeds, and the other members are not read */
} octree_sampled;

/* The complete input of a game. The game borrows the struct and its arrays: they must outlive the game. */
typedef struct octree_session {
    octree_def tree;
    octree_player player;
    const octree_body *bodies;
    size_t body_count;
    const char *keys;         /* a string with one key per tick, or null */
    uint64_t ticks;           /* the minimum number of ticks after tick 0; a tick for which there is no key waits */
    uint64_t unplayed;        /* the number of ticks at the end that are not played because the session ended early */
    const octree_edit *edits; /* ascending by tick */
    size_t edit_count;
    const octree_query *queries; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t query_count;
    const octree_shape *shapes; /* ascending by tick, OCTREE_EVERY_TICK last */
    size_t shape_count;
    const octree_gap *gaps; /* in ascending order of their ticks, at most one for each tick */
    size_t gap_count;
    /* the foreign nodes, in ascending order of their ticks, at most one element for each tick */
    const octree_foreign_tree *foreign;
    size_t foreign_count;
    octree_sampled sampled; /* the seeds of the bodies, for writing session files; the game does not read this member */
} octree_session;

/* Return the paper's session: world [-1000, 1000]^3, capacity 2, depth 5, eleven points, the player at the origin with
 * step 50 and box size 30. Its keys cause every event of a game. The arrays have static storage. */
octree_session octree_session_default(void);

/* The number of ticks after tick 0 that the session plays. */
uint64_t octree_session_length(const octree_session *session);

/* The session's gap at a tick, or null. Cost: O(log gaps). */
const octree_gap *octree_session_gap(const octree_session *session, uint64_t tick);

/* What a tick did: bits of octree_tick.events. */
typedef enum octree_event {
    OCTREE_EVENT_MOVED = 1, /* the player made its step */
    /* the player's step would leave the world, or the tree refused a body or an edit; see FULL */
    OCTREE_EVENT_REFUSED = 2,
    /* points are in the player's box. If the player's step led there, the step was taken back */
    OCTREE_EVENT_COLLIDED = 4,
    OCTREE_EVENT_FULL = 8,    /* a leaf was full: the player's step was taken back, or a body was refused */
    OCTREE_EVENT_SPLIT = 16,  /* at least one leaf became an inner node */
    OCTREE_EVENT_MERGED = 32, /* at least one inner node became a leaf or disappeared */
    OCTREE_EVENT_WRONG = 64,  /* the answer or a node of a foreign index is wrong */
} octree_event;

#define OCTREE_EVENT_KINDS 7

/* The name of one event, such as "moved". Null unless exactly one known bit is set. */
const char *octree_event_name(octree_event event);

/* A point that was refused. Either the tree refused to insert or move it: at loading, by an edit, by its velocity, or
 * by the player's step into a full leaf. Or an edit names a point that does not exist. */
typedef struct octree_refusal {
    uint64_t id;
    octree_status why;
    double position[3]; /* the position at which the point was to be stored; 0 for an edit that removes a point */
} octree_refusal;

/* A node that the collision test or the queries of a tick visited or pruned. */
typedef struct octree_visit {
    octree_address node;     /* an address in the tree at the time of the search. The player's step comes after the
                                collision test and may merge a node that the test visited */
    octree_trace_kind touch; /* what the searches did with the node; of several touches the first in the order visited,
                                taken whole, pruned */
    bool taken;              /* true: at least one search took the node whole */
} octree_visit;

/* The state after one tick, and the events in it. The game owns the arrays; they are valid until the game's next
 * step. */
typedef struct octree_tick {
    uint64_t number;
    char key;        /* the key of the tick; 0 at tick 0 */
    unsigned events; /* bit mask of octree_event values */
    bool has_player; /* false: there is no player. The next three positions are then its last ones, or the center of the
                        world */
    double player[3];  /* the player's position after the tick */
    double attempt[3]; /* the position of the collision test: the end of the step, even if the step was taken back */
    bool swept;        /* true: the collision test covered the whole way from `from` to `attempt` */
    double from[3];    /* the player's position before the tick; an inserted body starts where it is inserted */
    const octree_point *hits; /* the points that collide with the player, sorted by id */
    size_t hit_count;
    /* the position of each hit before the tick, in the order of `hits`; null if `swept` is false */
    const double (*hit_from)[3];
    /* the cost of the collision test. With sweep, hit_cost.points includes all bodies that moved */
    octree_cost hit_cost;
    const octree_refusal *refusals; /* the refusals in the order in which they happened */
    size_t refusal_count;
    size_t edit_count; /* the number of edits of the tick, including refused edits */
    octree_box edited; /* the bounding box of all inserted and moved positions of the edits; min > max if all edits are
                          removals. Not valid if edit_count is 0 */
    /* addresses of the nodes that became inner nodes in this tick, in pre-order; empty at tick 0 */
    const octree_address *splits;
    size_t split_count;
    const octree_address *merges; /* addresses of the nodes that ceased to be inner nodes in this tick, in pre-order */
    size_t merge_count;
    octree_stats stats;   /* octree_statistics() of the tree after the tick */
    uint64_t tree_digest; /* octree_digest() of the tree after the tick */
    /* the answer to the query of the key n first, then those to the session's queries in their order */
    const octree_answer *answers;
    size_t answer_count;
    unsigned asked; /* bit mask, bit 1 << octree_query_kind: the kinds of queries asked at this tick or earlier */
    bool judged;    /* true: a foreign answer was judged at this tick or earlier */
    const octree_visit *visits; /* the visited and pruned nodes, each once, in pre-order */
    size_t visit_count;
    size_t touched[OCTREE_TRACE_KINDS]; /* the number of visits with each value of octree_visit.touch */
    /* addresses of the leaves that hold a hit or a point of an answer, in pre-order */
    const octree_address *hit_leaves;
    size_t hit_leaf_count;
    const octree_shape *shapes; /* the shapes of this tick, then the shapes of every tick */
    size_t shape_count;
    const octree_body *movers; /* the bodies with a velocity: their positions, and their current velocities, which
                                  bounces reverse. The order is the same each time the session is played */
    size_t mover_count;
    octree_foreign_state foreign; /* the nodes of the foreign index */
    const char *gap; /* the reason if the tick is a gap, else null. In a gap there are no events, and the other members
                        are those of the tick before */
} octree_tick;

typedef struct octree_game octree_game;

/* Start a session and play tick 0. Bodies that the tree refuses, or whose velocity is not finite (NOT_FINITE), are left
 * out and become refusals of tick 0.
 *
 * Errors: NULL_ARGUMENT; those of octree_create; NOT_FINITE, OUTSIDE, BAD_SIZE (the player); DUPLICATE (two bodies with
 * one id, or a body with the player's id); BAD_KEY; BAD_OPTION; BAD_ORDER; NOT_FINITE, BAD_RANGE, BAD_SIZE (a query;
 * infinite boxes are allowed); NOT_FINITE, BAD_RANGE, BAD_TEXT (a shape); BAD_TEXT (a gap); those of
 * octree_foreign_check; TOO_MANY (more bodies than a tree can hold); NO_MEMORY. *game is then null. Cost: that of
 * octree_insert_many, and about 90 bytes for each body during the call. */
octree_status octree_game_create(const octree_session *session, octree_game **game);
void octree_game_destroy(octree_game *game);

/* Play one tick with this key instead of the session's. Errors: NULL_ARGUMENT, BUSY (a visitor, tracer or
 * task of the game's tree is running), BAD_KEY (nothing is played); NO_MEMORY (the game must not be stepped again).
 * Cost: O(queries + v log v) for v visits; O(bodies) if a body has a velocity or with sweep; and if inner nodes
 * changed, 8 bytes for each inner node and the points near the changes, or all points after very many changes. */
octree_status octree_game_step(octree_game *game, char key);

/* The input of one tick, for a program that makes its session while the game runs. The `tick` members inside edits,
 * queries, shapes, gap and foreign nodes are not read. */
typedef struct octree_input {
    char key;                 /* the key of the tick; '.' and 0 both wait */
    const octree_edit *edits; /* the edits in the order in which they are applied */
    size_t edit_count;
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_gap *gap;              /* not null: the tick is a gap */
    const octree_foreign_tree *foreign; /* the foreign nodes from this tick on; null: they stay as they were */
} octree_input;

/* Play one tick with this input instead of the session's input. The session's queries and shapes for every tick follow
 * those of the input. The result is the same as in a session that contains this input. The arrays are not needed after
 * the call. A body whose position or velocity does not allow its edit causes no error: it becomes a refusal of the
 * tick.
 *
 * Errors: those of octree_game_step, BAD_OPTION, and those of octree_game_create for queries, shapes and foreign nodes.
 * On these errors nothing is played. */
octree_status octree_game_play(octree_game *game, const octree_input *input);

/* Check an input without playing it. Returns the status that octree_game_play would return; the key is not checked.
 * Cost: O(edits + queries + shapes), and that of octree_foreign_check. */
octree_status octree_input_check(const octree_input *input);

/* Play the session's next tick. Errors: those of octree_game_step; NOT_FOUND when the session is over. */
octree_status octree_game_advance(octree_game *game);

/* Ask more queries at the end of the last played tick. Their answers follow the tick's existing answers. The nodes that
 * they visit and the leaves that they hit are added to the tick. Later ticks do not change.
 *
 * Errors: NULL_ARGUMENT and those of octree_query_check (no query is asked); NO_MEMORY (do not read the tick or step
 * the game after it). Cost: that of the queries, and of sorting all visits and leaves of the tick. */
octree_status octree_game_ask(octree_game *game, const octree_query *queries, size_t count);

/* True when the session has no further tick. */
bool octree_game_over(const octree_game *game);

/* Return the last played tick. It is valid until the game's next step. */
const octree_tick *octree_game_tick(const octree_game *game);

/* The tree after the last played tick. The game owns it. */
const octree *octree_game_tree(const octree_game *game);

/* Copy the point that has this id after the last played tick to *point. False if no point has the id, or an argument is
 * null. Cost: O(1). */
bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point);

/* The session that was passed to octree_game_create. */
const octree_session *octree_game_session(const octree_game *game);

/* The largest initial speed of the session's bodies along one axis, in world units per tick. 0 if all bodies are at
 * rest, and for null. Bodies whose velocity is not finite are ignored. Cost: O(1). */
double octree_game_fastest(const octree_game *game);

#ifdef __cplusplus
}
#endif

#endif
