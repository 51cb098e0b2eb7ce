/* SPDX-License-Identifier: MIT */
/* test_game_many_edits.c - many moves among a tick's edits are made at once: the tick is that of one after the other.
 */
#include "game_fixture.h"

#include <math.h>
#include <string.h>

#include "counting_allocator.h"
#include "fixture.h"

enum { BODIES = 600, EDITS = 1500 };

typedef struct script {
    octree_game_body bodies[BODIES];
    octree_edit edits[EDITS];
} script;

static void random_place(uint64_t *random, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(random, 33) - 16;
    if (random_below(random, 50) == 0)
        at[random_below(random, 3)] = random_below(random, 2) ? NAN : 17;
}

/* Mostly moves; of some that are not there, of some twice. Half of the bodies go on by themselves. */
static void write_script(script *s, uint64_t seed)
{
    uint64_t random = seed;
    for (size_t i = 0; i < BODIES; i++) {
        s->bodies[i] = (octree_game_body){.id = i};
        for (int axis = 0; axis < 3; axis++) {
            s->bodies[i].position[axis] = (double)random_below(&random, 33) - 16;
            s->bodies[i].velocity[axis] = i % 2 ? (double)random_below(&random, 5) - 2 : 0;
        }
    }
    for (size_t i = 0; i < EDITS; i++) {
        octree_edit *e = &s->edits[i];
        *e = (octree_edit){.tick = 1 + i / (EDITS / 3), .kind = OCTREE_EDIT_MOVE, .body = {.id = i * 7 % BODIES}};
        if (random_below(&random, 100) == 0)
            e->body.id = random_below(&random, 2) ? BODIES + i : s->edits[i / 2].body.id;
        if (seed % 2 && random_below(&random, 300) == 0)
            e->kind = random_below(&random, 2) ? OCTREE_EDIT_INSERT : OCTREE_EDIT_REMOVE;
        random_place(&random, e->body.position);
    }
}

/* Between any two of them one that changes nothing: no two are moved at once. Its refusals are left out. */
static octree_status play_apart(octree_game *game, const octree_edit *edits, size_t count, octree_edit *spread)
{
    for (size_t i = 0; i < count; i++) {
        spread[2 * i] = edits[i];
        spread[2 * i + 1] = (octree_edit){.kind = OCTREE_EDIT_REMOVE, .body.id = UINT64_MAX};
    }
    return octree_game_play(game, &(octree_input){.edits = spread, .edit_count = 2 * count});
}

static void assert_same_refusals(const octree_tick *a, const octree_tick *b)
{
    size_t at = 0;
    for (size_t i = 0; i < b->refusal_count; i++) {
        if (b->refusals[i].id == UINT64_MAX)
            continue;
        assert_true(at < a->refusal_count);
        assert_int_equal(a->refusals[at].id, b->refusals[i].id);
        assert_int_equal(a->refusals[at].why, b->refusals[i].why);
        assert_memory_equal(a->refusals[at].position, b->refusals[i].position, sizeof b->refusals[i].position);
        at++;
    }
    assert_int_equal(at, a->refusal_count);
}

static void assert_same_tick(const octree_game *a, const octree_game *b)
{
    const octree_tick *p = octree_game_tick(a), *q = octree_game_tick(b);
    assert_same_refusals(p, q);
    assert_true(p->tree_digest == q->tree_digest);
    assert_int_equal(p->split_count, q->split_count);
    assert_int_equal(p->merge_count, q->merge_count);
    assert_int_equal(p->mover_count, q->mover_count);
    assert_memory_equal(p->movers, q->movers, p->mover_count * sizeof *p->movers);
    for (uint64_t id = 0; id < BODIES; id++) {
        octree_point x = {.id = 0}, y = {.id = 0};
        assert_int_equal(octree_game_find(a, id, &x), octree_game_find(b, id, &y));
        assert_memory_equal(&x, &y, sizeof x);
    }
}

static void moves_at_once_make_the_tick_of_one_after_the_other(void **state)
{
    static script s;
    static octree_edit spread[2 * EDITS];
    (void)state;
    for (uint64_t seed = 0; seed < 12; seed++) {
        write_script(&s, seed);
        const octree_full_leaf full_leaf = seed % 3 ? OCTREE_GROW : OCTREE_REFUSE;
        const octree_session session = {.tree = define(cube(-16, 16), 2, 3 + seed % 3, full_leaf),
                                        .player = {.kind = OCTREE_PLAYER_BODY, .id = 3, .box_size = 1, .sweep = true},
                                        .bodies = s.bodies,
                                        .body_count = BODIES,
                                        .ticks = 5};
        octree_game *at_once, *apart;
        assert_int_equal(octree_game_create(&session, &at_once), OCTREE_OK);
        assert_int_equal(octree_game_create(&session, &apart), OCTREE_OK);
        for (size_t tick = 0; tick < 3; tick++) {
            const octree_edit *edits = s.edits + tick * (EDITS / 3);
            assert_int_equal(octree_game_play(at_once, &(octree_input){.edits = edits, .edit_count = EDITS / 3}),
                             OCTREE_OK);
            assert_int_equal(play_apart(apart, edits, EDITS / 3, spread), OCTREE_OK);
            assert_same_tick(at_once, apart);
            assert_valid(octree_game_tree(at_once));
        }
        octree_game_destroy(at_once);
        octree_game_destroy(apart);
    }
}

/* After NO_MEMORY a game can be ended, and gives all back; a tick that is OK is that with all memory. */
static void a_tick_without_memory_says_so_or_is_the_same(void **state)
{
    static script s;
    const octree_input input = {.edits = s.edits, .edit_count = 500};
    octree_game *whole = NULL;
    size_t failed = 0;
    (void)state;
    write_script(&s, 0);
    for (size_t n = 0; n < 40; n++) {
        counting_allocator counts = {0};
        octree_session session = {.tree = define(cube(-16, 16), 2, 5, OCTREE_GROW),
                                  .player = {.kind = OCTREE_PLAYER_NONE},
                                  .bodies = s.bodies,
                                  .body_count = BODIES,
                                  .ticks = 5};
        octree_game *game;
        if (!whole) {
            assert_int_equal(octree_game_create(&session, &whole), OCTREE_OK);
            assert_int_equal(octree_game_play(whole, &input), OCTREE_OK);
        }
        session.tree.allocator = counting_allocator_use(&counts);
        assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
        counting_allocator_fail_at(&counts, n);
        const octree_status status = octree_game_play(game, &input);
        if (status != OCTREE_NO_MEMORY) {
            assert_int_equal(status, OCTREE_OK);
            assert_same_tick(game, whole);
        }
        failed += status == OCTREE_NO_MEMORY;
        octree_game_destroy(game);
        assert_all_returned(&counts);
    }
    octree_game_destroy(whole);
    assert_true(failed > 5 && failed < 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moves_at_once_make_the_tick_of_one_after_the_other),
        cmocka_unit_test(a_tick_without_memory_says_so_or_is_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
