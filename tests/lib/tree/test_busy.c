/* SPDX-License-Identifier: MIT */
/* test_busy.c - inside its visitors, tracers and executors a tree refuses every change, and answers every query. */
#include "fixture.h"

#include "octree/game.h"

enum { COUNT = 3000, CHANGES = 11 }; /* enough points for several tasks */

/* The counts of what callbacks attempted. */
typedef struct attempts {
    octree *tree, *other; /* callbacks also change the other tree, which is not visited */
    size_t calls, refused, answered, changed_other;
} attempts;

static octree_status change_somehow(octree *tree, int change)
{
    static const octree_point stored = {{0, 0, 0}, 0};
    static const double to[1][3] = {{0.5, 0.25, 0.5}};
    const octree_box world = cube(-2, 2);
    switch (change) {
    case 0:
        return octree_insert(tree, to[0], 7);
    case 1:
        return octree_remove(tree, stored.position, stored.id);
    case 2:
        return octree_move(tree, stored.position, stored.id, to[0]);
    case 3:
        return octree_insert_many(tree, &(octree_point){{1, 1, 1}, 8}, 1, NULL, NULL);
    case 4:
        return octree_remove_many(tree, &stored, 1, NULL, NULL);
    case 5:
        return octree_move_many(tree, &stored, to, 1, NULL, NULL);
    case 6:
        return octree_clear(tree);
    case 7:
        return octree_tune(tree, NULL);
    case 8:
        return octree_reworld(tree, &world);
    case 9:
        return octree_replace_all(tree, &stored, 1, NULL, NULL);
    default:
        return octree_compact(tree);
    }
}

static bool ignore_point(const octree_point *point, void *context)
{
    (void)point, (void)context;
    return false;
}

static void try_changes(attempts *a)
{
    const octree_box all = cube(-1, 1);
    a->calls++;
    for (int change = 0; change < CHANGES; change++)
        a->refused += change_somehow(a->tree, change) == OCTREE_BUSY;
    octree_destroy(a->tree); /* does nothing */
    a->answered += octree_range(a->tree, &all, ignore_point, NULL) == OCTREE_OK;
    a->refused += change_somehow(a->tree, 0) == OCTREE_BUSY; /* the inner visit does not end the outer one */
    a->changed_other += octree_insert(a->other, all.min, a->calls) == OCTREE_OK;
}

static bool visit_point(const octree_point *point, void *context)
{
    (void)point;
    try_changes(context);
    return false;
}

static octree_walk_order visit_node(const octree_node *node, void *context)
{
    (void)node;
    try_changes(context);
    return OCTREE_WALK_STOP;
}

static void visit_change(const octree_change *change, void *context)
{
    (void)change;
    try_changes(context);
}

static void trace(octree_address node, octree_trace_kind kind, void *context)
{
    (void)node, (void)kind;
    try_changes(context);
}

/* Calls the callback from a query, at least once. */
static void ask_visited(const octree *tree, int query, attempts *a)
{
    static const double at[1][3] = {{0.1, 0.2, 0.3}};
    const octree_box box = cube(-1, 1), part = cube(0, 0.5);
    const octree_search traced = {.trace = trace, .trace_context = a};
    octree_neighbor near[1];
    octree_answer answer;
    octree_cursor cursor = {0};
    size_t count;
    switch (query) {
    case 0:
        octree_range(tree, &box, visit_point, a);
        return;
    case 1:
        octree_radius(tree, at[0], 1, NULL, visit_point, a);
        return;
    case 2:
        octree_collide(tree, at[0], 1, NULL, visit_point, a);
        return;
    case 3:
        octree_collide_swept(tree, at[0], (double[3]){0.5, 0.5, 0.5}, 1, NULL, NULL, visit_point, a);
        return;
    case 4:
        octree_walk(tree, visit_node, a);
        return;
    case 5:
        octree_range_collect(tree, &part, &traced, NULL, 0, &count);
        return;
    case 6:
        octree_nearest_k(tree, at[0], 1, &traced, near, &count);
        return;
    case 7:
        octree_nearest_within(tree, at[0], 1, &traced, near);
        return;
    case 8:
        octree_nearest_batch(tree, at, 1, &traced, near, NULL);
        return;
    case 9:
        octree_query_answer(tree, &(octree_query){.kind = OCTREE_QUERY_NEAREST, .k = 1}, NULL, &traced, &answer);
        octree_answer_release(tree, &answer);
        return;
    default:
        octree_changes_since(tree, 1, &cursor, visit_change, a);
        octree_insert(a->tree, at[0], 99);
        octree_changes_since(tree, 1, &cursor, visit_change, a);
        octree_remove(a->tree, at[0], 99);
    }
}

static octree *make_filled(octree_executor executor)
{
    octree_def def = define(cube(-1, 1), 8, 21, OCTREE_GROW);
    octree *tree;
    def.executor = executor;
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (uint64_t id = 0; id < COUNT; id++) {
        const double at = (double)id / COUNT;
        assert_int_equal(octree_insert(tree, (double[3]){at, at * at, at / 2}, id), OCTREE_OK);
    }
    return tree;
}

static void assert_all_refused(const attempts *a)
{
    assert_true(a->calls > 0);
    assert_int_equal(a->refused, a->calls * (CHANGES + 1));
    assert_int_equal(a->answered, a->calls);
    assert_int_equal(a->changed_other, a->calls);
}

static void visitors_and_tracers_cannot_change_their_tree(void **state)
{
    (void)state;
    for (int query = 0; query <= 10; query++) {
        attempts a = {.tree = make_filled((octree_executor){0}), .other = make_tree(cube(-1, 1), 8, 21, OCTREE_GROW)};
        const uint64_t digest = octree_digest(a.tree);
        ask_visited(a.tree, query, &a);
        assert_all_refused(&a);
        assert_true(octree_digest(a.tree) == digest);
        assert_int_equal(octree_insert(a.tree, (double[3]){1, 1, 1}, 1), OCTREE_OK);
        octree_destroy(a.tree);
        octree_destroy(a.other);
    }
}

/* ---- Executors ---------------------------------------------------------------------------------------------- */

static void run_and_try_changes(octree_task *task, size_t count, void *task_context, void *context)
{
    attempts *a = context;
    for (size_t i = 0; i < count; i++)
        task(i, task_context);
    if (a->tree) /* null while it is filled */
        try_changes(a);
}

static void executors_cannot_change_their_tree(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    attempts a = {.other = make_tree(cube(-1, 1), 8, 21, OCTREE_GROW)};
    octree *tree = make_filled((octree_executor){run_and_try_changes, &a});
    for (uint64_t i = 0; i < COUNT; i++)
        points[i] = (octree_point){{0, (double)i / COUNT, 1}, COUNT + i};
    a.tree = tree;
    assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, NULL), OCTREE_OK);
    const size_t inserting = a.calls;
    assert_true(octree_digest(tree) != 0);
    const size_t digesting = a.calls;
    assert_int_equal(octree_compact(tree), OCTREE_OK); /* the tasks are those of another tree */
    const size_t compacting = a.calls;
    assert_int_equal(octree_tune(tree, NULL), OCTREE_OK);
    assert_true(0 < inserting && inserting < digesting && digesting < compacting && compacting < a.calls);
    assert_all_refused(&a);
    assert_int_equal(octree_count(tree), 2 * COUNT);
    assert_int_equal(octree_insert(tree, (double[3]){1, 1, 1}, 1), OCTREE_OK);
    a.tree = NULL;
    octree_destroy(tree);
    octree_destroy(a.other);
}

/* ---- Nested visits and games -------------------------------------------------------------------------------- */

typedef struct nesting {
    octree *tree, *other;
    unsigned depth, refused;
} nesting;

/* Visits the other tree and this one in turn, deeper than a thread lists visits. */
static bool visit_deeper(const octree_point *point, void *context)
{
    nesting *n = context;
    const octree_box all = cube(-1, 1);
    (void)point;
    n->refused += octree_clear(n->tree) == OCTREE_BUSY;
    if (++n->depth < 40)
        octree_range(n->depth % 2 ? n->other : n->tree, &all, visit_deeper, n);
    n->refused += octree_clear(n->tree) == OCTREE_BUSY;
    return false;
}

static void nested_visits_refuse_changes_until_the_outermost_ends(void **state)
{
    (void)state;
    nesting n = {.tree = make_filled((octree_executor){0}), .other = make_filled((octree_executor){0})};
    const octree_box all = cube(-1, 1);
    octree_range(n.tree, &all, visit_deeper, &n);
    assert_int_equal(n.depth, 40);
    assert_int_equal(n.refused, 80);
    assert_int_equal(octree_clear(n.tree), OCTREE_OK);
    octree_destroy(n.tree);
    octree_destroy(n.other);
}

static octree_walk_order step_game(const octree_node *node, void *context)
{
    (void)node;
    assert_int_equal(octree_game_step(context, 'w'), OCTREE_BUSY);
    return OCTREE_WALK_STOP;
}

static void a_game_is_not_stepped_inside_a_visitor_of_its_tree(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    assert_int_equal(octree_walk(octree_game_tree(game), step_game, game), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->number, 0);
    assert_int_equal(octree_game_step(game, 'w'), OCTREE_OK);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(visitors_and_tracers_cannot_change_their_tree),
        cmocka_unit_test(executors_cannot_change_their_tree),
        cmocka_unit_test(nested_visits_refuse_changes_until_the_outermost_ends),
        cmocka_unit_test(a_game_is_not_stepped_inside_a_visitor_of_its_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
