/* meter.h - what a query did: its counts, and the trace that a caller asked for. Private. */
#ifndef OCTREE_METER_H
#define OCTREE_METER_H

#include "bits.h"
#include "plane.h"

typedef struct meter {
    octree_cost count;
    const octree_search *how;
} meter;

static inline void meter_trace(const meter *m, octree_address address, octree_touch touch)
{
    if (m->how->trace)
        m->how->trace(address, touch, m->how->trace_context);
}

/* A node whose children or points are looked at one by one. */
static inline void meter_visit(meter *m, octree_address address)
{
    m->count.nodes++;
    meter_trace(m, address, OCTREE_TOUCH_VISITED);
}

/* All nodes on the way from the root to the one at this depth in which a Morton code lies. */
static inline void meter_way(meter *m, uint64_t code, unsigned last)
{
    m->count.nodes += last + 1;
    if (m->how->trace)
        for (unsigned depth = 0; depth <= last; depth++)
            meter_trace(m, morton_address(code, depth), OCTREE_TOUCH_VISITED);
}

/* The children in these octants of a node are left out, with all below them. */
static inline void meter_prune(meter *m, octree_address parent, unsigned octants)
{
    m->count.pruned += bits_count8(octants);
    if (m->how->trace)
        for (unsigned octant = 0; octant < 8; octant++)
            if (octants >> octant & 1)
                meter_trace(m, parent << 3 | octant, OCTREE_TOUCH_PRUNED);
}

/* Add the counts to the caller's report. */
static inline void meter_report(const meter *m)
{
    octree_cost *cost = m->how->cost;
    if (!cost)
        return;
    cost->nodes += m->count.nodes;
    cost->leaves += m->count.leaves;
    cost->points += m->count.points;
    cost->pruned += m->count.pruned;
}

#endif
