/* SPDX-License-Identifier: MIT */
/* box_lines.c - the set of lines on which the edges of a scene's boxes lie.
 *
 * The problem: each box has twelve edges, and the line of each edge must be found. With one hash look-up per edge,
 * 100,000 boxes would need 1.2 million look-ups in every frame. Between two frames, however, few boxes appear or
 * vanish, and the other boxes keep their order.
 *
 * The idea: match the boxes of the new scene with the boxes of the last scene, as diff matches the lines of two files.
 * Both lists are walked side by side. If a new box is not the next box of the old list, the next MISSING_AT_MOST old
 * boxes are searched for it. Old boxes that the search skips count as removed; a box that is not found counts as added.
 * A wrong match costs only time: the box is then removed and added again. Only removed and added boxes change lines,
 * and only added boxes look up lines in the hash map.
 *
 * Each line counts the box edges on it. Lines without box edges stay in the set until edges.c rebuilds the whole
 * set. */
#include "edges.h"
#include "array.h"

#include <string.h>

/* The greatest number of consecutive old boxes that are searched for a box of the new scene. */
#define MISSING_AT_MOST 64

void box_lines_clear(box_lines *kept)
{
    kept->now.count = kept->count = kept->idle = 0;
    hash_map_clear(&kept->map);
}

void box_lines_release(box_lines *kept)
{
    free(kept->now.items);
    free(kept->before.items);
    free(kept->lines);
    free(kept->changed);
    hash_map_release(&kept->map);
    memset(kept, 0, sizeof *kept);
}

/* ---- Lines --------------------------------------------------------------------------------------------------- */

/* Copy the high bits of a coordinate into the low bits, so that the multiplication in hash_key() spreads them.
 * Coordinates of tree planes have only a few bits set, and all of these are high bits. */
static uint64_t fold_double_to_word(double value)
{
    uint64_t bits;
    const double canonical = value + 0.0; /* turns -0 into 0, because equal coordinates need equal hashes */
    memcpy(&bits, &canonical, sizeof bits);
    return bits ^ bits >> 32;
}

static uint64_t hash_key(const void *item)
{
    const line_key *key = item;
    const uint64_t mixed = (fold_double_to_word(key->u) + key->kind) * UINT64_C(0x9e3779b97f4a7c15) ^
                           (fold_double_to_word(key->v) + key->kind) * UINT64_C(0xc2b2ae3d27d4eb4f);
    return (mixed ^ mixed >> 32) * UINT64_C(0xd6e8feb86659fd93) >> 32;
}

/* Compares coordinates as doubles, not as bytes: -0 equals 0, although their bytes differ. */
static bool are_keys_equal(const void *a, const void *b)
{
    const line_key *p = a, *q = b;
    return p->u == q->u && p->v == q->v && p->kind == q->kind;
}

static const hash_map_item_type by_key = {sizeof(line), hash_key, are_keys_equal};

static uint32_t add_line(box_lines *kept, const line_key *key)
{
    if (!array_grow(&kept->lines, kept->count + 1, &kept->room, sizeof *kept->lines) ||
        !array_grow(&kept->changed, kept->count + 1, &kept->changed_room, sizeof *kept->changed))
        return LINE_NONE;
    kept->lines[kept->count] = (line){.key = *key};
    if (!hash_map_add(&kept->map, &by_key, kept->lines))
        return LINE_NONE;
    kept->idle++;
    return (uint32_t)kept->count++;
}

/* Count one more box edge on a line, and add the line to the set if it is new. Returns the line's index. Returns
 * LINE_NONE if memory runs out. */
static uint32_t add_line_user(box_lines *kept, const line_key *key)
{
    uint32_t place = hash_map_find(&kept->map, &by_key, kept->lines, key);
    if (place == HASH_MAP_NONE)
        place = add_line(kept, key);
    if (place == LINE_NONE)
        return LINE_NONE;
    kept->idle -= kept->lines[place].users++ == 0;
    kept->changed[place] = true;
    return place;
}

static void remove_line_user(box_lines *kept, uint32_t place)
{
    kept->idle += --kept->lines[place].users == 0;
    kept->changed[place] = true;
}

/* ---- Boxes --------------------------------------------------------------------------------------------------- */

static bool add_edge_to_line(box_lines *kept, lined_box *of, unsigned edge)
{
    const line_key key = line_key_of_box_edge(&of->box, edge / 4, edge % 4);
    of->lines[edge] = add_line_user(kept, &key);
    return of->lines[edge] != LINE_NONE;
}

/* Find or add the lines of a box's edges. A box that is flat along an axis has no edges along this axis. A box that is
 * a single point has one edge, of length 0. */
static bool add_edges_to_lines(box_lines *kept, lined_box *of)
{
    const octree_box *box = &of->box.box;
    bool ok = true, dot = true;
    for (unsigned edge = 0; ok && edge < BOX_EDGES; edge++) {
        const bool extends = box->min[edge / 4] < box->max[edge / 4];
        of->lines[edge] = LINE_NONE;
        ok = !extends || add_edge_to_line(kept, of, edge);
        dot = dot && !extends;
    }
    return ok && (!dot || add_edge_to_line(kept, of, 0));
}

static void remove_edges_from_lines(box_lines *kept, const lined_box *box, const lined_box *end)
{
    for (; box < end; box++)
        for (unsigned edge = 0; edge < BOX_EDGES; edge++)
            if (box->lines[edge] != LINE_NONE)
                remove_line_user(kept, box->lines[edge]);
}

static bool are_boxes_equal(const scene_box *a, const scene_box *b)
{
    return a->id == b->id && a->depth == b->depth && memcmp(&a->style, &b->style, sizeof a->style) == 0 &&
           memcmp(&a->box, &b->box, sizeof a->box) == 0;
}

/* Find a box among at most MISSING_AT_MOST old boxes, from index `from` on. Returns null if none of these old boxes
 * equals the box. */
static const lined_box *find_old_box(const lined_boxes *in, size_t from, const scene_box *box)
{
    const size_t left = in->count - from, end = from + (left < MISSING_AT_MOST ? left : MISSING_AT_MOST);
    for (size_t i = from; i < end; i++)
        if (are_boxes_equal(&in->items[i].box, box))
            return &in->items[i];
    return NULL;
}

/* Add the next box of the scene. If an equal old box is found at index *old or later, the new box gets the lines of
 * this old box. The old boxes that the search skipped are then removed from their lines, and *old becomes the index
 * after the found box. Returns false if memory runs out. */
static bool add_box(box_lines *kept, const scene_box *box, size_t *old, bool *changed)
{
    const lined_box *next = *old < kept->before.count ? &kept->before.items[*old] : NULL,
                    *found = find_old_box(&kept->before, *old, box);
    if (!ARRAY_GROW(&kept->now, 1))
        return false;
    lined_box *added = &kept->now.items[kept->now.count++];
    *changed = *changed || !found || found != next;
    if (!found) {
        added->box = *box;
        return add_edges_to_lines(kept, added);
    }
    *added = *found;
    remove_edges_from_lines(kept, next, found);
    *old = (size_t)(found - kept->before.items) + 1;
    return true;
}

bool box_lines_update(box_lines *kept, const scene *s, unsigned first, unsigned end, bool *changed)
{
    const lined_boxes before = kept->now;
    size_t old = 0;
    bool ok = true;
    kept->now = kept->before;
    kept->now.count = 0;
    kept->before = before;
    *changed = false;
    for (size_t i = 0; ok && i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (box->style.layer >= first && box->style.layer < end)
            ok = add_box(kept, box, &old, changed);
    }
    if (ok && old < before.count) {
        remove_edges_from_lines(kept, before.items + old, before.items + before.count);
        *changed = true;
    }
    return ok;
}
