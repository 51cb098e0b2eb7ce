/* SPDX-License-Identifier: MIT */
/* node_changes.c - keeps the last split or merge of each address, and the points that a tick may change; see
 * node_changes.h. */
#include "node_changes.h"
#include "octree/octree.h"

static const hash_map_item_type by_node = {sizeof(node_change), hash_map_hash_id, hash_map_ids_equal};

void node_changes_release(node_changes *c)
{
    free(c->items);
    free(c->before.items);
    hash_map_release(&c->places);
    *c = (node_changes){0};
}

bool is_descendant_or_self(octree_address address, octree_address node)
{
    while (address > node)
        address >>= 3;
    return address == node;
}

/* ---- Before a tick ------------------------------------------------------------------------------------------ */

static bool store_point(node_changes *c, const octree_game *game, uint64_t id)
{
    octree_point point;
    if (!ARRAY_GROW(&c->before, 1))
        return false;
    earlier_point *added = &c->before.items[c->before.count++];
    *added = (earlier_point){.id = id, .existed = octree_game_find(game, id, &point)};
    if (added->existed)
        memcpy(added->position, point.position, sizeof added->position);
    return true;
}

static bool store_movers(node_changes *c, const octree_tick *tick)
{
    if (!ARRAY_GROW(&c->before, tick->mover_count))
        return false;
    for (size_t i = 0; i < tick->mover_count; i++) {
        earlier_point *added = &c->before.items[c->before.count++];
        *added = (earlier_point){.id = tick->movers[i].id, .existed = true};
        memcpy(added->position, tick->movers[i].position, sizeof added->position);
    }
    return true;
}

bool node_changes_begin_tick(node_changes *c, const octree_game *game, const octree_input *input)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_session *session = octree_game_session(game);
    if (!c->tracked)
        return true;
    c->before.count = 0;
    bool ok = store_movers(c, tick) && store_point(c, game, session->player.id);
    for (size_t i = 0; ok && input && i < input->edit_count; i++)
        ok = store_point(c, game, input->edits[i].body.id);
    for (; ok && c->next_edit < session->edit_count && session->edits[c->next_edit].tick <= tick->number + 1;
         c->next_edit++)
        ok = input || store_point(c, game, session->edits[c->next_edit].body.id);
    return ok;
}

/* ---- After a tick ------------------------------------------------------------------------------------------- */

static const node_change *find_change(const node_changes *c, octree_address node)
{
    const uint32_t place = hash_map_find(&c->places, &by_node, c->items, &node);
    return place == HASH_MAP_NONE ? NULL : &c->items[place];
}

static bool set_change(node_changes *c, const node_change *change)
{
    const uint32_t place = hash_map_find(&c->places, &by_node, c->items, &change->node);
    const size_t count = c->places.count;
    if (place != HASH_MAP_NONE) {
        c->items[place] = *change;
        return true;
    }
    if (!array_grow(&c->items, count + 1, &c->room, sizeof *c->items))
        return false;
    c->items[count] = *change;
    return hash_map_add(&c->places, &by_node, c->items);
}

bool node_changes_end_tick(node_changes *c, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    bool ok = true;
    for (size_t i = 0; ok && c->tracked && i < tick->split_count + tick->merge_count; i++) {
        octree_node node;
        const bool split = i < tick->split_count;
        const octree_address address = split ? tick->splits[i] : tick->merges[i - tick->split_count];
        const bool exists = octree_node_at(octree_game_tree(game), address, &node) == OCTREE_OK;
        ok = set_change(c, &(node_change){address, tick->number, exists ? node.count : 0, split});
    }
    return ok;
}

node_change node_changes_find_origin(const node_changes *c, octree_address node)
{
    const node_change *own = find_change(c, node), *parent = find_change(c, node >> 3);
    if (own && !own->split && own->points > 0 && (!parent || own->tick >= parent->tick))
        return *own;
    return parent && parent->split ? *parent : (node_change){0};
}

static bool is_position_in_node(const octree_game *game, const double position[3], const octree_node *node)
{
    octree_node leaf;
    for (int i = 0; i < 3; i++) /* avoids octree_locate() for most points */
        if (position[i] < node->box.min[i] || position[i] > node->box.max[i])
            return false;
    return octree_locate(octree_game_tree(game), position, &leaf) == OCTREE_OK &&
           is_descendant_or_self(leaf.address, node->address);
}

static bool add_id(id_list *ids, uint64_t id)
{
    if (!ARRAY_GROW(ids, 1))
        return false;
    ids->items[ids->count++] = id;
    return true;
}

static void sort_unique_ids(id_list *ids)
{
    size_t kept = 0;
    if (ids->count > 0)
        qsort(ids->items, ids->count, sizeof *ids->items, compare_uint64);
    for (size_t i = 0; i < ids->count; i++)
        if (i == 0 || ids->items[i] != ids->items[kept - 1])
            ids->items[kept++] = ids->items[i];
    ids->count = kept;
}

bool node_changes_list_points(const node_changes *c, const octree_game *game, const octree_node *node, id_list *arrived,
                              id_list *left)
{
    bool ok = true;
    *arrived = *left = (id_list){0};
    for (size_t i = 0; ok && i < c->before.count; i++) {
        octree_point now;
        const earlier_point *then = &c->before.items[i];
        const bool was = then->existed && is_position_in_node(game, then->position, node);
        const bool is = octree_game_find(game, then->id, &now) && is_position_in_node(game, now.position, node);
        ok = was == is || add_id(is ? arrived : left, then->id);
    }
    sort_unique_ids(arrived);
    sort_unique_ids(left);
    return ok;
}
