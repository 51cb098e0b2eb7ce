/* element_ids.h - ids that say more than a node's address, a point's id or a place in a list: how scenes make them, and
 * how those who tell of an element read them again.
 */
#ifndef SCENE_ELEMENT_IDS_H
#define SCENE_ELEMENT_IDS_H

#include "octree/octree.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- Boxes of LAYER_WORLD ----------------------------------------------------------------------------------- */

enum { WORLD_ID, SLICE_ID, REGION_ID, WORLD_IDS };

/* ---- LAYER_SPLITS and LAYER_MERGES: a node, and the axis of a line through it -------------------------------- */

/* An address may need all of 64 bits at the greatest depth, but nodes that split lie above it. */
static inline uint64_t change_line_id(octree_address node, unsigned axis)
{
    return node << 2 | axis;
}

static inline octree_address change_line_node(uint64_t id)
{
    return id >> 2;
}

/* ---- Parts of an answer: its place among the tick's, and a neighbour's rank or a chord of a ball -------------- */

static inline uint64_t answer_part_id(size_t place, size_t part)
{
    return (uint64_t)place << 32 | (uint64_t)part;
}

static inline uint64_t answer_part_place(uint64_t id)
{
    return id >> 32;
}

static inline uint64_t answer_part(uint64_t id)
{
    return id & UINT32_MAX;
}

/* ---- LAYER_BOX ---------------------------------------------------------------------------------------------- */

/* The box of a collision; that of the player has the player's id. */
#define COLLISION_BOX_ID UINT64_MAX

/* The lines that cross it out have the first ids; those of a swept test's ways come after them. */
#define CROSS_LINES 12

/* ---- Panels of LAYER_DIAGRAM -------------------------------------------------------------------------------- */

/* What is no node: its highest bit is that of no address. */
#define DIAGRAM_GROUND_ID UINT64_C(0)
#define DIAGRAM_BAR_ID (UINT64_C(1) << 61)
#define DIAGRAM_WAY_ID (UINT64_C(1) << 62)

/* The bar of a column of a level. */
static inline uint64_t diagram_bar_id(unsigned depth, size_t column)
{
    return DIAGRAM_BAR_ID | (uint64_t)depth << 32 | (uint64_t)column;
}

static inline bool diagram_is_bar(uint64_t id)
{
    return id / DIAGRAM_BAR_ID == 1;
}

static inline unsigned diagram_bar_depth(uint64_t id)
{
    return (unsigned)(id >> 32 & 255);
}

/* What marks a node on the way; and the ring that keeps mark and node apart. */
static inline uint64_t diagram_way_id(unsigned depth)
{
    return DIAGRAM_WAY_ID | depth;
}

static inline uint64_t diagram_ring_id(unsigned depth)
{
    return DIAGRAM_WAY_ID | 32 | depth;
}

static inline bool diagram_is_way(uint64_t id)
{
    return id / DIAGRAM_WAY_ID == 1;
}

#endif
