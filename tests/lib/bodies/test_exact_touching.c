/* SPDX-License-Identifier: MIT */
/* test_exact_touching.c - bodies and regions whose faces nearly touch, a few doubles apart, against rational numbers.
 *
 * The bodies are cubes of one size on a grid whose spacing is their side. Neither the positions nor the faces are
 * exact, so every test of the library is wrong here unless it knows the errors of its sums. In other scenes all numbers
 * are whole, so that no sum has an error, and bounds without any room are wrong. The bodies are asked as a set of
 * bodies and as the points of a tree with a thickness, where half extents are bounded best.
 */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "body_oracle.h"
#include "octree/sample.h"

enum { SIDE = 4, BODIES = SIDE * SIDE * SIDE, SCENES = 8, QUERIES = 200 };

typedef struct scene {
    uint64_t seed;
    bool equal; /* all bodies are cubes of one size */
    octree_body bodies[BODIES];
    octree *tree;
    octree_bodies *set, *shown;
} scene;

/* Returns a double that is at most two steps away. */
static double near(scene *s, double x)
{
    const double up = nextafter(x, HUGE_VAL), down = nextafter(x, -HUGE_VAL);
    const double steps[] = {nextafter(down, -HUGE_VAL), down, x, up, nextafter(up, HUGE_VAL)};
    return steps[random_below(&s->seed, 5)];
}

/* Make the layers of an axis: the middle and the half extent of each. */
static void make_layers(scene *s, double half, double middles[SIDE], double halves[SIDE])
{
    double end = -SIDE * 0.75 + octree_random_unit(&s->seed);
    for (size_t i = 0; i < SIDE; i++) {
        halves[i] = s->equal ? half : 0.5 + octree_random_unit(&s->seed) / 2;
        middles[i] = end + halves[i];
        end = middles[i] + halves[i];
    }
}

static void insert_body(scene *s, octree_body *b)
{
    assert_int_equal(octree_insert(s->tree, b->position, b->id), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(s->set, b), OCTREE_OK);
}

static scene make_scene(uint64_t seed)
{
    scene s = {.seed = seed, .equal = seed % 2};
    const octree_def def = define((octree_box){{-9, -9, -9}, {9, 9, 9}}, 4, 21, OCTREE_GROW);
    const double half = 0.5 + octree_random_unit(&s.seed) / 2;
    double middles[3][SIDE], halves[3][SIDE];
    assert_int_equal(octree_create(&def, &s.tree), OCTREE_OK);
    assert_int_equal(octree_bodies_create(&def, &s.set), OCTREE_OK);
    for (int k = 0; k < 3; k++)
        make_layers(&s, half, middles[k], halves[k]);
    for (size_t i = 0; i < BODIES; i++) {
        const size_t at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        s.bodies[i] = (octree_body){.id = i};
        for (int k = 0; k < 3; k++) {
            s.bodies[i].position[k] = near(&s, middles[k][at[k]]);
            s.bodies[i].half[k] = halves[k][at[k]];
        }
        insert_body(&s, &s.bodies[i]);
    }
    if (s.equal)
        assert_int_equal(octree_bodies_of_points(s.tree, s.bodies[0].half, &s.shown), OCTREE_OK);
    return s;
}

static void destroy_scene(scene *s)
{
    octree_bodies_destroy(s->shown);
    octree_bodies_destroy(s->set);
    octree_destroy(s->tree);
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

/* The face of a body on an axis, moved by at most two steps. */
static double near_face(scene *s, const octree_body *b, int axis, int side)
{
    return near(s, b->position[axis] + side * b->half[axis]);
}

static bool is_zero_vector(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/* Make a region of a kind that touches a face of a body, or nearly does. */
static octree_region make_touching_region(scene *s, octree_region_kind kind, octree_half_space *space)
{
    const octree_body *b = &s->bodies[random_below(&s->seed, BODIES)];
    const int axis = (int)random_below(&s->seed, 3), side = random_below(&s->seed, 2) ? 1 : -1;
    const double face = near_face(s, b, axis, side), size = octree_random_unit(&s->seed);
    const double away = near(s, face + side * size), steep = 1 + octree_random_unit(&s->seed);
    octree_region r = {.kind = kind, .radius = size, .half_spaces = space, .half_space_count = 1};
    *space = (octree_half_space){.offset = near(s, face * -side * steep)};
    space->normal[axis] = -side * steep;
    for (int k = 0; k < 3; k++) {
        r.box.min[k] = b->position[k] - b->half[k] / 2;
        r.box.max[k] = b->position[k] + b->half[k] / 2;
        r.center[k] = r.origin[k] = r.from[k] = b->position[k];
        r.half[k] = kind == OCTREE_REGION_SWEPT ? size : 0;
    }
    r.box.min[axis] = side > 0 ? face : -9;
    r.box.max[axis] = side > 0 ? 9 : face;
    r.center[axis] = r.origin[axis] = r.from[axis] = away;
    r.direction[axis] = -side * steep;
    r.length = near(s, size / steep);
    memcpy(r.to, r.from, sizeof r.to);
    r.to[(axis + 1) % 3] += 1; /* the box grazes the face */
    return r;
}

typedef struct found {
    bool bodies[BODIES];
    size_t count;
} found;

static bool find(const octree_body *body, void *context)
{
    found *f = context;
    f->bodies[body->id] = true;
    f->count++;
    return true;
}

static void assert_region(const scene *s, const octree_bodies *set, const octree_region *region)
{
    found f = {.count = 0};
    size_t expected = 0;
    assert_int_equal(octree_bodies_search(set, region, NULL, find, &f), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        expected += oracle_matches(region, &s->bodies[i]);
        assert_int_equal(f.bodies[i], oracle_matches(region, &s->bodies[i]));
    }
    assert_int_equal(f.count, expected);
}

static void regions_find_bodies_that_they_touch(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        scene s = make_scene(seed);
        for (int i = 0; i < QUERIES; i++) {
            octree_half_space space;
            octree_region region = make_touching_region(&s, (octree_region_kind)(i % OCTREE_REGION_KINDS), &space);
            assert_region(&s, s.set, &region);
            if (s.equal)
                assert_region(&s, s.shown, &region);
        }
        destroy_scene(&s);
    }
}

/* ---- Whole numbers ------------------------------------------------------------------------------------------ */

/* Positions and faces in whole numbers, in a world whose planes are whole numbers, too: regions lie in the faces of
 * cells and of the world. Bodies are points, equal cubes, or plates of which some are larger than the world. */
static scene make_whole_scene(uint64_t seed)
{
    enum { POINTS, CUBES, PLATES };
    scene s = {.seed = seed, .equal = seed % 3 != PLATES};
    const octree_def def = define(cube(0, 8), 4, 21, OCTREE_GROW);
    assert_int_equal(octree_create(&def, &s.tree), OCTREE_OK);
    assert_int_equal(octree_bodies_create(&def, &s.set), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        s.bodies[i] = (octree_body){.id = i};
        for (int k = 0; k < 3; k++) {
            s.bodies[i].position[k] = (double)random_below(&s.seed, 9);
            s.bodies[i].half[k] = seed % 3 == POINTS ? 0 : 1;
            if (seed % 3 == PLATES)
                s.bodies[i].half[k] = random_below(&s.seed, 2) ? 0 : (double)random_below(&s.seed, 20);
        }
        insert_body(&s, &s.bodies[i]);
    }
    if (s.equal)
        assert_int_equal(octree_bodies_of_points(s.tree, s.bodies[0].half, &s.shown), OCTREE_OK);
    return s;
}

static octree_region make_whole_region(scene *s, octree_region_kind kind, octree_half_space *space)
{
    const octree_body *b = &s->bodies[random_below(&s->seed, BODIES)];
    const double far = 1 + (double)random_below(&s->seed, 20);
    octree_region r = {.kind = kind, .radius = far, .half_spaces = space, .half_space_count = 1};
    *space = (octree_half_space){{0, 0, 0}, (double)random_below(&s->seed, 9)};
    for (int k = 0; k < 3; k++) {
        r.center[k] = r.box.min[k] = (double)random_below(&s->seed, 20) - 6;
        r.box.max[k] = r.box.min[k] + (double)random_below(&s->seed, 9);
        r.direction[k] = (double)random_below(&s->seed, 3) - 1; /* often rests on an axis */
        r.origin[k] = r.from[k] = b->position[k] - far * r.direction[k];
        r.to[k] = random_below(&s->seed, 2) ? b->position[k] : r.from[k];
        r.half[k] = random_below(&s->seed, 3) ? 0 : 1;
        space->normal[k] = (double)random_below(&s->seed, 3) - 1;
    }
    r.direction[0] = is_zero_vector(r.direction) ? 1 : r.direction[0];
    space->normal[1] = is_zero_vector(space->normal) ? -1 : space->normal[1];
    r.length = random_below(&s->seed, 2) ? HUGE_VAL : far;
    return r;
}

/* A cast finds the bodies that a search finds. */
static void assert_cast(const octree_bodies *set, const octree_region *region)
{
    octree_hit hits[BODIES];
    size_t count;
    found f = {.count = 0};
    assert_int_equal(octree_bodies_search(set, region, NULL, find, &f), OCTREE_OK);
    assert_int_equal(octree_bodies_cast(set, region, BODIES, NULL, NULL, NULL, hits, &count), OCTREE_OK);
    assert_int_equal(count, f.count);
    for (size_t i = 0; i < count; i++)
        assert_true(f.bodies[hits[i].body.id]);
}

static void regions_of_whole_numbers_find_bodies_that_they_touch(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2 * SCENES; seed++) {
        scene s = make_whole_scene(seed);
        for (int i = 0; i < QUERIES; i++) {
            octree_half_space space;
            const octree_region_kind kind = (octree_region_kind)(i % OCTREE_REGION_KINDS);
            const octree_region region = make_whole_region(&s, kind, &space);
            const bool casts = kind == OCTREE_REGION_RAY || kind == OCTREE_REGION_SWEPT;
            assert_region(&s, s.set, &region);
            if (casts)
                assert_cast(s.set, &region);
            if (s.equal)
                assert_region(&s, s.shown, &region);
            if (s.equal && casts)
                assert_cast(s.shown, &region);
        }
        destroy_scene(&s);
    }
}

/* The world is much smaller than its coordinates, and nothing moves on the axis on which the box touches its face. */
static void a_box_moves_along_the_face_of_a_world_of_three_doubles(void **state)
{
    (void)state;
    const double one = 1 + 0x1p-52, two = 1 + 0x1p-51;
    const octree_def def = define(cube(1, two), 4, 21, OCTREE_GROW);
    const octree_body body = {{1, two, one}, {0, 0, 0x1p-53}, 2};
    const octree_region way = {
        .kind = OCTREE_REGION_SWEPT, .from = {1 - 0x1p-53, two, two}, .to = {1, two, one}, .half = {0, 0, 0x1p-60}};
    octree_bodies *set;
    found f = {.count = 0};
    assert_int_equal(octree_bodies_create(&def, &set), OCTREE_OK);
    assert_int_equal(octree_bodies_insert(set, &body), OCTREE_OK);
    assert_int_equal(octree_bodies_search(set, &way, NULL, find, &f), OCTREE_OK);
    assert_int_equal(f.count, 1);
    assert_cast(set, &way);
    octree_bodies_destroy(set);
}

/* ---- Neighbours and pairs ----------------------------------------------------------------------------------- */

static void assert_nearest(const scene *s, const octree_bodies *set, const double target[3])
{
    octree_hit hits[3];
    size_t count;
    assert_int_equal(octree_bodies_nearest(set, target, 3, HUGE_VAL, NULL, NULL, NULL, hits, &count), OCTREE_OK);
    assert_int_equal(count, 3);
    for (size_t i = 0; i < BODIES; i++) {
        size_t rank = 0;
        while (rank < 3 && hits[rank].body.id != i)
            rank++;
        if (rank == 3) { /* not found: it is farther, or as far with a greater id */
            const int order = oracle_compare_distances(target, &s->bodies[i], &hits[2].body);
            assert_true(order > 0 || (order == 0 && i > hits[2].body.id));
        }
    }
    for (int i = 1; i < 3; i++)
        assert_true(oracle_compare_distances(target, &hits[i - 1].body, &hits[i].body) <= 0);
}

static void targets_on_faces_find_the_nearest_bodies(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        scene s = make_scene(seed);
        for (int i = 0; i < QUERIES; i++) {
            const octree_body *b = &s.bodies[random_below(&s.seed, BODIES)];
            double target[3];
            for (int k = 0; k < 3; k++)
                target[k] = near_face(&s, b, k, random_below(&s.seed, 2) ? 1 : -1);
            assert_nearest(&s, s.set, target);
            if (s.equal)
                assert_nearest(&s, s.shown, target);
        }
        destroy_scene(&s);
    }
}

static bool add_pair(const octree_body *a, const octree_body *b, void *context)
{
    size_t *pairs = context;
    assert_true(oracle_overlap(a, b));
    ++*pairs;
    return true;
}

static void pairs_touch(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        scene s = make_scene(seed);
        size_t expected = 0, pairs = 0, shown = 0;
        for (size_t i = 0; i < BODIES; i++)
            for (size_t j = i + 1; j < BODIES; j++)
                expected += oracle_overlap(&s.bodies[i], &s.bodies[j]);
        assert_int_equal(octree_bodies_pairs(s.set, NULL, add_pair, &pairs), OCTREE_OK);
        assert_int_equal(pairs, expected);
        if (s.equal)
            assert_int_equal(octree_bodies_pairs(s.shown, NULL, add_pair, &shown), OCTREE_OK);
        assert_int_equal(shown, s.equal ? expected : 0);
        assert_true(expected > 0);
        destroy_scene(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_find_bodies_that_they_touch),
        cmocka_unit_test(regions_of_whole_numbers_find_bodies_that_they_touch),
        cmocka_unit_test(a_box_moves_along_the_face_of_a_world_of_three_doubles),
        cmocka_unit_test(targets_on_faces_find_the_nearest_bodies),
        cmocka_unit_test(pairs_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
