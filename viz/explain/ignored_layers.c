/* ignored_layers.c - see ignored_layers.h. */
#include "ignored_layers.h"
#include "draw.h"
#include "frame_file.h"
#include "replay.h"

#include <stdlib.h>

/* Where a pair's rectangles go. */
typedef struct rectangles {
    diff_pair *pair;
    bool out_of_memory;
} rectangles;

static void add_rectangle(const draw_box *box, void *context)
{
    rectangles *to = context;
    diff_pair *pair = to->pair;
    image_rectangle *grown = realloc(pair->ignored, (pair->ignored_count + 1) * sizeof *grown);
    if (!grown) {
        to->out_of_memory = true;
        return;
    }
    pair->ignored = grown;
    pair->ignored[pair->ignored_count++] = (image_rectangle){box->x, box->y, box->width, box->height};
}

/* A recording's frames are named for their ticks. */
static uint64_t tick_of(const diff_frame *frame)
{
    uint64_t tick = 0;
    frame_parse_name(frame->name, &tick);
    return tick;
}

static bool ignore_in(replay *r, diff_pair *pair, const diff_frame *frame, octreel_error *error)
{
    rectangles to = {.pair = pair};
    if (!replay_to(r, tick_of(frame), error) || !replay_scene(r, error))
        return false;
    draw_text_boxes(&r->take.scene, add_rectangle, &to);
    return !to.out_of_memory || error_set(error, "there is no memory for what is ignored");
}

static int by_tick(const void *a, const void *b)
{
    const uint64_t x = tick_of((*(diff_pair *const *)a)->a), y = tick_of((*(diff_pair *const *)b)->a);
    return (x > y) - (x < y);
}

/* Names are alike on both sides, so that one order by ticks serves both; beyond six digits it is not that of names. */
static bool ignore_of(const diff_side *side, bool is_a, diff_pair **pairs, size_t count, octreel_error *error)
{
    replay r;
    bool ok = replay_open(&r, side->path, error);
    qsort(pairs, count, sizeof *pairs, by_tick);
    for (size_t i = 0; ok && i < count; i++)
        ok = ignore_in(&r, pairs[i], is_a ? pairs[i]->a : pairs[i]->b, error);
    replay_close(&r);
    return ok;
}

bool ignore_text_layer(const diff_side *a, const diff_side *b, diff_pair **pairs, size_t count, octreel_error *error)
{
    if (a->kind != DIFF_RECORDING && b->kind != DIFF_RECORDING)
        return error_set(error, "where text is can be told of recordings alone: neither %s nor %s is one", a->path,
                         b->path);
    return count == 0 || ((a->kind != DIFF_RECORDING || ignore_of(a, true, pairs, count, error)) &&
                          (b->kind != DIFF_RECORDING || ignore_of(b, false, pairs, count, error)));
}
