/* game_parts.h - a game's insides, and the parts of a tick in their order. Private. */
#ifndef OCTREE_GAME_PARTS_H
#define OCTREE_GAME_PARTS_H

#include "bodies.h"
#include "tree_summary.h"

struct octree_game {
    const octree_session *session;
    octree *tree;
    arena memory;
    bodies bodies;
    int64_t steps[3]; /* the player's net steps on each axis: its place is computed from them */
    size_t next_edit; /* the first edit that is still to come */
    size_t next_query;
    size_t next_shape;
    size_t standing, standing_shapes; /* the first query, and the first shape, of every tick */
    double fastest;                   /* of the session's bodies, along one axis */
    bool quit;
    survey survey;
    octree_tick tick;
    list hits;           /* octree_point */
    list hit_from;       /* double[3]: of each hit, when swept */
    list found;          /* octree_point: those of all answers, one after the other */
    list near;           /* octree_neighbor: the same */
    list refusals;       /* octree_refusal */
    list answers;        /* octree_answer */
    list splits, merges; /* octree_address */
    list visits;         /* octree_visit: as they come, until game_finish_visits */
    list hit_leaves;     /* octree_address: the same */
    list shapes;         /* octree_shape */
    list movers;         /* octree_body */
    bool lost_visits;    /* there was no memory for one of them */
};

bool game_is_key(char key);

/* OK, or what octree_game_create says of a session whose tree could be made. */
octree_status game_check_session(const octree_session *session, const octree *tree);

/* Change the tree: as octree_insert(), octree_remove() and octree_move(). */
octree_status game_insert(octree_game *game, const double position[3], uint64_t id);
octree_status game_remove(octree_game *game, const double position[3], uint64_t id);
octree_status game_move(octree_game *game, const double from[3], uint64_t id, const double to[3]);

/* The tick's splits and merges, and the digest and numbers of its tree. */
octree_status game_survey(octree_game *game);

/* Whether a body may be inserted at all: DUPLICATE for an id that is taken, NOT_FINITE for its velocity, OK. */
octree_status game_check_body(const octree_game *game, const octree_body *body);

/* Add a body that is in the tree, or that was refused with this status, which is noted and returned. */
octree_status game_settle_body(octree_game *game, const octree_body *body, octree_status status);

/* Insert the bodies of the session. DUPLICATE, NO_MEMORY or OK: refusals are noted. */
octree_status game_load_bodies(octree_game *game);

octree_status game_apply_edits(octree_game *game, const octree_input *input);
octree_status game_move_bodies(octree_game *game);

/* The bodies that have a velocity, as they are after the tick, which are published. */
octree_status game_note_movers(octree_game *game);

/* The player's step and the collision test that decides it. */
octree_status game_step_player(octree_game *game);

/* Whether an id is that of a player who is no body. */
bool game_is_players(const octree_game *game, uint64_t id);

/* Note where the player is, and was before the tick: of a body, what edits and motion have made of it. */
void game_find_player(octree_game *game);

/* Ask the tick's queries, those of its key and those of every tick. */
octree_status game_ask(octree_game *game, const octree_input *input);

/* Let each answer point to its part of the lists, which do not grow any more. */
void game_publish_answers(octree_game *game);

/* The queries, the survey, and the tick's arrays. At tick 0 the collision test too. */
octree_status game_finish_tick(octree_game *game, const octree_input *input);

/* Let the tick show its shapes and those of every tick. */
octree_status game_show_shapes(octree_game *game, const octree_input *input);

/* Note that the tree did not take a body. NO_MEMORY, or OK. */
octree_status game_note_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3]);

/* Collect what the player's box meets into `hits`, by id: about the end of its step or, swept, on the way there. */
octree_status game_collide(octree_game *game, const double to[3]);

/* A search that adds to `cost` and to the tick's visits. */
octree_search game_search(octree_game *game, octree_cost *cost);

/* Sort the tick's visits and count them; find the leaves of its hits and answers, which are published. */
octree_status game_finish_visits(octree_game *game);

/* A visitor that appends points to a list of octree_point; it stops, and says so, when there is no memory. */
typedef struct point_collector {
    arena *memory;
    list *points;
    bool failed;
} point_collector;

bool collect_point(const octree_point *point, void *context);

/* Sort points by id, then position. */
void game_sort_points(octree_point *points, size_t count);

#endif
