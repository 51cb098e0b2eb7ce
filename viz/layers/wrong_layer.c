/* SPDX-License-Identifier: MIT */
/* wrong_layer.c - the layer of wrong foreign answers, nodes and pairs. It marks missing and extra points and pairs. It
 * draws a ring around each wrong answer. The ring has a fixed size on screen, so that it is visible even if the answer
 * is small in the world. */
#include "foreign_nodes.h"
#include "judgement.h"
#include "layer_type.h"
#include "layout.h"
#include "wrong_pairs.h"

#include <string.h>

/* Half the size of markers, half the size of rings, and the width of lines, in halves of a picture unit. */
#define MARK 9
#define RING 28
#define LINE_WIDTH 3

/* If there are more than FEW_MARKS markers or FEW_RINGS rings, they are drawn smaller, so that they hide less. The ring
 * of the worst answer keeps its size. */
#define FEW_MARKS 50
#define FEW_RINGS 3

/* Return the element id of the ring around the wrong answer with the index `place`. A marker has the id of its point,
 * and no point of a session file can have the id of a ring. */
static uint64_t ring_id(size_t place)
{
    return UINT64_MAX - place;
}

#define LEFT_OUT_ID UINT64_MAX /* the id of the label "and 3 more wrong" */

static bool has_judged_tick(const layer_source *in)
{
    return in->tick && (in->tick->judged || shows_foreign_nodes(in));
}

static bool can_have_wrong_answers(const octree_session *session)
{
    for (size_t i = 0; i < session->query_count; i++)
        if (session->queries[i].answered)
            return true;
    return session->foreign_count > 0 || session->foreign_pairs_count > 0;
}

/* Find the middle of an answer's ring: the first missing or extra point. If there is none, the middle is the query's
 * target or the middle of the query's region. */
static void find_ring_position(const octree_answer *answer, double place[3])
{
    const octree_judgement *judgement = &answer->judgement;
    octree_box bound;
    if (judgement->missing_count)
        memcpy(place, judgement->missing[0].position, sizeof judgement->missing[0].position);
    else if (judgement->extra_count)
        memcpy(place, judgement->extra[0].position, sizeof judgement->extra[0].position);
    else if (octree_query_about(answer->kind)->members & OCTREE_QUERY_HAS_TARGET ||
             !octree_answer_bound(answer, &bound))
        memcpy(place, answer->target, sizeof answer->target);
    else
        scene_box_middle(&bound, place);
}

static void mark_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style,
                        text_space *occupied)
{
    scene_add_points(s, points, count, shape, style);
    for (size_t i = 0; i < count && i < FEW_MARKS; i++)
        text_space_reserve_mark(occupied, s, points[i].position, style.width);
}

static unsigned mark_size(size_t missing, size_t extra)
{
    return missing + extra <= FEW_MARKS ? MARK : MARK / 2;
}

static void mark_wrong_answer(scene *s, const octree_answer *answer, size_t place, unsigned ring, text_space *occupied)
{
    const octree_judgement *judgement = &answer->judgement;
    const unsigned size = mark_size(judgement->missing_count, judgement->extra_count);
    const scene_style extra = make_layer_style(LAYER_WRONG, STROKE_SOLID, size);
    const scene_style missing = make_role_style(LAYER_WRONG, ROLE_MISSED, STROKE_SOLID, size);
    double at[3];
    for (size_t i = 0; octree_query_about(answer->kind)->neighbors && i < judgement->extra_count; i++)
        scene_add_line(s, (uint64_t)place << 32 | (uint64_t)i, answer->target, judgement->extra[i].position,
                       make_layer_style(LAYER_WRONG, STROKE_SOLID, ring == RING ? LINE_WIDTH : 1));
    mark_points(s, judgement->missing, judgement->missing_count, SHAPE_TRIANGLE, missing, occupied);
    mark_points(s, judgement->extra, judgement->extra_count, SHAPE_WEDGE, extra, occupied);
    find_ring_position(answer, at);
    scene_add_mark(s, ring_id(place), at, SHAPE_RING, make_layer_style(LAYER_WRONG, STROKE_SOLID, ring));
    text_space_reserve_mark(occupied, s, at, ring);
}

/* Write the error of an answer beside its ring. Return false if there is no room. */
static bool add_answer_label(scene *s, const octree_answer *answer, size_t place, text_space *occupied)
{
    char words[JUDGEMENT_TEXT];
    double at[3];
    const scene_label label = scene_make_label(place, make_layer_style(LAYER_WRONG, STROKE_SOLID, 1), "%s",
                                               judgement_text(&answer->judgement, words));
    find_ring_position(answer, at);
    return text_space_add_label_beside(occupied, s, label, at, RING);
}

/* Write the number of error texts without room into the top right corner. */
static void add_left_out_count(scene *s, size_t count, text_space *occupied)
{
    const camera_window w = layout_space_area(s);
    scene_label label = scene_make_label(LEFT_OUT_ID, make_layer_style(LAYER_WRONG, STROKE_SOLID, 1),
                                         "and %zu others that are wrong", count);
    const double half = (double)strlen(label.text) * s->text.width / 2;
    const double middle[2] = {w.x + w.width - half - s->text.width, w.y + s->text.height};
    if (count > 0 && text_space_reserve_text(occupied, s, label.text, middle, label.at))
        scene_add_label_on_ground(s, &label, ROLE_BACKGROUND);
}

/* Add markers, rings and texts. Markers come first, so that texts do not cover them. Texts of answers are placed before
 * texts of nodes, so texts of nodes are the first for which there is no room. */
static void add_wrong_answers(scene *s, const layer_source *in, view_layer layer)
{
    (void)layer;
    size_t worst, left_out = 0;
    const bool few = judgement_count_wrong(in->answers, in->answer_count, &worst) <= FEW_RINGS;
    text_space occupied = {.count = 0};
    const wrong_marks marks = find_marks_of_wrong_nodes(in);
    for (size_t i = 0; i < in->answer_count; i++)
        if (in->answers[i].judgement.wrong)
            mark_wrong_answer(s, &in->answers[i], i, few || i == worst ? RING : RING / 2, &occupied);
    const octree_pair_judgement *pairs = has_wrong_pairs(in) ? &in->tick->foreign_pairs : NULL;
    if (pairs)
        mark_wrong_pairs(s, in, mark_size(pairs->missing_count, pairs->extra_count), RING, &occupied);
    mark_wrong_foreign_nodes(s, &marks, &occupied);
    if (pairs)
        left_out += !label_wrong_pairs(s, in, RING, &occupied);
    for (size_t i = 0; i < in->answer_count; i++)
        if (in->answers[i].judgement.wrong && (few || i == worst))
            left_out += !add_answer_label(s, &in->answers[i], i, &occupied);
    left_out += label_wrong_foreign_nodes(s, &marks, &occupied);
    add_left_out_count(s, left_out, &occupied);
}

static void add_wrong_legend(legend *l, const layer_source *in)
{
    size_t worst, missing = 0, extra = 0;
    for (size_t i = 0; i < in->answer_count; i++) {
        missing += in->answers[i].judgement.missing_count;
        extra += in->answers[i].judgement.extra_count;
    }
    if (judgement_count_wrong(in->answers, in->answer_count, &worst) || has_ring_of_pairs(in))
        legend_add(l, SIGN_RING, "wrong answer");
    if (missing)
        legend_add(l, SIGN_TRIANGLE, "missing point")->role = ROLE_MISSED;
    if (extra)
        legend_add(l, SIGN_WEDGE, "extra point");
    if (has_wrong_pairs(in))
        add_wrong_pairs_legend(l, in);
    if (shows_foreign_nodes(in) && in->tick->foreign.wrong_count)
        legend_add(l, SIGN_DASHES, "wrong node");
}

static bool contains_point_with_id(const octree_point *points, size_t count, uint64_t id)
{
    for (size_t i = 0; i < count; i++)
        if (points[i].id == id)
            return true;
    return false;
}

/* Return the index of the first answer in which the point with this id is missing (`missing` true) or extra (`missing`
 * false). Return answer_count if there is no such answer. */
static size_t find_answer_with_wrong_point(const octree_tick *tick, uint64_t id, bool missing)
{
    size_t i = 0;
    for (; i < tick->answer_count; i++) {
        const octree_judgement *judgement = &tick->answers[i].judgement;
        if (missing ? contains_point_with_id(judgement->missing, judgement->missing_count, id)
                    : contains_point_with_id(judgement->extra, judgement->extra_count, id))
            break;
    }
    return i;
}

static void append_wrong_answer(description *d, uint64_t place)
{
    const octree_tick *tick = d->tick;
    char words[JUDGEMENT_TEXT];
    if (place >= tick->answer_count)
        return;
    d->subject->query = place + 1;
    append_text(d, "the foreign answer to the %s query", octree_query_name(tick->answers[place].kind));
    if (tick->answer_count > 1)
        append_text(d, " (answer %zu of %zu)", place + 1, tick->answer_count);
    const octree_answer *answer = &tick->answers[place];
    append_text(d, ", which is wrong: %s", judgement_text(&answer->judgement, words));
    if (answer->judgement.on_boundary)
        append_text(d, "; all its %s points lie on the boundary of the %s",
                    octree_wrong_name(answer->judgement.on_boundary), octree_query_about(answer->kind)->region);
}

static void describe_mark(description *d, const described_element *element)
{
    if (is_foreign_element(element->id)) {
        describe_wrong_foreign_node(d, element);
    } else if (is_pair_element(element->id)) {
        describe_wrong_pair(d, element);
    } else if (element->kind == SCENE_MARKER && element->shape == SHAPE_RING) {
        append_text(d, "the ring around ");
        append_wrong_answer(d, UINT64_MAX - element->id);
    } else if (element->kind == SCENE_MARKER) {
        const bool missing = element->shape == SHAPE_TRIANGLE;
        describe_point(d, "", element->id, element->at);
        append_text(d, missing ? ", missing from " : ", extra in ");
        append_wrong_answer(d, find_answer_with_wrong_point(d->tick, element->id, missing));
    } else if (element->kind == SCENE_SEGMENT) {
        append_text(d, "the line to an extra point of ");
        append_wrong_answer(d, element->id >> 32);
    } else if (element->id == LEFT_OUT_ID) {
        append_text(d, element->kind == SCENE_PANEL ? "the background of the number of hidden texts"
                                                    : ", the number of hidden texts");
    } else {
        append_text(d, element->kind == SCENE_PANEL ? "the background of the text about " : ", about ");
        append_wrong_answer(d, element->id);
    }
}

const layer_type layer_WRONG = {.applies = has_judged_tick,
                                .in_session = can_have_wrong_answers,
                                .add = add_wrong_answers,
                                .legend = {.order = 195, .add_lines = add_wrong_legend},
                                .describe = describe_mark};
