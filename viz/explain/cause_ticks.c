/* SPDX-License-Identifier: MIT */
/* cause_ticks.c - compares the ticks with the same number in two sessions: their lines of ticks.jsonl, and their
 * trees node by node. See cause_compare.h. */
#include "cause_compare.h"
#include "json_read.h"
#include "octree/octree.h"
#include "text.h"
#include "ticks_write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Nodes --------------------------------------------------------------------------------------------------- */

/* The state of a walk over the nodes of one tree. Each node is looked up in the other tree. */
typedef struct walking {
    const octree *other;
    bool is_a; /* true: the walked tree belongs to the reference */
    cause_facts *facts;
} walking;

static void add_node_fact(const walking *w, const char *where, octree_address node)
{
    char text[OCTREE_ADDRESS_TEXT];
    cause_add_whole(w->facts, where, CAUSE_MORE, NULL, json_string(octree_address_format(node, text)));
}

/* Report a node that is missing from the other tree, or that is a leaf only in the other tree. After such a report,
 * skip the nodes below. */
static octree_walk_order compare_node(const octree_node *node, void *context)
{
    const walking *w = context;
    octree_node other;
    if (octree_node_at(w->other, node->address, &other) != OCTREE_OK)
        add_node_fact(w, w->is_a ? "nodes.gone" : "nodes.born", node->address);
    else if (!node->leaf && other.leaf)
        add_node_fact(w, w->is_a ? "nodes.merged" : "nodes.split", node->address);
    else
        return OCTREE_WALK_ON;
    return OCTREE_WALK_SKIP;
}

/* ---- Points -------------------------------------------------------------------------------------------------- */

/* Return all points of a tree in ascending order of id. If `excluded` is not null, leave out the point with the id
 * *excluded. */
static cause_points list_sorted_points(const octree *tree, const uint64_t *excluded)
{
    static const octree_box all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    const size_t room = octree_count(tree);
    cause_points sorted = {malloc((room + 1) * sizeof *sorted.points), 0};
    size_t count = 0;
    if (sorted.points && octree_range_collect_sorted(tree, &all, NULL, sorted.points, room, &count) != OCTREE_OK) {
        free(sorted.points);
        sorted.points = NULL;
    }
    for (size_t i = 0; sorted.points && i < count; i++)
        if (!excluded || sorted.points[i].id != *excluded)
            sorted.points[sorted.count++] = sorted.points[i];
    return sorted;
}

/* Return the id of the player if both games have a player with the same id, else null. */
static const uint64_t *find_common_player_id(const octree_game *a, const octree_game *b)
{
    const uint64_t *ids[2] = {&octree_game_session(a)->player.id, &octree_game_session(b)->player.id};
    const bool both = octree_game_tick(a)->has_player && octree_game_tick(b)->has_player;
    return both && *ids[0] == *ids[1] ? ids[0] : NULL;
}

/* Compare the points of both trees. Points with the same id are compared with each other: an id is unique in a game. */
static void compare_points(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const uint64_t *player = find_common_player_id(a, b);
    const cause_points as = list_sorted_points(octree_game_tree(a), player),
                       bs = list_sorted_points(octree_game_tree(b), player);
    facts->out_of_memory |= !as.points || !bs.points;
    if (as.points && bs.points)
        cause_compare_points(facts, "tree.points", &as, &bs, false);
    free(as.points);
    free(bs.points);
}

/* Return whether both trees have the same world. Only then can their nodes be compared. */
static bool have_same_world(const octree *a, const octree *b)
{
    const octree_box x = octree_definition(a).world, y = octree_definition(b).world;
    return memcmp(&x, &y, sizeof x) == 0;
}

void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const octree *const as = octree_game_tree(a), *const bs = octree_game_tree(b);
    walking over_b = {as, false, facts}, over_a = {bs, true, facts};
    if (have_same_world(as, bs)) {
        octree_walk(bs, compare_node, &over_b);
        octree_walk(as, compare_node, &over_a);
    } else {
        cause_add_whole(facts, "world", CAUSE_OTHER, NULL, NULL);
    }
    compare_points(a, b, facts);
}

/* ---- Lines --------------------------------------------------------------------------------------------------- */

/* Write the line of ticks.jsonl for the game's current tick. The digest of the tree is left out, because it also
 * depends on the tree's options. */
static char *write_line(const octree_game *game)
{
    octree_tick tick = *octree_game_tick(game);
    const tick_extras extras = {.frame = NULL, .whole = true};
    text_stream s;
    char *text;
    tick.tree_digest = 0;
    if (text_stream_begin(&s))
        tick_write(s.stream, &tick, &extras);
    return text_stream_end(&s, &text) ? text : NULL;
}

static bool is_inner_node(const octree_game *game, octree_address address)
{
    octree_node node;
    return octree_node_at(octree_game_tree(game), address, &node) == OCTREE_OK && !node.leaf;
}

/* Remove from `nodes`, a list of addresses in a line of ticks.jsonl, each node that is an inner node in only one of the
 * trees, because cause_compare_trees() reports this node. */
static void drop_reported_nodes(const octree_game *a, const octree_game *b, json_t *nodes)
{
    for (size_t i = json_array_size(nodes); i-- > 0;) {
        octree_address node;
        if (!octree_address_parse(json_string_value(json_array_get(nodes, i)), &node) ||
            is_inner_node(a, node) != is_inner_node(b, node))
            json_array_remove(nodes, i);
    }
}

/* Parse a line of ticks.jsonl and remove what cause_compare_trees() reports. */
static json_t *parse_line(const octree_game *a, const octree_game *b, const char *text)
{
    json_error_t error;
    json_t *line = json_parse(text, strlen(text), JSON_DECODE_INT_AS_REAL, &error);
    json_object_del(line, "tree"); /* the counts in "tree" follow from compared nodes and points */
    drop_reported_nodes(a, b, json_object_get(line, "splits"));
    drop_reported_nodes(a, b, json_object_get(line, "merges"));
    return line;
}

static void compare_lines(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const cause_place place = {facts, "", "", CAUSE_NO_TICK, false};
    char *texts[2] = {write_line(a), write_line(b)};
    facts->out_of_memory |= !texts[0] || !texts[1];
    if (texts[0] && texts[1] && strcmp(texts[0], texts[1]) != 0) {
        json_t *lines[2] = {parse_line(a, b, texts[0]), parse_line(a, b, texts[1])};
        facts->out_of_memory |= !lines[0] || !lines[1];
        cause_compare_members(&place, lines[0], lines[1]);
        json_decref(lines[0]);
        json_decref(lines[1]);
    }
    free(texts[0]);
    free(texts[1]);
}

/* ---- Values that are drawn but not in ticks.jsonl ------------------------------------------------------------ */

static bool have_same_visits(const octree_tick *a, const octree_tick *b)
{
    if (a->visit_count != b->visit_count || a->hit_leaf_count != b->hit_leaf_count)
        return false;
    for (size_t i = 0; i < a->visit_count; i++)
        if (a->visits[i].node != b->visits[i].node || a->visits[i].touch != b->visits[i].touch ||
            a->visits[i].taken != b->visits[i].taken)
            return false;
    for (size_t i = 0; i < a->hit_leaf_count; i++)
        if (a->hit_leaves[i] != b->hit_leaves[i])
            return false;
    return true;
}

/* In both ticks, a swept collision test hit points. Return whether these points came from the same positions. */
static bool have_same_hit_starts(const octree_tick *a, const octree_tick *b)
{
    for (size_t i = 0; a->hit_from && b->hit_from && a->hit_count == b->hit_count && i < a->hit_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (a->hits[i].id == b->hits[i].id && a->hit_from[i][axis] != b->hit_from[i][axis])
                return false;
    return true;
}

void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const octree_tick *x = octree_game_tick(a), *y = octree_game_tick(b);
    compare_lines(a, b, facts);
    if (!have_same_visits(x, y) && !cause_find_group(facts, "visits", CAUSE_OTHER))
        cause_add_whole(facts, "visited", CAUSE_OTHER, NULL, NULL);
    if (!have_same_hit_starts(x, y))
        cause_add_whole(facts, "hit_from", CAUSE_OTHER, NULL, NULL);
}
