/* SPDX-License-Identifier: MIT */
/* test_float_mode.c - on a thread with any floating-point mode all functions give the answers of the default mode, call
 * the caller's functions in the caller's mode, and restore it, after errors too. */
#include "fixture.h"

#include <fenv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "octree/bodies.h"
#include "octree/digest.h"
#include "octree/game.h"
#include "octree/sample.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/* ---- Modes --------------------------------------------------------------------------------------------------- */

typedef struct mode {
    const char *name;
    int rounding;
    unsigned sse;   /* bits of MXCSR to be set */
    unsigned clear; /* bits to be cleared */
} mode;

static const mode modes[] = {
    {"default", FE_TONEAREST, 0, 0},    {"up", FE_UPWARD, 0, 0},
    {"down", FE_DOWNWARD, 0, 0},        {"to zero", FE_TOWARDZERO, 0, 0},
#if defined(__SSE2__)
    {"flush", FE_TONEAREST, 0x8000, 0}, {"denormals are zero", FE_TONEAREST, 0x0040, 0},
    {"both", FE_TONEAREST, 0x8040, 0},  {"all", FE_UPWARD, 0x8040, 0},
    {"traps", FE_TONEAREST, 0, 0x1f80}, /* every exception traps, an inexact result too */
#endif
};
enum { MODES = sizeof modes / sizeof modes[0] };

static void set_mode(const mode *m)
{
    assert_int_equal(fesetround(m->rounding), 0);
#if defined(__SSE2__)
    _mm_setcsr((_mm_getcsr() | m->sse) & ~(m->clear | 0x3fu));
#endif
}

static void set_default_mode(void)
{
#if defined(__SSE2__)
    _mm_setcsr(0x1f80);
#endif
    assert_int_equal(fesetround(FE_TONEAREST), 0);
}

/* The thread's mode as a number; exceptions that were raised are no part of it. */
static unsigned current_mode(void)
{
    unsigned found = (unsigned)fegetround();
#if defined(__SSE2__)
    found = found << 16 | (_mm_getcsr() & 0xffc0u);
#endif
    return found;
}

/* ---- A script that calls all functions ------------------------------------------------------------------------ */

/* What the calls of a script returned, and whether the mode was the caller's after each call and in each callback. */
typedef struct run {
    unsigned mode;
    uint64_t digest;
    bool kept;
    const char *lost; /* where the mode was another one */
    size_t callbacks[5], allocations_left;
    octree *tree;
} run;

enum { IN_VISITOR, IN_TRACER, IN_WALK, IN_ALLOCATOR, IN_EXECUTOR };

static void check_mode(run *r, const char *where)
{
    if (current_mode() != r->mode && r->kept) {
        r->kept = false;
        r->lost = where;
    }
}

static void add_bytes(run *r, const void *bytes, size_t size)
{
    r->digest = octree_digest_words(r->digest, bytes, size);
}

/* Add the status of a call, and check the mode after it. */
static void said(run *r, const char *what, octree_status status)
{
    check_mode(r, what);
    r->digest = octree_digest_word(r->digest, status);
}
#define SAY(call) said(r, #call, call)

static void check_callback(run *r, int which)
{
    static const char *const names[] = {"a visitor", "a tracer", "a walk", "an allocator", "an executor"};
    check_mode(r, names[which]);
    r->callbacks[which]++;
}

/* A visitor may call the library itself. */
static bool visit(const octree_point *point, void *context)
{
    run *r = context;
    check_callback(r, IN_VISITOR);
    add_bytes(r, point, sizeof *point);
    if (!octree_contains(r->tree, point->position, point->id))
        r->digest++;
    check_mode(r, "a query in a visitor");
    return true;
}

static void trace(octree_address address, octree_trace_kind kind, void *context)
{
    run *r = context;
    check_callback(r, IN_TRACER);
    r->digest = octree_digest_word(octree_digest_word(r->digest, address), kind);
}

static octree_walk_order look(const octree_node *node, void *context)
{
    run *r = context;
    check_callback(r, IN_WALK);
    add_bytes(r, &node->box, sizeof node->box);
    return OCTREE_WALK_ON;
}

static void *allocate(size_t size, void *context)
{
    run *r = context;
    check_callback(r, IN_ALLOCATOR);
    return r->allocations_left > 0 && r->allocations_left-- > 0 ? malloc(size) : NULL;
}

static void release(void *memory, size_t size, void *context)
{
    (void)size;
    check_callback(context, IN_ALLOCATOR);
    free(memory);
}

/* Runs the tasks on the calling thread. */
static void execute(octree_task *task, size_t count, void *task_context, void *context)
{
    check_callback(context, IN_EXECUTOR);
    for (size_t i = 0; i < count; i++) {
        task(i, task_context);
        check_mode(context, "a task");
    }
}

/* The script's lengths are multiples of a unit. They are made beforehand, because the script itself must not compute in
 * a mode that would give it other numbers. */
enum { POINTS = 3000, GREATEST = 2000 };
static double multiples[2 * GREATEST + 1];
static octree_point points[POINTS];

static double times(int count)
{
    return multiples[GREATEST + count];
}

static void make_lengths(double unit)
{
    uint64_t random = 1;
    for (int i = -GREATEST; i <= GREATEST; i++)
        multiples[GREATEST + i] = i * unit;
    for (uint64_t i = 0; i < POINTS; i++) {
        points[i].id = i;
        for (int axis = 0; axis < 3; axis++)
            points[i].position[axis] = times((int)random_below(&random, 1999) - 999);
    }
}

static octree_def definition(run *r, octree_full_leaf full_leaf)
{
    octree_def def = octree_def_default();
    def.world = cube(times(-1000), times(1000));
    def.leaf_capacity = 8;
    def.full_leaf = full_leaf;
    def.allocator = (octree_allocator){allocate, release, r};
    def.executor = (octree_executor){execute, r};
    return def;
}

static void change(run *r)
{
    static octree_status statuses[POINTS];
    static double to[POINTS][3];
    octree *tree = r->tree;
    size_t done = 0;
    for (size_t i = 0; i < POINTS; i++)
        memcpy(to[i], points[POINTS - 1 - i].position, sizeof to[i]);
    SAY(octree_insert_many(tree, points, POINTS - 100, statuses, &done));
    add_bytes(r, statuses, (POINTS - 100) * sizeof *statuses);
    for (size_t i = POINTS - 100; i < POINTS; i++)
        SAY(octree_insert(tree, points[i].position, points[i].id));
    for (size_t i = 0; i < 50; i++)
        SAY(octree_remove(tree, points[i].position, points[i].id));
    for (size_t i = 50; i < 100; i++)
        SAY(octree_move(tree, points[i].position, points[i].id, to[i]));
    SAY(octree_remove_many(tree, points + 100, 200, NULL, &done));
    SAY(octree_move_many(tree, points + 300, (const double(*)[3])to + 300, 1500, statuses, &done));
    add_bytes(r, statuses, 1500 * sizeof *statuses);
    r->digest = octree_digest_word(octree_digest_word(r->digest, done), octree_digest(tree));
    const octree_box larger = cube(times(-1500), times(1500)), smaller = cube(0, times(1));
    SAY(octree_reworld(tree, &larger));
    SAY(octree_reworld(tree, &smaller));
    SAY(octree_compact(tree));
    SAY(octree_replace_all(tree, points, POINTS / 2, NULL, &done));
    SAY(octree_tune(tree, NULL));
    r->digest = octree_digest_word(r->digest, octree_digest(tree));
    check_mode(r, "octree_digest");
}

static void search_ranges(run *r, const double at[3])
{
    const octree *tree = r->tree;
    const octree_search how = {.epsilon = times(25), .trace = trace, .trace_context = r};
    octree_box box;
    size_t count;
    static octree_point found[POINTS];
    const double to[3] = {at[2], at[1], at[0]};
    SAY(octree_collision_box(at, times(200), &box));
    add_bytes(r, &box, sizeof box);
    SAY(octree_range(tree, &box, visit, r));
    SAY(octree_range_search(tree, &box, &how, visit, r));
    SAY(octree_range_count(tree, &box, &count));
    r->digest = octree_digest_word(r->digest, count);
    SAY(octree_range_collect(tree, &box, &how, found, POINTS, &count));
    add_bytes(r, found, count * sizeof *found);
    SAY(octree_range_collect_sorted(tree, &box, NULL, found, 20, &count));
    add_bytes(r, found, (count < 20 ? count : 20) * sizeof *found);
    SAY(octree_radius(tree, at, times(200), NULL, visit, r));
    SAY(octree_radius(tree, at, times(200), &how, visit, r));
    SAY(octree_collide(tree, at, times(200), NULL, visit, r));
    const octree_point self = {{at[0], at[1], at[2]}, found[0].id}; /* often the id of another point */
    SAY(octree_collide_search(tree, at, times(200), &self, &how, visit, r));
    SAY(octree_collide_swept(tree, at, to, times(50), NULL, &how, visit, r));
}

static void ask(run *r, const octree_query *query, const double player[3])
{
    const octree_search how = {.trace = trace, .trace_context = r};
    octree_answer answer;
    octree_box bound;
    SAY(octree_query_check(query));
    SAY(octree_query_answer(r->tree, query, player, &how, &answer));
    r->digest = octree_digest_word(r->digest, octree_answer_bound(&answer, &bound));
    add_bytes(r, &bound, sizeof bound);
    add_bytes(r, answer.points, answer.count * sizeof *answer.points);
    octree_answer_release(r->tree, &answer);
    check_mode(r, "octree_answer_release");
}

static void search_neighbors(run *r, const double at[3])
{
    const octree *tree = r->tree;
    const octree_search how = {.skip = OCTREE_SKIP_COINCIDENT, .trace = trace, .trace_context = r};
    octree_neighbor found[40] = {{.distance = 0}};
    bool one[40] = {false};
    double targets[40][3];
    size_t count;
    for (int i = 0; i < 40; i++)
        for (int axis = 0; axis < 3; axis++)
            targets[i][axis] = times(axis * 20 - i * 13);
    SAY(octree_nearest(tree, at, OCTREE_SKIP_NONE, 0, found));
    SAY(octree_nearest_k(tree, at, 39, &how, found + 1, &count));
    add_bytes(r, found, sizeof found);
    SAY(octree_nearest_within(tree, at, times(300), &how, found));
    SAY(octree_nearest_batch(tree, (const double(*)[3])targets, 40, &how, found, one));
    add_bytes(r, found, sizeof found);
    ask(r, &(octree_query){.kind = OCTREE_QUERY_RADIUS, .target = {at[0], at[1], at[2]}, .radius = times(300)}, at);
    ask(r, &(octree_query){.kind = OCTREE_QUERY_RANGE, .at_player = true, .box = cube(times(-200), times(200))}, at);
}

static void look_around(run *r)
{
    const octree *tree = r->tree;
    octree_node node;
    uint64_t id;
    SAY(octree_walk(tree, look, r));
    SAY(octree_node_at(tree, 8, &node));
    add_bytes(r, &node.box, sizeof node.box);
    for (size_t i = 0; i < 300; i++) {
        SAY(octree_locate(tree, points[i].position, &node));
        add_bytes(r, &node.box, sizeof node.box);
        SAY(octree_find(tree, points[i].position, &id));
        r->digest = octree_digest_word(r->digest, octree_contains(tree, points[i].position, points[i].id));
        octree_point same_id = points[i + 1];
        same_id.id = points[i].id;
        r->digest = octree_digest_word(r->digest, (uint64_t)octree_compare_points(&points[i], &same_id));
    }
    octree_address where;
    r->digest = octree_digest_word(r->digest, octree_check(tree, &where) == NULL);
    const octree_box cell = octree_cell_box(&(octree_box){{times(-3), 0, 0}, {times(1), 5, times(1)}}, 01234);
    add_bytes(r, &cell, sizeof cell);
    check_mode(r, "looking around");
}

/* Every call fails. */
static void fail_all(run *r, const double at[3])
{
    octree *tree = r->tree, *other;
    const octree_def def = definition(r, OCTREE_GROW);
    const octree_box nan = {{NAN, 0, 0}, {1, 1, 1}}, reversed = {{0, 0, times(1)}, {1, 1, 0}};
    octree_neighbor nearest;
    octree_answer answer;
    octree_node node;
    size_t count;
    SAY(octree_insert(tree, (double[]){INFINITY, 0, 0}, 1));
    SAY(octree_insert(tree, (double[]){times(2000), 0, 0}, 1));
    SAY(octree_remove(tree, at, 1 << 20));
    SAY(octree_move(tree, at, 1 << 20, at));
    SAY(octree_find(tree, NULL, NULL));
    SAY(octree_range(tree, &nan, visit, r));
    SAY(octree_range(tree, &reversed, visit, r));
    SAY(octree_range(tree, &reversed, NULL, r));
    SAY(octree_range_count(tree, NULL, &count));
    SAY(octree_radius(tree, at, times(-1), NULL, visit, r)); /* a negative subnormal number is not zero */
    SAY(octree_collide_swept(tree, at, at, times(-1), NULL, NULL, visit, r));
    SAY(octree_nearest_within(tree, at, times(-1), NULL, &nearest));
    SAY(octree_nearest_k(tree, at, 1, &(octree_search){.epsilon = times(-1)}, &nearest, &count));
    SAY(octree_nearest_batch(tree, NULL, 3, NULL, &nearest, NULL));
    SAY(octree_locate(tree, (double[]){0, NAN, 0}, &node));
    SAY(octree_walk(tree, NULL, NULL));
    SAY(octree_query_answer(tree, NULL, NULL, NULL, &answer));
    SAY(octree_create(NULL, &other));
    r->allocations_left = 0;
    SAY(octree_create(&def, &other));
    SAY(octree_compact(tree));
    SAY(octree_tune(tree, NULL));
    r->allocations_left = SIZE_MAX;
}

/* `extended`: every third body is a box, and their pairs are listed. */
static void play(run *r, bool extended)
{
    octree_session session = octree_session_default();
    static octree_game_body bodies[50];
    session.tree = definition(r, OCTREE_GROW);
    session.player.sweep = true;
    session.player.step = times(40);
    session.player.box_size = times(300);
    for (size_t i = 0; i < 50; i++) {
        bodies[i] = (octree_game_body){.id = i + 10, .velocity = {times(1), times(-3), 0}};
        memcpy(bodies[i].position, points[i].position, sizeof bodies[i].position);
        for (int axis = 0; extended && i % 3 == 0 && axis < 3; axis++)
            bodies[i].half[axis] = times(1 + axis);
    }
    session.pairs = extended;
    session.bodies = bodies;
    session.body_count = 50;
    const octree_query queries[] = {{.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 5},
                                    {.kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = times(500)}};
    octree_game *game;
    SAY(octree_game_create(&session, &game));
    for (int i = 0; i < 20; i++) {
        SAY(octree_game_step(game, "wwdseafn."[i % 9]));
        SAY(octree_game_ask(game, queries, 2));
        SAY(octree_game_play(game, &(octree_input){.key = 'd', .queries = queries, .query_count = 2}));
        const octree_tick *tick = octree_game_tick(game);
        r->digest = octree_digest_word(r->digest, tick->tree_digest);
        add_bytes(r, tick->player, sizeof tick->player);
        add_bytes(r, tick->hits, tick->hit_count * sizeof *tick->hits);
        add_bytes(r, tick->pairs, tick->pair_count * sizeof *tick->pairs);
        for (size_t a = 0; a < tick->answer_count; a++)
            for (size_t n = 0; tick->answers[a].neighbors && n < tick->answers[a].count; n++)
                add_bytes(r, &tick->answers[a].neighbors[n], sizeof(octree_neighbor));
    }
    SAY(octree_game_step(game, '?'));
    octree_game_destroy(game);
    check_mode(r, "octree_game_destroy");
    double positions[50][3];
    const octree_box box = cube(times(-1), times(1));
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++) {
        SAY(octree_sample((octree_sample_kind)kind, 1, &box, 50, positions));
        add_bytes(r, positions, sizeof positions);
    }
    const octree_shape shape = {.kind = OCTREE_SHAPE_BOX, .at = {0, 0, times(1)}, .to = {1, 1, 0}};
    SAY(octree_input_check(&(octree_input){.shapes = &shape, .shape_count = 1}));
    octree_foreign_node node = {.id = 1, .box = {{0, 0, times(1)}, {1, 1, 0}}};
    SAY(octree_foreign_check(&(octree_foreign_tree){.nodes = &node, .node_count = 1}, NULL));
}

/* ---- Bodies --------------------------------------------------------------------------------------------------- */

static bool visit_body(const octree_body *body, void *context)
{
    check_callback(context, IN_VISITOR);
    add_bytes(context, body, sizeof *body);
    return true;
}

static bool visit_pair(const octree_body *a, const octree_body *b, void *context)
{
    return visit_body(a, context) && visit_body(b, context);
}

/* A body whose size depends on its number. */
static octree_body make_body(size_t i)
{
    octree_body body = {.id = i};
    memcpy(body.position, points[i].position, sizeof body.position);
    for (int axis = 0; axis < 3; axis++)
        body.half[axis] = times((int)((i * 7 + (size_t)axis * 5) % (i % 50 == 0 ? 900 : 40)));
    return body;
}

static void search_bodies(run *r, const octree_bodies *set, const octree_region *region)
{
    octree_hit hits[8];
    size_t count;
    const octree_search how = {.trace = trace, .trace_context = r};
    SAY(octree_region_check(region));
    SAY(octree_bodies_search(set, region, &how, visit_body, r));
    SAY(octree_bodies_nearest(set, region->center, 8, region->radius, &how, visit_body, r, hits, &count));
    for (size_t i = 0; i < count; i++)
        add_bytes(r, &hits[i], sizeof hits[i]);
    SAY(octree_bodies_cast(set, region, 8, &how, visit_body, r, hits, &count));
    for (size_t i = 0; i < count; i++)
        add_bytes(r, &hits[i], sizeof hits[i]);
}

static void change_bodies(run *r, octree_bodies *set)
{
    enum { MANY = 1200, MOVED = 200 };
    static octree_body bodies[MANY + MOVED];
    octree_body bad = make_body(1);
    for (size_t i = 0; i < MANY + MOVED; i++)
        bodies[i] = make_body(i);
    SAY(octree_bodies_insert_many(set, bodies, MANY, NULL, NULL));
    for (size_t i = 0; i < 50; i++) {
        SAY(octree_bodies_remove(set, &bodies[i]));
        SAY(octree_bodies_insert(set, &bodies[i]));
        SAY(octree_bodies_move(set, &bodies[i], &bodies[MANY + i]));
    }
    SAY(octree_bodies_move_many(set, bodies + 50, bodies + MANY + 50, 100, NULL, NULL));
    SAY(octree_bodies_remove_many(set, bodies + 200, 100, NULL, NULL));
    SAY(octree_bodies_compact(set));
    bad.half[1] = times(-1); /* a negative subnormal number is not zero */
    SAY(octree_bodies_insert(set, &bad));
    r->digest = octree_digest_word(r->digest, octree_bodies_contain(set, &bodies[400]));
    r->digest = octree_digest_word(r->digest, octree_bodies_digest(set));
    r->digest = octree_digest_word(r->digest, octree_bodies_check(set) == NULL);
    r->digest = octree_digest_word(r->digest, octree_compare_bodies(&bodies[0], &bad) < 0);
    check_mode(r, "bodies");
}

static void use_bodies(run *r)
{
    octree_bodies *set;
    octree_def def = definition(r, OCTREE_GROW);
    SAY(octree_bodies_create(&def, &set));
    change_bodies(r, set);
    for (size_t i = 0; i < 20; i++) {
        const octree_half_space half_space = {{1, -1, 0.5}, times((int)i * 20)};
        octree_region region = {
            .contained = i % 2, .half_spaces = &half_space, .half_space_count = 1, .length = HUGE_VAL};
        octree_collision_box(points[i].position, times(100), &region.box);
        memcpy(region.center, points[i].position, sizeof region.center);
        memcpy(region.origin, points[i].position, sizeof region.origin);
        memcpy(region.from, points[i].position, sizeof region.from);
        memcpy(region.to, points[i + 1].position, sizeof region.to);
        memcpy(region.direction, points[i + 2].position, sizeof region.direction);
        region.radius = times(150);
        region.half[0] = times(10);
        for (int kind = 0; kind < OCTREE_REGION_KINDS; kind++) {
            region.kind = (octree_region_kind)kind;
            search_bodies(r, set, &region);
        }
    }
    SAY(octree_bodies_pairs(set, NULL, visit_pair, r));
    octree_bodies_destroy(set);
    check_mode(r, "octree_bodies_destroy");
}

/* Call everything in a mode. */
static run run_script(const mode *m)
{
    run all = {.kept = true, .digest = OCTREE_DIGEST_START, .allocations_left = SIZE_MAX}, *r = &all;
    const octree_def def = definition(r, OCTREE_GROW);
    set_mode(m);
    r->mode = current_mode();
    SAY(octree_create(&def, &r->tree));
    change(r);
    for (size_t i = 0; i < 20; i++) {
        search_ranges(r, points[i].position);
        search_neighbors(r, points[i].position);
    }
    look_around(r);
    fail_all(r, points[5].position);
    play(r, false);
    play(r, true);
    use_bodies(r);
    octree_destroy(r->tree);
    check_mode(r, "octree_destroy");
    set_default_mode();
    return all;
}

/* ---- Tests --------------------------------------------------------------------------------------------------- */

static void check_all_modes(double unit)
{
    make_lengths(unit);
    const run usual = run_script(&modes[0]);
    for (int i = 0; i < MODES; i++) {
        const run unusual = run_script(&modes[i]);
        if (!unusual.kept)
            fail_msg("%s: the mode is another one: %s", modes[i].name, unusual.lost);
        if (unusual.digest != usual.digest)
            fail_msg("%s: other answers than in the default mode", modes[i].name);
        for (int which = 0; which < 5; which++)
            assert_true(unusual.callbacks[which] > 0 && unusual.callbacks[which] == usual.callbacks[which]);
    }
}

static void answers_are_the_same_in_every_mode(void **state)
{
    (void)state;
    check_all_modes(1);
    check_all_modes(0x1.23456789abcdep-3);
}

static void answers_about_subnormal_positions_are_the_same_in_every_mode(void **state)
{
    (void)state;
    check_all_modes(0x1p-1074);
    check_all_modes(0x1p-1060);
}

static void answers_whose_squares_overflow_are_the_same_in_every_mode(void **state)
{
    (void)state;
    check_all_modes(0x1.fp1013);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_the_same_in_every_mode),
        cmocka_unit_test(answers_about_subnormal_positions_are_the_same_in_every_mode),
        cmocka_unit_test(answers_whose_squares_overflow_are_the_same_in_every_mode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
