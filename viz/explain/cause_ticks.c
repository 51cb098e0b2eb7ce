/* cause_ticks.c - in what two ticks of one number differ; see cause_compare.h. */
#include "cause_compare.h"

static bool same_numbers(const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (a[i] != b[i])
            return false;
    return true;
}

static void add_places(cause_facts *facts, cause_kind kind, const double a[3], const double b[3])
{
    if (!same_numbers(a, b, 3))
        cause_add(facts, (cause_fact){.kind = kind, .tick = CAUSE_NO_TICK, .a = cause_place(a), .b = cause_place(b)});
}

static void compare_keys(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    const char keys[2][2] = {{a->key}, {b->key}};
    if (a->key != b->key)
        cause_add(facts, (cause_fact){.kind = CAUSE_PRESSED,
                                      .tick = CAUSE_NO_TICK,
                                      .a = cause_word(keys[0]),
                                      .b = cause_word(keys[1])});
}

static void compare_events(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        const unsigned bit = 1u << i;
        if ((a->events ^ b->events) & bit)
            cause_add(facts, (cause_fact){.kind = b->events & bit ? CAUSE_EVENT_MORE : CAUSE_EVENT_LESS,
                                          .tick = CAUSE_NO_TICK,
                                          .name = octree_event_name(1u << i)});
    }
}

/* ---- Results -------------------------------------------------------------------------------------------------- */

static void compare_hits(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    for (size_t i = 0, j = 0; i < a->hit_count || j < b->hit_count;) {
        const bool less = j == b->hit_count || (i < a->hit_count && a->hits[i].id < b->hits[j].id);
        const bool more = i == a->hit_count || (j < b->hit_count && b->hits[j].id < a->hits[i].id);
        if (less || more)
            cause_add(facts, (cause_fact){.kind = less ? CAUSE_HIT_LESS : CAUSE_HIT_MORE,
                                          .tick = CAUSE_NO_TICK,
                                          .id = less ? a->hits[i].id : b->hits[j].id});
        i += !more;
        j += !less;
    }
}

static bool has_neighbors(const octree_answer *answer)
{
    return answer->kind == OCTREE_QUERY_NEAREST || answer->kind == OCTREE_QUERY_KNEAREST;
}

static const octree_point *result_at(const octree_answer *answer, size_t i)
{
    return has_neighbors(answer) ? &answer->neighbors[i].point : &answer->points[i];
}

static bool finds(const octree_answer *answer, uint64_t id)
{
    for (size_t i = 0; i < answer->count; i++)
        if (result_at(answer, i)->id == id)
            return true;
    return false;
}

/* How many results of one the other does not have. Those of ranges are in the order of their ids; of neighbours there
 * are few. */
static size_t count_only_in(const octree_answer *one, const octree_answer *other)
{
    size_t count = 0;
    if (has_neighbors(one)) {
        for (size_t i = 0; i < one->count; i++)
            count += !finds(other, result_at(one, i)->id);
        return count;
    }
    for (size_t i = 0, j = 0; i < one->count; i++) {
        while (j < other->count && other->points[j].id < one->points[i].id)
            j++;
        count += j == other->count || other->points[j].id != one->points[i].id;
    }
    return count;
}

static bool same_question(const octree_answer *a, const octree_answer *b)
{
    if (a->kind == OCTREE_QUERY_RANGE)
        return same_numbers(a->box.min, b->box.min, 3) && same_numbers(a->box.max, b->box.max, 3);
    return same_numbers(a->target, b->target, 3) && a->k == b->k && a->radius == b->radius;
}

static bool same_results(const octree_answer *a, const octree_answer *b)
{
    for (size_t i = 0; i < a->count; i++) {
        const octree_point *p = result_at(a, i), *q = result_at(b, i);
        if (p->id != q->id || !same_numbers(p->position, q->position, 3) ||
            (has_neighbors(a) && a->neighbors[i].distance != b->neighbors[i].distance))
            return false;
    }
    return true;
}

static cause_value found_value(const octree_answer *answer)
{
    return answer->count ? cause_whole(answer->neighbors[0].point.id) : cause_word("none");
}

/* A fact about the i-th answer of a tick. */
static cause_fact about_answer(const octree_tick *tick, size_t i, cause_kind kind)
{
    size_t of_kind = 0;
    for (size_t j = 0; j < tick->answer_count; j++)
        of_kind += tick->answers[j].kind == tick->answers[i].kind;
    return (cause_fact){.kind = kind,
                        .tick = CAUSE_NO_TICK,
                        .name = octree_query_name(tick->answers[i].kind),
                        .query = i,
                        .only = of_kind == 1};
}

/* An answer of the reference and the i-th of a tick, of one kind. */
static void compare_answer(const octree_answer *a, const octree_tick *tick, size_t i, cause_facts *facts)
{
    const octree_answer *b = &tick->answers[i];
    const size_t gained = count_only_in(b, a), lost = count_only_in(a, b);
    if (gained + lost == 0 && same_question(a, b) && same_results(a, b))
        return;
    cause_fact fact = about_answer(tick, i, gained + lost ? CAUSE_ANSWER : CAUSE_ANSWER_PLACE);
    if (gained + lost && b->kind == OCTREE_QUERY_NEAREST) {
        fact.kind = CAUSE_NEAREST;
        fact.a = found_value(a);
        fact.b = found_value(b);
    } else {
        fact.gained = gained;
        fact.lost = lost;
    }
    cause_add(facts, fact);
}

/* Which of two answers is taken next: -1 the first alone, 1 the second alone, 0 both. What is asked by a key comes
 * first, and may be asked in one tick alone; of unlike kinds the one goes of which more are left. */
static int order_answers(const octree_answer *x, size_t x_left, const octree_answer *y, size_t y_left)
{
    if (x_left == 0 || y_left == 0)
        return x_left ? -1 : 1;
    if (x->by_key != y->by_key)
        return x->by_key ? -1 : 1;
    if (x->kind == y->kind || x_left == y_left)
        return 0;
    return x_left > y_left ? -1 : 1;
}

/* The n-th with the n-th. */
static void compare_answers(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    for (size_t i = 0, j = 0; i < a->answer_count || j < b->answer_count;) {
        const octree_answer *x = a->answers + i, *y = b->answers + j;
        const int order = order_answers(x, a->answer_count - i, y, b->answer_count - j);
        const bool pair = order == 0 && x->kind == y->kind;
        if (pair)
            compare_answer(x, b, j, facts);
        if (!pair && order <= 0)
            cause_add(facts, about_answer(a, i, CAUSE_ANSWER_LESS));
        if (!pair && order >= 0)
            cause_add(facts, about_answer(b, j, CAUSE_ANSWER_MORE));
        i += order <= 0;
        j += order >= 0;
    }
}

/* ---- What the tree did --------------------------------------------------------------------------------------- */

static bool same_refusal(const octree_refusal *a, const octree_refusal *b)
{
    return a->id == b->id && a->why == b->why && same_numbers(a->position, b->position, 3);
}

static void add_refusal(const octree_refusal *refusal, cause_kind kind, cause_facts *facts)
{
    cause_add(facts, (cause_fact){.kind = kind,
                                  .tick = CAUSE_NO_TICK,
                                  .name = octree_status_name(refusal->why),
                                  .id = refusal->id,
                                  .b = cause_place(refusal->position)});
}

/* Between those that are the same before and behind. */
static void compare_refusals(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    size_t first = 0, a_end = a->refusal_count, b_end = b->refusal_count;
    while (first < a_end && first < b_end && same_refusal(&a->refusals[first], &b->refusals[first]))
        first++;
    for (; a_end > first && b_end > first && same_refusal(&a->refusals[a_end - 1], &b->refusals[b_end - 1]); a_end--)
        b_end--;
    for (size_t i = first; i < b_end; i++)
        add_refusal(&b->refusals[i], CAUSE_REFUSAL_MORE, facts);
    for (size_t i = first; i < a_end; i++)
        add_refusal(&a->refusals[i], CAUSE_REFUSAL_LESS, facts);
}

/* Pre-order: the leading bits decide, and of two nodes on one way the shallower comes first. */
static int order_nodes(octree_address a, octree_address b)
{
    const unsigned depths[2] = {octree_address_depth(a), octree_address_depth(b)};
    const octree_address x = depths[0] < depths[1] ? a << 3 * (depths[1] - depths[0]) : a;
    const octree_address y = depths[1] < depths[0] ? b << 3 * (depths[0] - depths[1]) : b;
    return x != y ? (x > y) - (x < y) : (depths[0] > depths[1]) - (depths[0] < depths[1]);
}

static bool is_inner(const octree_game *game, octree_address address)
{
    octree_node node;
    return octree_node_at(octree_game_tree(game), address, &node) == OCTREE_OK && !node.leaf;
}

/* Nodes in pre-order that split at this tick, or that merged. */
typedef struct node_list {
    const octree_address *nodes;
    size_t count;
} node_list;

/* Where the trees differ in the node itself it is told already. */
static void compare_lists(const octree_game *a, const octree_game *b, node_list as, node_list bs, cause_kind kind,
                          cause_facts *facts)
{
    for (size_t i = 0, j = 0; i < as.count || j < bs.count;) {
        const int order = i == as.count ? 1 : j == bs.count ? -1 : order_nodes(as.nodes[i], bs.nodes[j]);
        const octree_address node = order <= 0 ? as.nodes[i] : bs.nodes[j];
        if (order != 0 && is_inner(a, node) == is_inner(b, node))
            cause_add(facts,
                      (cause_fact){.kind = order < 0 ? CAUSE_NOT_NOW : kind, .tick = CAUSE_NO_TICK, .node = node});
        i += order <= 0;
        j += order >= 0;
    }
}

static void compare_changes(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const octree_tick *x = octree_game_tick(a), *y = octree_game_tick(b);
    compare_lists(a, b, (node_list){x->splits, x->split_count}, (node_list){y->splits, y->split_count},
                  CAUSE_SPLITS_NOW, facts);
    compare_lists(a, b, (node_list){x->merges, x->merge_count}, (node_list){y->merges, y->merge_count},
                  CAUSE_MERGES_NOW, facts);
}

/* ---- What it cost --------------------------------------------------------------------------------------------- */

static bool same_visits(const octree_tick *a, const octree_tick *b)
{
    if (a->visit_count != b->visit_count || a->hit_leaf_count != b->hit_leaf_count)
        return false;
    for (size_t i = 0; i < a->visit_count; i++)
        if (a->visits[i].node != b->visits[i].node || a->visits[i].touch != b->visits[i].touch ||
            a->visits[i].taken != b->visits[i].taken)
            return false;
    for (size_t i = 0; i < a->hit_leaf_count; i++)
        if (a->hit_leaves[i] != b->hit_leaves[i])
            return false;
    return true;
}

static octree_cost cost_of(const octree_tick *tick)
{
    octree_cost sum = tick->hit_cost;
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_cost *cost = &tick->answers[i].cost;
        sum.nodes += cost->nodes;
        sum.leaves += cost->leaves;
        sum.points += cost->points;
        sum.pruned += cost->pruned;
    }
    return sum;
}

static void add_counts(cause_facts *facts, cause_kind kind, uint64_t a, uint64_t b)
{
    cause_add(facts, (cause_fact){.kind = kind, .tick = CAUSE_NO_TICK, .a = cause_whole(a), .b = cause_whole(b)});
}

static void compare_costs(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    const octree_cost x = cost_of(a), y = cost_of(b);
    if (!same_visits(a, b) || x.nodes != y.nodes || x.leaves != y.leaves || x.pruned != y.pruned)
        add_counts(facts, CAUSE_VISITS, a->touched[OCTREE_TOUCH_VISITED], b->touched[OCTREE_TOUCH_VISITED]);
    if (x.points != y.points)
        add_counts(facts, CAUSE_COST, x.points, y.points);
}

/* What a swept test was made along; without one there is only its end. */
static void compare_ways(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    bool same = a->swept == b->swept && (!a->swept || same_numbers(a->from, b->from, 3));
    const bool same_hits = a->hit_count == b->hit_count && a->hit_from && b->hit_from;
    for (size_t i = 0; same && same_hits && i < a->hit_count; i++)
        same = a->hits[i].id != b->hits[i].id || same_numbers(a->hit_from[i], b->hit_from[i], 3);
    if (!same)
        cause_add(facts, (cause_fact){.kind = CAUSE_WAY, .tick = CAUSE_NO_TICK});
}

static cause_value place_of_player(const octree_tick *tick)
{
    return tick->has_player ? cause_place(tick->player) : cause_word("nowhere");
}

static void compare_players(const octree_tick *a, const octree_tick *b, cause_facts *facts)
{
    if (a->has_player != b->has_player)
        cause_add(facts,
                  (cause_fact){
                      .kind = CAUSE_PLAYER, .tick = CAUSE_NO_TICK, .a = place_of_player(a), .b = place_of_player(b)});
    if (!a->has_player || !b->has_player)
        return;
    add_places(facts, CAUSE_PLAYER, a->player, b->player);
    if (!same_numbers(a->attempt, a->player, 3) || !same_numbers(b->attempt, b->player, 3))
        add_places(facts, CAUSE_ATTEMPT, a->attempt, b->attempt);
    compare_ways(a, b, facts);
}

void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts)
{
    const octree_tick *x = octree_game_tick(a), *y = octree_game_tick(b);
    compare_keys(x, y, facts);
    compare_players(x, y, facts);
    compare_events(x, y, facts);
    compare_hits(x, y, facts);
    compare_answers(x, y, facts);
    compare_refusals(x, y, facts);
    compare_changes(a, b, facts);
    compare_costs(x, y, facts);
}
