/* SPDX-License-Identifier: MIT */
/* ignored_layers.c - finds the pixels of ignored layers: it plays both recordings and draws their scenes again. */
#include "ignored_layers.h"
#include "layer.h"
#include "letters.h"
#include "pixel.h"
#include "replay.h"

#include <stdlib.h>
#include <string.h>

#define TEXT_ALONE (1u << LAYER_TEXT)

/* A mask with one byte for each pixel of a frame. */
typedef struct frame_mask {
    uint8_t *bytes;
    int width, height;
} frame_mask;

static int clamp(int value, int limit)
{
    return value < 0 ? 0 : value > limit ? limit : value;
}

/* Add the pixels of a box to the mask. Parts of the box outside the frame are ignored. */
static void add_box_to_mask(const draw_box *box, void *context)
{
    frame_mask *m = context;
    const int left = clamp(box->x, m->width), right = clamp(box->x + box->width, m->width);
    const int bottom = clamp(box->y + box->height, m->height);
    for (int y = clamp(box->y, m->height); y < bottom; y++)
        memset(m->bytes + (size_t)y * (size_t)m->width + left, 1, (size_t)(right - left));
}

static bool draw_mask(replay *playing, unsigned layers, frame_mask *m, octreel_error *error)
{
    const scene *s = &playing->playback.scene;
    const renderer_choice any = {0};
    if (layers & ~TEXT_ALONE) {
        renderer *drawing = replay_renderer(playing, &any, error);
        if (!drawing || !renderer_find_layer_mask(drawing, s, layers, m->bytes, error))
            return false;
    }
    if (layers & TEXT_ALONE)
        visit_text_boxes(s, add_box_to_mask, m);
    return true;
}

static bool add_mask(replay *playing, diff_pair *pair, octreel_error *error)
{
    if (!replay_play_up_to(playing, diff_pair_tick(pair), error) || !playback_compose_scene(&playing->playback, error))
        return false;
    const view *v = &playing->playback.scene.view;
    frame_mask m = {calloc((size_t)v->width, (size_t)v->height), v->width, v->height};
    bool ok = m.bytes || error_no_memory(error);
    ok = ok && draw_mask(playing, pair->layers, &m, error) &&
         (mask_add(&pair->mask, m.bytes, m.width, m.height) || error_no_memory(error));
    free(m.bytes);
    return ok;
}

static int compare_by_tick(const void *a, const void *b)
{
    const uint64_t x = diff_pair_tick(*(diff_pair *const *)a), y = diff_pair_tick(*(diff_pair *const *)b);
    return (x > y) - (x < y);
}

static bool add_masks(const diff_side *side, diff_pair **pairs, size_t count, octreel_error *error)
{
    replay playing = {0};
    bool ok = replay_open(&playing, side->path, side->max_ticks, error);
    for (size_t i = 0; ok && i < count; i++)
        ok = add_mask(&playing, pairs[i], error);
    replay_close(&playing);
    return ok;
}

bool ignore_layers(const diff_side *a, const diff_side *b, diff_pair **pairs, size_t count, octreel_error *error)
{
    if (a->kind != DIFF_RECORDING && b->kind != DIFF_RECORDING)
        return error_set(error, "--ignore-layer needs a recording, and neither %s nor %s is one", a->path, b->path);
    if (count == 0)
        return true;
    /* Sort the pairs by tick, the order in which a recording is played. Until here they are sorted by name, and
     * names of ticks with more than six digits are not in the order of ticks. Both frames of a pair have the same
     * name, so the order fits both recordings. */
    qsort(pairs, count, sizeof *pairs, compare_by_tick);
    return (a->kind != DIFF_RECORDING || add_masks(a, pairs, count, error)) &&
           (b->kind != DIFF_RECORDING || add_masks(b, pairs, count, error));
}
