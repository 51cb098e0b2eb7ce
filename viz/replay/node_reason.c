/* SPDX-License-Identifier: MIT */
/* node_reason.c - finds and prints the reason why a node exists and how full it is at a tick. */
#include "node_reason.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>

static bool has_split(const octree_tick *tick, octree_address node)
{
    for (size_t i = 0; i < tick->split_count; i++)
        if (tick->splits[i] == node)
            return true;
    return false;
}

bool has_node_reason(const octree_game *game, const octree_node *node)
{
    return node->leaf || has_split(octree_game_tick(game), node->address);
}

bool node_reason_find(node_reason *r, const octree_game *game, const node_changes *changes, const octree_node *node)
{
    *r = (node_reason){.tick = octree_game_tick(game)->number,
                       .points = node->count,
                       .capacity = octree_definition(octree_game_tree(game)).leaf_capacity,
                       .split = !node->leaf,
                       .maker = node_changes_find_origin(changes, node->address)};
    return node_changes_list_points(changes, game, node, &r->arrived, &r->left);
}

void node_reason_release(node_reason *r)
{
    free(r->arrived.items);
    free(r->left.items);
    *r = (node_reason){0};
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* Print a part of a sentence: the text `before`, the ids of points, and a verb, such as "; points 5, 7 and 12 more
 * arrived". */
static void print_points(FILE *out, const char *before, const id_list *ids, const char *verb)
{
    const size_t shown = ids->count > LIST_LINES ? LIST_LINES : ids->count;
    fprintf(out, "%spoint%s", before, plural_ending(ids->count));
    for (size_t i = 0; i < shown; i++)
        fprintf(out, "%s %" PRIu64, i ? "," : "", ids->items[i]);
    if (shown < ids->count)
        fprintf(out, " and %zu more", ids->count - shown);
    fprintf(out, " %s", verb);
}

static void print_arrivals(FILE *out, const node_reason *r)
{
    if (r->arrived.count)
        print_points(out, "; ", &r->arrived, "arrived");
    if (r->left.count)
        print_points(out, r->arrived.count ? ", " : "; ", &r->left, "left");
    if (!r->arrived.count && !r->left.count)
        fputs("; no point arrived or left", out);
    fputs(" at this tick", out);
}

static void print_maker(FILE *out, const node_change *maker)
{
    char path[OCTREE_ADDRESS_TEXT];
    if (!maker->node)
        fputs("; its cell exists since tick 0", out);
    else if (maker->split)
        fprintf(out, "; its cell was made by the split of node %s at tick %" PRIu64 ", when that node held %zu point%s",
                octree_address_format(maker->node, path), maker->tick, maker->points, plural_ending(maker->points));
    else
        fprintf(out, "; its cell was made by a merge at tick %" PRIu64 ", when it held %zu point%s", maker->tick,
                maker->points, plural_ending(maker->points));
}

void node_reason_print(FILE *out, const node_reason *r)
{
    fprintf(out, "; capacity %zu", r->capacity);
    if (r->split)
        fprintf(out, ", so it split at this tick, when it held %zu point%s", r->points, plural_ending(r->points));
    if (r->tick > 0)
        print_arrivals(out, r);
    print_maker(out, &r->maker);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_ids(json_writer *w, const char *key, const id_list *ids)
{
    json_begin_array_member(w, key);
    for (size_t i = 0; i < ids->count; i++)
        json_write_integer(w, ids->items[i]);
    json_write_end_array(w);
}

void node_reason_write(json_writer *w, const node_reason *r)
{
    char path[OCTREE_ADDRESS_TEXT];
    json_write_integer_member(w, "capacity", r->capacity);
    json_write_bool_member(w, "split", r->split);
    write_ids(w, "arrived", &r->arrived);
    write_ids(w, "left", &r->left);
    if (!r->maker.node)
        return;
    json_begin_object_member(w, "made_by");
    json_write_text_member(w, "change", r->maker.split ? "split" : "merge");
    json_write_text_member(w, "path", octree_address_format(r->maker.node, path));
    json_write_integer_member(w, "tick", r->maker.tick);
    json_write_integer_member(w, "points", r->maker.points);
    json_write_end_object(w);
}
