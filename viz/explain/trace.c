/* trace.c - see trace.h. */
#include "trace.h"
#include "frame_file.h"
#include "layer.h"
#include "tick_scene.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>

/* Samples of a picture that is traced, which take 8 bytes each at most. */
#define MOST_SAMPLES ((size_t)1 << 25)

/* Pixels are added up in portions of so many. */
#define PORTION ((size_t)1 << 16)

void tracer_close(tracer *t)
{
    for (int i = 0; i < 2; i++) {
        heat_release(&t->heats[i]);
        scene_release(&t->scenes[i]);
    }
    renderer_close(t->renderer);
    for (size_t i = 0; i < t->count; i++)
        free(t->traces[i].parts);
    free(t->traces);
    *t = (tracer){0};
}

bool tracer_add_tick(tracer *t, const recorded sides[2], const octree_game *const games[2], octreel_error *error)
{
    for (int i = 0; i < 2; i++)
        if ((sides[i].view.view.layers & VIEW_HEAT_LAYERS) && !heat_add_tick(&t->heats[i], games[i]))
            return error_set(error, "there is no memory for the heat of the nodes");
    return true;
}

/* ---- What is drawn ------------------------------------------------------------------------------------------- */

/* The pixels of a pair that are unlike, and what of the reference is at each of their samples. */
typedef struct spots {
    size_t *at; /* y * width + x */
    size_t count;
    uint32_t *numbers; /* of the reference: samples * samples of each */
    int width, samples;
} spots;

static void release_spots(spots *s)
{
    free(s->at);
    free(s->numbers);
}

static bool list_spots(const image *a, const image *b, const diff_pair *pair, const diff_options *options, int samples,
                       spots *s)
{
    image_tolerance tolerance;
    *s = (spots){.width = a->width, .samples = samples};
    s->at = malloc(((size_t)pair->difference.unlike.pixels + 1) * sizeof *s->at);
    const bool ok = pair_tolerance(pair, options, &tolerance) && s->at;
    for (int y = 0; ok && y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            const image_color p = image_color_at(a, x, y), q = image_color_at(b, x, y);
            if ((p.r != q.r || p.g != q.g || p.b != q.b) && !image_is_ignored(&tolerance, a->width, x, y) &&
                s->count < pair->difference.unlike.pixels)
                s->at[s->count++] = (size_t)y * (size_t)a->width + (size_t)x;
        }
    pair_tolerance_release(&tolerance);
    s->numbers = ok ? calloc(s->count + 1, sizeof *s->numbers * (size_t)(samples * samples)) : NULL;
    return s->numbers != NULL;
}

/* The number at one of the samples of a spot. */
static uint32_t number_at(const spots *s, const uint32_t *numbers, size_t spot, int sample)
{
    const size_t samples = (size_t)s->samples, width = (size_t)s->width;
    const size_t x = s->at[spot] % width * samples + (size_t)sample % samples;
    const size_t y = s->at[spot] / width * samples + (size_t)sample / samples;
    return numbers[y * width * samples + x];
}

static void keep_numbers(spots *s, const uint32_t *numbers)
{
    const int all = s->samples * s->samples;
    for (size_t i = 0; i < s->count; i++)
        for (int j = 0; j < all; j++)
            s->numbers[i * (size_t)all + (size_t)j] = number_at(s, numbers, i, j);
}

/* ---- What it belongs to -------------------------------------------------------------------------------------- */

/* The highest node on the way to this one, or itself, in which the trees differ: there on one side alone, or inner on
 * one side and a leaf on the other. 0: none. */
static octree_address changed_node(const octree_game *const games[2], octree_address node)
{
    const unsigned depth = octree_address_depth(node);
    octree_node both[2];
    for (unsigned d = 0; d <= depth; d++) {
        const octree_address above = node >> 3 * (depth - d);
        const bool in_a = octree_node_at(octree_game_tree(games[0]), above, &both[0]) == OCTREE_OK;
        const bool in_b = octree_node_at(octree_game_tree(games[1]), above, &both[1]) == OCTREE_OK;
        if (in_a != in_b || (in_a && both[0].leaf != both[1].leaf))
            return above;
    }
    return 0;
}

/* Points, and nodes in the layer that has all of them or where they are what differs, are told one by one; of other
 * layers what they show is told as one. */
static trace_part part_of(const scene *s, uint32_t number, const octree_game *const games[2])
{
    trace_part part = {.layer = TRACE_BACKGROUND, .pixels = 1};
    if (number == 0)
        return part;
    const scene_element element = scene_element_at(s, number);
    part.layer = scene_style_of(s, element).layer;
    const bool about_node = part.layer == LAYER_NODES || part.layer == LAYER_VISITED || part.layer == LAYER_PRUNED ||
                            part.layer == LAYER_HIT;
    const octree_address changed = about_node ? changed_node(games, scene_id_of(s, element)) : 0;
    if (changed)
        part.layer = LAYER_NODES;
    if (changed || part.layer == LAYER_NODES || part.layer == LAYER_POINTS)
        part.id = changed ? changed : scene_id_of(s, element);
    return part;
}

/* Of what both sides show the one on top: the layers' order is that of covering, and the background is below all. */
static trace_part upper(trace_part a, trace_part b)
{
    if (a.layer == TRACE_BACKGROUND || b.layer == TRACE_BACKGROUND)
        return a.layer == TRACE_BACKGROUND ? b : a;
    return a.layer > b.layer ? a : b;
}

static bool same_part(trace_part a, trace_part b)
{
    return a.layer == b.layer && a.id == b.id;
}

/* Of the samples of a pixel the first at which the sides show unlike elements; else the first that shows any. */
static trace_part part_at(const tracer *t, const octree_game *const games[2], const spots *s, const uint32_t *numbers,
                          size_t spot)
{
    const int all = s->samples * s->samples;
    trace_part found = {.layer = TRACE_BACKGROUND, .pixels = 1};
    for (int i = 0; i < all; i++) {
        const trace_part a = part_of(&t->scenes[0], s->numbers[spot * (size_t)all + (size_t)i], games);
        const trace_part b = part_of(&t->scenes[1], number_at(s, numbers, spot, i), games);
        if (!same_part(a, b))
            return upper(a, b);
        if (found.layer == TRACE_BACKGROUND)
            found = b;
    }
    return found;
}

static int by_part(const void *a, const void *b)
{
    const trace_part *x = a, *y = b;
    return x->layer != y->layer ? x->layer - y->layer : (x->id > y->id) - (x->id < y->id);
}

static int by_pixels(const void *a, const void *b)
{
    const trace_part *x = a, *y = b;
    return x->pixels != y->pixels ? (x->pixels < y->pixels) - (x->pixels > y->pixels) : by_part(a, b);
}

/* Add up what is of one part; returns how many parts there are. */
static size_t fold(trace_part *parts, size_t count)
{
    size_t kept = 0;
    if (count == 0)
        return 0;
    qsort(parts, count, sizeof *parts, by_part);
    for (size_t i = 0; i < count; i++) {
        if (kept && same_part(parts[kept - 1], parts[i]))
            parts[kept - 1].pixels += parts[i].pixels;
        else
            parts[kept++] = parts[i];
    }
    qsort(parts, kept, sizeof *parts, by_pixels);
    return kept;
}

static bool keep_trace(tracer *t, const trace *made)
{
    if (t->count == t->room) {
        const size_t room = t->room ? 2 * t->room : 16;
        trace *grown = realloc(t->traces, room * sizeof *grown);
        if (!grown)
            return false;
        t->traces = grown;
        t->room = room;
    }
    t->traces[t->count++] = *made;
    return true;
}

/* Make room for one more: by adding up first, and by memory where that does not help. */
static bool make_room(trace *made, size_t *room)
{
    if (made->count < *room)
        return true;
    made->count = fold(made->parts, made->count);
    if (made->parts && made->count < *room / 2)
        return true;
    trace_part *grown = realloc(made->parts, (*room + PORTION) * sizeof *grown);
    if (!grown)
        return false;
    made->parts = grown;
    *room += PORTION;
    return true;
}

static bool add_trace(tracer *t, const octree_game *const games[2], const spots *s, const uint32_t *numbers)
{
    trace made = {.tick = octree_game_tick(games[0])->number, .pixels = s->count};
    size_t room = 0;
    bool ok = true;
    for (size_t i = 0; ok && i < s->count; i++) {
        ok = make_room(&made, &room);
        if (ok)
            made.parts[made.count++] = part_at(t, games, s, numbers, i);
    }
    made.count = fold(made.parts, made.count);
    if (ok && keep_trace(t, &made))
        return true;
    free(made.parts);
    return false;
}

/* ---- A pair -------------------------------------------------------------------------------------------------- */

/* Where nothing draws, that is said once. */
static bool pick(tracer *t, const scene *s, uint32_t *numbers)
{
    const renderer_choice choice = {0};
    const int samples = view_samples(&s->view);
    octreel_error why = {""};
    if (!t->renderer && !*t->untraced)
        t->renderer = renderer_open(s->view.width * samples, s->view.height * samples, &choice, &why);
    if (t->renderer && renderer_pick(t->renderer, s, numbers, &why))
        return true;
    if (!*t->untraced)
        snprintf(t->untraced, sizeof t->untraced, "%s", why.text);
    return false;
}

/* Both frames, where they are those of the scenes that are at hand. */
static bool read_frames(const tracer *t, const diff_pair *pair, image frames[2])
{
    const diff_frame *const files[2] = {pair->a, pair->b};
    bool ok = true;
    for (int i = 0; i < 2; i++) {
        frame_origin origin;
        octreel_error ignored;
        const view *v = &t->scenes[i].view;
        ok = ok && frame_read_origin(files[i]->path, &origin) && origin.scene == scene_digest(&t->scenes[i]) &&
             image_read_png(files[i]->path, &frames[i], &ignored) && frames[i].width == v->width &&
             frames[i].height == v->height;
    }
    return ok;
}

static bool trace_frames(tracer *t, const octree_game *const games[2], const diff_pair *pair,
                         const diff_options *options, const image frames[2], octreel_error *error)
{
    const int samples = view_samples(&t->scenes[0].view);
    const size_t size = (size_t)frames[0].width * (size_t)frames[0].height * (size_t)(samples * samples);
    spots s;
    if (size > MOST_SAMPLES) {
        snprintf(t->untraced, sizeof t->untraced, "a picture of more than %zu samples is too large for it",
                 MOST_SAMPLES);
        return true;
    }
    uint32_t *numbers = malloc(size * sizeof *numbers);
    bool ok = list_spots(&frames[0], &frames[1], pair, options, samples, &s) && numbers;
    if (ok && pick(t, &t->scenes[0], numbers)) {
        keep_numbers(&s, numbers);
        ok = !pick(t, &t->scenes[1], numbers) || add_trace(t, games, &s, numbers);
    }
    release_spots(&s);
    free(numbers);
    return ok || error_set(error, "there is no memory to trace what differs in %s", diff_pair_name(pair));
}

bool tracer_add_pair(tracer *t, const recorded sides[2], const octree_game *const games[2], const diff_pair *pair,
                     const diff_options *options, octreel_error *error)
{
    const view *a = &sides[0].view.view, *b = &sides[1].view.view;
    image frames[2] = {{0}, {0}};
    if (a->width != b->width || a->height != b->height || view_samples(a) != view_samples(b) || *t->untraced)
        return true;
    for (int i = 0; i < 2; i++)
        if (!tick_scene_build(&t->scenes[i], &sides[i].view.view, games[i], &t->heats[i]))
            return error_set(error, "there is no memory for a scene");
    const bool ok = !read_frames(t, pair, frames) || trace_frames(t, games, pair, options, frames, error);
    image_release(&frames[0]);
    image_release(&frames[1]);
    return ok;
}

static int by_tick(const void *tick, const void *told)
{
    const uint64_t x = *(const uint64_t *)tick, y = ((const trace *)told)->tick;
    return (x > y) - (x < y);
}

const trace *tracer_at(const tracer *t, uint64_t tick)
{
    return t->count ? bsearch(&tick, t->traces, t->count, sizeof *t->traces, by_tick) : NULL;
}
