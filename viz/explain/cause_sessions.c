/* cause_sessions.c - in what two sessions differ; see cause_compare.h. */
#include "cause_compare.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof((cause_value *)0)->word >= OCTREE_SHAPE_TEXT, "a label is a word");

static bool same_place(const double a[3], const double b[3])
{
    return cause_order_numbers(a, b, 3) == 0;
}

static int order_whole(uint64_t a, uint64_t b)
{
    return (a > b) - (a < b);
}

/* ---- Options ------------------------------------------------------------------------------------------------- */

#define OPTIONS 10

/* What the kinds of both players read. */
typedef struct both_read {
    bool player, step;
} both_read;

static both_read read_by_both(const octree_player *a, const octree_player *b)
{
    return (both_read){.player = a->kind != OCTREE_PLAYER_NONE && b->kind != OCTREE_PLAYER_NONE,
                       .step = a->kind == OCTREE_PLAYER_KEYS && b->kind == OCTREE_PLAYER_KEYS};
}

static const char *kind_name(octree_player_kind kind)
{
    static const char *const names[] = {
        [OCTREE_PLAYER_KEYS] = "keys", [OCTREE_PLAYER_BODY] = "body", [OCTREE_PLAYER_NONE] = "none"};
    return names[kind];
}

/* Those in force: a tree clamps them. What is not read is the same on both sides. */
static void list_options(const octree_session *session, both_read read, cause_option options[OPTIONS])
{
    const octree_def *tree = &session->tree;
    const octree_player *player = &session->player;
    const size_t capacity = tree->leaf_capacity < UINT32_MAX ? tree->leaf_capacity : UINT32_MAX;
    const size_t depth = tree->max_depth < OCTREE_MAX_DEPTH ? tree->max_depth : OCTREE_MAX_DEPTH;
    const cause_value unread = {.type = VALUE_NONE};
    const cause_option list[OPTIONS] = {
        {"world", cause_box(&tree->world)},
        {"leaf capacity", cause_whole(capacity)},
        {"depth", cause_whole(depth)},
        {"rule for full leaves", cause_word(tree->full_leaf == OCTREE_GROW ? "grow" : "refuse")},
        {"kind of player", cause_word(kind_name(player->kind))},
        {"player's id", read.player ? cause_whole(player->id) : unread},
        {"start of the player", read.step ? cause_place(player->position) : unread},
        {"step of the player", read.step ? cause_number(player->step) : unread},
        {"collision box", read.player ? cause_number(player->box_size) : unread},
        {"collision test", read.player ? cause_word(player->sweep ? "swept" : "at the end of a step") : unread},
    };
    memcpy(options, list, sizeof list);
}

static void compare_options(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const both_read read = read_by_both(&a->player, &b->player);
    cause_option options[2][OPTIONS];
    list_options(a, read, options[0]);
    list_options(b, read, options[1]);
    cause_add_options(facts, CAUSE_OPTION, options[0], options[1], OPTIONS);
}

/* ---- Points at the start ------------------------------------------------------------------------------------- */

static int by_id(const void *a, const void *b)
{
    return order_whole((*(const octree_body *const *)a)->id, (*(const octree_body *const *)b)->id);
}

/* The bodies in the order of their ids; null for no memory. */
static const octree_body **sort_bodies(const octree_session *session)
{
    const octree_body **sorted = malloc((session->body_count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < session->body_count; i++)
        sorted[i] = &session->bodies[i];
    if (sorted)
        qsort(sorted, session->body_count, sizeof *sorted, by_id);
    return sorted;
}

static void compare_body(const octree_body *a, const octree_body *b, cause_facts *facts)
{
    if (!same_place(a->position, b->position))
        cause_add(facts, (cause_fact){.kind = CAUSE_START_MOVED,
                                      .tick = CAUSE_NO_TICK,
                                      .id = a->id,
                                      .a = cause_place(a->position),
                                      .b = cause_place(b->position)});
    if (!same_place(a->velocity, b->velocity))
        cause_add(facts, (cause_fact){.kind = CAUSE_VELOCITY,
                                      .tick = CAUSE_NO_TICK,
                                      .id = a->id,
                                      .a = cause_place(a->velocity),
                                      .b = cause_place(b->velocity)});
}

static void add_body(const octree_body *body, cause_kind kind, cause_facts *facts)
{
    const cause_value place = cause_place(body->position);
    cause_fact fact = {.kind = kind, .tick = CAUSE_NO_TICK, .id = body->id};
    *(kind == CAUSE_START_LESS ? &fact.a : &fact.b) = place;
    cause_add(facts, fact);
}

static void compare_bodies(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const octree_body **as = sort_bodies(a), **bs = sort_bodies(b);
    facts->out_of_memory |= !as || !bs;
    for (size_t i = 0, j = 0; as && bs && (i < a->body_count || j < b->body_count);) {
        const int order = i == a->body_count ? 1 : j == b->body_count ? -1 : order_whole(as[i]->id, bs[j]->id);
        if (order < 0)
            add_body(as[i], CAUSE_START_LESS, facts);
        else if (order > 0)
            add_body(bs[j], CAUSE_START_MORE, facts);
        else
            compare_body(as[i], bs[j], facts);
        i += order <= 0;
        j += order >= 0;
    }
    free(as);
    free(bs);
}

/* A leaf that refuses takes those that come first. */
static void compare_body_order(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const bool same =
        a->body_count == b->body_count && !facts->found[CAUSE_START_MORE] && !facts->found[CAUSE_START_LESS];
    for (size_t i = 0; same && i < a->body_count; i++)
        if (a->bodies[i].id != b->bodies[i].id) {
            cause_add(facts, (cause_fact){.kind = CAUSE_START_ORDER, .tick = CAUSE_NO_TICK});
            return;
        }
}

/* ---- Keys ---------------------------------------------------------------------------------------------------- */

static void compare_keys(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const uint64_t lengths[2] = {octree_session_length(a), octree_session_length(b)};
    const uint64_t both = lengths[0] < lengths[1] ? lengths[0] : lengths[1];
    const octree_session *const sessions[2] = {a, b};
    size_t counts[2];
    if (lengths[0] != lengths[1])
        cause_add(facts, (cause_fact){.kind = CAUSE_LENGTH,
                                      .tick = CAUSE_NO_TICK,
                                      .a = cause_whole(lengths[0]),
                                      .b = cause_whole(lengths[1])});
    for (int i = 0; i < 2; i++)
        counts[i] = sessions[i]->keys ? strlen(sessions[i]->keys) : 0;
    for (uint64_t i = 0; i < both && (i < counts[0] || i < counts[1]); i++) {
        const char keys[2][2] = {{i < counts[0] ? a->keys[i] : '.'}, {i < counts[1] ? b->keys[i] : '.'}};
        if (keys[0][0] != keys[1][0])
            cause_add(facts, (cause_fact){
                                 .kind = CAUSE_KEY, .tick = i + 1, .a = cause_word(keys[0]), .b = cause_word(keys[1])});
    }
}

/* ---- Edits --------------------------------------------------------------------------------------------------- */

/* Two edits that do the same kind of thing to the same point at the same tick. */
static int order_of_deed(const octree_edit *a, const octree_edit *b)
{
    int order = order_whole(a->tick, b->tick);
    if (order == 0)
        order = order_whole(a->body.id, b->body.id);
    return order ? order : (int)a->kind - (int)b->kind;
}

/* By all that an edit of its kind says. */
static int order_edits(const octree_edit *a, const octree_edit *b)
{
    int order = order_of_deed(a, b);
    if (order == 0 && a->kind != OCTREE_EDIT_REMOVE)
        order = cause_order_numbers(a->body.position, b->body.position, 3);
    if (order == 0 && a->kind == OCTREE_EDIT_INSERT)
        order = cause_order_numbers(a->body.velocity, b->body.velocity, 3);
    return order;
}

static int by_edit(const void *a, const void *b)
{
    return order_edits(*(const octree_edit *const *)a, *(const octree_edit *const *)b);
}

/* Edits in some order, and how many of them are left. */
typedef struct edit_list {
    const octree_edit **edits;
    size_t count;
} edit_list;

static edit_list sort_edits(const octree_session *session)
{
    edit_list list = {malloc((session->edit_count + 1) * sizeof *list.edits), session->edit_count};
    for (size_t i = 0; list.edits && i < list.count; i++)
        list.edits[i] = &session->edits[i];
    if (list.edits)
        qsort(list.edits, list.count, sizeof *list.edits, by_edit);
    return list;
}

/* Leave in both lists what the other one does not have. */
static void drop_common(edit_list *a, edit_list *b)
{
    edit_list left[2] = {{a->edits, 0}, {b->edits, 0}};
    for (size_t i = 0, j = 0; i < a->count || j < b->count;) {
        const int order = i == a->count ? 1 : j == b->count ? -1 : order_edits(a->edits[i], b->edits[j]);
        if (order < 0)
            left[0].edits[left[0].count++] = a->edits[i];
        else if (order > 0)
            left[1].edits[left[1].count++] = b->edits[j];
        i += order <= 0;
        j += order >= 0;
    }
    *a = left[0];
    *b = left[1];
}

static const char *edit_name(octree_edit_kind kind)
{
    static const char *const names[] = {
        [OCTREE_EDIT_INSERT] = "insert", [OCTREE_EDIT_REMOVE] = "remove", [OCTREE_EDIT_MOVE] = "move"};
    return names[kind];
}

/* An edit of one side, or those of both that do the same to the same point. */
static void add_edit(const octree_edit *a, const octree_edit *b, cause_facts *facts)
{
    const octree_edit *some = a ? a : b;
    cause_fact fact = {.kind = !b   ? CAUSE_EDIT_LESS
                               : !a ? CAUSE_EDIT_MORE
                                    : CAUSE_EDIT_OTHER,
                       .tick = some->tick,
                       .name = edit_name(some->kind),
                       .id = some->body.id};
    const bool speed = a && b && same_place(a->body.position, b->body.position);
    if (speed)
        fact.kind = CAUSE_EDIT_SPEED;
    if (a && a->kind != OCTREE_EDIT_REMOVE)
        fact.a = cause_place(speed ? a->body.velocity : a->body.position);
    if (b && b->kind != OCTREE_EDIT_REMOVE)
        fact.b = cause_place(speed ? b->body.velocity : b->body.position);
    cause_add(facts, fact);
}

static void compare_order(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    for (size_t i = 0; i < a->edit_count; i++)
        if (order_edits(&a->edits[i], &b->edits[i]) != 0) {
            cause_add(facts, (cause_fact){.kind = CAUSE_EDIT_ORDER, .tick = a->edits[i].tick});
            return;
        }
}

static void compare_edits(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    edit_list as = sort_edits(a), bs = sort_edits(b);
    const bool ok = as.edits && bs.edits;
    facts->out_of_memory |= !ok;
    if (ok)
        drop_common(&as, &bs);
    for (size_t i = 0, j = 0; ok && (i < as.count || j < bs.count);) {
        const int order = i == as.count ? 1 : j == bs.count ? -1 : order_of_deed(as.edits[i], bs.edits[j]);
        add_edit(order <= 0 ? as.edits[i] : NULL, order >= 0 ? bs.edits[j] : NULL, facts);
        i += order <= 0;
        j += order >= 0;
    }
    if (ok && as.count + bs.count == 0)
        compare_order(a, b, facts);
    free(as.edits);
    free(bs.edits);
}

/* ---- What ticks have: queries and shapes --------------------------------------------------------------------- */

/* Things in ascending order of their ticks, which are their first members; and how two of them are compared. */
typedef struct tick_things {
    const void *things;
    size_t count, size;
    bool (*same)(const void *a, const void *b);
    void (*add)(const void *a, const void *b, cause_facts *facts); /* one of one side, or the two of both; else null */
} tick_things;

static const void *thing_at(const tick_things *t, size_t i)
{
    return (const char *)t->things + i * t->size;
}

static uint64_t tick_at(const tick_things *t, size_t i)
{
    return *(const uint64_t *)thing_at(t, i);
}

static bool is_same(const tick_things *a, size_t i, const tick_things *b, size_t j)
{
    return a->same(thing_at(a, i), thing_at(b, j));
}

/* The end of those that have the tick of the i-th. */
static size_t end_of_tick(const tick_things *t, size_t i)
{
    size_t end = i;
    while (end < t->count && tick_at(t, end) == tick_at(t, i))
        end++;
    return end;
}

/* Those of one tick: between what is the same before and behind, one by one. */
static void compare_one_tick(const tick_things *a, size_t i, size_t a_end, const tick_things *b, size_t j, size_t b_end,
                             cause_facts *facts)
{
    for (; i < a_end && j < b_end && is_same(a, i, b, j); i++)
        j++;
    for (; i < a_end && j < b_end && is_same(a, a_end - 1, b, b_end - 1); a_end--)
        b_end--;
    for (; i < a_end || j < b_end; i++, j++)
        if (i >= a_end || j >= b_end || !is_same(a, i, b, j))
            a->add(i < a_end ? thing_at(a, i) : NULL, j < b_end ? thing_at(b, j) : NULL, facts);
}

static void compare_things(const tick_things *a, const tick_things *b, cause_facts *facts)
{
    for (size_t i = 0, j = 0; i < a->count || j < b->count;) {
        const int order = i == a->count ? 1 : j == b->count ? -1 : order_whole(tick_at(a, i), tick_at(b, j));
        const size_t a_end = order <= 0 ? end_of_tick(a, i) : i, b_end = order >= 0 ? end_of_tick(b, j) : j;
        compare_one_tick(a, i, a_end, b, j, b_end, facts);
        i = a_end;
        j = b_end;
    }
}

static bool same_query(const void *one, const void *other)
{
    const octree_query *a = one, *b = other;
    if (a->kind != b->kind || a->at_player != b->at_player)
        return false;
    if (a->kind == OCTREE_QUERY_RANGE)
        return same_place(a->box.min, b->box.min) && same_place(a->box.max, b->box.max);
    return (a->at_player || same_place(a->target, b->target)) && (a->kind != OCTREE_QUERY_KNEAREST || a->k == b->k) &&
           (a->kind != OCTREE_QUERY_RADIUS || cause_order_numbers(&a->radius, &b->radius, 1) == 0);
}

static void add_query(const void *a, const void *b, cause_facts *facts)
{
    const octree_query *query = b ? b : a;
    cause_add(facts, (cause_fact){.kind = !a   ? CAUSE_QUERY_MORE
                                          : !b ? CAUSE_QUERY_LESS
                                               : CAUSE_QUERY_OTHER,
                                  .tick = query->tick,
                                  .name = octree_query_name(query->kind)});
}

static void compare_queries(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const tick_things as = {a->queries, a->query_count, sizeof *a->queries, same_query, add_query};
    const tick_things bs = {b->queries, b->query_count, sizeof *b->queries, same_query, add_query};
    compare_things(&as, &bs, facts);
}

static bool has_two_ends(octree_shape_kind kind)
{
    return kind == OCTREE_SHAPE_BOX || kind == OCTREE_SHAPE_SEGMENT;
}

static bool same_shape(const void *one, const void *other)
{
    const octree_shape *a = one, *b = other;
    return a->kind == b->kind && same_place(a->at, b->at) && (!has_two_ends(a->kind) || same_place(a->to, b->to)) &&
           (a->kind != OCTREE_SHAPE_LABEL || strcmp(a->text, b->text) == 0);
}

/* Where it is; and of a label what it says, unless that is the same. */
static cause_value shape_value(const octree_shape *shape, bool same_text)
{
    if (has_two_ends(shape->kind))
        return cause_ends(shape->kind == OCTREE_SHAPE_BOX ? VALUE_BOX : VALUE_SEGMENT, shape->at, shape->to);
    return shape->kind == OCTREE_SHAPE_LABEL && !same_text ? cause_word(shape->text) : cause_place(shape->at);
}

/* Two kinds of shapes have nothing to do with each other. */
static void add_shape(const void *one, const void *other, cause_facts *facts)
{
    const octree_shape *a = one, *b = other, *some = b ? b : a;
    if (a && b && a->kind != b->kind) {
        add_shape(a, NULL, facts);
        add_shape(NULL, b, facts);
        return;
    }
    const bool same_text = a && b && strcmp(a->text, b->text) == 0;
    cause_fact fact = {.kind = !a   ? CAUSE_SHAPE_MORE
                               : !b ? CAUSE_SHAPE_LESS
                                    : CAUSE_SHAPE_OTHER,
                       .tick = some->tick,
                       .name = octree_shape_name(some->kind)};
    if (a)
        fact.a = shape_value(a, same_text);
    if (b)
        fact.b = shape_value(b, same_text);
    cause_add(facts, fact);
}

static void compare_shapes(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const tick_things as = {a->shapes, a->shape_count, sizeof *a->shapes, same_shape, add_shape};
    const tick_things bs = {b->shapes, b->shape_count, sizeof *b->shapes, same_shape, add_shape};
    compare_things(&as, &bs, facts);
}

void cause_compare_sessions(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    compare_options(a, b, facts);
    compare_bodies(a, b, facts);
    compare_body_order(a, b, facts);
    compare_keys(a, b, facts);
    compare_edits(a, b, facts);
    compare_queries(a, b, facts);
    compare_shapes(a, b, facts);
}
