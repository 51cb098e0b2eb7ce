/* test_replay.c - sessions replay to the same ticks.jsonl and the same scenes on every machine and compiler: to the
 * digests that stand here. tests/viz/same_ticks_everywhere runs this under the compilers at hand, with FMA and without.
 *
 * What ticks or scenes say may change on purpose; then the digests here change with it. The tree's speed, its layout in
 * memory, a compiler or a processor must not change them.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixture.h"
#include "game_fixture.h"
#include "octree/digest.h"
#include "octree/sample.h"
#include "random_session.h"
#include "tick_scene.h"
#include "ticks_write.h"

/* What a whole session came to. */
typedef struct replay {
    uint64_t ticks;  /* of the bytes of ticks.jsonl, but for what it says of frames */
    uint64_t scenes; /* of the scene digests of all ticks, from every camera */
} replay;

static void add_scenes(scene *s, const octree_game *game, uint64_t *all)
{
    for (int i = 0; i < CAMERA_COUNT; i++) {
        view v = view_default();
        v.camera = (view_camera)i;
        assert_true(tick_scene_build(s, &v, game, NULL));
        *all = octree_digest_word(*all, scene_digest(s));
    }
}

static void add_line(FILE *out, const octree_game *game)
{
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
}

static replay play(const octree_session *session)
{
    replay r = {OCTREE_DIGEST_START, OCTREE_DIGEST_START};
    char *text = NULL;
    size_t size = 0;
    scene s = {0};
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    octree_game *game = start_game(session);
    for (;;) {
        add_scenes(&s, game, &r.scenes);
        add_line(out, game);
        if (octree_game_over(game))
            break;
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    assert_int_equal(fclose(out), 0);
    r.ticks = octree_digest_bytes(r.ticks, text, size);
    octree_game_destroy(game);
    scene_release(&s);
    free(text);
    return r;
}

static void assert_replays(const octree_session *session, replay pinned)
{
    const replay r = play(session);
    if (r.ticks != pinned.ticks || r.scenes != pinned.scenes)
        fail_msg("ticks 0x%016" PRIx64 " and scenes 0x%016" PRIx64 " are not those that are pinned", r.ticks, r.scenes);
}

static void the_default_session_replays_to_its_digests(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    assert_replays(&session, (replay){UINT64_C(0x1e9b8f8e0f49e676), UINT64_C(0x122bff0b757f3cf0)});
}

static void a_random_session_replays_to_its_digests(void **state)
{
    (void)state;
    static random_session made;
    random_session_full(&made, 2);
    assert_replays(&made.session, (replay){UINT64_C(0x6ac583f9fa7da02a), UINT64_C(0x7cfc26bb35513528)});
}

enum { BODIES = 60, TICKS = 120 };

/* Bodies that all move, in a world and with velocities that are no round numbers: nearly every operation rounds, and
 * one that was fused with another would show. */
static void a_session_that_rounds_everywhere_replays_to_its_digests(void **state)
{
    (void)state;
    static octree_body bodies[BODIES];
    static double positions[BODIES][3];
    uint64_t random = 5;
    octree_query queries[2] = {
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .at_player = true, .box = cube(-21.7, 13.3)},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .target = {0.1, 31.7, -11.3}},
    };
    octree_session session = {.tree =
                                  define((octree_box){{-33.3, -27.1, -0.7}, {41.9, 36.7, 55.1}}, 2, 9, OCTREE_GROW)};
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 7, &session.tree.world, BODIES, positions), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        bodies[i].id = i;
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = positions[i][axis];
            bodies[i].velocity[axis] = random_between(&random, -1.9, 1.9);
        }
    }
    session.player = (octree_player){.id = 1000, .position = {0.1, 0.2, 0.3}, .step = 1.7, .box_size = 3.3};
    session.bodies = bodies;
    session.body_count = BODIES;
    session.keys = "wdnewwddnssaafewnddwwnaae.nsdwd";
    session.ticks = TICKS;
    session.queries = queries;
    session.query_count = 2;
    assert_replays(&session, (replay){UINT64_C(0xc7061f796fe89348), UINT64_C(0x6ebc4e4729ba77de)});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_session_replays_to_its_digests),
        cmocka_unit_test(a_random_session_replays_to_its_digests),
        cmocka_unit_test(a_session_that_rounds_everywhere_replays_to_its_digests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
