/* SPDX-License-Identifier: MIT */
/* test_recorder_threads.c - a program and the worker that films it share nothing but what is handed over. Built with
 * ThreadSanitizer: the recorder and the library, whose every access is watched; what draws is taken as it is.
 */
#include "fixture.h"

#include <pthread.h>
#include <stdio.h>

#include "files.h"
#include "moving_tree.h"

enum { TICKS = 30, PROGRAMS = 2 };

typedef struct program {
    pthread_t thread;
    place folder;
    octreel_recorder *recorder;
    moving_tree tree;
    bool ok;
} program;

/* No assertions in other threads than the test's. */
static void *run(void *context)
{
    program *p = context;
    for (int tick = 0; p->ok && tick < TICKS; tick++) {
        moving_tree_step(&p->tree);
        p->ok = octreel_recorder_tick(p->recorder, p->tree.tree, &p->tree.about) == OCTREEL_OK;
    }
    return NULL;
}

static void begin(program *p, const place *folder, size_t ring)
{
    p->folder = *folder;
    p->ok = true;
    moving_tree_make(&p->tree, OCTREE_REFUSE, 3);
    octreel_recorder_def def = small_recorder(&p->tree, p->folder.path);
    def.queue_ticks = 3;
    def.ring = ring;
    p->recorder = open_recorder(&def);
}

static void end(program *p)
{
    assert_true(p->ok);
    close_recorder(p->recorder);
    moving_tree_release(&p->tree);
}

static void a_recorder_is_used_by_one_thread_after_another(void **state)
{
    program p;
    const place folder = place_in(*state, "film");
    begin(&p, &folder, 0);
    assert_recorded(p.recorder, &p.tree);
    assert_int_equal(pthread_create(&p.thread, NULL, run, &p), 0);
    assert_int_equal(pthread_join(p.thread, NULL), 0);
    record_steps(p.recorder, &p.tree, 3);
    end(&p);
}

static void recorders_of_several_threads_share_nothing(void **state)
{
    program programs[PROGRAMS];
    const place folders[PROGRAMS] = {place_in(*state, "a"), place_in(*state, "b")};
    for (int i = 0; i < PROGRAMS; i++)
        begin(&programs[i], &folders[i], 0);
    for (int i = 0; i < PROGRAMS; i++)
        assert_int_equal(pthread_create(&programs[i].thread, NULL, run, &programs[i]), 0);
    for (int i = 0; i < PROGRAMS; i++)
        assert_int_equal(pthread_join(programs[i].thread, NULL), 0);
    for (int i = 0; i < PROGRAMS; i++)
        end(&programs[i]);
    assert_same_folders(folders[0].path, folders[1].path, NULL);
}

static void a_ring_is_filmed_by_a_thread_of_its_own(void **state)
{
    program p;
    const place folder = place_in(*state, "film");
    begin(&p, &folder, 8);
    record_steps(p.recorder, &p.tree, TICKS);
    assert_int_equal(octreel_recorder_write(p.recorder, folder.path, NULL), OCTREEL_OK);
    end(&p);
}

static void a_recording_that_breaks_off_ends_in_order(void **state)
{
    program p;
    const place folder = place_in(*state, "film"), gone = place_in(*state, "gone");
    octreel_status status = OCTREEL_OK;
    begin(&p, &folder, 0);
    record_steps(p.recorder, &p.tree, 5); /* more than the queue and the worker hold: tick 0 is filmed */
    assert_int_equal(rename(folder.path, gone.path), 0);
    for (int i = 0; status == OCTREEL_OK && i < 100; i++)
        status = octreel_recorder_tick(p.recorder, p.tree.tree, NULL);
    assert_int_equal(status, OCTREEL_BROKEN);
    assert_int_equal(octreel_recorder_close(p.recorder), OCTREEL_BROKEN);
    octreel_recorder_destroy(p.recorder);
    moving_tree_release(&p.tree);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_recorder_is_used_by_one_thread_after_another),
        TEST(recorders_of_several_threads_share_nothing),
        TEST(a_ring_is_filmed_by_a_thread_of_its_own),
        TEST(a_recording_that_breaks_off_ends_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
