/* SPDX-License-Identifier: MIT */
/* wrong_pairs.c - draws the missing and the extra pairs of a foreign index.
 *
 * A pair is a line from the centre of one body to that of the other. The line has a bend, where its marker stands: in
 * the middle of what the two boxes have in common or, if they do not overlap, in the middle of the gap between them. So
 * the marker shows the overlap that the index did not find even if one of the bodies is as large as a floor. */
#include "wrong_pairs.h"
#include "body_boxes.h"
#include "judgement.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define PAIR_ELEMENT (UINT64_C(1) << 63)
#define RING_ELEMENT (PAIR_ELEMENT | UINT64_C(1) << 61)

/* The width of a line is this part of the size of its marker. */
#define LINE_PART 3

/* The two bodies of a pair, and the position of its marker. */
typedef struct located_pair {
    octree_body a, b;
    double middle[3];
} located_pair;

/* Find the bodies of a pair. Return false if one of them does not exist. */
static bool locate_pair(const octree_game *game, const octree_pair *pair, located_pair *p)
{
    if (!octree_game_find_body(game, pair->a, &p->a) || !octree_game_find_body(game, pair->b, &p->b))
        return false;
    const octree_box a = box_of_body(&p->a), b = box_of_body(&p->b);
    for (int i = 0; i < 3; i++)
        p->middle[i] = fmax(a.min[i], b.min[i]) / 2 + fmin(a.max[i], b.max[i]) / 2;
    return true;
}

bool has_wrong_pairs(const layer_source *in)
{
    return in->tick && in->tick->foreign_pairs.wrong;
}

/* Find the position of the ring: the first missing or extra pair or, if there is none, the pair that is given twice, or
 * the body beside an unknown id. Return false if that body does not exist either. */
static bool find_ring_position(const layer_source *in, double at[3])
{
    const octree_pair_judgement *made = &in->tick->foreign_pairs;
    const octree_pair *pair = made->missing_count ? made->missing : made->extra_count ? made->extra : &made->wrong_pair;
    located_pair p;
    octree_point beside;
    const bool whole = locate_pair(in->game, pair, &p);
    if (!whole && !octree_game_find(in->game, pair->b, &beside))
        return false;
    memcpy(at, whole ? p.middle : beside.position, sizeof p.middle);
    return true;
}

/* ---- Marks --------------------------------------------------------------------------------------------------- */

/* Draw a pair. `index` is its index among all missing pairs, followed by all extra pairs. */
static void mark_pair(scene *s, const located_pair *p, size_t index, scene_shape shape, scene_style style)
{
    const uint64_t id = PAIR_ELEMENT | (uint64_t)index << 1;
    scene_style line = style;
    line.width /= LINE_PART;
    scene_add_line(s, id, p->a.position, p->middle, line);
    scene_add_line(s, id + 1, p->middle, p->b.position, line);
    scene_add_mark(s, id, p->middle, shape, style);
}

void mark_wrong_pairs(scene *s, const layer_source *in, unsigned mark, unsigned ring, text_space *occupied)
{
    const octree_pair_judgement *made = &in->tick->foreign_pairs;
    const scene_style missing = make_role_style(LAYER_WRONG, ROLE_MISSED, STROKE_SOLID, mark);
    const scene_style extra = make_layer_style(LAYER_WRONG, STROKE_SOLID, mark);
    const size_t most = s->view.budget ? s->view.budget : SIZE_MAX;
    located_pair p;
    double at[3];
    for (size_t i = 0; i < made->missing_count && i < most; i++)
        if (locate_pair(in->game, &made->missing[i], &p))
            mark_pair(s, &p, i, SHAPE_TRIANGLE, missing);
    for (size_t i = 0; i < made->extra_count && i < most; i++)
        if (locate_pair(in->game, &made->extra[i], &p))
            mark_pair(s, &p, made->missing_count + i, SHAPE_WEDGE, extra);
    if (!find_ring_position(in, at))
        return;
    scene_add_mark(s, RING_ELEMENT, at, SHAPE_RING, make_layer_style(LAYER_WRONG, STROKE_SOLID, ring));
    text_space_reserve_mark(occupied, s, at, ring);
}

bool label_wrong_pairs(scene *s, const layer_source *in, unsigned ring, text_space *occupied)
{
    char words[JUDGEMENT_TEXT];
    double at[3];
    if (!find_ring_position(in, at))
        return true;
    const scene_label label = scene_make_label(RING_ELEMENT, make_layer_style(LAYER_WRONG, STROKE_SOLID, 1),
                                               "pairs: %s", pair_judgement_text(&in->tick->foreign_pairs, words));
    return text_space_add_label_beside(occupied, s, label, at, ring);
}

bool has_ring_of_pairs(const layer_source *in)
{
    double at[3];
    return has_wrong_pairs(in) && find_ring_position(in, at);
}

void add_wrong_pairs_legend(legend *l, const layer_source *in)
{
    if (in->tick->foreign_pairs.missing_count)
        legend_add(l, SIGN_TRIANGLE, "missing pair")->role = ROLE_MISSED;
    if (in->tick->foreign_pairs.extra_count)
        legend_add(l, SIGN_WEDGE, "extra pair");
}

/* ---- Descriptions -------------------------------------------------------------------------------------------- */

void describe_wrong_pair(description *d, const described_element *element)
{
    const octree_pair_judgement *made = &d->tick->foreign_pairs;
    char words[JUDGEMENT_TEXT];
    if ((element->id & RING_ELEMENT) == RING_ELEMENT) {
        append_text(d, "%sthe foreign pairs, which are wrong: %s",
                    element->kind == SCENE_MARKER  ? "the ring around "
                    : element->kind == SCENE_PANEL ? "the background of the text about "
                                                   : ", about ",
                    pair_judgement_text(made, words));
        return;
    }
    const uint64_t index = (element->id & ~PAIR_ELEMENT) >> 1;
    const bool missing = index < made->missing_count;
    if (index >= made->missing_count + made->extra_count)
        return;
    const octree_pair *pair = missing ? &made->missing[index] : &made->extra[index - made->missing_count];
    append_text(d, "the %s pair of body %" PRIu64 " and body %" PRIu64 ": %s", missing ? "missing" : "extra", pair->a,
                pair->b,
                missing ? "their boxes overlap, but the foreign index did not find the pair"
                        : "the foreign index found the pair, but their boxes do not overlap");
}
