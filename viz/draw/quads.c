/* SPDX-License-Identifier: MIT */
/* quads.c - a list of quads, each with one colour, sorted in painter's order. */
#include "quads.h"
#include "array.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>

#define DEPTHS 32
#define ORDERS ((LAYER_DIAGRAM + 1) * QUAD_BANDS * DEPTHS)

uint16_t make_quad_order(unsigned layer, unsigned band, unsigned depth)
{
    return (uint16_t)((layer * QUAD_BANDS + (QUAD_BANDS - 1 - band)) * DEPTHS + (DEPTHS - 1 - depth));
}

uint16_t make_text_order(unsigned layer)
{
    return make_quad_order(layer == LAYER_WORLD      ? LAYER_POINTS
                           : layer == LAYER_NODES    ? LAYER_VELOCITIES
                           : layer == LAYER_KNEAREST ? LAYER_SHAPES
                                                     : layer,
                           0, 0);
}

void quads_release(quad_list *list)
{
    free(list->items);
    memset(list, 0, sizeof *list);
}

static void append_quad(quad_list *list, const quad *q)
{
    if (!ARRAY_GROW(list, 1)) {
        list->out_of_memory = true;
        return;
    }
    quad *added = &list->items[list->count++];
    *added = *q;
    added->kind = list->kind;
    added->index = list->index;
}

/* Returns whether a quad lies within the limits. A negative coordinate becomes a large unsigned number, so that one
 * comparison tests both limits of an axis. */
static bool is_quad_within(const quad *q, const int32_t limits[2])
{
    uint32_t x = 0, y = 0;
    for (int i = 0; i < 4; i++) {
        x = (uint32_t)q->x[i] > x ? (uint32_t)q->x[i] : x;
        y = (uint32_t)q->y[i] > y ? (uint32_t)q->y[i] : y;
    }
    return x <= (uint32_t)limits[0] && y <= (uint32_t)limits[1];
}

void quads_add_quad(quad_list *list, const quad *q)
{
    if (list->limits[0] == 0 || is_quad_within(q, list->limits)) {
        append_quad(list, q);
        return;
    }
    quad pieces[CLIP_PIECES];
    const int count = clip_quad(q, list->limits, pieces);
    for (int i = 0; i < count; i++)
        append_quad(list, &pieces[i]);
}

void quads_add_rectangle(quad_list *list, quad *q, int32_t left, int32_t top, int32_t right, int32_t bottom)
{
    for (int i = 0; i < 4; i++) {
        q->x[i] = i == 1 || i == 2 ? right : left;
        q->y[i] = i < 2 ? top : bottom;
    }
    quads_add_quad(list, q);
}

bool quads_sort(quad_list *list)
{
    size_t starts[ORDERS] = {0};
    for (size_t i = 0; i < list->count; i++)
        starts[list->items[i].order]++;
    for (size_t order = 0, next = 0; order < ORDERS; order++) {
        const size_t here = starts[order];
        starts[order] = next;
        next += here;
    }
    quad *sorted = malloc((list->room ? list->room : 1) * sizeof *sorted);
    if (!sorted)
        return false;
    for (size_t i = 0; i < list->count; i++)
        sorted[starts[list->items[i].order]++] = list->items[i];
    free(list->items);
    list->items = sorted;
    return true;
}

bool quads_insert_closeup(quad_list *list, const quad_list *closeup, const int32_t by[2])
{
    const uint16_t after = (uint16_t)(make_quad_order(LAYER_CLOSEUP, 0, 0) + 1);
    const size_t count = closeup->count;
    if (!ARRAY_GROW(list, count))
        return false;
    quad *items = list->items;
    size_t at = list->count;
    while (at > 0 && items[at - 1].order >= after)
        at--;
    memmove(items + at + count, items + at, (list->count - at) * sizeof *items);
    for (size_t i = 0; i < count; i++) {
        quad q = closeup->items[i];
        q.kind += QUAD_IN_CLOSEUP;
        for (int corner = 0; corner < 4; corner++) {
            q.x[corner] += by[0];
            q.y[corner] += by[1];
        }
        items[at + i] = q;
    }
    list->count += count;
    return true;
}
