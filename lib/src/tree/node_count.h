/* node_count.h - counting nodes for octree_stats. Private. */
#ifndef OCTREE_NODE_COUNT_H
#define OCTREE_NODE_COUNT_H

#include "tree.h"

static inline void count_node(octree_stats *stats, const node *n, unsigned depth)
{
    stats->nodes++;
    stats->nodes_at_depth[depth]++;
    stats->depth = depth > stats->depth ? depth : stats->depth;
    if (n->octants == 0) {
        stats->leaves++;
        stats->leaves_at_depth[depth]++;
        stats->largest_leaf = n->count > stats->largest_leaf ? n->count : stats->largest_leaf;
    }
}

#endif
