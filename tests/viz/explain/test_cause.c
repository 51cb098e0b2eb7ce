/* SPDX-License-Identifier: MIT */
/* test_cause.c - random sessions with one change each: the cause that is found is this change alone, and its
 * consequences are those that brute force finds. A number among the arguments is the number of seeds. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cause_words.h"
#include "changed_session.h"
#include "fixture.h"
#include "game_fixture.h"
#include "text.h"
#include "ticks_write.h"

#define SEEDS 60 /* in the quick run */

static uint64_t seeds = SEEDS;

/* ---- What brute force finds ---------------------------------------------------------------------------------- */

/* What is drawn and in no line: the ways that a swept test was made along, and which nodes were met. */
static void print_drawn(FILE *stream, const octree_tick *tick)
{
    for (int axis = 0; tick->swept && axis < 3; axis++)
        fprintf(stream, "from %.17g\n", tick->from[axis]);
    for (size_t i = 0; tick->swept && i < 3 * tick->hit_count; i++)
        fprintf(stream, "hit from %.17g\n", tick->hit_from[i / 3][i % 3]);
    for (size_t i = 0; i < tick->visit_count; i++)
        fprintf(stream, "met %" PRIx64 " %d %d\n", tick->visits[i].node, (int)tick->visits[i].touch,
                tick->visits[i].taken);
    for (size_t i = 0; i < tick->hit_leaf_count; i++)
        fprintf(stream, "hit in %" PRIx64 "\n", tick->hit_leaves[i]);
}

/* As ticks.jsonl has it, without the digest of the tree: that knows of options, too. */
static char *line_of(const octree_game *game)
{
    octree_tick tick = *octree_game_tick(game);
    tick.tree_digest = 0;
    char *text;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    tick_write(stream, &tick, &(tick_extras){.frame = NULL});
    print_drawn(stream, octree_game_tick(game));
    assert_int_equal(fclose(stream), 0);
    return text;
}

/* The nodes of one tree that are not so in the other, below nodes that are. */
typedef struct counting {
    const octree *other;
    size_t missing, inner;
} counting;

static octree_walk_order count_node(const octree_node *node, void *context)
{
    counting *c = context;
    octree_node other, above;
    const octree_address parent = node->address >> 3;
    if (parent && (octree_node_at(c->other, parent, &above) != OCTREE_OK || above.leaf))
        return OCTREE_WALK_ON;
    if (octree_node_at(c->other, node->address, &other) != OCTREE_OK)
        c->missing++;
    else
        c->inner += other.leaf && !node->leaf;
    return OCTREE_WALK_ON;
}

/* A point that is in one tree so and not in the other: elsewhere there, or not there at all. */
typedef struct misplaced {
    const octree *other;
    size_t count;
} misplaced;

static bool count_point(const octree_point *point, void *context)
{
    misplaced *m = context;
    m->count += !octree_contains(m->other, point->position, point->id);
    return true;
}

/* Everything in which two trees of one world can differ. */
typedef struct tree_counts {
    counting nodes[2];
    misplaced points[2];
} tree_counts;

static tree_counts count_unlike(const octree *a, const octree *b)
{
    static const octree_box all = {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
    tree_counts counts = {{{.other = b}, {.other = a}}, {{.other = b}, {.other = a}}};
    octree_walk(a, count_node, &counts.nodes[0]);
    octree_walk(b, count_node, &counts.nodes[1]);
    octree_range(a, &all, count_point, &counts.points[0]);
    octree_range(b, &all, count_point, &counts.points[1]);
    return counts;
}

static bool any_unlike(const octree *a, const octree *b)
{
    const tree_counts c = count_unlike(a, b);
    return c.nodes[0].missing || c.nodes[0].inner || c.nodes[1].missing || c.nodes[1].inner || c.points[0].count ||
           c.points[1].count;
}

static uint64_t count_facts(const cause_facts *facts, const char *where, cause_change change)
{
    const cause_group *group = cause_find_group(facts, where, change);
    return group ? group->found : 0;
}

/* Where both have a player, the tick tells of it. */
static void assert_trees_told(const octree_game *const games[2], const cause_facts *facts)
{
    const bool both = octree_game_tick(games[0])->has_player && octree_game_tick(games[1])->has_player;
    const octree *a = octree_game_tree(games[0]), *b = octree_game_tree(games[1]);
    const uint64_t points =
        count_facts(facts, "tree.points", CAUSE_OTHER) + (both ? count_facts(facts, "player", CAUSE_OTHER) : 0);
    const tree_counts c = count_unlike(a, b);
    assert_int_equal(count_facts(facts, "nodes.gone", CAUSE_MORE), c.nodes[0].missing);
    assert_int_equal(count_facts(facts, "nodes.born", CAUSE_MORE), c.nodes[1].missing);
    assert_int_equal(count_facts(facts, "nodes.merged", CAUSE_MORE), c.nodes[0].inner);
    assert_int_equal(count_facts(facts, "nodes.split", CAUSE_MORE), c.nodes[1].inner);
    assert_int_equal(points + count_facts(facts, "tree.points", CAUSE_LESS), c.points[0].count);
    assert_int_equal(points + count_facts(facts, "tree.points", CAUSE_MORE), c.points[1].count);
}

static bool is_there(const octree *tree, const json_t *position, uint64_t id)
{
    double place[3];
    for (size_t i = 0; i < 3; i++)
        place[i] = json_number_value(json_array_get(position, i));
    return octree_contains(tree, place, id);
}

/* The facts that are listed are so in both trees. */
static void assert_group_holds(const octree *a, const octree *b, const cause_group *group)
{
    for (size_t i = 0; i < cause_count_listed(group); i++) {
        const cause_fact *fact = &group->listed[i];
        octree_address address;
        octree_node node;
        if (strcmp(group->where, "tree.points") == 0) {
            assert_true(!fact->a || is_there(a, fact->a, fact->id));
            assert_true(!fact->b || is_there(b, fact->b, fact->id));
        }
        if (strncmp(group->where, "nodes.", 6) != 0)
            continue;
        assert_true(octree_address_parse(json_string_value(fact->b), &address));
        if (strcmp(group->where, "nodes.split") == 0)
            assert_true(octree_node_at(b, address, &node) == OCTREE_OK && !node.leaf);
        if (strcmp(group->where, "nodes.born") == 0)
            assert_true(octree_node_at(b, address, &node) == OCTREE_OK &&
                        octree_node_at(a, address, &node) == OCTREE_NOT_FOUND);
    }
}

static uint64_t result_id(const octree_answer *answer, size_t i)
{
    return answer->points ? answer->points[i].id : answer->neighbors[i].point.id;
}

static size_t count_only_in(const octree_answer *one, const octree_answer *other)
{
    size_t count = 0;
    for (size_t i = 0; i < one->count; i++) {
        bool found = false;
        for (size_t j = 0; j < other->count; j++)
            found = found || result_id(other, j) == result_id(one, i);
        count += !found;
    }
    return count;
}

/* Whether a fact is about the i-th answer of a tick. */
static bool is_about(const cause_group *group, const octree_tick *tick, size_t i)
{
    char names[2][64];
    sprintf(names[0], "the %s query", octree_query_name(tick->answers[i].kind));
    sprintf(names[1], "query %zu (%s)", i + 1, octree_query_name(tick->answers[i].kind));
    return strcmp(group->query, names[0]) == 0 || strcmp(group->query, names[1]) == 0;
}

/* How many hits an answer has gained and lost, as the facts have it. */
static void count_hits(const cause_facts *facts, const octree_tick *tick, size_t answer, uint64_t hits[2])
{
    hits[0] = hits[1] = 0;
    for (size_t i = 0; i < facts->count; i++) {
        const cause_group *group = &facts->groups[i];
        if (!is_about(group, tick, answer))
            continue;
        if (strcmp(group->where, "answers.ids") == 0 || strcmp(group->where, "answers.neighbors") == 0)
            for (int less = 0; less < 2; less++)
                hits[less] += group->change == (less ? CAUSE_LESS : CAUSE_MORE) ? group->found : 0;
        if (strcmp(group->where, "answers.id") == 0)
            for (int less = 0; less < 2; less++)
                hits[less] += !json_is_null(less ? group->listed[0].a : group->listed[0].b);
    }
}

static uint64_t count_asked(const cause_facts *facts, cause_change change)
{
    uint64_t count = 0;
    for (size_t i = 0; i < facts->count; i++)
        if (strcmp(facts->groups[i].where, "answers") == 0 && facts->groups[i].change == change)
            count += facts->groups[i].found;
    return count;
}

/* The session asks the same on both sides: the answers are in the same places, but for those that need a player. */
static void assert_answers_told(const octree_tick *a, const octree_tick *b, const cause_facts *facts)
{
    assert_int_equal(count_asked(facts, CAUSE_MORE) - count_asked(facts, CAUSE_LESS),
                     b->answer_count - a->answer_count);
    if (a->has_player != b->has_player)
        return;
    assert_int_equal(a->answer_count, b->answer_count);
    for (size_t i = 0; i < b->answer_count; i++) {
        uint64_t hits[2];
        count_hits(facts, b, i, hits);
        assert_int_equal(hits[0], count_only_in(&b->answers[i], &a->answers[i]));
        assert_int_equal(hits[1], count_only_in(&a->answers[i], &b->answers[i]));
    }
}

static void assert_tick_told(const octree_game *const games[2], const cause_tick *told)
{
    const octree_tick *x = octree_game_tick(games[0]), *y = octree_game_tick(games[1]);
    const octree *a = octree_game_tree(games[0]), *b = octree_game_tree(games[1]);
    assert_true(told->facts.count > 0);
    assert_trees_told(games, &told->facts);
    for (size_t i = 0; i < told->facts.count; i++)
        assert_group_holds(a, b, &told->facts.groups[i]);
    assert_answers_told(x, y, &told->facts);
    unsigned events = 0;
    for (unsigned bits = x->events ^ y->events; bits; bits &= bits - 1)
        events++;
    assert_int_equal(count_facts(&told->facts, "events", CAUSE_MORE) + count_facts(&told->facts, "events", CAUSE_LESS),
                     events);
    assert_int_equal(count_facts(&told->facts, "player", CAUSE_OTHER),
                     x->has_player != y->has_player || (x->has_player && !same_position(x->player, y->player)));
    assert_int_equal(count_facts(&told->facts, "hits", CAUSE_MORE) - count_facts(&told->facts, "hits", CAUSE_LESS),
                     y->hit_count - x->hit_count);
}

/* Line by line, as ticks.jsonl would have it. */
static void assert_played_right(const changed_session *t, const cause *c)
{
    octree_game *games[2] = {start_game(&t->made.session), start_game(&t->changed)};
    uint64_t differing = 0, first = 0, compared = 0;
    for (bool over = false; !over; compared++) {
        char *lines[2] = {line_of(games[0]), line_of(games[1])};
        const bool differs =
            strcmp(lines[0], lines[1]) != 0 || any_unlike(octree_game_tree(games[0]), octree_game_tree(games[1]));
        const cause_tick *told = cause_find_tick(c, compared);
        if (differs && differing++ == 0)
            first = compared;
        if (differs != (told != NULL))
            fail_msg("tick %" PRIu64 ": %s%s", compared, lines[0], lines[1]);
        if (told)
            assert_tick_told((const octree_game *const[2]){games[0], games[1]}, told);
        free(lines[0]);
        free(lines[1]);
        over = octree_game_over(games[0]) || octree_game_over(games[1]);
        for (int i = 0; i < 2 && !over; i++)
            assert_int_equal(octree_game_advance(games[i]), OCTREE_OK);
    }
    assert_int_equal(c->compared, compared);
    assert_int_equal(c->differing.count, differing);
    assert_int_equal(c->differing.first, first);
    octree_game_destroy(games[0]);
    octree_game_destroy(games[1]);
}

/* ---- The trials ---------------------------------------------------------------------------------------------- */

/* The one fact, the first thing that is said, and what follows. */
static void assert_named(const changed_session *t, uint64_t seed)
{
    const cause_watcher all = {.first = SIZE_MAX};
    octreel_error error = {""};
    cause c;
    if (!cause_find(&(session_file){.session = t->made.session}, &(session_file){.session = t->changed}, NULL, &all, &c,
                    &error))
        fail_msg("%s", error.text);
    char *headline;
    text_stream s;
    assert_true(text_stream_begin(&s));
    cause_print_headline(s.stream, &c);
    assert_true(text_stream_end(&s, &headline));
    const cause_group *group = cause_find_group(&c.session, t->where, t->change);
    if (c.session.count != 1 || !group || group->found != 1 || group->listed[0].tick != t->tick ||
        group->listed[0].id != t->id || strncmp(headline, t->text, strlen(t->text)) != 0)
        fail_msg("seed %" PRIu64 ": %s\nand not %s", seed, headline, t->text);
    assert_int_equal(c.view.count, 0);
    assert_played_right(t, &c);
    free(headline);
    cause_release(&c);
}

static void try_seeds(uint64_t first, session_change *change)
{
    static changed_session t;
    uint64_t tried = 0;
    for (uint64_t seed = first; tried < (seeds + 3) / 4; seed++)
        if (try_change(&t, seed, change)) {
            assert_named(&t, seed);
            tried++;
        }
}

static void moved_point_is_the_cause(void **state)
{
    (void)state;
    try_seeds(1, move_by_one_step);
}

static void point_inserted_by_an_edit_is_the_cause(void **state)
{
    (void)state;
    try_seeds(10001, add_one_point);
}

static void different_capacity_is_the_cause(void **state)
{
    (void)state;
    try_seeds(20001, change_capacity);
}

static void different_step_is_the_cause(void **state)
{
    (void)state;
    try_seeds(30001, change_step);
}

static void different_velocity_is_the_cause(void **state)
{
    (void)state;
    try_seeds(40001, change_velocity);
}

static void different_kind_of_player_is_the_cause(void **state)
{
    (void)state;
    try_seeds(50001, change_kind);
}

static void added_or_removed_shape_is_the_cause(void **state)
{
    (void)state;
    try_seeds(60001, change_number_of_shapes);
}

static void different_shape_is_the_cause(void **state)
{
    (void)state;
    try_seeds(70001, change_shape);
}

static void different_half_extent_is_the_cause(void **state)
{
    (void)state;
    try_seeds(80001, change_half);
}

static void detection_of_overlaps_in_one_session_is_the_cause(void **state)
{
    (void)state;
    try_seeds(90001, change_pairs);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        seeds = strtoull(argv[1], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moved_point_is_the_cause),
        cmocka_unit_test(point_inserted_by_an_edit_is_the_cause),
        cmocka_unit_test(different_capacity_is_the_cause),
        cmocka_unit_test(different_step_is_the_cause),
        cmocka_unit_test(different_velocity_is_the_cause),
        cmocka_unit_test(different_kind_of_player_is_the_cause),
        cmocka_unit_test(added_or_removed_shape_is_the_cause),
        cmocka_unit_test(different_shape_is_the_cause),
        cmocka_unit_test(different_half_extent_is_the_cause),
        cmocka_unit_test(detection_of_overlaps_in_one_session_is_the_cause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
