/* SPDX-License-Identifier: MIT */
/* scene_digest.c - hashes the elements of a scene; scene_digest.h explains the digest. */
#include "scene_digest.h"
#include "kept_tree.h"
#include "layer.h"
#include "octree/digest.h"

#include <string.h>

static uint64_t digest_doubles(uint64_t digest, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        digest = octree_digest_double(digest, values[i]);
    return digest;
}

static uint64_t hash_element_name(const char *what, const char *name)
{
    return octree_digest_bytes(octree_digest_bytes(OCTREE_DIGEST_START, what, strlen(what)), name, strlen(name));
}

digest_names make_digest_names(void)
{
    digest_names n;
    for (int i = 0; i < LAYER_ALL; i++)
        n.layers[i] = hash_element_name("layer ", layer_rows[i].name);
    for (int i = 0; i <= ROLE_OWN; i++)
        n.roles[i] = hash_element_name("role ", theme_role_name((theme_role)i));
    return n;
}

static uint64_t digest_style(const digest_names *n, uint64_t id, scene_style style, unsigned extra)
{
    const uint64_t how = (uint64_t)style.stroke | (uint64_t)style.width << 8 | (uint64_t)extra << 16;
    const uint64_t digest = octree_digest_word(OCTREE_DIGEST_START, id);
    return octree_digest_word(digest, n->layers[style.layer] + n->roles[style.role] + how);
}

/* Add the colouring, the shading and the spacing of painted points to a digest. If the view does not paint points,
 * return the digest unchanged. */
static uint64_t digest_point_painting(const scene *s, uint64_t digest)
{
    if (!view_paints_points(&s->view))
        return digest;
    digest = octree_digest_word(digest, hash_element_name("color ", view_point_color_name(s->view.point_color)));
    digest = octree_digest_word(digest, hash_element_name("shade ", view_shade_name(s->view.shade)));
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
    return digest_point_painting(s, digest_doubles(digest, c->middle, 2));
}

uint64_t digest_box(const digest_names *n, const scene_box *box)
{
    const uint64_t digest = digest_style(n, box->id, box->style, box->depth);
    return digest_doubles(digest_doubles(digest, box->box.min, 3), box->box.max, 3);
}

static uint64_t digest_segment(const digest_names *n, const scene_segment *segment)
{
    const uint64_t digest = digest_style(n, segment->id, segment->style, segment->in_picture);
    return digest_doubles(digest_doubles(digest, segment->ends[0], 3), segment->ends[1], 3);
}

/* Returns a colour as one number. Returns 0 for an element without a colour of its own. */
static unsigned pack_rgb(theme_color color)
{
    return (unsigned)color.r << 16 | (unsigned)color.g << 8 | color.b;
}

uint64_t digest_marker(const digest_names *n, const scene_marker *marker)
{
    const unsigned extra = marker->shape | pack_rgb(marker->color) << 8;
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
    uint64_t digest = digest_style(n, panel->id, panel->style, pack_rgb(panel->color));
    digest = octree_digest_word(digest, (uint64_t)(uint32_t)panel->x << 32 | (uint32_t)panel->y);
    return octree_digest_word(digest, (uint64_t)(uint32_t)panel->width << 32 | (uint32_t)panel->height);
}

/* Add an array to a digest. The elements before index `first` are not hashed: `known` is their polynomial
 * (scene_digest.h). Each other element is hashed separately, so that a processor can work on several elements at
 * once. */
#define DIGEST_FROM(first, known, digest, array, digest_one)                                                           \
    do {                                                                                                               \
        uint64_t all = known;                                                                                          \
        for (size_t i = first; i < (array).count; i++)                                                                 \
            all = all * DIGEST_BASE + digest_one(&names, &(array).items[i]);                                           \
        digest = octree_digest_word(octree_digest_word(digest, (array).count), all);                                   \
    } while (0)

/* Add an array to a digest. Elements in runs with a known digest are not hashed again. Runs that end beyond the array
 * are ignored. */
#define DIGEST_RUNS(digest, array, digest_one, runs)                                                                   \
    do {                                                                                                               \
        uint64_t sum = 0;                                                                                              \
        size_t at = 0;                                                                                                 \
        for (size_t run = 0; run < (runs).count && (runs).items[run].end <= (array).count; run++) {                    \
            for (; at < (runs).items[run].first; at++)                                                                 \
                sum = sum * DIGEST_BASE + digest_one(&names, &(array).items[at]);                                      \
            sum = sum * (runs).items[run].power + (runs).items[run].sum;                                               \
            at = (runs).items[run].end;                                                                                \
        }                                                                                                              \
        DIGEST_FROM(at, sum, digest, array, digest_one);                                                               \
    } while (0)

uint64_t scene_digest(const scene *s)
{
    const digest_names names = make_digest_names();
    const digest_runs none = {.count = 0}, boxes = s->kept ? s->kept->box_runs : none,
                      markers = s->kept ? s->kept->marker_runs : none;
    uint64_t digest = digest_view(s);
    DIGEST_RUNS(digest, s->boxes, digest_box, boxes);
    DIGEST_FROM(0, 0, digest, s->segments, digest_segment);
    DIGEST_RUNS(digest, s->markers, digest_marker, markers);
    DIGEST_FROM(0, 0, digest, s->labels, digest_label);
    DIGEST_FROM(0, 0, digest, s->panels, digest_panel);
    if (!s->has_closeup)
        return digest;
    digest =
        octree_digest_word(digest, (uint64_t)(uint32_t)s->closeup->place[0] << 32 | (uint32_t)s->closeup->place[1]);
    return octree_digest_word(digest, scene_digest(s->closeup));
}
