/* SPDX-License-Identifier: MIT */
/* test_game_bounds.c - whether points exactly on the boundary of a box or a ball belong to an answer. The judge is
 * compared with a linear scan in whole numbers: the points are a lattice, scaled by a power of two. */
#include "fixture.h"
#include "game_fixture.h"

#include <math.h>
#include <string.h>

/* ---- A lattice ---------------------------------------------------------------------------------------------- */

enum { REACH = 3, SIDE = 2 * REACH + 1, POINTS = SIDE * SIDE * SIDE };

/* A region in whole numbers. The radius of a box is -1. */
typedef struct lattice_region {
    int min[3], max[3], center[3], radius;
} lattice_region;

/* How a foreign index treats the boundary, and what else is wrong with its answers. */
typedef enum habit { HABIT_OPEN, HABIT_CLOSED, HABIT_MIXED, HABITS } habit;
typedef enum fault { FAULT_NONE, FAULT_LACKS_INSIDE, FAULT_NAMES_OUTSIDE, FAULTS } fault;

static void lattice_position(size_t id, int at[3])
{
    for (size_t i = 0, rest = id; i < 3; i++, rest /= SIDE)
        at[i] = (int)(rest % SIDE) - REACH;
}

/* -1: the point is inside the region, 0: on its boundary, 1: outside. */
static int lattice_side(const lattice_region *r, size_t id)
{
    int at[3], square = 0, side = -1;
    lattice_position(id, at);
    for (int i = 0; i < 3; i++) {
        square += (at[i] - r->center[i]) * (at[i] - r->center[i]);
        if (at[i] < r->min[i] || at[i] > r->max[i])
            side = 1;
        else if (side < 0 && (at[i] == r->min[i] || at[i] == r->max[i]))
            side = 0;
    }
    const int limit = r->radius * r->radius;
    return r->radius < 0 ? side : (square > limit) - (square < limit);
}

static lattice_region random_region(uint64_t *random)
{
    lattice_region r = {.radius = (int)random_below(random, 6)};
    if (random_below(random, 2))
        r.radius = -1;
    for (int i = 0; i < 3; i++) {
        r.center[i] = r.min[i] = (int)random_below(random, SIDE) - REACH;
        r.max[i] = r.min[i] + (int)random_below(random, 5);
    }
    return r;
}

static octree_query make_query(const lattice_region *r, double scale)
{
    octree_query q = {.kind = r->radius < 0 ? OCTREE_QUERY_RANGE : OCTREE_QUERY_RADIUS, .radius = r->radius * scale};
    for (int i = 0; i < 3; i++) {
        q.target[i] = r->center[i] * scale;
        q.box.min[i] = r->min[i] * scale;
        q.box.max[i] = r->max[i] * scale;
    }
    return q;
}

/* Answer as an index with this habit and this fault. Returns the number of ids. */
static size_t answer(const lattice_region *r, habit h, fault f, uint64_t ids[POINTS])
{
    size_t count = 0, seen = 0, faults = f == FAULT_NONE ? 0 : 1;
    for (size_t id = 0; id < POINTS; id++) {
        const int side = lattice_side(r, id);
        const bool part = h == HABIT_CLOSED || (h == HABIT_MIXED && seen % 2 == 0);
        bool named = side < 0 || (side == 0 && part);
        seen += side == 0;
        if (faults > 0 && side == (f == FAULT_LACKS_INSIDE ? -1 : 1)) {
            named = !named;
            faults--;
        }
        if (named)
            ids[count++] = id;
    }
    return count;
}

/* ---- What is right ------------------------------------------------------------------------------------------ */

/* The numbers of points that an answer contains and lacks, by their side of the boundary: index 1 is the boundary. */
typedef struct tally {
    size_t has[3], lacks[3];
} tally;

static tally count_sides(const lattice_region *r, const uint64_t *ids, size_t count)
{
    tally t = {{0}, {0}};
    for (size_t id = 0, next = 0; id < POINTS; id++) {
        const bool named = next < count && ids[next] == id;
        size_t *counts = named ? t.has : t.lacks;
        next += named;
        counts[lattice_side(r, id) + 1]++;
    }
    return t;
}

static void assert_judged_like_the_scan(const octree_query *q, const tally *t, const octree_judgement *made)
{
    const size_t missing = t->lacks[0] + (q->bounds == OCTREE_BOUNDS_CLOSED ? t->lacks[1] : 0);
    const size_t extra = t->has[2] + (q->bounds == OCTREE_BOUNDS_OPEN ? t->has[1] : 0);
    octree_wrong_kind on_boundary = OCTREE_WRONG_NONE;
    octree_bounds accepting = t->has[1] ? OCTREE_BOUNDS_EITHER : OCTREE_BOUNDS_OPEN;
    if (missing > 0 && t->lacks[0] == 0)
        on_boundary = OCTREE_WRONG_MISSING;
    if (extra > 0 && t->has[2] == 0) {
        on_boundary = OCTREE_WRONG_EXTRA;
        accepting = t->lacks[1] ? OCTREE_BOUNDS_EITHER : OCTREE_BOUNDS_CLOSED;
    }
    assert_int_equal(made->wrong, missing ? OCTREE_WRONG_MISSING : extra ? OCTREE_WRONG_EXTRA : OCTREE_WRONG_NONE);
    assert_true(made->missing_count == missing && made->extra_count == extra);
    assert_int_equal(made->on_boundary, on_boundary);
    if (on_boundary)
        assert_int_equal(made->accepting, accepting);
}

/* The exact answer has all points inside, and those on the boundary unless the bounds are open. */
static void assert_exact(const lattice_region *r, const octree_answer *exact)
{
    size_t at = 0;
    for (size_t id = 0; id < POINTS; id++)
        if (lattice_side(r, id) < (exact->bounds == OCTREE_BOUNDS_OPEN ? 0 : 1)) {
            assert_true(at < exact->count);
            assert_int_equal(exact->points[at++].id, id);
        }
    assert_int_equal(at, exact->count);
}

enum { REGIONS = 60, QUERIES = REGIONS * HABITS * FAULTS * OCTREE_BOUNDS_KINDS };

static lattice_region regions[QUERIES];
static octree_query queries[QUERIES];
static uint64_t ids[QUERIES][POINTS];
static octree_game_body bodies[POINTS];

static void make_queries(double scale, octree_precision precision)
{
    uint64_t random = 11;
    size_t made = 0;
    for (int i = 0; i < REGIONS; i++) {
        const lattice_region region = random_region(&random);
        for (int variant = 0; variant < HABITS * FAULTS * OCTREE_BOUNDS_KINDS; variant++, made++) {
            octree_query *q = &queries[made];
            regions[made] = region;
            *q = make_query(&region, scale);
            q->bounds = (octree_bounds)(variant % OCTREE_BOUNDS_KINDS);
            q->precision = precision;
            q->answered = true;
            q->answer = ids[made];
            q->answer_count = answer(&region, (habit)(variant / OCTREE_BOUNDS_KINDS % HABITS),
                                     (fault)(variant / OCTREE_BOUNDS_KINDS / HABITS), ids[made]);
        }
    }
}

static void judge_lattice(double scale, octree_precision precision)
{
    for (size_t id = 0; id < POINTS; id++) {
        int at[3];
        lattice_position(id, at);
        bodies[id] = (octree_game_body){.id = id, .position = {at[0] * scale, at[1] * scale, at[2] * scale}};
    }
    make_queries(scale, precision);
    octree_session session = {.tree = define(cube(-8 * scale, 8 * scale), 2, 21, OCTREE_GROW),
                              .player.kind = OCTREE_PLAYER_NONE,
                              .bodies = bodies,
                              .body_count = POINTS,
                              .queries = queries,
                              .query_count = QUERIES};
    octree_game *game = start_game(&session);
    for (size_t i = 0; i < QUERIES; i++) {
        const octree_answer *exact = &octree_game_tick(game)->answers[i];
        const tally t = count_sides(&regions[i], ids[i], queries[i].answer_count);
        assert_exact(&regions[i], exact);
        assert_judged_like_the_scan(&queries[i], &t, &exact->judgement);
    }
    octree_game_destroy(game);
}

static void judge_agrees_with_a_scan_of_a_lattice(void **state)
{
    (void)state;
    judge_lattice(1, OCTREE_DOUBLES);
    judge_lattice(1, OCTREE_FLOATS);
}

/* Squares of these coordinates overflow and underflow. */
static void judge_agrees_with_a_scan_of_huge_and_tiny_lattices(void **state)
{
    (void)state;
    judge_lattice(0x1p1019, OCTREE_DOUBLES);
    judge_lattice(0x1p-1074, OCTREE_DOUBLES);
    judge_lattice(0x1p-600, OCTREE_DOUBLES);
}

/* ---- Single answers ----------------------------------------------------------------------------------------- */

static octree_game *last_game;

/* The answer of a game to one query, with the judgement of a foreign answer. */
static const octree_answer *judge_one(const octree_game_body *all, size_t body_count, double reach, octree_query q,
                                      const uint64_t *named, size_t count)
{
    q.answered = true;
    q.answer = named;
    q.answer_count = count;
    octree_session session = {.tree = define(cube(-reach, reach), 2, 21, OCTREE_GROW),
                              .player.kind = OCTREE_PLAYER_NONE,
                              .bodies = all,
                              .body_count = body_count,
                              .queries = &q,
                              .query_count = 1};
    octree_game_destroy(last_game);
    last_game = start_game(&session);
    return &octree_game_tick(last_game)->answers[0];
}

#define IDS(...) (const uint64_t[]){__VA_ARGS__}, sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t)

/* With x = 2m^2, y = 2m and r = x + 1, the square of (x, y, z) is r^2 - 1 + z^2: the points with z = 0, 1 and 2 are
 * inside, on the boundary and outside, and all have the same rounded distance r. */
static void real_distances_decide_where_rounded_ones_are_equal(void **state)
{
    static const double scales[] = {1, 0x1p900, 0x1p-900, 0x1p-1074};
    const double x = 0x1p51, y = 0x1p26, r = 0x1p51 + 1;
    (void)state;
    assert_true(x * x + y * y == r * r && x * x + y * y + 4 == r * r);
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        const double s = scales[i];
        const octree_game_body all[] = {{.id = 1, .position = {x * s, y * s, 0}},
                                        {.id = 2, .position = {x * s, y * s, s}},
                                        {.id = 3, .position = {x * s, y * s, 2 * s}}};
        octree_query q = {.kind = OCTREE_QUERY_RADIUS, .radius = r * s};
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(1, 2))->judgement.wrong, OCTREE_WRONG_NONE);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(1))->judgement.accepting, OCTREE_BOUNDS_OPEN);
        q.bounds = OCTREE_BOUNDS_OPEN;
        const octree_answer *made = judge_one(all, 3, 2 * r * s, q, IDS(1));
        assert_true(made->count == 1 && made->judgement.wrong == OCTREE_WRONG_NONE);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, NULL, 0)->judgement.on_boundary, OCTREE_WRONG_NONE);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(1, 2))->judgement.on_boundary, OCTREE_WRONG_EXTRA);
        q.bounds = OCTREE_BOUNDS_EITHER;
        made = judge_one(all, 3, 2 * r * s, q, IDS(1));
        assert_true(made->count == 2 && made->judgement.wrong == OCTREE_WRONG_NONE);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(1, 2))->judgement.wrong, OCTREE_WRONG_NONE);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(2))->judgement.wrong, OCTREE_WRONG_MISSING);
        assert_int_equal(judge_one(all, 3, 2 * r * s, q, IDS(1, 3))->judgement.wrong, OCTREE_WRONG_EXTRA);
    }
}

static const octree_game_body few[] = {{.id = 1, .position = {1, 0, 0}},
                                       {.id = 2, .position = {0, 2, 0}},
                                       {.id = 3, .position = {-2, 0, 0}},
                                       {.id = 4, .position = {3, 0, 0}}};

static octree_judgement judge_few(octree_query q, const uint64_t *named, size_t count)
{
    return judge_one(few, 4, 10, q, named, count)->judgement;
}

static const octree_query open_ball = {.kind = OCTREE_QUERY_RADIUS, .radius = 2, .bounds = OCTREE_BOUNDS_OPEN};

/* Points 1 and 2 are on the boundary only as floats. */
static void rounded_positions_lie_on_the_boundary(void **state)
{
    const octree_game_body near[] = {{.id = 1, .position = {1 + 0x1p-30, 0, 0}},
                                     {.id = 2, .position = {0, 1 - 0x1p-30, 0}},
                                     {.id = 3, .position = {0, 0, 0.5}}};
    octree_query q = {.kind = OCTREE_QUERY_RADIUS, .radius = 1 + 0x1p-31, .precision = OCTREE_FLOATS};
    (void)state;
    octree_judgement j = judge_one(near, 3, 10, q, IDS(3))->judgement;
    assert_true(j.on_boundary == OCTREE_WRONG_MISSING && j.missing_count == 2 && j.accepting == OCTREE_BOUNDS_OPEN);
    q.bounds = OCTREE_BOUNDS_OPEN;
    assert_int_equal(judge_one(near, 3, 10, q, IDS(3))->judgement.wrong, OCTREE_WRONG_NONE);
    j = judge_one(near, 3, 10, q, IDS(3, 1))->judgement;
    assert_true(j.on_boundary == OCTREE_WRONG_EXTRA && j.extra_count == 1 && j.accepting == OCTREE_BOUNDS_EITHER);
}

/* A skipped point belongs to no answer, so it does not count among the points of the boundary. */
static void skipped_points_are_not_on_the_boundary(void **state)
{
    octree_query q = open_ball;
    (void)state;
    q.skip = OCTREE_SKIP_ID;
    q.skip_id = 3;
    assert_int_equal(judge_few(q, IDS(1)).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_few(q, IDS(1, 2)).accepting, OCTREE_BOUNDS_CLOSED);
    q.bounds = OCTREE_BOUNDS_CLOSED;
    assert_int_equal(judge_few(q, IDS(1)).accepting, OCTREE_BOUNDS_OPEN);
}

/* An epsilon allows all points that are so near to the region, which the points of its boundary are. */
static void epsilon_allows_the_boundary_of_an_open_ball(void **state)
{
    octree_query q = open_ball;
    (void)state;
    q.epsilon = 1;
    assert_int_equal(judge_few(q, IDS(1, 2, 4)).wrong, OCTREE_WRONG_NONE);
    q.epsilon = 0.5;
    assert_int_equal(judge_few(q, IDS(1, 2, 4)).wrong, OCTREE_WRONG_EXTRA);
}

/* An open region without an interior is empty; infinite faces have no boundary. */
static void flat_and_infinite_regions_have_bounds(void **state)
{
    octree_query q = {.kind = OCTREE_QUERY_RANGE, .box = {{-2, -2, 0}, {3, 2, 0}}, .bounds = OCTREE_BOUNDS_OPEN};
    (void)state;
    assert_int_equal(judge_few(q, NULL, 0).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_few(q, IDS(1, 2, 3, 4)).accepting, OCTREE_BOUNDS_CLOSED);
    q.box.min[2] = -INFINITY;
    q.box.max[2] = INFINITY;
    assert_int_equal(judge_few(q, IDS(1)).wrong, OCTREE_WRONG_NONE);
    q.box.max[0] = INFINITY;
    assert_int_equal(judge_few(q, IDS(1, 4)).wrong, OCTREE_WRONG_NONE);
    q = (octree_query){.kind = OCTREE_QUERY_RADIUS, .target = {3, 0, 0}, .bounds = OCTREE_BOUNDS_OPEN};
    assert_int_equal(judge_few(q, NULL, 0).wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge_few(q, IDS(4)).on_boundary, OCTREE_WRONG_EXTRA);
}

static void bounds_are_checked_for_kinds_that_have_a_region(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
        const octree_query q = {.kind = (octree_query_kind)kind, .direction = {1, 0, 0}, .bounds = OCTREE_BOUNDS_KINDS};
        assert_int_equal((about->members & OCTREE_QUERY_HAS_BOUNDS) != 0, !about->neighbors);
        assert_int_equal(octree_query_check(&q), about->neighbors ? OCTREE_OK : OCTREE_BAD_OPTION);
    }
    assert_string_equal(octree_bounds_name(OCTREE_BOUNDS_EITHER), "either");
    assert_null(octree_bounds_name(OCTREE_BOUNDS_KINDS));
}

/* A query outside a game, whose answer nothing judges. */
static void open_answers_leave_the_boundary_out(void **state)
{
    octree_answer made;
    octree *tree = make_tree(cube(-10, 10), 2, 21, OCTREE_GROW);
    (void)state;
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(octree_insert(tree, few[i].position, few[i].id), OCTREE_OK);
    assert_int_equal(octree_query_answer(tree, &open_ball, NULL, NULL, &made), OCTREE_OK);
    assert_true(made.bounds == OCTREE_BOUNDS_OPEN && made.count == 1 && made.points[0].id == 1);
    octree_answer_release(tree, &made);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(judge_agrees_with_a_scan_of_a_lattice),
        cmocka_unit_test(judge_agrees_with_a_scan_of_huge_and_tiny_lattices),
        cmocka_unit_test(real_distances_decide_where_rounded_ones_are_equal),
        cmocka_unit_test(rounded_positions_lie_on_the_boundary),
        cmocka_unit_test(skipped_points_are_not_on_the_boundary),
        cmocka_unit_test(epsilon_allows_the_boundary_of_an_open_ball),
        cmocka_unit_test(flat_and_infinite_regions_have_bounds),
        cmocka_unit_test(bounds_are_checked_for_kinds_that_have_a_region),
        cmocka_unit_test(open_answers_leave_the_boundary_out),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    octree_game_destroy(last_game);
    return failed;
}
