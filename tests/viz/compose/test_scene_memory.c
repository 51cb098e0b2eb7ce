/* SPDX-License-Identifier: MIT */
/* test_scene_memory.c - lets the n-th allocation fail, n = 0, 1, 2 ..., while a scene is made: building fails, or the
 * scene is the same as with enough memory. */
#include "fixture.h"

#include <stdlib.h>

#include "failing_memory.h"
#include "golden_frames.h"
#include "octree/sample.h"
#include "point_scale.h"
#include "scenes.h"

/* ---- Scenes from nothing ------------------------------------------------------------------------------------ */

/* The history of all ticks up to the game's last. */
static tick_history follow(golden_play *play, uint64_t tick)
{
    tick_history h = {0};
    assert_true(tick_history_add(&h, &play->view, play->game));
    for (uint64_t at = 0; at < tick; at++) {
        play_tick(play->game);
        assert_true(tick_history_add(&h, &play->view, play->game));
    }
    return h;
}

static bool make_scene(const golden_play *play, tick_history *h, long count, bool *made, uint64_t *digest)
{
    scene s = {0};
    fail_allocations_after(count);
    *made = tick_scene_build(&s, &play->view, play->game, h, NULL);
    const bool failed = memory_has_failed();
    *digest = *made ? scene_digest(&s) : 0;
    scene_release(&s);
    return failed;
}

static void scene_is_complete_or_fails_without_memory(void **state)
{
    (void)state;
    for (size_t i = 0; i < golden_frame_count; i++) {
        golden_play play;
        octreel_error error = {""};
        uint64_t whole, digest;
        bool made, failed = true;
        if (!golden_is_played(&golden_frames[i]))
            continue;
        if (!golden_open(&golden_frames[i], &play, &error))
            fail_msg("%s", error.text);
        tick_history h = follow(&play, golden_frames[i].tick);
        assert_false(make_scene(&play, &h, -1, &made, &whole));
        assert_true(made);
        for (long count = 0; failed; count++) {
            failed = make_scene(&play, &h, count, &made, &digest);
            assert_true(failed || made);
            if (made)
                assert_int_equal(digest, whole);
        }
        tick_history_release(&h);
        octree_game_destroy(play.game);
    }
}

/* ---- Histories ---------------------------------------------------------------------------------------------- */

static void history_reports_lack_of_memory(void **state)
{
    const octree_session session = octree_session_default();
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    (void)state;
    octree_game *game = start_game(&session);
    bool failed = true;
    for (long count = 0; failed; count++) {
        tick_history h = {0};
        fail_allocations_after(count);
        const bool added = tick_history_add(&h, &v, game);
        failed = memory_has_failed();
        assert_int_equal(added, !failed);
        tick_history_release(&h);
    }
    octree_game_destroy(game);
}

static void point_scale_is_measured_or_reports_lack_of_memory(void **state)
{
    const octree_session session = octree_session_default();
    view measured = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    (void)state;
    measured.point_color = POINTS_BY_HEIGHT;
    measured.shade = SHADE_EDL;
    octree_game *game = start_game(&session);
    bool failed = true;
    for (long count = 0; failed; count++) {
        view v = measured;
        fail_allocations_after(count);
        const bool done = point_scale_compute(&v, octree_game_tree(game), NULL);
        failed = memory_has_failed();
        assert_int_equal(done, !failed);
        assert_int_equal(v.point_scale.given, done);
    }
    octree_game_destroy(game);
}

/* ---- Scenes in the memory of those before -------------------------------------------------------------------- */

enum { BODIES = 5000, EDITS = 6 };

/* So many points that what did not change is kept, and a few edits a tick. */
typedef struct kept_play {
    octree_session session;
    octree_game_body bodies[BODIES];
    octree_edit edits[EDITS];
} kept_play;

static kept_play *make_kept_play(void)
{
    kept_play *p = calloc(1, sizeof *p);
    double(*positions)[3] = malloc(BODIES * sizeof *positions);
    assert_true(p && positions);
    p->session = octree_session_default();
    octree_sample(OCTREE_SAMPLE_UNIFORM, 3, &p->session.tree.world, BODIES, positions);
    for (uint64_t i = 0; i < BODIES; i++)
        p->bodies[i] =
            (octree_game_body){.id = i + 10, .position = {positions[i][0], positions[i][1], positions[i][2]}};
    for (uint64_t i = 0; i < EDITS; i++)
        p->edits[i] = (octree_edit){.tick = 2 + i / 2, .kind = OCTREE_EDIT_REMOVE, .body = p->bodies[i * 700]};
    p->session.tree.leaf_capacity = 8;
    p->session.tree.max_depth = 12;
    p->session.tree.full_leaf = OCTREE_GROW;
    p->session.bodies = p->bodies;
    p->session.body_count = BODIES;
    p->session.edits = p->edits;
    p->session.edit_count = EDITS;
    p->session.query_count = 0;
    p->session.keys = "....";
    free(positions);
    return p;
}

/* Make the scenes of ticks 0 to 4 in one scene, of which that of tick 2 or 3 gets no more than `count` allocations.
 * Returns whether it was too few. */
static bool play_scenes(const kept_play *p, uint64_t tick, long count, uint64_t digests[5])
{
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS & ~(1u << LAYER_TEXT));
    octree_game *game = start_game(&p->session);
    scene s = {0};
    bool failed = false;
    for (uint64_t at = 0; at < 5; at++) {
        if (at > 0)
            play_tick(game);
        fail_allocations_after(at == tick ? count : -1);
        const bool made = tick_scene_build(&s, &v, game, NULL, NULL);
        const bool missed = memory_has_failed();
        assert_true(made || missed);
        digests[at] = made ? scene_digest(&s) : 0;
        failed = failed || missed;
    }
    scene_release(&s);
    octree_game_destroy(game);
    return failed;
}

static void failed_scene_does_not_spoil_the_next_one(void **state)
{
    kept_play *p = make_kept_play();
    uint64_t expected[5], digests[5];
    (void)state;
    assert_false(play_scenes(p, 5, -1, expected));
    for (uint64_t tick = 0; tick < 4; tick++) {
        bool failed = true;
        for (long count = 0; failed; count = 1 + count + count / 16) {
            failed = play_scenes(p, tick, count, digests);
            for (uint64_t at = 0; at < 5; at++)
                if (at != tick || digests[at] != 0)
                    assert_int_equal(digests[at], expected[at]);
        }
    }
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_is_complete_or_fails_without_memory),
        cmocka_unit_test(history_reports_lack_of_memory),
        cmocka_unit_test(point_scale_is_measured_or_reports_lack_of_memory),
        cmocka_unit_test(failed_scene_does_not_spoil_the_next_one),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fail_one_allocation();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
