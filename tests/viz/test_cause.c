/* test_cause.c - one seeded change to a random session: the cause is that change and nothing else, and what follows
 * from it is what brute force finds. A number in its arguments is that of the seeds. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cause_words.h"
#include "fixture.h"
#include "number.h"
#include "random_session.h"
#include "sentence.h"
#include "ticks_write.h"

#define SEEDS 60 /* in the quick run */

static uint64_t seeds = SEEDS;

/* A random session, the same with one change, and what the change is. */
typedef struct trial {
    random_session made;
    octree_session changed;
    octree_body bodies[RANDOM_SESSION_BODIES];
    octree_edit edits[RANDOM_SESSION_EDITS + 1];
    cause_fact expected;
    char text[256]; /* what the headline begins with */
} trial;

static octree_game *play_to(const octree_session *session, uint64_t tick)
{
    octree_game *game;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    while (octree_game_tick(game)->number < tick)
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    return game;
}

/* ---- The changes --------------------------------------------------------------------------------------------- */

static const char *place_text(const double place[3], char text[3 * NUMBER_TEXT + 8])
{
    char numbers[3][NUMBER_TEXT];
    for (int axis = 0; axis < 3; axis++)
        number_print(place[axis], numbers[axis]);
    sprintf(text, "(%s, %s, %s)", numbers[0], numbers[1], numbers[2]);
    return text;
}

/* Behind all other edits of its tick. */
static void add_edit(trial *t, const octree_edit *edit, const char *name, const char *verb)
{
    const octree_session *session = &t->made.session;
    char place[3 * NUMBER_TEXT + 8];
    size_t at = session->edit_count;
    while (at > 0 && session->edits[at - 1].tick > edit->tick)
        at--;
    memcpy(t->edits, session->edits, at * sizeof *edit);
    t->edits[at] = *edit;
    memcpy(t->edits + at + 1, session->edits + at, (session->edit_count - at) * sizeof *edit);
    t->changed.edits = t->edits;
    t->changed.edit_count++;
    t->expected = (cause_fact){.kind = CAUSE_EDIT_MORE, .tick = edit->tick, .name = name, .id = edit->body.id};
    t->expected.b = cause_place(edit->body.position);
    sprintf(t->text, "one more edit at tick %" PRIu64 " (point %" PRIu64 " %s %s); ", edit->tick, edit->body.id, verb,
            place_text(edit->body.position, place));
}

/* Some point as it is before a tick, the player left out; false where there is no other. */
static bool random_point(const octree_session *session, uint64_t tick, uint64_t *state, octree_point *point)
{
    static const octree_box all = {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
    octree_game *game = play_to(session, tick - 1);
    const octree *tree = octree_game_tree(game);
    octree_point points[RANDOM_SESSION_BODIES + RANDOM_SESSION_EDITS + 1];
    size_t count, others = 0;
    assert_int_equal(octree_range_collect_sorted(tree, &all, NULL, points, sizeof points / sizeof *points, &count),
                     OCTREE_OK);
    for (size_t i = 0; i < count; i++)
        if (points[i].id != session->player.id)
            points[others++] = points[i];
    octree_game_destroy(game);
    if (others)
        *point = points[random_below(state, others)];
    return others > 0;
}

static bool move_by_one_step(trial *t, uint64_t tick, uint64_t *state)
{
    octree_session *session = &t->made.session;
    const int axis = (int)random_below(state, 3);
    octree_point point;
    if (!random_point(session, tick, state, &point))
        return false;
    octree_edit edit = {.tick = tick, .kind = OCTREE_EDIT_MOVE, .body.id = point.id};
    memcpy(edit.body.position, point.position, sizeof point.position);
    const double step = session->player.step, to = point.position[axis] + step;
    edit.body.position[axis] += to <= session->tree.world.max[axis] ? step : -step;
    add_edit(t, &edit, "move", "moved to");
    return true;
}

static bool add_one_point(trial *t, uint64_t tick, uint64_t *state)
{
    const octree_box *world = &t->made.session.tree.world;
    octree_edit edit = {.tick = tick, .kind = OCTREE_EDIT_INSERT, .body.id = 5000};
    for (int axis = 0; axis < 3; axis++)
        edit.body.position[axis] =
            world->min[axis] + (double)random_below(state, (uint64_t)(world->max[axis] - world->min[axis]));
    add_edit(t, &edit, "insert", "inserted at");
    return true;
}

static bool change_capacity(trial *t, uint64_t tick, uint64_t *state)
{
    const size_t old = t->made.session.tree.leaf_capacity;
    const size_t new = old > 1 && random_below(state, 2) ? old - 1 : old + 1 + random_below(state, 3);
    (void)tick;
    t->changed.tree.leaf_capacity = new;
    t->expected = (cause_fact){.kind = CAUSE_OPTION, .tick = CAUSE_NO_TICK, .name = "leaf capacity"};
    t->expected.a = cause_whole(old);
    t->expected.b = cause_whole(new);
    sprintf(t->text, "another leaf capacity (%zu, was %zu): ", new, old);
    return true;
}

static bool change_step(trial *t, uint64_t tick, uint64_t *state)
{
    const double old = t->made.session.player.step, new = old + (double)(1 + random_below(state, 8)) / 4;
    char texts[2][NUMBER_TEXT];
    (void)tick;
    t->changed.player.step = new;
    t->expected = (cause_fact){.kind = CAUSE_OPTION, .tick = CAUSE_NO_TICK, .name = "step of the player"};
    t->expected.a = cause_number(old);
    t->expected.b = cause_number(new);
    number_print(old, texts[0]);
    number_print(new, texts[1]);
    sprintf(t->text, "another step of the player (%s, was %s): ", texts[1], texts[0]);
    return true;
}

static const char *const kinds[] = {
    [OCTREE_PLAYER_KEYS] = "keys", [OCTREE_PLAYER_BODY] = "body", [OCTREE_PLAYER_NONE] = "none"};

/* Step and start, which not both kinds read, differ too, and are not named. */
static bool change_kind(trial *t, uint64_t tick, uint64_t *state)
{
    const octree_player_kind old = (octree_player_kind)random_below(state, 3);
    const octree_player_kind new = (octree_player_kind)((old + 1 + random_below(state, 2)) % 3);
    octree_player *a = &t->made.session.player, *b = &t->changed.player;
    (void)tick;
    if (old != OCTREE_PLAYER_KEYS && new != OCTREE_PLAYER_KEYS && t->made.session.body_count)
        a->id = b->id = 1 + random_below(state, t->made.session.body_count);
    a->kind = old;
    b->kind = new;
    b->step += 1;
    b->position[0] = b->position[0] < 0 ? b->position[0] + 1 : b->position[0] - 1;
    t->expected = (cause_fact){.kind = CAUSE_OPTION, .tick = CAUSE_NO_TICK, .name = "kind of player"};
    t->expected.a = cause_word(kinds[old]);
    t->expected.b = cause_word(kinds[new]);
    sprintf(t->text, "another kind of player (%s, was %s): ", kinds[new], kinds[old]);
    return true;
}

/* Of a point at the start. */
static bool change_velocity(trial *t, uint64_t tick, uint64_t *state)
{
    const octree_session *session = &t->made.session;
    char texts[2][3 * NUMBER_TEXT + 8];
    (void)tick;
    if (session->body_count == 0)
        return false;
    const size_t i = random_below(state, session->body_count);
    memcpy(t->bodies, session->bodies, session->body_count * sizeof *t->bodies);
    t->changed.bodies = t->bodies;
    octree_body *body = &t->bodies[i];
    t->expected = (cause_fact){.kind = CAUSE_VELOCITY, .tick = CAUSE_NO_TICK, .id = body->id};
    t->expected.a = cause_place(body->velocity);
    body->velocity[random_below(state, 3)] += 0.25 * (double)(1 + random_below(state, 8));
    t->expected.b = cause_place(body->velocity);
    sprintf(t->text, "another velocity of a point (point %" PRIu64 ": %s, was %s); ", body->id,
            place_text(body->velocity, texts[1]), place_text(t->expected.a.numbers, texts[0]));
    return true;
}

/* ---- What brute force finds ---------------------------------------------------------------------------------- */

/* As ticks.jsonl has it, without the digest of the tree: that knows of options, too. */
static char *line_of(const octree_game *game)
{
    tick_extras extras = {.tree_digest = 0};
    char *text;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    octree_statistics(octree_game_tree(game), &extras.stats);
    tick_write(stream, octree_game_tick(game), &extras);
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

/* Where both have a player, the tick tells of it. */
static void assert_trees_told(const octree_game *const games[2], const cause_facts *facts)
{
    const bool both = octree_game_tick(games[0])->has_player && octree_game_tick(games[1])->has_player;
    const octree *a = octree_game_tree(games[0]), *b = octree_game_tree(games[1]);
    const uint64_t points = facts->found[CAUSE_POINT_MOVED] + (both ? facts->found[CAUSE_PLAYER] : 0);
    const tree_counts c = count_unlike(a, b);
    assert_int_equal(facts->found[CAUSE_NODE_GONE], c.nodes[0].missing);
    assert_int_equal(facts->found[CAUSE_NODE_BORN], c.nodes[1].missing);
    assert_int_equal(facts->found[CAUSE_NODE_MERGED], c.nodes[0].inner);
    assert_int_equal(facts->found[CAUSE_NODE_SPLIT], c.nodes[1].inner);
    assert_int_equal(points + facts->found[CAUSE_POINT_LESS], c.points[0].count);
    assert_int_equal(points + facts->found[CAUSE_POINT_MORE], c.points[1].count);
}

/* A fact that is listed is so in both trees. */
static void assert_fact_holds(const octree *a, const octree *b, const cause_fact *fact)
{
    if (fact->kind == CAUSE_POINT_MOVED || fact->kind == CAUSE_POINT_LESS)
        assert_true(octree_contains(a, fact->a.numbers, fact->id));
    if (fact->kind == CAUSE_POINT_MOVED || fact->kind == CAUSE_POINT_MORE)
        assert_true(octree_contains(b, fact->b.numbers, fact->id));
    octree_node node;
    if (fact->kind == CAUSE_NODE_SPLIT)
        assert_true(octree_node_at(b, fact->node, &node) == OCTREE_OK && !node.leaf);
    if (fact->kind == CAUSE_NODE_BORN)
        assert_true(octree_node_at(b, fact->node, &node) == OCTREE_OK &&
                    octree_node_at(a, fact->node, &node) == OCTREE_NOT_FOUND);
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

/* The session asks the same on both sides: the answers are in the same places, but for those that need a player. */
static void assert_answers_told(const octree_tick *a, const octree_tick *b, const cause_facts *facts)
{
    size_t unlike = 0;
    assert_int_equal(facts->found[CAUSE_ANSWER_MORE] - facts->found[CAUSE_ANSWER_LESS],
                     b->answer_count - a->answer_count);
    if (a->has_player != b->has_player)
        return;
    assert_int_equal(a->answer_count, b->answer_count);
    for (size_t i = 0; i < b->answer_count; i++) {
        const size_t gained = count_only_in(&b->answers[i], &a->answers[i]);
        const size_t lost = count_only_in(&a->answers[i], &b->answers[i]);
        unlike += gained + lost > 0;
        for (size_t j = 0; j < facts->count; j++)
            if (facts->facts[j].kind == CAUSE_ANSWER && facts->facts[j].query == i) {
                assert_int_equal(facts->facts[j].gained, gained);
                assert_int_equal(facts->facts[j].lost, lost);
            }
    }
    assert_int_equal(facts->found[CAUSE_ANSWER] + facts->found[CAUSE_NEAREST], unlike);
}

static void assert_tick_told(const octree_game *const games[2], const cause_tick *told)
{
    const octree_tick *x = octree_game_tick(games[0]), *y = octree_game_tick(games[1]);
    const octree *a = octree_game_tree(games[0]), *b = octree_game_tree(games[1]);
    assert_true(cause_any(&told->facts));
    assert_trees_told(games, &told->facts);
    for (size_t i = 0; i < told->facts.count; i++)
        assert_fact_holds(a, b, &told->facts.facts[i]);
    assert_answers_told(x, y, &told->facts);
    unsigned events = 0;
    for (unsigned bits = x->events ^ y->events; bits; bits &= bits - 1)
        events++;
    assert_int_equal(told->facts.found[CAUSE_EVENT_MORE] + told->facts.found[CAUSE_EVENT_LESS], events);
    assert_int_equal(told->facts.found[CAUSE_PLAYER],
                     x->has_player != y->has_player || (x->has_player && !same_position(x->player, y->player)));
    assert_int_equal(told->facts.found[CAUSE_HIT_MORE] - told->facts.found[CAUSE_HIT_LESS],
                     y->hit_count - x->hit_count);
}

/* Line by line, as ticks.jsonl would have it. */
static void assert_played_right(const trial *t, const cause *c)
{
    octree_game *games[2] = {play_to(&t->made.session, 0), play_to(&t->changed, 0)};
    uint64_t differing = 0, first = 0, compared = 0;
    for (bool over = false; !over; compared++) {
        char *lines[2] = {line_of(games[0]), line_of(games[1])};
        const bool differs =
            strcmp(lines[0], lines[1]) != 0 || any_unlike(octree_game_tree(games[0]), octree_game_tree(games[1]));
        const cause_tick *told = cause_at(c, compared);
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
    assert_int_equal(c->differing, differing);
    assert_int_equal(c->first, first);
    octree_game_destroy(games[0]);
    octree_game_destroy(games[1]);
}

/* ---- The trials ---------------------------------------------------------------------------------------------- */

static bool same_values(const cause_value *a, const cause_value *b)
{
    return a->type == b->type && a->whole == b->whole && memcmp(a->numbers, b->numbers, sizeof a->numbers) == 0 &&
           strcmp(a->word, b->word) == 0;
}

static bool same_text(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

/* The one fact, the first thing that is said, and what follows. */
static void assert_named(const trial *t, uint64_t seed)
{
    const cause_wanted all = {.first = SIZE_MAX};
    record_error error = {""};
    cause c;
    if (!cause_find(&t->made.session, &t->changed, NULL, &all, NULL, NULL, &c, &error))
        fail_msg("%s", error.text);
    char *headline;
    sentence s;
    assert_true(sentence_begin(&s));
    cause_print_headline(s.stream, &c);
    assert_true(sentence_end(&s, &headline));
    const cause_fact *fact = c.session.facts, *expected = &t->expected;
    if (c.session.count != 1 || c.session.found[expected->kind] != 1 || fact->kind != expected->kind ||
        fact->tick != expected->tick || !same_text(fact->name, expected->name) || fact->id != expected->id ||
        !same_values(&fact->a, &expected->a) || !same_values(&fact->b, &expected->b) ||
        strncmp(headline, t->text, strlen(t->text)) != 0)
        fail_msg("seed %" PRIu64 ": %s\nand not %s", seed, headline, t->text);
    assert_false(cause_any(&c.look));
    assert_played_right(t, &c);
    free(headline);
    cause_release(&c);
}

/* False where the session has nothing to change so. */
static bool try_seed(uint64_t seed, bool change(trial *t, uint64_t tick, uint64_t *state))
{
    static trial t;
    uint64_t state = seed ^ 0x5eed;
    t = (trial){.text = ""};
    random_session_full(&t.made, seed);
    t.changed = t.made.session;
    const uint64_t tick = 1 + random_below(&state, octree_session_length(&t.made.session));
    if (!change(&t, tick, &state))
        return false;
    assert_named(&t, seed);
    return true;
}

static void try_seeds(uint64_t first, bool change(trial *t, uint64_t tick, uint64_t *state))
{
    uint64_t tried = 0;
    for (uint64_t seed = first; tried < (seeds + 3) / 4; seed++)
        tried += try_seed(seed, change);
}

static void a_point_moved_by_one_step_is_the_cause(void **state)
{
    (void)state;
    try_seeds(1, move_by_one_step);
}

static void one_more_point_by_an_edit_is_the_cause(void **state)
{
    (void)state;
    try_seeds(10001, add_one_point);
}

static void another_capacity_is_the_cause(void **state)
{
    (void)state;
    try_seeds(20001, change_capacity);
}

static void another_step_size_is_the_cause(void **state)
{
    (void)state;
    try_seeds(30001, change_step);
}

static void another_velocity_is_the_cause(void **state)
{
    (void)state;
    try_seeds(40001, change_velocity);
}

static void another_kind_of_player_is_the_cause(void **state)
{
    (void)state;
    try_seeds(50001, change_kind);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        seeds = strtoull(argv[1], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_moved_by_one_step_is_the_cause),
        cmocka_unit_test(one_more_point_by_an_edit_is_the_cause),
        cmocka_unit_test(another_capacity_is_the_cause),
        cmocka_unit_test(another_step_size_is_the_cause),
        cmocka_unit_test(another_velocity_is_the_cause),
        cmocka_unit_test(another_kind_of_player_is_the_cause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
