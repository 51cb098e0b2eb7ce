/* SPDX-License-Identifier: MIT */
/* test_game_ticks.c - what every tick of every session promises, on random sessions with moving bodies, edits and
 * queries; and that playing twice is playing the same. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "game_fixture.h"
#include "inner_nodes.h"
#include "octree/digest.h"
#include "random_session.h"

static void assert_same_points(const octree_point *points, size_t count, brute *expected)
{
    brute given = {0};
    for (size_t i = 0; i < count; i++) {
        brute_insert(&given, points[i].position, points[i].id);
        assert_true(i == 0 || points[i].id > points[i - 1].id); /* by id, and ids are unique */
    }
    assert_true(brute_equal(&given, expected));
    brute_free(&given);
}

static const octree_point *find_id(const brute *all, uint64_t id)
{
    for (size_t i = 0; i < all->count; i++)
        if (all->points[i].id == id)
            return &all->points[i];
    return NULL;
}

/* Whether the tree did not take a body where an edit puts it. */
static bool is_refused(const octree_tick *tick, const octree_game_body *body)
{
    for (size_t i = 0; i < tick->refusal_count; i++)
        if (tick->refusals[i].id == body->id && tick->refusals[i].why != OCTREE_DUPLICATE &&
            same_position(tick->refusals[i].position, body->position))
            return true;
    return false;
}

/* Where each body comes from: where it was at the tick before, or where an edit of this tick has inserted it. */
static void trace(const octree_session *session, const octree_tick *tick, const brute *before, brute *from)
{
    for (size_t i = 0; i < before->count; i++)
        brute_collect(&before->points[i], from);
    for (size_t i = 0; i < session->edit_count; i++) {
        const octree_edit *edit = &session->edits[i];
        const octree_point *known = find_id(from, edit->body.id);
        if (edit->tick != tick->number || edit->kind == OCTREE_EDIT_MOVE || edit->body.id == session->player.id)
            continue;
        if (edit->kind == OCTREE_EDIT_REMOVE && known)
            brute_remove(from, known->position, known->id);
        if (edit->kind == OCTREE_EDIT_INSERT && !known && !is_refused(tick, &edit->body))
            brute_insert(from, edit->body.position, edit->body.id);
    }
}

/* The edits of the tick, and the box around where they put bodies. */
static void check_edits(const octree_tick *tick, const octree_session *session)
{
    size_t count = 0;
    octree_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < session->edit_count; i++) {
        const octree_edit *edit = &session->edits[i];
        count += edit->tick == tick->number;
        for (int axis = 0; edit->tick == tick->number && edit->kind != OCTREE_EDIT_REMOVE && axis < 3; axis++) {
            const double at = edit->body.position[axis];
            box.min[axis] = at < box.min[axis] ? at : box.min[axis];
            box.max[axis] = at > box.max[axis] ? at : box.max[axis];
        }
    }
    assert_int_equal(tick->edit_count, count);
    assert_true(count == 0 || (same_position(tick->edited.min, box.min) && same_position(tick->edited.max, box.max)));
}

static bool is_met(const octree_tick *tick, double size, const double from[3], const double at[3])
{
    return tick->swept ? brute_touches(tick->from, tick->attempt, size, from, at)
                       : brute_touches(tick->attempt, tick->attempt, size, at, at);
}

/* `before` is what there was after the tick before. */
static void check_hits(const octree_tick *tick, const octree_session *session, const brute *before, const brute *all)
{
    const octree_player *player = &session->player;
    brute from = {0}, expected = {0};
    trace(session, tick, before, &from);
    for (size_t i = 0; i < all->count; i++) {
        const octree_point *point = &all->points[i];
        if (point->id != player->id &&
            is_met(tick, player->box_size, find_id(&from, point->id)->position, point->position))
            brute_collect(point, &expected);
    }
    assert_same_points(tick->hits, tick->hit_count, &expected);
    assert_true(((tick->events & OCTREE_EVENT_COLLIDED) != 0) == (tick->hit_count > 0));
    assert_true(tick->swept == player->sweep);
    assert_true(same_position(tick->from, find_id(before, player->id)->position));
    for (size_t i = 0; tick->swept && i < tick->hit_count; i++)
        assert_true(same_position(tick->hit_from[i], find_id(&from, tick->hits[i].id)->position));
    brute_free(&from);
    brute_free(&expected);
}

static void check_neighbors(const octree_answer *answer, const octree_query *query, const octree_tick *tick,
                            const octree_player *player, const brute *all)
{
    octree_neighbor *expected;
    const octree_skip skip = query->at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    const size_t k = query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k;
    const double *target = query->at_player ? tick->player : query->target;
    const size_t found = brute_nearest_k(all, target, k, skip, player->id, &expected);
    assert_int_equal(answer->count, found);
    assert_true(answer->k == k && same_position(answer->target, target));
    for (size_t i = 0; i < found; i++)
        assert_true(answer->neighbors[i].point.id == expected[i].point.id &&
                    same_position(answer->neighbors[i].point.position, expected[i].point.position) &&
                    answer->neighbors[i].distance == expected[i].distance);
    free(expected);
}

/* Whether the answer is what the query asks for, and is true. */
static void check_answer(const octree_answer *answer, const octree_query *query, const octree_tick *tick,
                         const octree_player *player, brute *all)
{
    assert_int_equal(answer->kind, query->kind);

    if (!octree_query_about(query->kind)->neighbors) {
        brute expected = {0};
        octree_box box = query->box;
        for (int axis = 0; query->at_player && axis < 3; axis++) {
            box.min[axis] += tick->player[axis];
            box.max[axis] += tick->player[axis];
        }
        if (query->kind == OCTREE_QUERY_RANGE)
            brute_range(all, &box, &expected);
        else
            brute_radius(all, query->at_player ? tick->player : query->target, query->radius, &expected);
        assert_same_points(answer->points, answer->count, &expected);
        brute_free(&expected);
        return;
    }
    check_neighbors(answer, query, tick, player, all);
}

/* The answers are those of the queries that the tick is due, n first. */
static void check_answers(const octree_tick *tick, const octree_session *session, brute *all)
{
    static const octree_query by_key = {.kind = OCTREE_QUERY_NEAREST, .at_player = true};
    size_t due = 0;
    if (tick->key == 'n')
        check_answer(&tick->answers[due++], &by_key, tick, &session->player, all);
    for (size_t i = 0; i < session->query_count; i++) {
        const octree_query *query = &session->queries[i];
        if (query->tick != tick->number && query->tick != OCTREE_EVERY_TICK)
            continue;
        assert_true(due < tick->answer_count);
        assert_true(tick->answers[due].by_key == (tick->key == 'n' && due == 0));
        check_answer(&tick->answers[due++], query, tick, &session->player, all);
    }
    assert_int_equal(tick->answer_count, due);
}

static int direction_on(char key, int axis)
{
    static const char up[] = "dwe", down[] = "asf";
    return (key == up[axis]) - (key == down[axis]);
}

/* A body or an edit, for another reason than a full leaf. */
static bool refused_points(const octree_tick *tick)
{
    bool refused = false;
    for (size_t i = 0; i < tick->refusal_count; i++)
        refused |= tick->refusals[i].why != OCTREE_FULL;
    return refused;
}

/* The step was made, or the player is where it was; position = start + net steps * step. */
static void check_player(const octree_tick *tick, const octree_session *session, int64_t steps[3])
{
    const bool told = refused_points(tick), refused = tick->events & OCTREE_EVENT_REFUSED;
    const unsigned back = OCTREE_EVENT_COLLIDED | (told ? 0 : OCTREE_EVENT_REFUSED);
    bool stepped = tick->key != 0 && strchr("wasdef", tick->key) != NULL;
    bool moved = (tick->events & OCTREE_EVENT_MOVED) != 0;
    assert_false(moved && (!stepped || tick->events & back));
    assert_true(refused || !told);
    assert_true(moved || !stepped || refused || tick->events & (back | OCTREE_EVENT_FULL));
    for (int axis = 0; axis < 3; axis++) {
        steps[axis] += moved ? direction_on(tick->key, axis) : 0;
        double expected = session->player.position[axis] + (double)steps[axis] * session->player.step;
        assert_true(tick->player[axis] == expected);
    }
}

/* What a tick is compared with: the tick before it. */
typedef struct last_tick {
    inner_nodes nodes;
    int64_t steps[3];
    brute points;
} last_tick;

static void check_tick(const octree_game *game, last_tick *last)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_session *session = octree_game_session(game);
    const octree *tree = octree_game_tree(game);
    const octree_box everywhere = cube(-INFINITY, INFINITY);
    brute all = {0};
    assert_int_equal(octree_range(tree, &everywhere, brute_collect, &all), OCTREE_OK);
    assert_int_equal(octree_count(tree), all.count);
    assert_true(brute_contains(&all, tick->player, session->player.id));
    assert_valid(tree);
    if (tick->number == 0) /* nothing came before it, so it has no splits and nothing has moved */
        for (size_t i = 0; i < all.count; i++)
            brute_collect(&all.points[i], &last->points);
    check_player(tick, session, last->steps);
    assert_splits_and_merges(tick, tree, &last->nodes);
    check_hits(tick, session, &last->points, &all);
    check_edits(tick, session);
    check_answers(tick, session, &all);
    brute_free(&last->points);
    last->points = all;
}

static void play_and_check(const octree_session *session)
{
    octree_game *game = start_game(session);
    static last_tick last;
    last = (last_tick){.steps = {0, 0, 0}};
    list_inner_nodes(octree_game_tree(game), &last.nodes);
    for (uint64_t number = 0;; number++) {
        const octree_tick *tick = octree_game_tick(game);
        assert_int_equal(tick->number, number);
        check_tick(game, &last);
        if (octree_game_over(game))
            break;
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    assert_int_equal(octree_game_tick(game)->number, octree_session_length(session));
    brute_free(&last.points);
    octree_game_destroy(game);
}

static void every_tick_of_random_sessions_keeps_its_promises(void **state)
{
    (void)state;
    static random_session made;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        random_session_full(&made, seed);
        made.session.tree.full_leaf = seed % 3 == 0 ? OCTREE_GROW : OCTREE_REFUSE;
        play_and_check(&made.session);
    }
}

static void every_tick_of_the_default_session_keeps_its_promises(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    play_and_check(&session);
}

static uint64_t digest_points(uint64_t digest, const octree_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        digest = octree_digest_word(digest, points[i].id);
        for (int axis = 0; axis < 3; axis++)
            digest = octree_digest_double(digest, points[i].position[axis]);
    }
    return octree_digest_word(digest, count);
}

static uint64_t digest_tick(uint64_t digest, const octree_tick *tick)
{
    digest = octree_digest_word(digest, tick->number);
    digest = octree_digest_word(digest, tick->events);
    digest = octree_digest_bytes(digest, tick->player, sizeof tick->player);
    digest = octree_digest_bytes(digest, tick->from, sizeof tick->from);
    digest = octree_digest_bytes(digest, tick->attempt, sizeof tick->attempt);
    digest = digest_points(digest, tick->hits, tick->hit_count);
    digest = octree_digest_bytes(digest, tick->splits, tick->split_count * sizeof(octree_address));
    digest = octree_digest_bytes(digest, tick->merges, tick->merge_count * sizeof(octree_address));
    for (size_t i = 0; i < tick->refusal_count; i++)
        digest = octree_digest_word(digest, tick->refusals[i].id ^ (uint64_t)tick->refusals[i].why << 32);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_answer *answer = &tick->answers[i];
        digest = octree_digest_word(digest, answer->count);
        if (answer->points)
            digest = digest_points(digest, answer->points, answer->count);
        for (size_t j = 0; answer->neighbors && j < answer->count; j++) {
            digest = digest_points(digest, &answer->neighbors[j].point, 1);
            digest = octree_digest_double(digest, answer->neighbors[j].distance);
        }
    }
    return digest;
}

static uint64_t digest_of_playing(const octree_session *session)
{
    octree_game *game = start_game(session);
    uint64_t digest = digest_tick(OCTREE_DIGEST_START, octree_game_tick(game));
    while (!octree_game_over(game)) {
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        digest = digest_tick(digest, octree_game_tick(game));
        digest = octree_digest_word(digest, octree_digest(octree_game_tree(game)));
    }
    octree_game_destroy(game);
    return digest;
}

static void playing_twice_gives_the_same_ticks(void **state)
{
    (void)state;
    static random_session made;
    octree_session session = octree_session_default();
    assert_true(digest_of_playing(&session) == digest_of_playing(&session));
    for (uint64_t seed = 1; seed <= 20; seed++) {
        random_session_full(&made, seed);
        assert_true(digest_of_playing(&made.session) == digest_of_playing(&made.session));
    }
}

static void stepping_by_hand_is_advancing(void **state)
{
    (void)state;
    static random_session made;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        random_session_full(&made, seed);
        octree_game *by_hand = start_game(&made.session), *played = start_game(&made.session);
        while (!octree_game_over(played)) {
            assert_int_equal(octree_game_advance(played), OCTREE_OK);
            const octree_tick *tick = octree_game_tick(played);
            assert_int_equal(octree_game_step(by_hand, tick->key), OCTREE_OK);
            assert_true(digest_tick(0, tick) == digest_tick(0, octree_game_tick(by_hand)));
        }
        octree_game_destroy(by_hand);
        octree_game_destroy(played);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tick_of_random_sessions_keeps_its_promises),
        cmocka_unit_test(every_tick_of_the_default_session_keeps_its_promises),
        cmocka_unit_test(playing_twice_gives_the_same_ticks),
        cmocka_unit_test(stepping_by_hand_is_advancing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
