/* cause_trees.c - in what two trees differ; see cause_compare.h. */
#include "cause_compare.h"

#include <math.h>
#include <stdlib.h>

/* ---- Nodes --------------------------------------------------------------------------------------------------- */

/* The nodes of one tree beside another. */
typedef struct walking {
    const octree *other;
    bool is_a; /* those of the reference are walked */
    cause_facts *facts;
} walking;

static void add_node(const walking *w, cause_kind kind, octree_address node)
{
    cause_add(w->facts, (cause_fact){.kind = kind, .tick = CAUSE_NO_TICK, .node = node});
}

/* A node that the other tree does not have, or has as a leaf, takes what is below it along. */
static octree_walk_order look_at(const octree_node *node, void *context)
{
    const walking *w = context;
    octree_node other;
    if (octree_node_at(w->other, node->address, &other) != OCTREE_OK)
        add_node(w, w->is_a ? CAUSE_NODE_GONE : CAUSE_NODE_BORN, node->address);
    else if (!node->leaf && other.leaf)
        add_node(w, w->is_a ? CAUSE_NODE_MERGED : CAUSE_NODE_SPLIT, node->address);
    else
        return OCTREE_WALK_ON;
    return OCTREE_WALK_SKIP;
}

/* ---- Points -------------------------------------------------------------------------------------------------- */

static octree_point *sort_points(const octree *tree)
{
    static const octree_box all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    const size_t room = octree_count(tree);
    octree_point *points = malloc((room + 1) * sizeof *points);
    size_t count;
    if (points && octree_range_collect_sorted(tree, &all, NULL, points, room, &count) != OCTREE_OK) {
        free(points);
        points = NULL;
    }
    return points;
}

static void compare_point(const octree_point *a, const octree_point *b, cause_facts *facts)
{
    for (int axis = 0; axis < 3; axis++)
        if (a->position[axis] != b->position[axis]) {
            cause_add(facts, (cause_fact){.kind = CAUSE_POINT_MOVED,
                                          .tick = CAUSE_NO_TICK,
                                          .id = a->id,
                                          .a = cause_place(a->position),
                                          .b = cause_place(b->position)});
            return;
        }
}

/* In a game an id is unique. */
static void compare_points(const octree *a, const octree *b, const uint64_t *player, cause_facts *facts)
{
    octree_point *as = sort_points(a), *bs = sort_points(b);
    const size_t a_count = octree_count(a), b_count = octree_count(b);
    facts->out_of_memory |= !as || !bs;
    for (size_t i = 0, j = 0; as && bs && (i < a_count || j < b_count);) {
        const bool less = j == b_count || (i < a_count && as[i].id < bs[j].id);
        const bool more = i == a_count || (j < b_count && bs[j].id < as[i].id);
        if (less)
            cause_add(facts, (cause_fact){.kind = CAUSE_POINT_LESS,
                                          .tick = CAUSE_NO_TICK,
                                          .id = as[i].id,
                                          .a = cause_place(as[i].position)});
        else if (more)
            cause_add(facts, (cause_fact){.kind = CAUSE_POINT_MORE,
                                          .tick = CAUSE_NO_TICK,
                                          .id = bs[j].id,
                                          .b = cause_place(bs[j].position)});
        else if (!player || as[i].id != *player)
            compare_point(&as[i], &bs[j], facts);
        i += !more;
        j += !less;
    }
    free(as);
    free(bs);
}

/* Nodes of unlike worlds have nothing to do with each other. */
static bool same_world(const octree *a, const octree *b, cause_facts *facts)
{
    const octree_box worlds[2] = {octree_definition(a).world, octree_definition(b).world};
    const cause_option options[2] = {{"world", cause_box(&worlds[0])}, {"world", cause_box(&worlds[1])}};
    const uint64_t before = facts->found[CAUSE_OPTION];
    cause_add_options(facts, CAUSE_OPTION, &options[0], &options[1], 1);
    return facts->found[CAUSE_OPTION] == before;
}

/* Whom the ticks tell of, and so not the trees; null where it is not one and the same. */
static const uint64_t *player_of_both(const octree_game *a, const octree_game *b)
{
    const uint64_t *ids[2] = {&octree_game_session(a)->player.id, &octree_game_session(b)->player.id};
    const bool both = octree_game_tick(a)->has_player && octree_game_tick(b)->has_player;
    return both && *ids[0] == *ids[1] ? ids[0] : NULL;
}

void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const octree *const as = octree_game_tree(a), *const bs = octree_game_tree(b);
    walking over_b = {as, false, facts}, over_a = {bs, true, facts};
    if (same_world(as, bs, facts)) {
        octree_walk(bs, look_at, &over_b);
        octree_walk(as, look_at, &over_a);
    }
    compare_points(as, bs, player_of_both(a, b), facts);
}
