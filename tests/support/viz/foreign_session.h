/* SPDX-License-Identifier: MIT */
/* foreign_session.h - a session with foreign nodes: correct at tick 0, wrong from tick 1 on. */
#ifndef FOREIGN_SESSION_H
#define FOREIGN_SESSION_H

#include "octree/game.h"

/* The nodes of tick 0, by their ids: a root, a half with two leaves, and a leaf for the other half. */
enum { FOREIGN_ROOT = 1, FOREIGN_LEFT = 2, FOREIGN_RIGHT = 3, FOREIGN_LOW = 4, FOREIGN_HIGH = 5, FOREIGN_NODES = 5 };

/* Points 1 to 8 and no player. A range query at both ticks visits FOREIGN_LEFT and FOREIGN_HIGH, and prunes the right
 * half. At tick 1 FOREIGN_LOW reaches outside its parent, no node holds point 8, and FOREIGN_HIGH is pruned although it
 * holds point 3, which the right answer contains. */
octree_session foreign_session(void);

#endif
