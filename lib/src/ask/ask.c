/* SPDX-License-Identifier: MIT */
/* ask.c - the tables of octree/query.h, and functions that check and ask a query of any kind with the table row of the
 * kind. */
#include "../exact/float_mode.h"
#include "kind.h"
#include "../query/search.h"

#include <stdlib.h>

/* ---- The tables --------------------------------------------------------------------------------------------- */

const octree_query_member_traits *octree_query_member_at(size_t index)
{
#define MEMBER_REQUIRED false
#define MEMBER_OPTIONAL true
#define MEMBER(member, field, type, key, presence)                                                                     \
    {OCTREE_QUERY_HAS_##member, OCTREE_MEMBER_##type,          key,                                                    \
     MEMBER_##presence,         offsetof(octree_query, field), offsetof(octree_answer, field)},
    static const octree_query_member_traits table[] = {OCTREE_QUERY_MEMBER_MAP(MEMBER)};
#undef MEMBER
    return index < OCTREE_QUERY_MEMBERS ? &table[index] : NULL;
}

const octree_query_traits *octree_query_about(octree_query_kind kind)
{
#define RESULT_POINTS false
#define RESULT_NEIGHBORS true
#define TRAITS(kind, name, members, named_by, result, ...) {#name, members, named_by, RESULT_##result, __VA_ARGS__},
    static const octree_query_traits table[] = {OCTREE_QUERY_MAP(TRAITS)};
#undef TRAITS
    return (unsigned)kind < OCTREE_QUERY_KINDS ? &table[kind] : NULL;
}

const char *octree_query_name(octree_query_kind kind)
{
    const octree_query_traits *about = octree_query_about(kind);
    return about ? about->name : NULL;
}

const char *octree_bounds_name(octree_bounds bounds)
{
    static const char *const names[OCTREE_BOUNDS_KINDS] = {"closed", "open", "either"};
    return (unsigned)bounds < OCTREE_BOUNDS_KINDS ? names[bounds] : NULL;
}

const char *octree_wrong_name(octree_wrong_kind wrong)
{
    static const char *const names[OCTREE_WRONG_KINDS] = {"none",  "unknown", "duplicate", "skipped",
                                                          "count", "farther", "missing",   "extra"};
    return (unsigned)wrong < OCTREE_WRONG_KINDS ? names[wrong] : NULL;
}

const query_rules *query_rules_of(octree_query_kind kind)
{
#define RULES_POINTS(name)                                                                                             \
    {.ask = run_##name##_query, .compare = compare_body_to_##name, .bound = find_bounds_of_##name},
#define RULES_NEIGHBORS(name)                                                                                          \
    {.ask = run_##name##_query,                                                                                        \
     .order = compare_##name##_order,                                                                                  \
     .measure = measure_for_##name,                                                                                    \
     .region = find_region_of_##name},
#define RULES(kind, name, members, named_by, result, ...) RULES_##result(name)
    static const query_rules table[] = {OCTREE_QUERY_MAP(RULES)};
#undef RULES
    return &table[kind];
}

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static octree_status check_frustum(const octree_frustum *frustum)
{
    const octree_region region = {
        .kind = OCTREE_REGION_HALF_SPACES, .half_spaces = frustum->half_spaces, .half_space_count = frustum->count};
    return frustum->count <= OCTREE_FRUSTUM_HALF_SPACES ? octree_region_check(&region) : OCTREE_BAD_SIZE;
}

static octree_status check_member(const octree_query *query, const octree_query_member_traits *member)
{
    const void *value = (const char *)query + member->in_query;
    switch (member->type) {
    case OCTREE_MEMBER_BOX:
        return check_box(value);
    case OCTREE_MEMBER_POSITION:
        return member->bit == OCTREE_QUERY_HAS_TARGET && query->at_player ? OCTREE_OK : check_finite_position(value);
    case OCTREE_MEMBER_DIRECTION:
        return check_direction(value);
    case OCTREE_MEMBER_LENGTH:
        return check_length(*(const double *)value);
    case OCTREE_MEMBER_FRUSTUM:
        return check_frustum(value);
    case OCTREE_MEMBER_EXTENTS:
        return check_half_extents(value);
    case OCTREE_MEMBER_BOUNDS:
        return octree_bounds_name(*(const octree_bounds *)value) ? OCTREE_OK : OCTREE_BAD_OPTION;
    case OCTREE_MEMBER_COUNT:
        break;
    }
    return OCTREE_OK;
}

static octree_status check_foreign_answer(const octree_query *query)
{
    if (query->answered && !query->answer && query->answer_count)
        return OCTREE_NULL_ARGUMENT;
    return (unsigned)query->precision < OCTREE_PRECISIONS ? OCTREE_OK : OCTREE_BAD_OPTION;
}

static octree_status check_visits(const octree_ids *visit)
{
    if (visit->count && !visit->ids)
        return OCTREE_NULL_ARGUMENT;
    for (size_t i = 0; i < visit->count; i++)
        if (visit->ids[i] >= OCTREE_NODE_ID_LIMIT)
            return OCTREE_BAD_SIZE;
    return OCTREE_OK;
}

octree_status octree_query_check(const octree_query *query)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_query_check, query);
    if (!query)
        return OCTREE_NULL_ARGUMENT;
    const octree_query_traits *about = octree_query_about(query->kind);
    if (!about)
        return OCTREE_BAD_OPTION;
    if (query->skip == OCTREE_SKIP_COINCIDENT && !(about->members & OCTREE_QUERY_HAS_TARGET))
        return OCTREE_BAD_OPTION;
    octree_status status = check_search_options(&(octree_search){.skip = query->skip, .epsilon = query->epsilon});
    for (size_t i = OCTREE_QUERY_MEMBERS; status == OCTREE_OK && i-- > 0;)
        if (about->members & octree_query_member_at(i)->bit)
            status = check_member(query, octree_query_member_at(i));
    if (status == OCTREE_OK && is_query_judged(query))
        status = check_foreign_answer(query);
    for (int visit = 0; status == OCTREE_OK && visit < OCTREE_NODE_VISITS; visit++)
        status = check_visits(&query->visits[visit]);
    return status;
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

void sort_points(list *points, size_t first)
{
    if (points->count > first)
        qsort((octree_point *)points->items + first, points->count - first, sizeof(octree_point),
              octree_compare_points);
}

/* An octree_body_visitor with a query_run as its context: append the body's point to the result unless the query skips
 * it. */
static bool collect_body_unless_skipped(const octree_body *body, void *context)
{
    query_run *run = context;
    const octree_answer *asked = run->asked;
    const bool skipped = (asked->skip == OCTREE_SKIP_ID && body->id == asked->skip_id) ||
                         (asked->skip == OCTREE_SKIP_COINCIDENT && is_same_position(body->position, asked->target)) ||
                         (asked->bounds == OCTREE_BOUNDS_OPEN && is_on_boundary(asked, body));
    const octree_point point = point_of_body(body);
    run->failed = !skipped && !list_push(run->memory, run->points, &point, sizeof point);
    return !run->failed;
}

bool collect_unless_skipped(const octree_point *point, void *context)
{
    octree_body body = {.id = point->id};
    memcpy(body.position, point->position, sizeof body.position);
    return collect_body_unless_skipped(&body, context);
}

/* The search skips nothing itself: the player is skipped by the queries of neighbours alone. */
octree_status collect_bodies_in_region(query_run *run, const octree_region *region)
{
    octree_search how = run->how;
    how.skip = OCTREE_SKIP_NONE;
    return octree_bodies_search(run->bodies, region, &how, collect_body_unless_skipped, run);
}

/* An octree_body_visitor with a query_run as its context: returns whether a body lies elsewhere than the target. */
static bool is_beside_target(const octree_body *body, void *context)
{
    const query_run *run = context;
    return !is_same_position(body->position, run->asked->target);
}

octree_status collect_first_bodies(query_run *run, const octree_answer *answer, const octree_region *ray)
{
    const size_t all = octree_count(run->tree), k = answer->k < all ? answer->k : all;
    octree_hit *hits = k ? arena_allocate(run->memory, k * sizeof *hits) : NULL;
    if (k && !hits)
        return OCTREE_NO_MEMORY;
    size_t found = 0;
    /* a cast has no target, so it does not skip bodies at the target itself */
    const octree_body_visitor accept = run->how.skip == OCTREE_SKIP_COINCIDENT ? is_beside_target : NULL;
    const octree_status status =
        ray ? octree_bodies_cast(run->bodies, ray, k, &run->how, accept, run, hits, &found)
            : octree_bodies_nearest(run->bodies, answer->target, k, HUGE_VAL, &run->how, NULL, NULL, hits, &found);
    for (size_t i = 0; !run->failed && i < found; i++) {
        const octree_neighbor neighbor = {point_of_body(&hits[i].body), hits[i].at};
        run->failed = !list_push(run->memory, run->neighbors, &neighbor, sizeof neighbor);
    }
    arena_free(run->memory, hits, k * sizeof *hits);
    return status;
}

/* For each type of query member: its size in bytes, and the number of its doubles. */
static const struct {
    size_t size, doubles;
} member_sizes[] = {
    [OCTREE_MEMBER_BOX] = {sizeof(octree_box), 6},         [OCTREE_MEMBER_POSITION] = {sizeof(double[3]), 3},
    [OCTREE_MEMBER_DIRECTION] = {sizeof(double[3]), 3},    [OCTREE_MEMBER_COUNT] = {sizeof(size_t), 0},
    [OCTREE_MEMBER_LENGTH] = {sizeof(double), 1},          [OCTREE_MEMBER_BOUNDS] = {sizeof(octree_bounds), 0},
    [OCTREE_MEMBER_FRUSTUM] = {sizeof(octree_frustum), 0}, [OCTREE_MEMBER_EXTENTS] = {sizeof(double[3]), 3}};

octree_answer make_answer_to_query(const octree_query *query, const double player[3])
{
    octree_answer answer = {.kind = query->kind,
                            .skip = query->skip,
                            .skip_id = query->skip_id,
                            .epsilon = query->epsilon,
                            .precision = is_query_judged(query) ? query->precision : OCTREE_DOUBLES};
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        memcpy((char *)&answer + member->in_answer, (const char *)query + member->in_query,
               member_sizes[member->type].size);
    }
    if (!query->at_player)
        return answer;
    memcpy(answer.target, player, sizeof answer.target);
    for (int i = 0; i < 3; i++) {
        answer.box.min[i] += player[i];
        answer.box.max[i] += player[i];
        answer.to[i] += player[i];
        for (size_t k = 0; k < answer.frustum.count; k++)
            answer.frustum.half_spaces[k].offset += answer.frustum.half_spaces[k].normal[i] * player[i];
    }
    return answer;
}

/* Round numbers to floats. If all of them become 0, but must not, they stay as they are. */
static void round_to_floats(double *numbers, size_t count, bool keep)
{
    double rounded[6];
    for (size_t i = 0; i < count; i++) {
        rounded[i] = round_to_float(numbers[i]);
        keep = keep && rounded[i] == 0;
    }
    if (!keep)
        memcpy(numbers, rounded, count * sizeof *numbers);
}

/* A direction or normal of 0 would be invalid, and an optional length of 0 would mean that there is none. */
void round_answer_to_floats(octree_answer *answer)
{
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        round_to_floats((double *)((char *)answer + member->in_answer), member_sizes[member->type].doubles,
                        member->optional || member->type == OCTREE_MEMBER_DIRECTION);
    }
    for (size_t i = 0; i < answer->frustum.count; i++) {
        round_to_floats(answer->frustum.half_spaces[i].normal, 3, true);
        round_to_floats(&answer->frustum.half_spaces[i].offset, 1, false);
    }
}

octree_status run_query(query_run *run, const octree_query *query, const double player[3], octree_answer *answer)
{
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    const list *found = neighbors ? run->neighbors : run->points;
    const size_t first = found->count;
    *answer = make_answer_to_query(query, player);
    run->asked = answer;
    run->how.cost = &answer->cost;
    if (query->skip != OCTREE_SKIP_NONE) {
        run->how.skip = query->skip;
        run->how.skip_id = query->skip_id;
    }
    /* epsilon is the permitted error of the foreign answer. The exact answer, with which the foreign answer is
     * compared, has no error. */
    if (is_query_judged(query))
        run->how.epsilon = 0;
    else if (query->epsilon > 0)
        run->how.epsilon = query->epsilon;
    octree_status status = query_rules_of(query->kind)->ask(run, answer);
    if (run->failed)
        status = OCTREE_NO_MEMORY;
    answer->count = found->count - first;
    if (status == OCTREE_OK && !neighbors)
        sort_points(run->points, first);
    return status;
}

/* ---- Outside a game ----------------------------------------------------------------------------------------- */

/* Copy the items of a list to a memory block of exactly the needed size, and release the list. Returns null if there
 * are no items or no memory. */
static void *move_list_to_block(arena *memory, list *l, size_t item_size)
{
    void *items = l->count ? arena_allocate(memory, l->count * item_size) : NULL;
    if (items)
        memcpy(items, l->items, l->count * item_size);
    list_release(memory, l, item_size);
    return items;
}

octree_status octree_query_answer(const octree *tree, const octree_query *query, const double player[3],
                                  const octree_search *how, octree_answer *answer)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_query_answer, tree, query, player, CALLER_SEARCH(how), answer);
    if (!answer)
        return OCTREE_NULL_ARGUMENT;
    *answer = (octree_answer){0};
    octree_status status = tree ? octree_query_check(query) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK && query->at_player && !player)
        status = OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = tree->def.allocator};
    list points = {0}, neighbors = {0};
    const octree_bodies bodies = show_points_as_bodies(tree, (double[3]){0, 0, 0});
    query_run run = {.tree = tree,
                     .bodies = &bodies,
                     .how = search_or_default(how),
                     .memory = &memory,
                     .points = &points,
                     .neighbors = &neighbors};
    octree_answer made;
    status = run_query(&run, query, player, &made);
    made.points = move_list_to_block(&memory, &points, sizeof(octree_point));
    made.neighbors = move_list_to_block(&memory, &neighbors, sizeof(octree_neighbor));
    if (status == OCTREE_OK && made.count && !made.points && !made.neighbors)
        status = OCTREE_NO_MEMORY;
    if (status == OCTREE_OK)
        *answer = made;
    else
        octree_answer_release(tree, &made);
    return status;
}

void octree_answer_release(const octree *tree, octree_answer *answer)
{
    if (!tree || !answer)
        return;
    arena memory = {.allocator = tree->def.allocator};
    arena_free(&memory, (void *)answer->points, answer->count * sizeof *answer->points);
    arena_free(&memory, (void *)answer->neighbors, answer->count * sizeof *answer->neighbors);
    *answer = (octree_answer){0};
}

bool octree_answer_bound(const octree_answer *answer, octree_box *bound)
{
    RETURN_IN_DEFAULT_MODE(bool, octree_answer_bound, answer, bound);
    const query_rules *rules = query_rules_of(answer->kind);
    if (rules->bound)
        *bound = rules->bound(answer, 0);
    return rules->bound != NULL;
}
