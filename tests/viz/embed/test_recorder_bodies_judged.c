/* SPDX-License-Identifier: MIT */
/* test_recorder_bodies_judged.c - the pairs and answers of a program, and the collisions of its player, are judged
 * against the boxes of its bodies. */
#include "fixture.h"

#include <stdio.h>
#include <string.h>

#include "body_sets.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

/* Append 'W' for wrong pairs or a wrong answer, '.' for right ones, and 'C' for a collision. */
static void note_judgement(const char *line, size_t number, void *context)
{
    (void)number;
    strcat(context, strstr(line, "\"collided\"") ? "C" : strstr(line, "\"wrong\"]") ? "W" : ".");
}

static octreel_status judged_tick(octreel_recorder *recorder, const octree_pair *pairs, size_t count)
{
    const octree_body met[] = {{{0, 0, 0}, {1, 1, 1}, 1}, {{2, 2, 2}, {1, 1, 1}, 2}, {{4.5, 2, 2}, {1, 1, 1}, 3}};
    const octree_foreign_pairs found = {.pairs = pairs, .pair_count = count};
    return octreel_recorder_tick(recorder, NULL,
                                 &(octreel_tick_info){.bodies = met, .body_count = 3, .foreign_pairs = &found});
}

/* The boxes of 1 and 2 have one common corner. */
static void foreign_pairs_are_judged_against_boxes(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const octree_pair pairs[] = {{2, 1}, {2, 3}};
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(judged_tick(recorder, pairs, 1), OCTREEL_OK);
    assert_int_equal(judged_tick(recorder, pairs, 0), OCTREEL_OK);
    assert_int_equal(judged_tick(recorder, pairs, 2), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_judgement, ".WW");
    assert_films_again(&folder, &again, 3);
}

static const octree_body boxes[] = {{{4, 0, 0}, {1, 2, 0.5}, 7}, {{-4, 1, 0}, {0, 0, 0}, 9}, {{0, 0, 3}, {2, 0, 0}, 5}};

static octreel_status ball_tick(octreel_recorder *recorder, const uint64_t *answer, size_t count)
{
    const octree_query query = {.kind = OCTREE_QUERY_RADIUS,
                                .target = {6, 0, 0},
                                .radius = 1,
                                .answered = true,
                                .answer = answer,
                                .answer_count = count};
    return octreel_recorder_tick(
        recorder, NULL, &(octreel_tick_info){.bodies = boxes, .body_count = 3, .queries = &query, .query_count = 1});
}

static void answers_are_judged_against_boxes(void **state)
{
    const place folder = place_in(*state, "film");
    const uint64_t touched[] = {7, 9};
    octreel_recorder *recorder = open_recorder_without_frames(folder.path, 0);
    assert_int_equal(ball_tick(recorder, touched, 1), OCTREEL_OK);
    assert_int_equal(ball_tick(recorder, touched, 0), OCTREEL_OK);
    assert_int_equal(ball_tick(recorder, touched, 2), OCTREEL_OK);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_judgement, ".WW");
}

static void jump_tick(octreel_recorder *recorder, const octree_body bodies[2])
{
    const octreel_tick_info about = {.bodies = bodies, .body_count = 2};
    assert_int_equal(octreel_recorder_tick(recorder, NULL, &about), OCTREEL_OK);
}

/* Record a player with these half extents, which jumps over a thin wall while it is resized or not. */
static void record_jump(void **state, double half, bool resized, const char *expected)
{
    octree_body jump[] = {body_at(-4, 0, 0, half, 1), {{0, 0, 0}, {0.25, 2, 2}, 2}};
    char name[32];
    snprintf(name, sizeof name, "film%g-%d", half, resized);
    const place folder = place_in(*state, name);
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = folder.path;
    def.every = 0;
    def.tree.world = cube(-8, 8);
    def.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = 1, .box_size = 0.5, .sweep = true};
    octreel_recorder *recorder = open_recorder(&def);
    jump_tick(recorder, jump);
    jump[0].position[0] = 4;
    jump[0].half[1] += resized;
    jump_tick(recorder, jump);
    jump[0].position[0] = 1; /* the boxes overlap if half is 1, but the player's collision box ends at 0.5 */
    jump[1].half[1] = 3;
    jump_tick(recorder, jump);
    close_recorder(recorder);
    assert_noted_lines(folder.path, note_judgement, expected);
}

static void player_collides_with_boxes_on_its_way_while_both_change(void **state)
{
    record_jump(state, 0, false, ".C.");
    record_jump(state, 1, false, ".C.");
    record_jump(state, 1, true, ".C.");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(foreign_pairs_are_judged_against_boxes),
        TEST(answers_are_judged_against_boxes),
        TEST(player_collides_with_boxes_on_its_way_while_both_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
