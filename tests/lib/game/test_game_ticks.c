/* SPDX-License-Identifier: MIT */
/* test_game_ticks.c - what every tick of every session promises, on random sessions with moving bodies, edits and
 * queries; and that playing twice is playing the same. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "brute_bodies.h"
#include "game_fixture.h"
#include "inner_nodes.h"
#include "octree/digest.h"
#include "random_session.h"

static void assert_same_points(const octree_point *points, size_t count, const brute_bodies *expected)
{
    assert_int_equal(count, expected->count);
    for (size_t i = 0; i < count; i++) {
        const octree_body *body = brute_bodies_find(expected, points[i].id);
        assert_true(body && same_position(points[i].position, body->position));
        assert_true(i == 0 || points[i].id > points[i - 1].id); /* by id, and ids are unique */
    }
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

static octree_body body_of(const octree_game_body *inserted)
{
    octree_body body = {.id = inserted->id};
    memcpy(body.position, inserted->position, sizeof body.position);
    memcpy(body.half, inserted->half, sizeof body.half);
    return body;
}

/* Where each body comes from: where it was at the tick before, or where an edit of this tick has inserted it. */
static void trace(const octree_session *session, const octree_tick *tick, const brute_bodies *before,
                  brute_bodies *from)
{
    for (size_t i = 0; i < before->count; i++)
        brute_bodies_add(from, &before->items[i]);
    for (size_t i = 0; i < session->edit_count; i++) {
        const octree_edit *edit = &session->edits[i];
        const octree_body body = body_of(&edit->body);
        if (edit->tick != tick->number || edit->kind == OCTREE_EDIT_MOVE || body.id == session->player.id)
            continue;
        if (edit->kind == OCTREE_EDIT_REMOVE)
            brute_bodies_remove(from, body.id);
        else if (!brute_bodies_find(from, body.id) && !is_refused(tick, &edit->body))
            brute_bodies_add(from, &body);
    }
}

/* The bodies of the tree, with the extents that they had in `from`. */
static void list_bodies(const octree_game *game, const brute_bodies *from, brute_bodies *all)
{
    const octree_box everywhere = cube(-INFINITY, INFINITY);
    brute points = {0};
    assert_int_equal(octree_range(octree_game_tree(game), &everywhere, brute_collect, &points), OCTREE_OK);
    for (size_t i = 0; i < points.count; i++) {
        const octree_body *known = brute_bodies_find(from, points.points[i].id);
        octree_body body, told;
        assert_non_null(known);
        body = *known;
        memcpy(body.position, points.points[i].position, sizeof body.position);
        brute_bodies_add(all, &body);
        assert_true(octree_game_find_body(game, body.id, &told));
        assert_int_equal(octree_compare_bodies(&told, &body), 0);
    }
    assert_true(octree_count(octree_game_tree(game)) == points.count && from->count == points.count);
    brute_free(&points);
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

static bool is_met(const octree_tick *tick, double size, const double before[3], const octree_body *body)
{
    const double *from = tick->swept ? tick->from : tick->attempt, *start = tick->swept ? before : body->position;
    const double sizes[] = {size + body->half[0], size + body->half[1], size + body->half[2]};
    return brute_touches_box(from, tick->attempt, sizes, start, body->position);
}

/* `before` is what there was after the tick before, `from` where the bodies of this tick come from. */
static void check_hits(const octree_tick *tick, const octree_session *session, const brute_bodies *before,
                       const brute_bodies *from, const brute_bodies *all)
{
    const octree_player *player = &session->player;
    brute_bodies expected = {0};
    for (size_t i = 0; i < all->count; i++) {
        const octree_body *body = &all->items[i];
        if (body->id != player->id && is_met(tick, player->box_size, brute_bodies_find(from, body->id)->position, body))
            brute_bodies_add(&expected, body);
    }
    assert_same_points(tick->hits, tick->hit_count, &expected);
    assert_true(((tick->events & OCTREE_EVENT_COLLIDED) != 0) == (tick->hit_count > 0));
    assert_true(tick->swept == player->sweep);
    assert_true(same_position(tick->from, brute_bodies_find(before, player->id)->position));
    for (size_t i = 0; tick->swept && i < tick->hit_count; i++)
        assert_true(same_position(tick->hit_from[i], brute_bodies_find(from, tick->hits[i].id)->position));
    brute_bodies_free(&expected);
}

/* All pairs of bodies except the player, in ascending order. */
static void check_pairs(const octree_tick *tick, const octree_session *session, const brute_bodies *all)
{
    size_t expected = 0;
    for (size_t i = 0; session->pairs && i < all->count; i++)
        for (size_t j = i + 1; j < all->count; j++)
            expected += all->items[i].id != session->player.id && all->items[j].id != session->player.id &&
                        brute_bodies_overlap(&all->items[i], &all->items[j]);
    assert_int_equal(tick->pair_count, expected);
    for (size_t i = 0; i < tick->pair_count; i++) {
        const octree_pair *p = &tick->pairs[i];
        assert_true(p->a < p->b && (i == 0 || p[-1].a < p->a || (p[-1].a == p->a && p[-1].b < p->b)));
        assert_true(brute_bodies_overlap(brute_bodies_find(all, p->a), brute_bodies_find(all, p->b)));
    }
    assert_true(((tick->events & OCTREE_EVENT_OVERLAPPED) != 0) == (expected > 0));
}

static void check_neighbors(const octree_answer *answer, const octree_query *query, const octree_tick *tick,
                            const octree_player *player, const brute_bodies *all)
{
    brute_bodies expected = {0};
    const size_t k = query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k;
    const double *target = query->at_player ? tick->player : query->target;
    brute_bodies_nearest(all, target, k, query->at_player ? player->id : UINT64_MAX, &expected);
    assert_int_equal(answer->count, expected.count);
    assert_true(answer->k == k && same_position(answer->target, target));
    for (size_t i = 0; i < expected.count; i++) {
        const double distance = sqrt(brute_body_square(&expected.items[i], target));
        assert_true(answer->neighbors[i].point.id == expected.items[i].id &&
                    same_position(answer->neighbors[i].point.position, expected.items[i].position));
        assert_true(fabs(answer->neighbors[i].distance - distance) <= distance * 0x1p-50);
    }
    brute_bodies_free(&expected);
}

/* Whether a body belongs to the answer of a query for bodies in a region. */
static bool is_in_region(const octree_query *query, const octree_tick *tick, const octree_body *body)
{
    octree_box box = query->box;
    for (int axis = 0; query->at_player && axis < 3; axis++) {
        box.min[axis] += tick->player[axis];
        box.max[axis] += tick->player[axis];
    }
    if (query->kind == OCTREE_QUERY_RANGE)
        return brute_body_meets_box(body, &box);
    assert_int_equal(query->kind, OCTREE_QUERY_RADIUS);
    return brute_body_square(body, query->at_player ? tick->player : query->target) <= query->radius * query->radius;
}

/* Whether the answer is what the query asks for, and is true. */
static void check_answer(const octree_answer *answer, const octree_query *query, const octree_tick *tick,
                         const octree_player *player, const brute_bodies *all)
{
    assert_int_equal(answer->kind, query->kind);
    if (octree_query_about(query->kind)->neighbors) {
        check_neighbors(answer, query, tick, player, all);
        return;
    }
    brute_bodies expected = {0};
    for (size_t i = 0; i < all->count; i++)
        if (is_in_region(query, tick, &all->items[i]))
            brute_bodies_add(&expected, &all->items[i]);
    assert_same_points(answer->points, answer->count, &expected);
    brute_bodies_free(&expected);
}

/* The answers are those of the queries that the tick is due, n first. */
static void check_answers(const octree_tick *tick, const octree_session *session, const brute_bodies *all)
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
    brute_bodies bodies;
} last_tick;

/* The bodies with which a session begins: nothing came before, so none has moved. */
static void list_first_bodies(const octree_session *session, const octree_tick *tick, brute_bodies *first)
{
    octree_body player = {.id = session->player.id};
    memcpy(player.position, session->player.position, sizeof player.position);
    brute_bodies_add(first, &player);
    for (size_t i = 0; i < session->body_count; i++) {
        const octree_body body = body_of(&session->bodies[i]);
        if (!is_refused(tick, &session->bodies[i]))
            brute_bodies_add(first, &body);
    }
}

static void check_tick(const octree_game *game, last_tick *last)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_session *session = octree_game_session(game);
    const octree *tree = octree_game_tree(game);
    brute_bodies from = {0}, all = {0};
    assert_valid(tree);
    if (tick->number == 0)
        list_first_bodies(session, tick, &last->bodies);
    trace(session, tick, &last->bodies, &from);
    list_bodies(game, &from, &all);
    assert_true(same_position(brute_bodies_find(&all, session->player.id)->position, tick->player));
    check_player(tick, session, last->steps);
    assert_splits_and_merges(tick, tree, &last->nodes);
    check_hits(tick, session, &last->bodies, &from, &all);
    check_pairs(tick, session, &all);
    check_edits(tick, session);
    check_answers(tick, session, &all);
    brute_bodies_free(&from);
    brute_bodies_free(&last->bodies);
    last->bodies = all;
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
    brute_bodies_free(&last.bodies);
    octree_game_destroy(game);
}

static void every_tick_of_random_sessions_keeps_its_promises(void **state)
{
    (void)state;
    static random_session made;
    for (uint64_t seed = 1; seed <= 120; seed++) {
        random_session_mixed(&made, seed);
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
    digest = octree_digest_bytes(digest, tick->pairs, tick->pair_count * sizeof(octree_pair));
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
        random_session_mixed(&made, seed);
        assert_true(digest_of_playing(&made.session) == digest_of_playing(&made.session));
    }
}

static void stepping_by_hand_is_advancing(void **state)
{
    (void)state;
    static random_session made;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        random_session_mixed(&made, seed);
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
