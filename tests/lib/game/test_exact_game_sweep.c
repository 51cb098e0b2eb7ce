/* SPDX-License-Identifier: MIT */
/* test_exact_game_sweep.c - swept ticks against exact rationals: points and boxes that move past a player that moves,
 * at every scale of doubles. */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "exact_oracle.h"
#include "game_fixture.h"
#include "octree/sample.h"

#define BODIES 54

/* A tick: the player goes up one axis, and every body from a place to another. */
typedef struct crossing {
    double from[3], step, size;
    char key;
    octree_game_body bodies[BODIES];
    octree_edit edits[BODIES];
} crossing;

static double nudged(double value, int steps)
{
    for (; steps > 0; steps--)
        value = next_up(value);
    for (; steps < 0; steps++)
        value = next_down(value);
    return fmin(fmax(value, -DBL_MAX), DBL_MAX);
}

/* Every second body is a point. */
static void draw_half(double half[3], uint64_t *random, double size)
{
    const bool extended = random_below(random, 2);
    for (int axis = 0; axis < 3; axis++)
        half[axis] = extended ? size * octree_random_unit(random) : 0;
}

static void send(crossing *c, size_t i, const double p[3], const double q[3], const double half[3])
{
    c->bodies[i] = (octree_game_body){.id = i, .half = {half[0], half[1], half[2]}};
    c->edits[i] = (octree_edit){.tick = 1, .kind = OCTREE_EDIT_MOVE, .body = {.id = i}};
    for (int axis = 0; axis < 3; axis++) {
        c->bodies[i].position[axis] = fmin(fmax(p[axis], -DBL_MAX), DBL_MAX);
        c->edits[i].body.position[axis] = fmin(fmax(q[axis], -DBL_MAX), DBL_MAX);
    }
}

/* The number of bodies that are hit. The test fails when one is that should not be, or the other way round. */
static size_t check(const crossing *c)
{
    octree_session session = {.tree = define(cube(-DBL_MAX, DBL_MAX), 4, 21, OCTREE_GROW)};
    session.player = (octree_player){.id = 100, .step = c->step, .box_size = c->size, .sweep = true};
    for (int axis = 0; axis < 3; axis++)
        session.player.position[axis] = c->from[axis];
    session.bodies = c->bodies;
    session.edits = c->edits;
    session.body_count = session.edit_count = BODIES;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, c->key);
    size_t at = 0;
    assert_int_equal(tick->refusal_count, 0);
    assert_true(same_position(tick->from, c->from));
    for (size_t i = 0; i < BODIES; i++) {
        const double *p = c->bodies[i].position, *q = c->edits[i].body.position;
        const bool hit = at < tick->hit_count && tick->hits[at].id == i;
        if (hit != exact_touches(tick->from, tick->attempt, c->size, p, q, c->bodies[i].half))
            fail_msg("(%a %a %a) to (%a %a %a) with %a: (%a %a %a) to (%a %a %a) is %s", tick->from[0], tick->from[1],
                     tick->from[2], tick->attempt[0], tick->attempt[1], tick->attempt[2], c->size, p[0], p[1], p[2],
                     q[0], q[1], q[2], hit ? "no hit" : "a hit");
        at += hit;
    }
    assert_int_equal(at, tick->hit_count);
    octree_game_destroy(game);
    return at;
}

/* The end of the step, if it is made. */
static void end_of(const crossing *c, double to[3])
{
    static const char keys[] = "dwe";
    for (int axis = 0; axis < 3; axis++) {
        to[axis] = c->key == keys[axis] ? c->from[axis] + c->step : c->from[axis];
        to[axis] = to[axis] > DBL_MAX ? c->from[axis] : to[axis]; /* refused: it stays */
    }
}

/* A body that is on two or three sides of the box at a moment t, as rounding lets it be. */
static void send_past(crossing *c, size_t i, uint64_t *random, double speed)
{
    static const double moments[] = {0, 1, 0.5, 0.25};
    const uint64_t which = random_below(random, 6);
    const double t = which < 4 ? moments[which] : octree_random_unit(random);
    const bool together = random_below(random, 6) == 0; /* at rest relative to the player, or nearly */
    double to[3], p[3], q[3], half[3];
    end_of(c, to);
    draw_half(half, random, c->size);
    for (int axis = 0; axis < 3; axis++) {
        const double size = fmin(c->size + half[axis], DBL_MAX);
        const double sides[] = {size, -size, size * octree_random_unit(random), size, -size};
        const double center = c->from[axis] * (1 - t) + to[axis] * t;
        const double at = center + sides[random_below(random, 5)];
        const double own = together ? to[axis] - c->from[axis] : speed * (2 * octree_random_unit(random) - 1);
        p[axis] = nudged(fmin(fmax(at - own * t, -DBL_MAX), DBL_MAX), (int)random_below(random, 3) - 1);
        q[axis] = nudged(fmin(fmax(at + own * (1 - t), -DBL_MAX), DBL_MAX), (int)random_below(random, 3) - 1);
    }
    send(c, i, p, q, half);
}

static void near_misses(double place, double reach, double step, double size, double speed, uint64_t seed)
{
    static const char keys[] = "dwe.";
    uint64_t random = seed;
    size_t hits = 0, trials = 40;
    for (size_t i = 0; i < trials; i++) {
        static crossing c;
        c.key = keys[random_below(&random, 4)];
        c.step = step * octree_random_unit(&random);
        c.size = size * octree_random_unit(&random);
        for (int axis = 0; axis < 3; axis++)
            c.from[axis] = fmin(fmax(place + random_between(&random, -reach, reach), -DBL_MAX), DBL_MAX);
        for (size_t j = 0; j < BODIES; j++)
            send_past(&c, j, &random, speed);
        hits += check(&c);
    }
    assert_true(hits > trials * BODIES / 20 && hits < trials * BODIES * 19 / 20); /* both are in it */
}

static void near_misses_of_moving_points_are_told_from_hits(void **state)
{
    (void)state;
    near_misses(0, 1, 1, 0.25, 1, 1);
    near_misses(0, 1, 0.1, 1, 10, 2);
    near_misses(1e15, 8, 16, 4, 32, 3);
    near_misses(-1e9, 1e3, 1, 1e-3, 1e-3, 4);
}

static void near_misses_at_extreme_scales_are_told_from_hits(void **state)
{
    (void)state;
    near_misses(0, DBL_MAX, DBL_MAX, DBL_MAX / 4, DBL_MAX, 5);
    near_misses(0, DBL_MAX / 8, DBL_MAX / 8, DBL_MAX / 16, DBL_MAX / 4, 6);
    near_misses(0, 1e-318, 1e-318, 1e-319, 1e-318, 7);
    near_misses(0, 1e-300, 1e-300, 1e-305, 1e-300, 8);
    near_misses(0, 1e-300, 1e300, 1e-300, 1e-300, 9);
    near_misses(0, 1e200, 1e-200, 1e200, 1e200, 10);
}

static void any_mixture_of_extremes_is_decided_rightly(void **state)
{
    (void)state;
    static const char keys[] = "dwe.";
    uint64_t random = 11;
    for (int i = 0; i < 300; i++) {
        static crossing c;
        c.key = keys[random_below(&random, 4)];
        c.step = fabs(random_extreme(&random));
        c.size = fabs(random_extreme(&random));
        for (int axis = 0; axis < 3; axis++)
            c.from[axis] = random_extreme(&random);
        for (size_t j = 0; j < BODIES; j++) {
            double half[3];
            draw_half(half, &random, fabs(random_extreme(&random)));
            const double p[3] = {random_extreme(&random), random_extreme(&random), random_extreme(&random)};
            const double q[3] = {random_extreme(&random), random_extreme(&random), random_extreme(&random)};
            send(&c, j, p, random_below(&random, 8) == 0 ? p : q, half);
        }
        check(&c);
    }
}

/* Bodies that move with the player along its step, but for an ulp: their relative way is a rounding error long. */
static void ways_that_cancel_but_for_an_ulp_are_decided_rightly(void **state)
{
    (void)state;
    uint64_t random = 12;
    for (int i = 0; i < 100; i++) {
        static crossing c = {.key = 'd'};
        c.step = random_between(&random, 0, 4);
        c.size = random_between(&random, 0, 2);
        double to[3];
        for (int axis = 0; axis < 3; axis++)
            c.from[axis] = random_between(&random, -1, 1);
        end_of(&c, to);
        for (size_t j = 0; j < BODIES; j++) {
            double p[3], q[3], half[3];
            draw_half(half, &random, 1);
            for (int axis = 0; axis < 3; axis++) {
                const double size = c.size + half[axis], side = random_below(&random, 2) == 0 ? size : -size;
                p[axis] = nudged(c.from[axis] + side, (int)random_below(&random, 5) - 2);
                q[axis] = nudged(to[axis] + side, (int)random_below(&random, 5) - 2);
            }
            send(&c, j, p, q, half);
        }
        check(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(near_misses_of_moving_points_are_told_from_hits),
        cmocka_unit_test(near_misses_at_extreme_scales_are_told_from_hits),
        cmocka_unit_test(any_mixture_of_extremes_is_decided_rightly),
        cmocka_unit_test(ways_that_cancel_but_for_an_ulp_are_decided_rightly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
