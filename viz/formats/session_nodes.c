/* SPDX-License-Identifier: MIT */
/* session_nodes.c - reads, writes, copies and frees the foreign nodes of a session. */
#include "octree/octree.h"
#include "session_members.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Memory ------------------------------------------------------------------------------------------------- */

/* Allocates one block of memory for the nodes, followed by the ids of their points. Returns null if memory runs out
 * or `nodes` is 0. */
static octree_foreign_node *allocate_nodes(size_t nodes, size_t ids)
{
    const size_t most = SIZE_MAX / 2 / sizeof(octree_foreign_node);
    return nodes && nodes < most && ids < most ? calloc(1, nodes * sizeof(octree_foreign_node) + ids * sizeof(uint64_t))
                                               : NULL;
}

bool foreign_tree_duplicate(const octree_foreign_tree *from, octree_foreign_tree *to)
{
    const octree_foreign_node *source = from->nodes; /* `from` and `to` may be the same tree */
    const size_t count = from->node_count;
    size_t ids = 0;
    for (size_t i = 0; i < count; i++)
        ids += source[i].has_points ? source[i].points.count : 0;
    octree_foreign_node *nodes = allocate_nodes(count, ids);
    uint64_t *room = nodes ? (uint64_t *)(nodes + count) : NULL;
    *to = (octree_foreign_tree){.tick = from->tick, .nodes = nodes, .node_count = nodes ? count : 0};
    for (size_t i = 0; nodes && i < count; i++) {
        nodes[i] = source[i];
        nodes[i].points.count = source[i].has_points ? source[i].points.count : 0;
        if (nodes[i].points.count)
            memcpy(room, nodes[i].points.ids, nodes[i].points.count * sizeof *room);
        nodes[i].points.ids = room;
        room += nodes[i].points.count;
    }
    return nodes || count == 0;
}

void foreign_tree_release(octree_foreign_tree *tree)
{
    free((octree_foreign_node *)tree->nodes);
    *tree = (octree_foreign_tree){0};
}

/* ---- One node ----------------------------------------------------------------------------------------------- */

JSON_NAMES(precision_name, octree_precision_name, octree_precision)

#define NODE(member) offsetof(octree_foreign_node, member)

static const json_member node_members[] = {
    {"id", &json_uint64, NODE(id), .required = true, .max = JSON_LARGEST_WHOLE},
    {"parent", &json_uint64, NODE(parent), .given = NODE(has_parent), .max = JSON_LARGEST_WHOLE},
    {"box", &json_box, NODE(box), .required = true},
    {"depth", &json_int, NODE(depth), .given = NODE(has_depth), .max = INT32_MAX},
    {"points", &json_ids, NODE(points), .given = NODE(has_points)},
    {"kind", &json_label, NODE(kind), .size = OCTREE_NODE_KIND, .about = "a node's kind",
     JSON_IF(octree_foreign_node, kind[0])},
    {"mode", &json_choice, NODE(precision), .names = precision_name, JSON_IF(octree_foreign_node, precision)},
    {0},
};

/* ---- The nodes of a tick ------------------------------------------------------------------------------------ */

static size_t count_ids(const json_t *nodes)
{
    size_t ids = 0;
    for (size_t i = 0; i < json_array_size(nodes); i++)
        ids += json_array_size(json_object_get(json_array_get(nodes, i), "points"));
    return ids;
}

/* Checks that the nodes form trees. Otherwise returns false with an error that names the invalid node. */
static bool check_foreign_tree(json_reader *r, const octree_foreign_tree *tree, const json_place *at)
{
    size_t wrong;
    const octree_status status = octree_foreign_check(tree, &wrong);
    if (status == OCTREE_OK)
        return true;
    const octree_foreign_node *node = &tree->nodes[wrong];
    const json_place place = {at, NULL, wrong};
    if (status == OCTREE_DUPLICATE)
        return json_fail(r, &place, "id %" PRIu64 " already belongs to another node", node->id);
    if (status == OCTREE_NOT_FOUND)
        return json_fail(r, &place, "the parent of node %" PRIu64 " is %" PRIu64 ", but this list has no such node",
                         node->id, node->parent);
    if (status == OCTREE_BAD_PARENT)
        return json_fail(r, &place, "node %" PRIu64 " is its own ancestor", node->id);
    return json_fail(r, &place, "%s", octree_status_text(status));
}

static bool read_foreign_tree(json_reader *r, json_t *value, const json_place *at, octree_foreign_tree *tree)
{
    const size_t count = json_array_size(value);
    octree_foreign_node *nodes = allocate_nodes(count, count_ids(value));
    uint64_t *room = nodes ? (uint64_t *)(nodes + count) : NULL;
    if (count && !nodes)
        return json_fail(r, at, "out of memory for %zu nodes", count);
    tree->nodes = nodes;
    tree->node_count = count;
    for (size_t i = 0; i < count; i++) {
        nodes[i].points.ids = room;
        if (!json_read_members(r, json_array_get(value, i), &(json_place){at, NULL, i}, node_members, &nodes[i]))
            return false;
        room += nodes[i].points.count;
    }
    return check_foreign_tree(r, tree, at);
}

/* Reads the foreign nodes of a tick or of the header. Nodes in the header apply from tick 0 on. */
static bool read_foreign_nodes(json_reader *r, json_t *value, const json_place *at, void *into)
{
    session_loader *s = r->context;
    const bool header = s->tick == OCTREE_EVERY_TICK;
    session_list *list = header ? &s->header_lists[SESSION_FOREIGN] : &s->lists[SESSION_FOREIGN];
    (void)into;
    if (!json_is_array(value))
        return json_fail_expected(r, value, at, "a list of nodes");
    if (s->tick == 0 && s->header_lists[SESSION_FOREIGN].count > 0)
        return json_fail(r, at, "the header already has the nodes of tick 0");
    octree_foreign_tree *tree = session_append_item(r, at, list, sizeof *tree);
    if (!tree)
        return false;
    *tree = (octree_foreign_tree){.tick = header ? 0 : s->tick};
    return read_foreign_tree(r, value, at, tree);
}

/* Foreign nodes that apply from tick 0 on are written in the object of tick 0, not in the header. */
static void write_foreign_nodes(json_writer *w, const void *from)
{
    const octree_foreign_tree *tree = *(const octree_foreign_tree *const *)from;
    json_write_begin_array(w);
    for (size_t i = 0; i < tree->node_count; i++)
        json_write_object(w, node_members, &tree->nodes[i]);
    json_write_end_array(w);
}

const json_codec session_nodes_codec = {read_foreign_nodes, write_foreign_nodes};
