/* SPDX-License-Identifier: MIT */
/* trace.c - finds the elements that are drawn at the pixels in which two frames differ.
 *
 * The problem: "312 pixels differ" does not help a user; "180 pixels of node 0/3/7" does. But a PNG file does not say
 * which element drew a pixel.
 *
 * The idea: rebuild the scenes of both frames and draw them once more, with element numbers in place of colours
 * (renderer_find_element_numbers()). For each differing pixel, look up the element in each of the two scenes. The upper
 * of the two elements is the one that caused the difference.
 *
 * A node may be drawn in only one scene because one of its ancestors is divided only there. Its pixels are then counted
 * for this ancestor, so that one change in the tree is reported once and not once for each descendant. A hash table
 * adds up the pixels of equal elements. The elements are then sorted by their number of pixels. Frames that do not show
 * the scene of their tick are not traced.
 *
 * Cost: two drawings, and 8 bytes for each sample of a picture. */
#include "trace.h"
#include "array.h"
#include "frame_file.h"
#include "hash_map.h"
#include "png_read.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>

/* The largest number of samples of a traced picture. Larger pictures are not traced, because each sample needs 8
 * bytes. */
#define MOST_SAMPLES ((size_t)1 << 25)

void tracer_close(tracer *t)
{
    for (int i = 0; i < 2; i++) {
        tick_history_release(&t->histories[i]);
        scene_release(&t->scenes[i]);
    }
    renderer_close(t->renderer);
    *t = (tracer){0};
}

bool tracer_add_tick(tracer *t, const recorded sides[2], const octree_game *const games[2], octreel_error *error)
{
    for (int i = 0; i < 2; i++)
        if (!tick_history_add(&t->histories[i], &sides[i].view.view, games[i]))
            return error_no_memory(error);
    return true;
}

/* ---- Parts of a scene ------------------------------------------------------------------------------------------ */

/* Among a node and its ancestors, return the highest changed node, or 0 if none of them is changed. A node is
 * changed if it exists in only one of the two trees, or is a leaf in only one of them. */
static octree_address find_changed_node(const octree_game *const games[2], octree_address node)
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

/* Return the part to which an element belongs. In the layers of nodes and points, each node and each point is a part
 * of its own. Every other layer is one part. */
static trace_part find_part_of_element(const scene *s, uint32_t number, const octree_game *const games[2])
{
    trace_part part = {.layer = TRACE_BACKGROUND, .pixels = 1};
    if (number == 0)
        return part;
    const scene_element element = scene_element_at(s, number);
    part.layer = scene_element_head(s, element).style.layer;
    const bool about_node = part.layer == LAYER_NODES || part.layer == LAYER_VISITED || part.layer == LAYER_PRUNED ||
                            part.layer == LAYER_HIT;
    const octree_address changed = about_node ? find_changed_node(games, scene_element_head(s, element).id) : 0;
    if (changed)
        part.layer = LAYER_NODES;
    if (changed || part.layer == LAYER_NODES || part.layer == LAYER_POINTS)
        part.id = changed ? changed : scene_element_head(s, element).id;
    return part;
}

/* Of two parts, return the part that is drawn on top. Layers are numbered in the order in which they are drawn; the
 * background is below all layers. */
static trace_part choose_upper_part(trace_part a, trace_part b)
{
    if (a.layer == TRACE_BACKGROUND || b.layer == TRACE_BACKGROUND)
        return a.layer == TRACE_BACKGROUND ? b : a;
    return a.layer > b.layer ? a : b;
}

static bool are_parts_equal(const void *a, const void *b)
{
    const trace_part *x = a, *y = b;
    return x->layer == y->layer && x->id == y->id;
}

/* The state while a pair of frames is traced. */
typedef struct tracing {
    const tracer *tracer;
    const octree_game *const *games;
    image frames[2];
    uint32_t *numbers[2]; /* for each of the two scenes, the number of the element drawn at each sample */
    size_t samples;       /* the number of samples of a pixel along each axis */
    trace made;
    size_t room;
    hash_map map; /* maps a part to its index in made.parts */
} tracing;

/* Return the part that differs at a pixel: the part at the first sample of the pixel at which the two scenes show
 * different parts. If all samples are equal, return the part at the first sample that shows an element. */
static trace_part find_part_at_pixel(const tracing *t, size_t x, size_t y)
{
    const size_t width = (size_t)t->frames[0].width;
    trace_part found = {.layer = TRACE_BACKGROUND, .pixels = 1};
    for (size_t i = 0; i < t->samples * t->samples; i++) {
        const size_t row = y * t->samples + i / t->samples;
        const size_t at = (row * width + x) * t->samples + i % t->samples;
        const trace_part a = find_part_of_element(&t->tracer->scenes[0], t->numbers[0][at], t->games);
        const trace_part b = find_part_of_element(&t->tracer->scenes[1], t->numbers[1][at], t->games);
        if (!are_parts_equal(&a, &b))
            return choose_upper_part(a, b);
        if (found.layer == TRACE_BACKGROUND)
            found = b;
    }
    return found;
}

/* ---- Counting pixels ------------------------------------------------------------------------------------------- */

static uint64_t hash_part(const void *part)
{
    const trace_part *p = part;
    const uint64_t key = p->id * (TRACE_BACKGROUND + 1) + (uint64_t)p->layer;
    return hash_map_hash_id(&key);
}

static const hash_map_item_type part_type = {sizeof(trace_part), hash_part, are_parts_equal};

static bool add_pixel_to_part(tracing *t, const trace_part *part)
{
    trace *made = &t->made;
    const uint32_t place = hash_map_find(&t->map, &part_type, made->parts, part);
    made->pixels++;
    if (place != HASH_MAP_NONE) {
        made->parts[place].pixels++;
        return true;
    }
    if (!array_grow(&made->parts, made->count + 1, &t->room, sizeof *made->parts))
        return false;
    made->parts[made->count++] = *part;
    return hash_map_add(&t->map, &part_type, made->parts);
}

static int compare_by_pixels(const void *a, const void *b)
{
    const trace_part *x = a, *y = b;
    if (x->pixels != y->pixels)
        return x->pixels < y->pixels ? 1 : -1;
    return x->layer != y->layer ? x->layer - y->layer : (x->id > y->id) - (x->id < y->id);
}

/* Count, for each part, the pixels that differ and are not ignored. */
static bool count_pixels_of_parts(tracing *t, const image_tolerance *tolerance)
{
    const image *frames = t->frames;
    for (int y = 0; y < frames[0].height; y++)
        for (int x = 0; x < frames[0].width; x++) {
            const image_color a = image_color_at(&frames[0], x, y), b = image_color_at(&frames[1], x, y);
            if ((a.r == b.r && a.g == b.g && a.b == b.b) || image_is_pixel_ignored(tolerance, frames[0].width, x, y))
                continue;
            const trace_part part = find_part_at_pixel(t, (size_t)x, (size_t)y);
            if (!add_pixel_to_part(t, &part))
                return false;
        }
    if (t->made.count)
        qsort(t->made.parts, t->made.count, sizeof *t->made.parts, compare_by_pixels);
    t->made.made = true;
    return true;
}

/* ---- A pair -------------------------------------------------------------------------------------------------- */

/* Draw a scene with element numbers instead of colours. If no renderer can be opened, nothing is traced, and
 * t->untraced keeps the first reason. */
static bool draw_element_numbers(tracer *t, const scene *s, uint32_t *numbers)
{
    const renderer_choice choice = {0};
    const int samples = s->view.aa;
    octreel_error why = {""};
    if (!t->renderer && !*t->untraced)
        t->renderer = renderer_open(s->view.width * samples, s->view.height * samples, &choice, &why);
    if (t->renderer && renderer_find_element_numbers(t->renderer, s, numbers, &why))
        return true;
    if (!*t->untraced)
        snprintf(t->untraced, sizeof t->untraced, "%.*s", (int)sizeof t->untraced - 1, why.text);
    return false;
}

/* Read both frames. Return false if a frame does not show the scene of its tick. */
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

/* Trace a pair of frames. Return false only if memory runs out. */
static bool trace_frames(tracer *t, tracing *state, const diff_pair *pair, const diff_options *options)
{
    const size_t pixels = (size_t)state->frames[0].width * (size_t)state->frames[0].height;
    const size_t size = pixels * state->samples * state->samples;
    image_tolerance tolerance;
    if (size > MOST_SAMPLES) {
        snprintf(t->untraced, sizeof t->untraced, "pictures of more than %zu samples are not traced", MOST_SAMPLES);
        return true;
    }
    for (int i = 0; i < 2; i++) {
        state->numbers[i] = malloc(size * sizeof *state->numbers[i]);
        if (!state->numbers[i])
            return false;
        if (!draw_element_numbers(t, &t->scenes[i], state->numbers[i]))
            return true;
    }
    const bool ok = pair_tolerance(pair, options, &tolerance) && count_pixels_of_parts(state, &tolerance);
    pair_tolerance_release(&tolerance);
    return ok;
}

bool tracer_trace(tracer *t, const recorded sides[2], const octree_game *const games[2], const diff_pair *pair,
                  const diff_options *options, trace *made, octreel_error *error)
{
    const view *a = &sides[0].view.view, *b = &sides[1].view.view;
    tracing state = {.tracer = t, .games = games, .samples = (size_t)a->aa};
    if (a->width != b->width || a->height != b->height || a->aa != b->aa || *t->untraced)
        return true;
    for (int i = 0; i < 2; i++)
        if (!tick_scene_build(&t->scenes[i], &sides[i].view.view, games[i], &t->histories[i],
                              &sides[i].replay.session.values))
            return error_no_memory(error);
    const bool ok = !read_frames(t, pair, state.frames) || trace_frames(t, &state, pair, options);
    *made = state.made;
    hash_map_release(&state.map);
    for (int i = 0; i < 2; i++) {
        free(state.numbers[i]);
        image_release(&state.frames[i]);
    }
    return ok || error_no_memory(error);
}

/* ---- In words ------------------------------------------------------------------------------------------------ */

const char *trace_part_text(const trace_part *part, char text[TRACE_TEXT])
{
    char address[OCTREE_ADDRESS_TEXT];
    if (part->layer == TRACE_BACKGROUND)
        return "the background";
    if (part->layer == LAYER_NODES)
        snprintf(text, TRACE_TEXT, "node %s", octree_address_format(part->id, address));
    else if (part->layer == LAYER_POINTS)
        snprintf(text, TRACE_TEXT, "point %" PRIu64, part->id);
    else
        return layer_rows[part->layer].words;
    return text;
}

void trace_print(FILE *out, const trace *t)
{
    const size_t most = t->count < TRACE_PRINTED ? t->count : TRACE_PRINTED;
    uint64_t printed = 0;
    char text[TRACE_TEXT];
    fprintf(out, "%" PRIu64 " pixel%s: ", t->pixels, plural_ending(t->pixels));
    for (int is_text = 0; is_text < 2; is_text++) /* text is printed last, because text differs in most frames */
        for (size_t i = 0; i < most; i++) {
            if ((t->parts[i].layer == LAYER_TEXT) != is_text)
                continue;
            fprintf(out, "%s%" PRIu64 " of %s", printed ? ", " : "", t->parts[i].pixels,
                    trace_part_text(&t->parts[i], text));
            printed += t->parts[i].pixels;
        }
    if (printed < t->pixels)
        fprintf(out, ", %" PRIu64 " of others", t->pixels - printed);
}
