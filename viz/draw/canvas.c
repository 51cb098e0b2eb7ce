/* SPDX-License-Identifier: MIT */
/* canvas.c - fills the quads of a frame. If the frame begins with the same quads as the previous frame, their pixels
 * are copied instead of filled. */
#include "fill.h"

#include <stdlib.h>
#include <string.h>

/* Keeping a picture takes about as long as filling this many quads. */
#define WORTH_KEEPING 256

void canvas_release(canvas *c)
{
    free(c->kept);
    quads_release(&c->last);
    memset(c, 0, sizeof *c);
}

static bool are_quads_equal(const quad *a, const quad *b)
{
    return a->color == b->color && a->order == b->order && memcmp(a->x, b->x, sizeof a->x) == 0 &&
           memcmp(a->y, b->y, sizeof a->y) == 0;
}

static size_t count_same_quads(const quad_list *a, const quad_list *b)
{
    size_t same = 0;
    while (same < a->count && same < b->count && are_quads_equal(&a->items[same], &b->items[same]))
        same++;
    return same;
}

/* Allocate the buffer in which the picture of the first `same` quads is kept for the next frame. The first `start` of
 * these quads are drawn already. Returns false if keeping the picture would save too little time, or if memory runs
 * out. */
static bool reserve_kept_picture(canvas *c, size_t start, size_t same, size_t pixels)
{
    if (same - start < WORTH_KEEPING)
        return false;
    c->kept = c->kept ? c->kept : malloc(pixels);
    return c->kept != NULL;
}

size_t canvas_fill_quads(canvas *c, quad_list *quads, uint8_t *indices)
{
    const renderer_part all = {0, 0, c->width, c->height};
    const size_t pixels = (size_t)c->width * (size_t)c->height, same = count_same_quads(&c->last, quads);
    const size_t kept = c->kept_count <= same ? c->kept_count : 0;
    size_t start = kept;
    if (kept > 0)
        memcpy(indices, c->kept, pixels);
    else
        memset(indices, 0, pixels);
    c->kept_count = kept;
    if (reserve_kept_picture(c, start, same, pixels)) {
        fill_quads(quads->items + start, same - start, all, indices);
        memcpy(c->kept, indices, pixels);
        c->kept_count = start = same;
    }
    if (start < quads->count)
        fill_quads(quads->items + start, quads->count - start, all, indices);
    const quad_list last = c->last;
    c->last = *quads;
    *quads = last;
    return c->last.count - kept;
}
