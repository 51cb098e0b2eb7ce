/* SPDX-License-Identifier: MIT */
/* test_replay.c - sessions replay to the same ticks.jsonl and the same scenes on every machine and compiler: to the
 * digests in replay_digests.txt, one line for each tick. tests/viz/same_ticks_everywhere runs this test with the
 * installed compilers, with FMA and without.
 *
 * Ticks or scenes may change on purpose: the target replay-update (test_replay --update) then rewrites the file. The
 * tree's speed, its layout in memory, a compiler or a processor must not change a digest. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "game_fixture.h"
#include "octree/digest.h"
#include "octree/sample.h"
#include "random_session.h"
#include "tick_scene.h"
#include "ticks_write.h"
#include "recording_file.h"

/* The digests of a tick: of its line, and for every camera of the view and of each array of the scene. */
enum { LINE, VIEW, BOXES, SEGMENTS, MARKERS, PANELS, LABELS, COLUMNS };
static const char *const columns[COLUMNS] = {"line", "view", "boxes", "segments", "markers", "panels", "labels"};

typedef struct row {
    char session[16];
    uint64_t tick;
    uint32_t digests[COLUMNS];
} row;

/* ---- Sessions ----------------------------------------------------------------------------------------------- */

static octree_session random_session_of_all_kinds(void)
{
    static random_session made;
    random_session_full(&made, 2);
    return made.session;
}

enum { BODIES = 60, TICKS = 120 };

/* All points move, and neither the world nor the velocities are round numbers: nearly every operation rounds, and a
 * fused multiply-add would change a digest. */
static octree_session session_that_rounds(void)
{
    static octree_game_body bodies[BODIES];
    static double positions[BODIES][3];
    static octree_query queries[2];
    uint64_t random = 5;
    octree_session session = {.tree =
                                  define((octree_box){{-33.3, -27.1, -0.7}, {41.9, 36.7, 55.1}}, 2, 9, OCTREE_GROW)};
    queries[0] = (octree_query){
        .tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .at_player = true, .box = cube(-21.7, 13.3)};
    queries[1] = (octree_query){.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .target = {0.1, 31.7, -11.3}};
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
    return session;
}

static const struct {
    const char *name;
    octree_session (*make)(void);
} sessions[] = {
    {"default", octree_session_default},
    {"random", random_session_of_all_kinds},
    {"rounding", session_that_rounds},
};

enum { SESSIONS = sizeof sessions / sizeof sessions[0] };

/* ---- Digests ------------------------------------------------------------------------------------------------ */

/* The digest of a scene with only one of its arrays; without any it covers the view and the camera. */
static uint64_t digest_alone(const scene *s, int column)
{
    scene alone = *s;
    alone.boxes.count = column == BOXES ? s->boxes.count : 0;
    alone.segments.count = column == SEGMENTS ? s->segments.count : 0;
    alone.markers.count = column == MARKERS ? s->markers.count : 0;
    alone.panels.count = column == PANELS ? s->panels.count : 0;
    alone.labels.count = column == LABELS ? s->labels.count : 0;
    return scene_digest(&alone);
}

static uint64_t digest_line(const octree_game *game)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
    assert_int_equal(fclose(out), 0);
    const uint64_t digest = octree_digest_bytes(OCTREE_DIGEST_START, text, size);
    free(text);
    return digest;
}

static row digest_tick(const char *session, const octree_game *game, scene *s)
{
    uint64_t digests[COLUMNS];
    row r = {.tick = octree_game_tick(game)->number};
    snprintf(r.session, sizeof r.session, "%s", session);
    for (int i = 0; i < COLUMNS; i++)
        digests[i] = OCTREE_DIGEST_START;
    digests[LINE] = digest_line(game);
    for (int i = 0; i < CAMERA_COUNT; i++) {
        view v = view_make_default();
        v.camera = (view_camera)i;
        assert_true(tick_scene_build(s, &v, game, NULL, NULL));
        for (int column = VIEW; column < COLUMNS; column++)
            digests[column] = octree_digest_word(digests[column], digest_alone(s, column));
    }
    for (int i = 0; i < COLUMNS; i++)
        r.digests[i] = (uint32_t)digests[i];
    return r;
}

/* Play a session and pass the row of each tick to a function. */
static void play(int which, void (*handle)(const row *r, void *context), void *context)
{
    const octree_session session = sessions[which].make();
    octree_game *game = start_game(&session);
    scene s = {0};
    for (bool over = false; !over;) {
        const row r = digest_tick(sessions[which].name, game, &s);
        handle(&r, context);
        over = octree_game_over(game);
        if (!over)
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    octree_game_destroy(game);
    scene_release(&s);
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

static void write_row(const row *r, void *context)
{
    FILE *out = context;
    fprintf(out, "%s %" PRIu64, r->session, r->tick);
    for (int i = 0; i < COLUMNS; i++)
        fprintf(out, " %08" PRIx32, r->digests[i]);
    fputc('\n', out);
}

static int update(void)
{
    FILE *out = fopen(REPLAY_DIGESTS, "w");
    if (!out)
        return EXIT_FAILURE;
    fputs("# session tick", out);
    for (int i = 0; i < COLUMNS; i++)
        fprintf(out, " %s", columns[i]);
    fputs("; written by the target replay-update\n", out);
    for (int i = 0; i < SESSIONS; i++)
        play(i, write_row, out);
    return fclose(out) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* False at the end of the file. */
static bool read_row(FILE *in, row *r)
{
    if (fscanf(in, " %15s %" SCNu64, r->session, &r->tick) != 2)
        return false;
    for (int i = 0; i < COLUMNS; i++)
        assert_int_equal(fscanf(in, "%8" SCNx32, &r->digests[i]), 1);
    return true;
}

/* Open the file of digests at the first row of a session. */
static FILE *open_rows(const char *session)
{
    FILE *in = fopen(REPLAY_DIGESTS, "r");
    row r;
    assert_non_null(in);
    assert_int_equal(fscanf(in, "#%*[^\n]"), 0);
    for (long start = ftell(in); read_row(in, &r); start = ftell(in)) {
        if (strcmp(r.session, session) == 0) {
            fseek(in, start, SEEK_SET);
            return in;
        }
    }
    fail_msg("%s has no session %s", REPLAY_DIGESTS, session);
    return in;
}

static void assert_row(const row *r, void *context)
{
    row pinned;
    if (!read_row(context, &pinned) || strcmp(pinned.session, r->session) != 0 || pinned.tick != r->tick)
        fail_msg("session %s has a tick %" PRIu64 " without pinned digests", r->session, r->tick);
    for (int i = 0; i < COLUMNS; i++)
        if (r->digests[i] != pinned.digests[i])
            fail_msg("session %s: tick %" PRIu64
                     " is the first that differs from what is pinned, in its %s; if that is "
                     "meant: cmake --build BUILD --target replay-update",
                     r->session, r->tick, columns[i]);
}

static void assert_replays(int which)
{
    row behind;
    FILE *in = open_rows(sessions[which].name);
    play(which, assert_row, in);
    if (read_row(in, &behind) && strcmp(behind.session, sessions[which].name) == 0)
        fail_msg("session %s ends before the pinned tick %" PRIu64, behind.session, behind.tick);
    fclose(in);
}

static void default_session_replays_to_its_digests(void **state)
{
    (void)state;
    assert_replays(0);
}

static void random_session_replays_to_its_digests(void **state)
{
    (void)state;
    assert_replays(1);
}

static void session_that_rounds_everywhere_replays_to_its_digests(void **state)
{
    (void)state;
    assert_replays(2);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_session_replays_to_its_digests),
        cmocka_unit_test(random_session_replays_to_its_digests),
        cmocka_unit_test(session_that_rounds_everywhere_replays_to_its_digests),
    };
    if (argc == 2 && strcmp(argv[1], "--update") == 0)
        return update();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
