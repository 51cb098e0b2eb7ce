/* SPDX-License-Identifier: MIT */
/* test_recorder_random_bodies.c - a recording of random bodies is that of a naive model, however the program hands its
 * bodies to the recorder. */
#include "fixture.h"

#include <stdio.h>

#include "film_again.h"
#include "moving_bodies.h"
#include "moving_tree.h"

enum { TICKS = 40, SEEDS = 6 };

static void record_bodies(octreel_recorder *recorder, moving_bodies *m, int ticks, bodies_source source)
{
    for (int tick = 0; tick < ticks; tick++) {
        const bodies_source next = source < BODIES_SOURCES ? source : (bodies_source)random_below(&m->random, 3);
        if (moving_bodies_record(m, recorder, next) != OCTREEL_OK)
            fail_msg("tick %d: %s", tick, octreel_recorder_error(recorder));
        moving_bodies_step(m);
    }
}

/* With the source BODIES_SOURCES the program changes its source from tick to tick. */
static void check_source(void **state, bodies_source source)
{
    static moving_bodies m;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        char name[16];
        snprintf(name, sizeof name, "film%d", (int)seed);
        const place folder = place_in(*state, name);
        octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
        moving_bodies_make(&m, seed);
        record_bodies(recorder, &m, TICKS, source);
        close_recorder(recorder);
        moving_bodies_assert_recorded(&m, folder.path);
        moving_bodies_release(&m);
    }
    const place folder = place_in(*state, "film1"), again = place_in(*state, "again");
    assert_films_again(&folder, &again, TICKS);
}

static void changes_give_the_session_of_the_model(void **state)
{
    check_source(state, BODIES_CHANGES);
}

static void lists_give_the_session_of_the_model(void **state)
{
    check_source(state, BODIES_LIST);
}

static void sets_give_the_session_of_the_model(void **state)
{
    check_source(state, BODIES_SET);
}

static void sources_in_turn_give_the_session_of_the_model(void **state)
{
    check_source(state, BODIES_SOURCES);
}

static void check_ring(void **state, bodies_source source, size_t size)
{
    static moving_bodies m;
    char name[32];
    snprintf(name, sizeof name, "film%d-%zu", (int)source, size);
    const place folder = place_in(*state, name);
    octreel_recorder *recorder = open_recorder_without_frames(NULL, size);
    moving_bodies_make(&m, 7 + size);
    record_bodies(recorder, &m, TICKS - (int)size, source);
    moving_bodies_forget_ticks(&m);
    record_bodies(recorder, &m, (int)size, source);
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_OK);
    close_recorder(recorder);
    moving_bodies_assert_recorded(&m, folder.path);
    moving_bodies_release(&m);
}

static void ring_gives_the_last_ticks_of_the_model(void **state)
{
    for (int source = 0; source <= BODIES_SOURCES; source++) {
        check_ring(state, (bodies_source)source, 1);
        check_ring(state, (bodies_source)source, 15);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(changes_give_the_session_of_the_model),  TEST(lists_give_the_session_of_the_model),
        TEST(sets_give_the_session_of_the_model),     TEST(sources_in_turn_give_the_session_of_the_model),
        TEST(ring_gives_the_last_ticks_of_the_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
