/* canvas.c - see canvas.h. */
#include "canvas.h"
#include "fill.h"

#include <stdlib.h>
#include <string.h>

/* To begin and to read once more costs a rasteriser about as much as so many quads. */
#define WORTH_A_PASS 256

/* The index of what is laid over another picture and shows it. */
#define NOTHING 255
_Static_assert(THEME_COLORS <= NOTHING, "an index is left over");

/* A frame under way. */
typedef struct drawing {
    canvas *canvas;
    const quad *quads;
    rasteriser *rasterise;
    void *context;
    uint8_t *indices;
    bool blank; /* nothing is in `indices` yet */
} drawing;

void canvas_release(canvas *c)
{
    free(c->over);
    free(c->kept);
    quads_release(&c->last);
    memset(c, 0, sizeof *c);
}

static size_t count_pixels(const canvas *c)
{
    return (size_t)c->width * (size_t)c->height;
}

/* ---- What is filled ----------------------------------------------------------------------------------------- */

static fill_target target_of(const drawing *d)
{
    return (fill_target){d->indices, d->canvas->width, d->canvas->height};
}

static void fill_all(drawing *d, size_t start, size_t end)
{
    if (d->blank)
        memset(d->indices, 0, count_pixels(d->canvas));
    d->blank = false;
    const fill_target to = target_of(d);
    for (size_t i = start; i < end; i++)
        fill_quad(&to, &d->quads[i]);
}

/* ---- The rasteriser ----------------------------------------------------------------------------------------- */

/* The rows that quads may light. */
static void find_rows(const drawing *d, size_t start, size_t end, int *first, int *behind)
{
    int32_t least = INT32_MAX, most = INT32_MIN;
    for (size_t i = start; i < end; i++)
        for (int j = 0; j < 4; j++) {
            const int32_t y = d->quads[i].y[j];
            least = y < least ? y : least;
            most = y > most ? y : most;
        }
    const int height = d->canvas->height, rows = most <= 0 ? 0 : (int)(most / QUAD_SUBPIXELS) + 1;
    *first = least <= 0 ? 0 : (int)(least / QUAD_SUBPIXELS);
    *behind = rows < height ? rows : height;
}

static bool lay_over(drawing *d, size_t start, size_t end)
{
    canvas *c = d->canvas;
    int first, behind;
    find_rows(d, start, end, &first, &behind);
    if (first >= behind)
        return true;
    c->over = c->over ? c->over : malloc(count_pixels(c));
    if (!c->over || !d->rasterise(d->context, d->quads + start, end - start, NOTHING, first, behind, c->over))
        return false;
    const size_t last = (size_t)behind * (size_t)c->width;
    for (size_t i = (size_t)first * (size_t)c->width; i < last; i++)
        d->indices[i] = c->over[i] == NOTHING ? d->indices[i] : c->over[i];
    return true;
}

static bool rasterise_all(drawing *d, size_t start, size_t end)
{
    if (start == end)
        return true;
    if (!d->blank)
        return lay_over(d, start, end);
    d->blank = false;
    return d->rasterise(d->context, d->quads + start, end - start, 0, 0, d->canvas->height, d->indices);
}

/* ---- A frame ------------------------------------------------------------------------------------------------ */

/* Many rectangles in a row, and those that come last, are filled. */
static bool draw_span(drawing *d, size_t start, size_t end)
{
    const fill_target to = target_of(d);
    size_t begun = start;
    for (size_t i = start, run; i < end; i = run + 1) {
        for (run = i; run < end && fill_takes(&to, &d->quads[run]);)
            run++;
        if (run == i || (run < end && run - i < WORTH_A_PASS))
            continue;
        if (!rasterise_all(d, begun, i))
            return false;
        fill_all(d, i, run);
        begun = run;
    }
    return rasterise_all(d, begun, end);
}

static bool same_quad(const quad *a, const quad *b)
{
    return a->color == b->color && a->order == b->order && memcmp(a->x, b->x, sizeof a->x) == 0 &&
           memcmp(a->y, b->y, sizeof a->y) == 0;
}

static size_t count_same(const quad_list *a, const quad_list *b)
{
    size_t same = 0;
    while (same < a->count && same < b->count && same_quad(&a->items[same], &b->items[same]))
        same++;
    return same;
}

/* Without memory for it the next frame is drawn from its beginning. */
static void remember(canvas *c, const quad_list *quads)
{
    c->last.count = 0;
    for (size_t i = 0; i < quads->count; i++)
        quads_add(&c->last, &quads->items[i]);
    if (c->last.out_of_memory)
        c->last.count = 0;
    c->last.out_of_memory = false;
}

/* Whether it pays to keep what is alike up to `same`, where `start` quads are drawn, and there is room for it. */
static bool is_worth_keeping(canvas *c, size_t start, size_t same)
{
    if (same - start < WORTH_A_PASS)
        return false;
    c->kept = c->kept ? c->kept : malloc(count_pixels(c));
    return c->kept != NULL;
}

bool canvas_draw(canvas *c, const quad_list *quads, rasteriser *rasterise, void *context, uint8_t *indices)
{
    drawing d = {c, quads->items, rasterise, context, indices, true};
    const size_t same = count_same(&c->last, quads);
    size_t start = c->kept_count <= same ? c->kept_count : 0;
    if (start > 0) {
        memcpy(indices, c->kept, count_pixels(c));
        d.blank = false;
    }
    c->kept_count = start;
    if (is_worth_keeping(c, start, same)) {
        if (!draw_span(&d, start, same))
            return false;
        memcpy(c->kept, indices, count_pixels(c));
        c->kept_count = start = same;
    }
    if (!draw_span(&d, start, quads->count))
        return false;
    if (d.blank)
        memset(indices, 0, count_pixels(c));
    remember(c, quads);
    return true;
}
