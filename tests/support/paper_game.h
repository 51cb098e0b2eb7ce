/* SPDX-License-Identifier: MIT */
/* paper_game.h - the paper's game loop with the paper's algorithms, to compare with octree/game.h tick by tick.
 *
 * It plays sessions without velocities, edits and queries, which the paper does not have. Where the paper is silent,
 * the loop follows the game: the player is the first point of the tree, and its position is start + net steps *
 * step. */
#ifndef PAPER_GAME_H
#define PAPER_GAME_H

#include "octree/game.h"
#include "paper.h"

typedef struct paper_game {
    paper_octree octree;
    const octree_session *session;
    octree_point player;
    int64_t steps[3]; /* net steps on each axis */
    /* the results of the last tick */
    bool moved;
    bool refused;
    bool full;
    bool collided;
    size_t hits; /* number of other points in the player's box */
    bool found;  /* a nearest neighbour that is not at the player's coordinates */
    octree_point nearest;
    double distance;
} paper_game;

/* Load a session and play tick 0. Bodies that insertPoint refuses are left out; their number is returned. */
size_t paper_game_start(paper_game *game, const octree_session *session);

/* Play one turn of the loop. */
void paper_game_play_key(paper_game *game, char key);

void paper_game_end(paper_game *game);

#endif
