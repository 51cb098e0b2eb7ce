/* SPDX-License-Identifier: MIT */
#include "scene.h"
#include "array.h"
#include "kept_tree.h"
#include "layer.h"
#include "octree/digest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void scene_clear(scene *s)
{
    s->boxes.count = s->segments.count = s->markers.count = s->labels.count = s->panels.count = 0;
    s->tally = (scene_tally){0};
    s->spacing = 0;
    s->refused = 0;
    s->out_of_memory = s->has_closeup = false;
    s->times = 0;
}

void scene_release(scene *s)
{
    free(s->boxes.items);
    free(s->segments.items);
    free(s->markers.items);
    free(s->labels.items);
    free(s->panels.items);
    if (s->closeup)
        scene_release(s->closeup);
    free(s->closeup);
    if (s->kept)
        kept_tree_release(s->kept);
    free(s->kept);
    memset(s, 0, sizeof *s);
}

/* Room for so many items. Null, and out_of_memory set, when there is none. */
static void *grow(scene *s, void *items, size_t count, size_t *room, size_t size)
{
    void *grown = array_reserve(items, count, room, size);
    if (!grown)
        s->out_of_memory = true;
    return grown;
}

/* Append an item to one of the scene's arrays. */
#define APPEND(s, array, item)                                                                                         \
    do {                                                                                                               \
        void *grown = grow(s, (array).items, (array).count + 1, &(array).room, sizeof *(array).items);                 \
        if (grown) {                                                                                                   \
            (array).items = grown;                                                                                     \
            (array).items[(array).count++] = (item);                                                                   \
        }                                                                                                              \
    } while (0)

static bool all_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Whether an element is added: its layer is shown and its geometry finite. */
static bool admits(scene *s, scene_style style, bool finite)
{
    if (!view_shows(&s->view, style.layer))
        return false;
    s->refused += !finite;
    return finite;
}

void scene_add_box(scene *s, scene_box box)
{
    if (admits(s, box.style, all_finite(box.box.min, 3) && all_finite(box.box.max, 3)))
        APPEND(s, s->boxes, box);
}

void scene_add_segment(scene *s, scene_segment segment)
{
    if (admits(s, segment.style, all_finite(segment.ends[0], 3) && all_finite(segment.ends[1], 3)))
        APPEND(s, s->segments, segment);
}

void scene_add_marker(scene *s, scene_marker marker)
{
    if (admits(s, marker.style, all_finite(marker.at, 3)))
        APPEND(s, s->markers, marker);
}

void scene_add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style)
{
    scene_add_segment(
        s, (scene_segment){.id = id, .ends = {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}}, .style = style});
}

void scene_add_mark(scene *s, uint64_t id, const double at[3], scene_shape shape, scene_style style)
{
    scene_add_marker(s, (scene_marker){.id = id, .at = {at[0], at[1], at[2]}, .style = style, .shape = (uint8_t)shape});
}

/* Room is made once for all: one call a point took 2 % more instructions for the picture of a cloud. */
void scene_add_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style)
{
    if (count == 0 || !view_shows(&s->view, style.layer))
        return;
    void *grown = grow(s, s->markers.items, s->markers.count + count, &s->markers.room, sizeof *s->markers.items);
    if (!grown)
        return;
    s->markers.items = grown;
    for (size_t i = 0; i < count; i++) {
        const double *at = points[i].position;
        const bool finite = all_finite(at, 3);
        s->markers.items[s->markers.count] =
            (scene_marker){.id = points[i].id, .at = {at[0], at[1], at[2]}, .style = style, .shape = (uint8_t)shape};
        s->markers.count += finite;
        s->refused += !finite;
    }
}

void scene_add_markers(scene *s, const scene_marker *markers, size_t count)
{
    if (count == 0)
        return;
    void *grown = grow(s, s->markers.items, s->markers.count + count, &s->markers.room, sizeof *s->markers.items);
    if (!grown)
        return;
    s->markers.items = grown;
    memcpy(s->markers.items + s->markers.count, markers, count * sizeof *markers);
    s->markers.count += count;
}

void scene_add_rectangle(scene *s, uint64_t id, const int at[2], const int size[2], unsigned layer, unsigned role)
{
    scene_add_panel(s, (scene_panel){.id = id,
                                     .x = at[0],
                                     .y = at[1],
                                     .width = size[0],
                                     .height = size[1],
                                     .style = {.layer = (uint8_t)layer, .role = (uint8_t)role}});
}

void scene_set_view(scene *s, const view *v)
{
    s->view = *v;
    s->unit = view_unit(v);
    s->text = lettering_of_text(v);
    s->title = lettering_of_title(v);
}

void scene_add_label(scene *s, scene_label label)
{
    if (admits(s, label.style, all_finite(label.at, 3)))
        APPEND(s, s->labels, label);
}

void scene_add_panel(scene *s, scene_panel panel)
{
    if (admits(s, panel.style, true))
        APPEND(s, s->panels, panel);
}

static const char *const kind_names[SCENE_KINDS] = {"box", "segment", "marker", "panel", "label"};

const char *scene_kind_name(scene_kind kind)
{
    return kind_names[kind];
}

static size_t count_of(const scene *s, scene_kind kind)
{
    const size_t counts[SCENE_KINDS] = {s->boxes.count, s->segments.count, s->markers.count, s->panels.count,
                                        s->labels.count};
    return counts[kind];
}

size_t scene_count(const scene *s)
{
    return s->boxes.count + s->segments.count + s->markers.count + s->panels.count + s->labels.count;
}

scene_element scene_element_at(const scene *s, uint32_t number)
{
    scene_element element = {SCENE_BOX, number - 1, s->has_closeup && number > scene_count(s)};
    element.index -= element.in_closeup ? scene_count(s) : 0;
    s = scene_with(s, element);
    while (element.kind < SCENE_LABEL && element.index >= count_of(s, element.kind))
        element.index -= count_of(s, element.kind++);
    return element;
}

uint32_t scene_number_of(const scene *s, scene_element element)
{
    size_t number = element.index + 1 + (element.in_closeup ? scene_count(s) : 0);
    s = scene_with(s, element);
    for (scene_kind kind = SCENE_BOX; kind < element.kind; kind++)
        number += count_of(s, kind);
    return (uint32_t)number;
}

scene_head scene_head_of(const scene *s, scene_element element)
{
    s = scene_with(s, element);
    const void *const arrays[SCENE_KINDS] = {s->boxes.items, s->segments.items, s->markers.items, s->panels.items,
                                             s->labels.items};
    static const size_t sizes[SCENE_KINDS] = {sizeof(scene_box), sizeof(scene_segment), sizeof(scene_marker),
                                              sizeof(scene_panel), sizeof(scene_label)};
    scene_head head;
    memcpy(&head, (const char *)arrays[element.kind] + element.index * sizes[element.kind], sizeof head);
    return head;
}

/* ---- The digest --------------------------------------------------------------------------------------------- */

static uint64_t digest_doubles(uint64_t digest, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        digest = octree_digest_double(digest, values[i]);
    return digest;
}

/* Layers and roles enter a digest as hashes of their names, so that adding one does not change the digests of scenes
 * without it. */
typedef struct digest_names {
    uint64_t layers[LAYER_ALL], roles[ROLE_OWN + 1];
} digest_names;

static uint64_t hash_name(const char *what, const char *name)
{
    return octree_digest_bytes(octree_digest_bytes(OCTREE_DIGEST_START, what, strlen(what)), name, strlen(name));
}

static digest_names hash_names(void)
{
    digest_names n;
    for (int i = 0; i < LAYER_ALL; i++)
        n.layers[i] = hash_name("layer ", layer_rows[i].name);
    for (int i = 0; i <= ROLE_OWN; i++)
        n.roles[i] = hash_name("role ", theme_role_name((theme_role)i));
    return n;
}

static uint64_t digest_style(const digest_names *n, uint64_t id, scene_style style, unsigned extra)
{
    const uint64_t how = (uint64_t)style.stroke | (uint64_t)style.width << 8 | (uint64_t)extra << 16;
    const uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
    return octree_digest_word(digest, n->layers[style.layer] + n->roles[style.role] + how);
}

/* Where points are painted, how. */
static uint64_t digest_painting(const scene *s, uint64_t digest)
{
    if (!view_paints_points(&s->view))
        return digest;
    digest = octree_digest_word(digest, hash_name("color ", view_point_color_name(s->view.point_color)));
    digest = octree_digest_word(digest, hash_name("shade ", view_shade_name(s->view.shade)));
    return octree_digest_double(digest, s->spacing);
}

static uint64_t digest_lettering(uint64_t digest, const lettering *l)
{
    return octree_digest_word(digest, (uint64_t)l->face << 32 | (uint64_t)(uint32_t)l->multiple);
}

static uint64_t digest_view(const scene *s)
{
    const camera *c = &s->camera;
    uint64_t digest = OCTREE_DIGEST_START;
    digest = octree_digest_word(digest, (uint64_t)s->view.width << 32 | (uint64_t)s->view.height);
    digest = octree_digest_word(digest, (uint64_t)s->unit);
    digest = digest_lettering(digest, &s->text);
    digest = digest_lettering(digest, &s->title);
    digest = digest_doubles(digest, c->origin, 3);
    digest = digest_doubles(digest, c->half, 3);
    digest = digest_doubles(digest, (double[]){c->scale, c->size}, 2);
    digest = digest_doubles(digest, c->right, 3);
    digest = digest_doubles(digest, c->up, 3);
    digest = digest_doubles(digest, c->forward, 3);
    digest = digest_doubles(digest, c->eye, 3);
    digest = digest_doubles(digest, (double[]){c->perspective, c->zoom, c->near, c->near_depth, c->far_depth}, 5);
    return digest_painting(s, digest_doubles(digest, c->middle, 2));
}

static uint64_t digest_box(const digest_names *n, const scene_box *box)
{
    const uint64_t digest = digest_style(n, box->id, box->style, box->depth);
    return digest_doubles(digest_doubles(digest, box->box.min, 3), box->box.max, 3);
}

static uint64_t digest_segment(const digest_names *n, const scene_segment *segment)
{
    const uint64_t digest = digest_style(n, segment->id, segment->style, segment->in_picture);
    return digest_doubles(digest_doubles(digest, segment->ends[0], 3), segment->ends[1], 3);
}

/* 0 where an element has no colour of its own. */
static unsigned word_of(theme_color color)
{
    return (unsigned)color.r << 16 | (unsigned)color.g << 8 | color.b;
}

static uint64_t digest_marker(const digest_names *n, const scene_marker *marker)
{
    const unsigned extra = marker->shape | word_of(marker->color) << 8;
    return digest_doubles(digest_style(n, marker->id, marker->style, extra), marker->at, 3);
}

static uint64_t digest_label(const digest_names *n, const scene_label *label)
{
    uint64_t digest = digest_style(n, label->id, label->style, label->in_world);
    digest = digest_doubles(digest, label->at, 3);
    return octree_digest_bytes(digest, label->text, strlen(label->text));
}

static uint64_t digest_panel(const digest_names *n, const scene_panel *panel)
{
    uint64_t digest = digest_style(n, panel->id, panel->style, word_of(panel->color));
    digest = octree_digest_word(digest, (uint64_t)(uint32_t)panel->x << 32 | (uint32_t)panel->y);
    return octree_digest_word(digest, (uint64_t)(uint32_t)panel->width << 32 | (uint32_t)panel->height);
}

/* The elements' digests are the coefficients of a polynomial, so that their order counts. Each is computed
 * independently, so that a processor can work on several at once. */
#define DIGEST_ALL(digest, array, digest_one)                                                                          \
    do {                                                                                                               \
        uint64_t sum = 0;                                                                                              \
        for (size_t i = 0; i < (array).count; i++)                                                                     \
            sum = sum * UINT64_C(0x9e3779b97f4a7c15) + digest_one(&names, &(array).items[i]);                          \
        digest = octree_digest_word(octree_digest_word(digest, (array).count), sum);                                   \
    } while (0)

uint64_t scene_digest(const scene *s)
{
    const digest_names names = hash_names();
    uint64_t digest = digest_view(s);
    DIGEST_ALL(digest, s->boxes, digest_box);
    DIGEST_ALL(digest, s->segments, digest_segment);
    DIGEST_ALL(digest, s->markers, digest_marker);
    DIGEST_ALL(digest, s->labels, digest_label);
    DIGEST_ALL(digest, s->panels, digest_panel);
    if (!s->has_closeup)
        return digest;
    digest =
        octree_digest_word(digest, (uint64_t)(uint32_t)s->closeup->place[0] << 32 | (uint32_t)s->closeup->place[1]);
    return octree_digest_word(digest, scene_digest(s->closeup));
}
