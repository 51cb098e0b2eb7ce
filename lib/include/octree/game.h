/* SPDX-License-Identifier: MIT */
/* game.h - the game loop of the paper: a player moves through a bounded world of points, tick by tick.
 *
 * A session is the complete input of a game. The same session gives the same ticks on every machine. Tick 0 is the
 * state before any key press. The order of events within a tick is: edits, points that move by their velocity, the
 * player's step, the collision test, the queries.
 *
 * Without octree_player.sweep, the collision test looks only at the positions at the end of a tick. So a point and the
 * player may pass each other in one tick without a collision. With octree_player.sweep the test covers the whole path
 * of the player, and the whole path of every body that moves by its velocity or by an edit. The path in a tick is a
 * straight line at constant speed, from the position stored at the end of the previous tick to the position stored at
 * the end of this tick, even for a body that bounces. The path of an inserted body starts at the position of its
 * insertion. The path of a player's step is tested even if the step is then taken back.
 *
 * Keys: w/s = +y/-y, d/a = +x/-x, e/f = +z/-z, n asks for the nearest neighbour, . waits, q ends the session without
 * playing a tick.
 */
#ifndef OCTREE_GAME_H
#define OCTREE_GAME_H

#include "octree/bodies.h"
#include "octree/query.h"
#include "octree/sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point or a box of the game. The velocity is in world units per tick. A body with a velocity bounces when its box
 * reaches the bounds of the world. On an axis on which the box is larger than the world, the body does not move. A body
 * whose box begins beyond the bounds bounces where it began. */
typedef struct octree_game_body {
    uint64_t id;
    double position[3]; /* the centre of its box */
    double velocity[3];
    double half[3]; /* the half extents of its box, finite and >= 0; all 0: a point */
} octree_game_body;

/* Which point is the player, and what moves the player. */
typedef enum octree_player_kind {
    OCTREE_PLAYER_KEYS, /* the player is a point of its own, which the game inserts first and key presses move */
    /* The player is the body that has the player's id, as long as this body exists. Edits and its velocity move the
     * body; key presses do not. The game never takes back moves of this body. The members `position` and `step` of
     * octree_player are not read. */
    OCTREE_PLAYER_BODY,
    /* There is no player: no collision is tested, key presses do nothing, and the other members of octree_player are
     * not read. */
    OCTREE_PLAYER_NONE,
} octree_player_kind;

typedef struct octree_player {
    octree_player_kind kind;
    uint64_t id;
    double position[3];
    double step;     /* the distance that the player moves for one key press, >= 0 */
    double box_size; /* half the side of the collision box: the box is position +- box_size on each axis; >= 0 */
    /* true: the collision test covers the whole path of the tick. false: as in the paper, only the end of the player's
     * step is tested. Such a test finds every collision only if player and point move along one axis, by at most 2 *
     * box_size per tick relative to each other */
    bool sweep;
} octree_player;

typedef enum octree_edit_kind { OCTREE_EDIT_INSERT, OCTREE_EDIT_REMOVE, OCTREE_EDIT_MOVE } octree_edit_kind;

/* A change of a body at the start of a tick >= 1. `body.id` identifies the body; ids are unique within a game. */
typedef struct octree_edit {
    uint64_t tick;
    octree_edit_kind kind;
    /* REMOVE reads only the body's id. MOVE reads its id and position; the body keeps its half extents and its current
     * velocity, which a bounce may have reversed (octree_tick.movers) */
    octree_game_body body;
} octree_edit;

typedef enum octree_shape_kind {
    OCTREE_SHAPE_BOX,
    OCTREE_SHAPE_SEGMENT,
    OCTREE_SHAPE_POINT,
    OCTREE_SHAPE_LABEL,
    OCTREE_SHAPE_KINDS
} octree_shape_kind;

/* Returns the name of a kind of shape: "box", "segment", "point" or "label". Returns null for kind >=
 * OCTREE_SHAPE_KINDS. */
const char *octree_shape_name(octree_shape_kind kind);

#define OCTREE_SHAPE_TEXT 47

/* A shape that is drawn at a tick, such as a wall or a goal. A shape is not in the tree, and queries do not find it. It
 * may lie outside the world. */
typedef struct octree_shape {
    uint64_t tick; /* the number of the tick at which the shape is drawn, or OCTREE_EVERY_TICK */
    octree_shape_kind kind;
    double at[3];                 /* position of a point or label, start of a segment, lowest corner of a box */
    double to[3];                 /* end of a segment, highest corner of a box; not read for other kinds */
    char text[OCTREE_SHAPE_TEXT]; /* a label's text: printable ASCII with its final zero; not read for other kinds */
} octree_shape;

#define OCTREE_GAP_TEXT 160

/* A tick for which the session has no data, because the recording program lost the data. At this tick nothing is
 * played, asked or shown, even if the session has edits or queries for the tick. The edits of the next tick contain the
 * changes that were lost in the gap. In the next tick, bodies with a velocity also move as far as they would have moved
 * in the gap. */
typedef struct octree_gap {
    uint64_t tick;
    char why[OCTREE_GAP_TEXT]; /* the reason of the gap: printable ASCII with its final zero, at least one character */
} octree_gap;

/* The seeds from which random bodies were made. Session files store these seeds in place of the bodies. */
typedef struct octree_sampled {
    struct {
        octree_sample_kind kind;
        uint64_t count, seed;
    } points; /* the positions were made by octree_sample() with these arguments, and with the world as the box */
    struct {
        double speed;
        uint64_t seed;
    } velocities; /* each component of a velocity is a random number from -speed to speed */
    bool by_points, by_velocities;
    bool known; /* true: the bodies were made from these seeds; false: the other members are not read */
} octree_sampled;

/* The complete input of a game. The game borrows the struct and its arrays: they must outlive the game. */
typedef struct octree_session {
    octree_def tree;
    octree_player player;
    const octree_game_body *bodies;
    size_t body_count;
    const char *keys; /* a string with one key per tick from tick 1 on, or null */
    /* the minimum number of ticks after tick 0. In a tick for which `keys` has no key, the player waits */
    uint64_t ticks;
    /* the number of ticks at the end of the session that are not played, because the session ended early */
    uint64_t unplayed;
    const octree_edit *edits; /* the edits, in ascending order of their ticks */
    size_t edit_count;
    /* the queries, in ascending order of their ticks; queries at OCTREE_EVERY_TICK come last */
    const octree_query *queries;
    size_t query_count;
    /* the shapes, in ascending order of their ticks; shapes at OCTREE_EVERY_TICK come last */
    const octree_shape *shapes;
    size_t shape_count;
    const octree_gap *gaps; /* the gaps, in ascending order of their ticks, at most one for each tick */
    size_t gap_count;
    /* the foreign trees, in ascending order of their ticks, at most one for each tick */
    const octree_foreign_tree *foreign;
    size_t foreign_count;
    /* the pairs of a foreign index, in ascending order of their ticks, at most one list for each tick; they are judged
     * also if `pairs` is false */
    const octree_foreign_pairs *foreign_pairs;
    size_t foreign_pairs_count;
    octree_sampled sampled; /* the seeds of the bodies, which session files store; the game does not read this member */
    /* true: each tick lists the pairs of bodies whose boxes have a common point. The pairs of n points at one position
     * are n^2 / 2 */
    bool pairs;
} octree_session;

/* Returns the paper's session: world [-1000, 1000]^3, capacity 2, depth 5, eleven points, the player at the origin with
 * step 50 and box size 30. Its keys cause every kind of event. The arrays have static storage. */
octree_session octree_session_default(void);

/* Returns the number of ticks after tick 0 that the session plays. */
uint64_t octree_session_length(const octree_session *session);

/* Returns the session's gap at a tick, or null if the tick is not a gap. Cost: O(log gaps). */
const octree_gap *octree_session_gap(const octree_session *session, uint64_t tick);

/* The events of a tick, as bits of octree_tick.events. */
typedef enum octree_event {
    OCTREE_EVENT_MOVED = 1, /* the player made its step */
    /* the player's step would have left the world, or the tree refused a body or an edit; see FULL */
    OCTREE_EVENT_REFUSED = 2,
    /* points lie in the player's collision box. If the player's step caused the collision, the step was taken back */
    OCTREE_EVENT_COLLIDED = 4,
    OCTREE_EVENT_FULL = 8,    /* a leaf was full, so that the player's step was taken back, or a body was refused */
    OCTREE_EVENT_SPLIT = 16,  /* at least one leaf became an inner node */
    OCTREE_EVENT_MERGED = 32, /* at least one inner node became a leaf or disappeared */
    OCTREE_EVENT_WRONG = 64,  /* an answer, a node or the pairs of the foreign index are wrong */
    /* the boxes of two bodies have a common point; only in a session with `pairs` */
    OCTREE_EVENT_OVERLAPPED = 128,
} octree_event;

#define OCTREE_EVENT_KINDS 8

/* Returns the name of one event, such as "moved". Returns null unless exactly one known bit is set. */
const char *octree_event_name(octree_event event);

/* A refusal of a point. Either the tree refused to insert or move the point: when the bodies were loaded, in an edit,
 * in a move by the point's velocity, or in the player's step into a full leaf. Or an edit names a point that does not
 * exist. */
typedef struct octree_refusal {
    uint64_t id;
    octree_status why;
    double position[3]; /* the position at which the point was to be stored; 0 for an edit that removes a point */
} octree_refusal;

/* A node that the collision test or the queries of a tick visited or pruned. */
typedef struct octree_visit {
    /* the node's address in the tree at the time of the search. The player's step is made after the collision test, and
     * may merge a node that the test visited, so that this node no longer exists */
    octree_address node;
    /* what the searches did with the node. If searches differ: VISITED if one of them visited the node, else TAKEN if
     * one took it whole, else PRUNED */
    octree_trace_kind touch;
    bool taken; /* true: at least one search accepted all points of the node without comparing them */
} octree_visit;

/* The state after one tick, and the events of the tick. The game owns the arrays; they are valid until the game's next
 * step. */
typedef struct octree_tick {
    uint64_t number;
    char key;        /* the key that was pressed in the tick; 0 at tick 0 */
    unsigned events; /* bit mask of octree_event values */
    /* false: there is no player. `player`, `attempt` and `from` then have the values of the last tick with a player or,
     * if no tick had a player, are the center of the world */
    bool has_player;
    double player[3]; /* the player's position after the tick */
    /* the player's position in the collision test: the end of the step, even if the step was taken back */
    double attempt[3];
    bool swept; /* true: the collision test covered the whole path from `from` to `attempt` */
    /* the player's position before the tick; if the player is a body inserted in this tick, the position of its
     * insertion */
    double from[3];
    /* the bodies whose boxes collide with the player's, as points at their positions, sorted by id */
    const octree_point *hits;
    size_t hit_count;
    /* the position that each hit had before the tick, in the order of `hits`; null if `swept` is false */
    const double (*hit_from)[3];
    /* the cost of the collision test. With octree_player.sweep, hit_cost.points includes all bodies that moved */
    octree_cost hit_cost;
    const octree_refusal *refusals; /* the refusals of the tick, in the order in which they happened */
    size_t refusal_count;
    size_t edit_count; /* the number of edits of the tick, refused edits included */
    /* the bounding box of all positions to which edits insert or move bodies; min > max if all edits are removals. Not
     * valid if edit_count is 0 */
    octree_box edited;
    /* addresses of the nodes that became inner nodes in this tick, in pre-order; empty at tick 0 */
    const octree_address *splits;
    size_t split_count;
    const octree_address *merges; /* addresses of the nodes that ceased to be inner nodes in this tick, in pre-order */
    size_t merge_count;
    octree_stats stats;   /* octree_statistics() of the tree after the tick */
    uint64_t tree_digest; /* octree_digest() of the tree after the tick */
    /* the answers of the tick: first the answer to the query that the key n asked, then the answers to the session's
     * queries, in their order */
    const octree_answer *answers;
    size_t answer_count;
    bool judged; /* true: foreign answers or pairs were compared with the exact ones at this tick or earlier */
    const octree_visit *visits; /* the nodes that searches visited or pruned, each once, in pre-order */
    size_t visit_count;
    size_t touched[OCTREE_TRACE_KINDS]; /* touched[t]: the number of visits whose octree_visit.touch is t */
    /* addresses of the leaves that hold a collision hit or a point of an answer, in pre-order */
    const octree_address *hit_leaves;
    size_t hit_leaf_count;
    /* the overlapping pairs, sorted by `a` and then `b`; none if octree_session.pairs is false */
    const octree_pair *pairs;
    size_t pair_count;
    const octree_shape *shapes; /* the shapes of this tick, followed by the shapes of every tick */
    size_t shape_count;
    /* the bodies with a velocity, in the same order each time the session is played. A body's velocity is its current
     * velocity, which bounces reverse */
    const octree_game_body *movers;
    size_t mover_count;
    octree_foreign_state foreign;        /* the nodes of the foreign index at this tick */
    octree_pair_judgement foreign_pairs; /* the judgement of the pairs that the foreign index found at this tick */
    /* the reason why the tick is a gap; null if the tick is not a gap. A gap has no events, and its other members keep
     * their values of the previous tick */
    const char *gap;
} octree_tick;

typedef struct octree_game octree_game;

/* Start a session and play tick 0. Bodies that the tree refuses, or whose velocity is not finite (NOT_FINITE), are left
 * out and become refusals of tick 0. So do bodies whose half extents are not finite (NOT_FINITE) or negative
 * (BAD_SIZE).
 *
 * Errors: NULL_ARGUMENT; those of octree_create; NOT_FINITE, OUTSIDE, BAD_SIZE (the player); DUPLICATE (two bodies with
 * one id, or a body with the player's id); BAD_KEY; BAD_OPTION; BAD_ORDER; NOT_FINITE, BAD_RANGE, BAD_SIZE (a query;
 * infinite boxes are allowed); NOT_FINITE, BAD_RANGE, BAD_TEXT (a shape); BAD_TEXT (a gap); those of
 * octree_foreign_check; BAD_PAIR (a foreign pair has one id twice); TOO_MANY (more bodies than a tree can hold);
 * NO_MEMORY. *game is then null. Cost: that of octree_insert_many, and about 90 bytes for each body during the call. */
octree_status octree_game_create(const octree_session *session, octree_game **game);
void octree_game_destroy(octree_game *game);

/* Play one tick with this key instead of the key of the session. Errors: NULL_ARGUMENT, BUSY (a visitor, tracer or task
 * of the game's tree is running), BAD_KEY (nothing is played); NO_MEMORY (the game must not be stepped again). Cost:
 * O(queries + v log v) for v visits. If a body has a velocity or octree_player.sweep is true, add O(bodies). If the
 * tree changed, add O(inner nodes) to copy their addresses of 8 bytes, and O(points near the changes), or O(all points)
 * after very many changes. */
octree_status octree_game_step(octree_game *game, char key);

/* The input of one tick, for a program that makes its session while the game runs. The member `tick` of edits, queries,
 * shapes, gap, foreign nodes and foreign pairs is not read. */
typedef struct octree_input {
    char key;                 /* the key of the tick; both '.' and 0 wait */
    const octree_edit *edits; /* the edits in the order in which they are applied */
    size_t edit_count;
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_gap *gap; /* if not null, the tick is a gap */
    /* the foreign nodes that are valid from this tick on; null: the foreign nodes stay as they are */
    const octree_foreign_tree *foreign;
    const octree_foreign_pairs *foreign_pairs; /* the pairs that the foreign index found; null: no pairs are judged */
} octree_input;

/* Play one tick with this input instead of the session's input. The session's queries and shapes for every tick follow
 * the queries and shapes of the input. The result is the same as in a session that contains this input. The arrays are
 * not needed after the call. A body whose position or velocity does not allow its edit causes no error: it becomes a
 * refusal of the tick.
 *
 * Errors: those of octree_game_step, BAD_OPTION, and those of octree_game_create for queries, shapes, foreign nodes and
 * foreign pairs. On these errors nothing is played. */
octree_status octree_game_play(octree_game *game, const octree_input *input);

/* Check the input of a tick without playing the tick. Returns the status that octree_game_play would return; the key is
 * not checked. Cost: O(edits + queries + shapes + foreign pairs), and that of octree_foreign_check. */
octree_status octree_input_check(const octree_input *input);

/* Play the session's next tick. Errors: those of octree_game_step; NOT_FOUND if the session has no further tick. */
octree_status octree_game_advance(octree_game *game);

/* Ask more queries at the end of the last played tick. The new answers follow the tick's existing answers. The nodes
 * that the queries visit, and the leaves in which they find points, are added to the tick. Later ticks do not change.
 *
 * Errors: NULL_ARGUMENT and those of octree_query_check (no query is asked); NO_MEMORY (the tick must not be read and
 * the game not be stepped after this error). Cost: that of the queries, and of sorting all visits and leaves of the
 * tick. */
octree_status octree_game_ask(octree_game *game, const octree_query *queries, size_t count);

/* Returns whether the session has no further tick. */
bool octree_game_over(const octree_game *game);

/* Returns the last played tick. The tick is valid until the game's next step. */
const octree_tick *octree_game_tick(const octree_game *game);

/* Returns the tree after the last played tick. The game owns the tree. */
const octree *octree_game_tree(const octree_game *game);

/* Copy the point with this id, as it is after the last played tick, to *point. Returns false if no point has the id, or
 * if an argument is null. Cost: O(1). */
bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point);

/* Like octree_game_find(), with the half extents. */
bool octree_game_find_body(const octree_game *game, uint64_t id, octree_body *body);

/* Returns the bodies after the last played tick, as a set for the queries of bodies.h; its level is the game's tree.
 * The game owns the set, which cannot be changed. Returns null for null. */
const octree_bodies *octree_game_bodies(const octree_game *game);

/* Returns the session that was passed to octree_game_create. */
const octree_session *octree_game_session(const octree_game *game);

/* Returns the largest initial speed of the session's bodies along one axis, in world units per tick. Returns 0 if all
 * bodies are at rest, and for null. Bodies whose velocity is not finite are ignored. Cost: O(1). */
double octree_game_fastest(const octree_game *game);

#ifdef __cplusplus
}
#endif

#endif
