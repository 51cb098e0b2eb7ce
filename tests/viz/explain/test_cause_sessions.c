/* SPDX-License-Identifier: MIT */
/* test_cause_sessions.c - every part of a session is changed in turn; the headline reports the change. */
#include "fixture.h"
#include "session_variant.h"

/* ---- Options ------------------------------------------------------------------------------------------------- */

static void set_world(variant *v)
{
    v->session.tree.world.max[2] = 12.5;
}

static void set_capacity(variant *v)
{
    v->session.tree.leaf_capacity = 8;
}

static void set_depth(variant *v)
{
    v->session.tree.max_depth = 0;
}

static void set_rule(variant *v)
{
    v->session.tree.full_leaf = OCTREE_GROW;
}

static void set_player(variant *v)
{
    v->session.player.id = 77;
}

static void set_start(variant *v)
{
    v->session.player.position[0] = 0.5;
}

static void set_step(variant *v)
{
    v->session.player.step = 0.25;
}

static void set_box(variant *v)
{
    v->session.player.box_size = 4;
}

static void set_sweep(variant *v)
{
    v->session.player.sweep = true;
}

static void set_minus_zero(variant *v)
{
    v->session.player.position[0] = -0.0;
}

static void set_two(variant *v)
{
    set_capacity(v);
    set_step(v);
}

static void each_option_is_named_with_both_values(void **state)
{
    (void)state;
    assert_change_headline(set_world,
                           "another world ((-10, -10, -10) to (10, 10, 12.5), was (-10, -10, -10) to (10, 10, 10)): "
                           "every tick from 0 on differs");
    assert_change_headline(set_capacity, "another leaf capacity (8, was 2): every tick from 0 on differs");
    assert_change_headline(set_depth, "another depth (0, was 5): every tick from 0 on differs");
    assert_change_headline(set_rule, "another rule for full leaves (grow, was refuse): " SAME_TICKS);
    assert_change_headline(set_player, "another player's id (77, was 100): every tick from 0 on differs");
    assert_change_headline(set_start,
                           "another start of the player ((0.5, 0, 0), was (0, 0, 0)): every tick from 0 on differs");
    assert_change_headline(set_minus_zero, "another start of the player ((-0, 0, 0), was (0, 0, 0)): " SAME_TICKS);
    assert_change_headline(set_step, "another step of the player (0.25, was 1): every tick from 1 on differs");
    assert_change_headline(set_box, "another collision box (4, was 0.5): every tick from 0 on differs");
    assert_change_headline(set_sweep, "another swept collision test (on, was off): every tick from 0 on differs");
}

static void options_come_before_their_consequences(void **state)
{
    (void)state;
    assert_change_headline(
        set_two,
        "another leaf capacity (8, was 2), another step of the player (0.25, was 1): every tick from 0 on differs");
}

/* ---- The kind of player --------------------------------------------------------------------------------------- */

static void set_nobody(variant *v)
{
    v->session.player = (octree_player){.kind = OCTREE_PLAYER_NONE};
}

static void set_body(variant *v)
{
    v->session.player.kind = OCTREE_PLAYER_BODY;
    v->session.player.id = 1;
}

static void set_all(variant *v)
{
    set_player(v);
    set_start(v);
    set_step(v);
    set_box(v);
    set_sweep(v);
}

static void set_nobody_with_all(variant *v)
{
    set_all(v);
    v->session.player.kind = OCTREE_PLAYER_NONE;
}

static void set_keys(variant *v)
{
    v->session.player = (octree_player){.id = 1000, .step = 1, .box_size = 0.5};
}

static void move_body_of_no_player(variant *v)
{
    v->session.player.kind = OCTREE_PLAYER_NONE;
    v->session.player.id = 3;
}

static void different_kind_of_player_is_named(void **state)
{
    (void)state;
    assert_change_headline(set_nobody, "another kind of player (none, was keys): every tick from 0 on differs");
    assert_change_headline(
        set_body,
        "another player's id (1, was 100), another kind of player (body, was keys): every tick from 0 on differs");
    assert_change_headline_from(set_nobody, set_keys,
                                "another kind of player (keys, was none): every tick from 0 on differs");
    assert_change_headline_from(set_nobody, set_body,
                                "another kind of player (body, was none): every tick from 0 on differs");
    assert_change_headline_from(set_body, set_nobody,
                                "another kind of player (none, was body): every tick from 0 on differs");
}

/* Nobody has no step, and a body none that is read. */
static void members_that_a_kind_of_player_ignores_are_not_named(void **state)
{
    (void)state;
    assert_change_headline(set_nobody_with_all,
                           "another kind of player (none, was keys): every tick from 0 on differs");
    assert_change_headline_from(set_nobody, set_nobody_with_all, "");
    assert_change_headline_from(set_body, set_step, "");
    assert_change_headline_from(set_body, set_start, "");
    assert_change_headline_from(set_body, set_box, "another collision box (4, was 0.5): every tick from 0 on differs");
}

/* ---- Points -------------------------------------------------------------------------------------------------- */

static void add_body(variant *v)
{
    v->bodies[v->session.body_count++] = (octree_game_body){.id = 5, .position = {9, -9, 9}};
}

static void drop_body(variant *v)
{
    v->bodies[1] = v->bodies[3];
    v->session.body_count--;
}

static void move_body(variant *v)
{
    v->bodies[2].position[1] = -7;
}

static void push_body(variant *v)
{
    v->bodies[2].velocity[1] = -0.5;
}

static void swap_bodies(variant *v)
{
    const octree_game_body first = v->bodies[0];
    v->bodies[0] = v->bodies[1];
    v->bodies[1] = first;
}

static void move_all(variant *v)
{
    for (size_t i = 0; i < v->session.body_count; i++)
        v->bodies[i].position[0] -= 0.5;
}

/* Nobody has an id, and so it is nobody's. */
static void points_are_named_without_a_player(void **state)
{
    (void)state;
    assert_change_headline_from(
        move_body_of_no_player, move_body,
        "another initial point (point 3: (7, -7, 7), was (7, 7, 7)); tick 0: node 5 only in the "
        "frames, node 7 divided only in the reference, "
        "point 3 moved");
}

static void points_at_the_start_are_named(void **state)
{
    (void)state;
    assert_change_headline(
        add_body, "one more initial point (point 5: (9, -9, 9)); tick 0: node 5 only in the frames, point 5 added");
    assert_change_headline(
        drop_body,
        "one initial point fewer (point 2: (-4, 5, -6)); tick 0: node 2 only in the reference, point 2 removed");
    assert_change_headline(move_body,
                           "another initial point (point 3: (7, -7, 7), was (7, 7, 7)); tick 0: node 5 only in "
                           "the frames, point 3 moved");
    assert_change_headline(push_body,
                           "another velocity of a point (point 3: (0, -0.5, 0), was (0, 0, 0)); tick 1: point 3 moved");
    assert_change_headline(swap_bodies, "another order of the initial points; " SAME_TICKS);
    assert_change_headline(move_all,
                           "4 other initial points (points 1, 2, 3 and 4); tick 0: points 1, 2, 3 and 4 moved");
}

/* ---- Values of points ----------------------------------------------------------------------------------------- */

static void give(variant *v, uint64_t id, point_value value)
{
    assert_true(point_values_add_entries(&v->values, &(point_entry){id, value}, 1));
}

static void give_color(variant *v)
{
    give(v, 3, (point_value){.color = {255, 0, 16}, .has[POINT_COLOR] = true});
}

static void give_some(variant *v)
{
    give(v, 1, (point_value){.intensity = 0.5F, .has[POINT_INTENSITY] = true});
    give(v, 9, (point_value){.class = 2, .has[POINT_CLASS] = true});
}

static void change_intensity(variant *v)
{
    v->values.rows[0].intensity = 0.1F;
}

static void change_class(variant *v)
{
    v->values.rows[point_values_find_row(&v->values, 9) - v->values.rows].class = 6;
}

static void drop_values(variant *v)
{
    point_values_release(&v->values);
}

static void give_classes(variant *v)
{
    for (uint64_t id = 1; id <= 4; id++)
        give(v, id, (point_value){.class = 7, .has[POINT_CLASS] = true});
}

static void add_body_with_class(variant *v)
{
    add_body(v);
    give(v, v->bodies[v->session.body_count - 1].id, (point_value){.class = 7, .has[POINT_CLASS] = true});
}

static void values_of_points_are_named(void **state)
{
    (void)state;
    assert_change_headline(give_color, "another colour of a point (point 3: #ff0010, was none); " SAME_TICKS);
    assert_change_headline_from(give_some, change_intensity,
                                "another intensity of a point (point 1: 0.1, was 0.5); " SAME_TICKS);
    assert_change_headline_from(give_some, change_class, "another class of a point (point 9: 6, was 2); " SAME_TICKS);
    assert_change_headline_from(
        give_some, drop_values,
        "another intensity of a point (point 1: none, was 0.5), another class of a point (point 9: none, "
        "was 2); " SAME_TICKS);
    assert_change_headline(give_classes, "4 other classes of points (points 1, 2, 3 and 4); " SAME_TICKS);
}

static void values_of_a_point_on_one_side_are_not_named(void **state)
{
    (void)state;
    assert_change_headline(
        add_body_with_class,
        "one more initial point (point 5: (9, -9, 9)); tick 0: node 5 only in the frames, point 5 added");
}

/* ---- Keys ---------------------------------------------------------------------------------------------------- */

static void other_key(variant *v)
{
    v->session.keys = "wdsa";
}

static void other_keys(variant *v)
{
    v->session.keys = "dddd";
}

/* What is missing is a wait. */
static void waits(variant *v)
{
    v->session.keys = "wdwa..";
}

static void shorter(variant *v)
{
    v->session.ticks = 5;
}

static void quits(variant *v)
{
    v->session.keys = "wdq";
}

static void keys_are_named_by_their_ticks(void **state)
{
    (void)state;
    assert_change_headline(
        other_key, "another key at tick 3 (s, was w); tick 3: another place of the player ((1, 0, 0), was (1, 2, 0))");
    assert_change_headline(
        other_keys, "3 other keys (ticks 1, 3 and 4); tick 1: another place of the player ((1, 0, 0), was (0, 1, 0))");
    assert_change_headline(waits, "");
    assert_change_headline(shorter, "another last tick (5, was 6); " SAME_TICKS);
    assert_change_headline(quits, "another last tick (2, was 6); " SAME_TICKS);
}

/* ---- Edits --------------------------------------------------------------------------------------------------- */

static void one_more_edit(variant *v)
{
    v->edits[3] = (octree_edit){5, OCTREE_EDIT_REMOVE, {.id = 3}};
    v->session.edit_count++;
}

static void one_edit_fewer(variant *v)
{
    v->session.edit_count--;
}

static void other_edit(variant *v)
{
    v->edits[0].body.position[2] = -4;
}

static void faster_edit(variant *v)
{
    v->edits[1].body.velocity[0] = -1;
}

static void swap_edits(variant *v)
{
    const octree_edit first = v->edits[0];
    v->edits[0] = v->edits[1];
    v->edits[1] = first;
}

/* What a removal says of a place means nothing. */
static void idle_edit(variant *v)
{
    v->edits[2].body.position[0] = 5;
}

static void many_edits(variant *v)
{
    for (uint64_t i = 0; i < 4; i++)
        v->edits[3 + i] = (octree_edit){5, OCTREE_EDIT_INSERT, {.id = 20 + i, .position = {-9, -9, -9 + (double)i}}};
    v->session.edit_count += 4;
}

static void late_edit_and_early_key(variant *v)
{
    one_more_edit(v);
    other_key(v);
    v->queries[v->session.query_count - 1].box.max[0] = 4;
}

static void the_first_tick_comes_first(void **state)
{
    (void)state;
    assert_change_headline(
        late_edit_and_early_key,
        "another query at every tick (range (-5, -5, -5) to (4, 5, 5), was (-5, -5, -5) to (5, 5, 5)); tick 0: "
        "another max in the range query ((4, 5, 5), was (5, 5, 5)), another cost in the range query, another "
        "number of visited nodes; another key at tick 3 (s, was w), one more edit at tick 5 (remove 3)");
}

static void edits_are_named_by_tick_and_point(void **state)
{
    (void)state;
    assert_change_headline(
        one_more_edit,
        "one more edit at tick 5 (remove 3); tick 5: node 7/7 divided only in the reference, point 3 removed");
    assert_change_headline(one_edit_fewer,
                           "one edit fewer at tick 4 (remove 2); tick 4: node 2 only in the frames, point 2 added");
    assert_change_headline(other_edit, "another edit at tick 2 (move id 1, position (1, 2, -4), was (1, 2, 4)); tick "
                                       "2: node 6 only in the frames, point 1 moved");
    assert_change_headline(
        faster_edit, "another edit at tick 2 (insert id 9, position (9, 9, 9), velocity (-1, 0, 0), was none); tick 2: "
                     "point 9 moved");
    assert_change_headline(swap_edits, "another order of the edits at tick 2; " SAME_TICKS);
    assert_change_headline(idle_edit, "");
    assert_change_headline(
        many_edits,
        "4 more edits (points 20, 21, 22 and 23); tick 5: node 0 only in the frames, points 20, 21, 22 and 23 added");
}

/* ---- Queries ------------------------------------------------------------------------------------------------- */

static void one_more_query(variant *v)
{
    v->queries[2] = v->queries[1];
    v->queries[1] = (octree_query){.tick = 4, .kind = OCTREE_QUERY_NEAREST, .target = {1, 1, 1}};
    v->session.query_count = 3;
}

/* Each a clause of its own: the first alone is told in the line. */
static void three_more_queries(variant *v)
{
    for (uint64_t i = 0; i < 3; i++)
        v->queries[i] = (octree_query){.tick = 4 + i, .kind = OCTREE_QUERY_NEAREST, .target = {1, 1, 1}};
    v->session.query_count = 3;
}

static void no_query(variant *v)
{
    v->session.query_count = 0;
}

static void one_query_fewer(variant *v)
{
    v->session.query_count = 1;
}

static void wider_query(variant *v)
{
    v->queries[1].box.max[1] = 8;
    v->queries[1].box.max[2] = 8;
    v->queries[1].box.max[0] = 8;
}

/* A ball has no box. */
static void idle_query(variant *v)
{
    v->queries[0].box.max[0] = 8;
    v->queries[0].k = 3;
}

static void queries_are_named_by_kind_and_tick(void **state)
{
    (void)state;
    assert_change_headline(
        one_more_query,
        "one more query at tick 4 (nearest (1, 1, 1)); tick 4: the nearest query asked only in the frames");
    assert_change_headline_from(
        no_query, three_more_queries,
        "one more query at tick 4 (nearest (1, 1, 1)) and 2 more of this kind; tick 4: the nearest query "
        "asked only in the frames");
    assert_change_headline(one_query_fewer,
                           "one query fewer at every tick (range (-5, -5, -5) to (5, 5, 5)); tick 0: the range "
                           "query asked only in the reference");
    assert_change_headline(wider_query,
                           "another query at every tick (range (-5, -5, -5) to (8, 8, 8), was (-5, -5, -5) to "
                           "(5, 5, 5)); tick 0: 2 more hits in the range query (points 3 and 4)");
    assert_change_headline(idle_query, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_option_is_named_with_both_values),
        cmocka_unit_test(options_come_before_their_consequences),
        cmocka_unit_test(different_kind_of_player_is_named),
        cmocka_unit_test(members_that_a_kind_of_player_ignores_are_not_named),
        cmocka_unit_test(points_at_the_start_are_named),
        cmocka_unit_test(points_are_named_without_a_player),
        cmocka_unit_test(values_of_points_are_named),
        cmocka_unit_test(values_of_a_point_on_one_side_are_not_named),
        cmocka_unit_test(keys_are_named_by_their_ticks),
        cmocka_unit_test(the_first_tick_comes_first),
        cmocka_unit_test(edits_are_named_by_tick_and_point),
        cmocka_unit_test(queries_are_named_by_kind_and_tick),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
