/* SPDX-License-Identifier: MIT */
/* paper.c - see paper.h. Where the paper's text is silent or at fault, a comment says what is done here. */
#include "paper.h"

#include <math.h>
#include <stdlib.h>

#include "fixture.h"

static paper_node *create_node(octree_box bounds, size_t depth)
{
    paper_node *node = calloc(1, sizeof *node);
    assert_non_null(node);
    node->bounds = bounds;
    node->depth = depth;
    node->leaf = true;
    return node;
}

static void free_children(paper_node *node)
{
    for (int i = 0; i < 8; i++) {
        if (node->children[i] != NULL) {
            free_children(node->children[i]);
            free(node->children[i]);
        }
        node->children[i] = NULL;
    }
}

paper_octree createOctree(octree_box world, size_t max_points, size_t max_depth)
{
    assert_true(max_points <= PAPER_POINTS);
    return (paper_octree){create_node(world, 0), max_points, max_depth};
}

void freeOctree(paper_octree *octree)
{
    free_children(octree->root);
    free(octree->root);
    octree->root = NULL;
}

/* Silent: where the centre is. The middle of the bounds. */
static double center(const paper_node *node, int axis)
{
    return (node->bounds.min[axis] + node->bounds.max[axis]) / 2;
}

/* Equation 1. */
static int octant_of(const paper_node *node, const double position[3])
{
    return (position[0] >= center(node, 0) ? 4 : 0) + (position[1] >= center(node, 1) ? 2 : 0) +
           (position[2] >= center(node, 2) ? 1 : 0);
}

static octree_box octant_bounds(const paper_node *node, int octant)
{
    octree_box bounds = node->bounds;
    for (int axis = 0; axis < 3; axis++) {
        bool upper = (octant & (4 >> axis)) != 0;
        *(upper ? &bounds.min[axis] : &bounds.max[axis]) = center(node, axis);
    }
    return bounds;
}

/* Lines 10 to 12. No child can be too full: together they receive what one leaf held. */
static void subdivide(const paper_octree *octree, paper_node *node)
{
    node->leaf = false;
    for (int i = 0; i < 8; i++)
        node->children[i] = create_node(octant_bounds(node, i), node->depth + 1);
    for (size_t i = 0; i < node->count; i++)
        insertPoint(octree, node->children[octant_of(node, node->points[i].position)], &node->points[i]);
    node->count = 0;
}

bool insertPoint(const paper_octree *octree, paper_node *node, const octree_point *point)
{
    /* Silent: points outside the world. They are the caller's to refuse. */
    if (node->leaf) {
        if (node->count < octree->max_points) {
            node->points[node->count++] = *point;
            return true;
        }
        if (node->depth >= octree->max_depth)
            return false;
        /* At fault: when the insertion below fails, the node stays subdivided although nothing was inserted. */
        subdivide(octree, node);
    }
    /* Silent: what lines 14 and 18 return. What the child returns. */
    return insertPoint(octree, node->children[octant_of(node, point->position)], point);
}

static size_t index_in_leaf(const paper_node *leaf, const double position[3])
{
    size_t i = 0;
    while (i < leaf->count && !same_position(leaf->points[i].position, position))
        i++;
    return i;
}

/* Lines 14 to 21. */
static void merge_children(const paper_octree *octree, paper_node *node)
{
    size_t total = 0;
    for (int i = 0; i < 8; i++) {
        if (!node->children[i]->leaf)
            return;
        total += node->children[i]->count;
    }
    if (total > octree->max_points)
        return;
    for (int i = 0; i < 8; i++)
        for (size_t j = 0; j < node->children[i]->count; j++)
            node->points[node->count++] = node->children[i]->points[j];
    free_children(node);
    node->leaf = true;
}

bool deletePoint(const paper_octree *octree, paper_node *node, const octree_point *point)
{
    if (node == NULL)
        return false;
    if (!node->leaf) {
        bool deleted = deletePoint(octree, node->children[octant_of(node, point->position)], point);
        merge_children(octree, node);
        return deleted;
    }
    /* At fault: of several points at these coordinates the first goes, whoever it belongs to. */
    size_t found = index_in_leaf(node, point->position);
    if (found == node->count)
        return false;
    for (size_t i = found + 1; i < node->count; i++)
        node->points[i - 1] = node->points[i];
    node->count--;
    return true;
}

const paper_node *searchPoint(const paper_node *node, const octree_point *point)
{
    if (node == NULL)
        return NULL;
    if (node->leaf)
        return index_in_leaf(node, point->position) < node->count ? node : NULL;
    return searchPoint(node->children[octant_of(node, point->position)], point);
}

static bool is_outside(const octree_box *bounds, const double min[3], const double max[3])
{
    return bounds->max[0] < min[0] || bounds->min[0] > max[0] || bounds->max[1] < min[1] || bounds->min[1] > max[1] ||
           bounds->max[2] < min[2] || bounds->min[2] > max[2];
}

void rangeQuery(const paper_node *node, const double min[3], const double max[3], size_t *count, brute *fp)
{
    if (node == NULL || is_outside(&node->bounds, min, max))
        return;
    if (!node->leaf) {
        for (int i = 0; i < 8; i++)
            rangeQuery(node->children[i], min, max, count, fp);
        return;
    }
    octree_box range = {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
    for (size_t i = 0; i < node->count; i++) {
        if (!box_holds(&range, node->points[i].position))
            continue;
        brute_collect(&node->points[i], fp);
        ++*count;
    }
}

bool detect_collision(const paper_octree *octree, const octree_point *moving_point, double box_size)
{
    /* At fault: a full leaf does not take the moving point. Then one neighbour makes count = 1 and is not seen, and
     * deletePoint takes out somebody else's point when one lies at the same coordinates. */
    insertPoint(octree, octree->root, moving_point);
    double min[3], max[3];
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = moving_point->position[axis] - box_size;
        max[axis] = moving_point->position[axis] + box_size;
    }
    size_t count = 0;
    brute near = {0}; /* Silent: line 5 names no file. The points are not used. */
    rangeQuery(octree->root, min, max, &count, &near);
    brute_free(&near);
    deletePoint(octree, octree->root, moving_point);
    return count > 1;
}

/* Equation 2 as Algorithm 7 means it: the distance to the box, 0 inside. */
static double distanceToCubeSquared(const double target[3], const octree_box *bounds)
{
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        double gap = fmax(fmax(bounds->min[axis] - target[axis], 0), target[axis] - bounds->max[axis]);
        sum += gap * gap;
    }
    return sum;
}

/* Equation 3. */
static double squaredDistance(const double p[3], const double q[3])
{
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]);
}

/* Silent: octants at equal distances. They stay in the order of their numbers. */
static void sort_children(const paper_node *node, const double target[3], int order[8])
{
    double distance[8];
    for (int i = 0; i < 8; i++) {
        distance[i] = distanceToCubeSquared(target, &node->children[i]->bounds);
        int at = i;
        for (; at > 0 && distance[order[at - 1]] > distance[i]; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
}

/* Algorithm 7. At fault: `dist != 0` leaves out every point at the target's coordinates, not the target alone, and
 * any point so near that the square underflows. Silent: ties; the point met first stays. */
static bool findNearestNeighborHelper(const paper_node *node, const double target[3], octree_point *nearest,
                                      double *minDist)
{
    if (node == NULL || distanceToCubeSquared(target, &node->bounds) > *minDist)
        return false;
    bool found = false;
    if (node->leaf) {
        for (size_t i = 0; i < node->count; i++) {
            double dist = squaredDistance(target, node->points[i].position);
            if (dist < *minDist && dist != 0) {
                *minDist = dist;
                *nearest = node->points[i];
                found = true;
            }
        }
        return found;
    }
    int order[8];
    sort_children(node, target, order);
    for (int i = 0; i < 8; i++)
        if (findNearestNeighborHelper(node->children[order[i]], target, nearest, minDist))
            found = true;
    return found;
}

bool findNearestNeighbor(const paper_octree *octree, const double target[3], octree_point *nearest, double *minDist)
{
    *minDist = INFINITY;
    bool found = findNearestNeighborHelper(octree->root, target, nearest, minDist);
    if (found)
        *minDist = sqrt(*minDist);
    return found;
}
