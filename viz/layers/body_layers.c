/* SPDX-License-Identifier: MIT */
/* body_layers.c - two layers of bodies with extent. The first shows the box of each body; the second shows where the
 * boxes of two bodies overlap.
 *
 * A body is also a point of the tree, so the layer of points has a marker at its centre. The box of a body that appears
 * smaller than SMALLEST pixels would hide this marker, and is left out. The other rules are those of points: the view's
 * filter shows a body if it shows its point, and a body whose point is beyond the view's budget has no box. If the
 * points are hidden, at most as many boxes are shown as the budget allows, chosen by a sieve over their ids
 * (node_boxes.h). Boxes are added in the order of ids, because a scene must not depend on the tree's history.
 * Cost: O(points) for the search, and O(n log n) for n boxes; nothing in a session without bodies. */
#include "body_boxes.h"
#include "layer_type.h"
#include "node_boxes.h"
#include "octree/bodies.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* In pixels. The twelve edges of a smaller box run together, and look like a large point. */
#define SMALLEST 8.0

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* Returns whether a body of the tick has an extent. */
static bool has_bodies(const layer_source *in)
{
    double reach[3] = {0, 0, 0};
    return in->game && octree_bodies_level(octree_game_bodies(in->game), OCTREE_BODY_LEVELS - 1, reach) &&
           has_extent(reach);
}

static bool session_has_bodies(const octree_session *session)
{
    for (size_t i = 0; i < session->body_count; i++)
        if (has_extent(session->bodies[i].half))
            return true;
    for (size_t i = 0; i < session->edit_count; i++)
        if (session->edits[i].kind == OCTREE_EDIT_INSERT && has_extent(session->edits[i].body.half))
            return true;
    return false;
}

/* The bodies whose boxes are shown. */
typedef struct box_selection {
    const scene *scene;
    const layer_source *in;
    uint64_t sieve;
    ARRAY(octree_body) bodies;
    bool out_of_memory;
} box_selection;

/* An octree_body_visitor that selects a body whose box is shown. */
static bool select_body(const octree_body *body, void *context)
{
    box_selection *b = context;
    if (!has_extent(body->half) || sieve_rejects_id(b->sieve, body->id) ||
        !is_position_shown(&b->scene->view.filter, b->in->tree, &b->in->world, body->position))
        return true;
    const octree_box box = box_of_body(body);
    if (camera_is_box_smaller_than(&b->scene->camera, &box, SMALLEST))
        return true;
    b->out_of_memory = !ARRAY_GROW(&b->bodies, 1);
    if (!b->out_of_memory)
        b->bodies.items[b->bodies.count++] = *body;
    return !b->out_of_memory;
}

/* Drop about half of the bodies until their number is within the budget. */
static void thin_bodies_to_budget(box_selection *b)
{
    const size_t budget = b->scene->view.budget;
    while (budget && b->bodies.count > budget && b->sieve != UINT64_MAX) {
        size_t kept = 0;
        b->sieve = make_finer_sieve(b->sieve);
        for (size_t i = 0; i < b->bodies.count; i++)
            if (!sieve_rejects_id(b->sieve, b->bodies.items[i].id))
                b->bodies.items[kept++] = b->bodies.items[i];
        b->bodies.count = kept;
    }
}

static void add_bodies(scene *s, const layer_source *in, view_layer layer)
{
    static const octree_region all = {.kind = OCTREE_REGION_BOX,
                                      .box = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}}};
    box_selection b = {.scene = s, .in = in, .sieve = s->tally.one_in ? s->tally.one_in - 1 : 0};
    /* The region is valid, so the search cannot fail. */
    octree_bodies_search(octree_game_bodies(in->game), &all, NULL, select_body, &b);
    thin_bodies_to_budget(&b);
    if (b.bodies.count)
        qsort(b.bodies.items, b.bodies.count, sizeof *b.bodies.items, octree_compare_bodies);
    for (size_t i = 0; i < b.bodies.count; i++) {
        const octree_box box = box_of_body(&b.bodies.items[i]);
        scene_add_outline(s, b.bodies.items[i].id, &box, make_layer_style(layer, STROKE_SOLID, 2));
    }
    s->out_of_memory = s->out_of_memory || b.out_of_memory;
    free(b.bodies.items);
}

static void describe_body(description *d, const described_element *element)
{
    octree_body body;
    if (!octree_game_find_body(d->game, element->id, &body))
        return;
    describe_point(d, "the box of ", body.id, body.position);
    append_position(d, ", half extents ", body.half);
}

const layer_type layer_BODIES = {.applies = has_bodies,
                                 .in_session = session_has_bodies,
                                 .add = add_bodies,
                                 .legend = {.order = 35, .sign = SIGN_BOLD, .text = "box of a body"},
                                 .describe = describe_body};

/* ---- Pairs -------------------------------------------------------------------------------------------------- */

static bool has_pairs(const layer_source *in)
{
    return in->game && in->tick->pair_count > 0;
}

static bool session_has_pairs(const octree_session *session)
{
    return session->pairs;
}

/* Store the part that two boxes have in common. The boxes are rounded, so that it may be empty by an ulp; the side is
 * then flat. */
static octree_box intersect_boxes(const octree_box *a, const octree_box *b)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = fmax(a->min[i], b->min[i]);
        box.max[i] = fmax(box.min[i], fmin(a->max[i], b->max[i]));
    }
    return box;
}

/* The bodies of a pair, and what their boxes have in common. */
typedef struct overlap {
    octree_body a, b;
    octree_box box;
} overlap;

/* Find the overlap of a pair of the game's last tick. */
static bool find_overlap(const octree_game *game, const octree_pair *pair, overlap *found)
{
    if (!octree_game_find_body(game, pair->a, &found->a) || !octree_game_find_body(game, pair->b, &found->b))
        return false;
    const octree_box first = box_of_body(&found->a), second = box_of_body(&found->b);
    found->box = intersect_boxes(&first, &second);
    return true;
}

/* The id of an overlap is the index of its pair. A pair is shown if both of its points are. */
static void add_pairs(scene *s, const layer_source *in, view_layer layer)
{
    const view_filter *filter = &s->view.filter;
    const size_t most = s->view.budget ? s->view.budget : SIZE_MAX;
    for (size_t i = 0; i < in->tick->pair_count && i < most; i++) {
        overlap o;
        double middle[3];
        if (!find_overlap(in->game, &in->tick->pairs[i], &o) ||
            !is_position_shown(filter, in->tree, &in->world, o.a.position) ||
            !is_position_shown(filter, in->tree, &in->world, o.b.position))
            continue;
        scene_box_middle(&o.box, middle);
        if (camera_is_box_smaller_than(&s->camera, &o.box, SMALLEST))
            scene_add_mark(s, i, middle, SHAPE_CROSS, make_layer_style(layer, STROKE_SOLID, 6));
        else
            scene_add_outline(s, i, &o.box, make_layer_style(layer, STROKE_SOLID, 3));
    }
}

static void add_pair_legend(legend *l, const layer_source *in)
{
    legend_add(l, SIGN_BOLD, "%zu pair%s overlap%s", in->tick->pair_count, plural_ending(in->tick->pair_count),
               verb_ending(in->tick->pair_count));
}

static void describe_pair(description *d, const described_element *element)
{
    const octree_pair *pair = &d->tick->pairs[element->id];
    overlap o;
    if (!find_overlap(d->game, pair, &o))
        return;
    append_text(d, "the overlap of body %" PRIu64 " and body %" PRIu64, pair->a, pair->b);
    append_box(d, ", box ", &o.box);
}

const layer_type layer_PAIRS = {.applies = has_pairs,
                                .in_session = session_has_pairs,
                                .add = add_pairs,
                                .legend = {.order = 157, .add_lines = add_pair_legend},
                                .describe = describe_pair};
