/* SPDX-License-Identifier: MIT */
/* game.c - the game loop: plays one tick after another, in the order that game.h states. */
#include "../exact/float_mode.h"
#include "extent.h"
#include "queries.h"
#include "session.h"
#include "../exact/sweep.h"

#include <math.h>
#include <string.h>

const char *octree_event_name(octree_event event)
{
    static const char *const names[OCTREE_EVENT_KINDS] = {"moved", "refused", "collided", "full",
                                                          "split", "merged",  "wrong",    "overlapped"};
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (event == 1u << i)
            return names[i];
    return NULL;
}

const char *octree_shape_name(octree_shape_kind kind)
{
    static const char *const names[OCTREE_SHAPE_KINDS] = {"box", "segment", "point", "label"};
    return (unsigned)kind < OCTREE_SHAPE_KINDS ? names[kind] : NULL;
}

/* ---- The collision test --------------------------------------------------------------------------------------
 *
 * The test takes place before the player's step is made. The test finds the points that collide with the player at the
 * end of the step, except the player's own point. So a step that collides is never made and need not be undone.
 *
 * If the session has swept collisions, the whole path of the player is tested. A query of the tree finds the points at
 * rest. The bodies that this tick has moved are tested one by one, because the tree stores only the end of a body's
 * path, but the test needs the whole path, relative to the player's.
 */

static bool was_moved_in_tick(const octree_game *game, const moving_body *body)
{
    return body->moved == game->tick.number;
}

/* An octree_point_visitor that collects a hit, and the same as an octree_body_visitor. If the session has swept
 * collisions, bodies that this tick has moved are skipped. */
static bool collect_hit(const octree_point *point, void *context)
{
    octree_game *game = context;
    const moving_body *body = game->tick.swept ? bodies_find(&game->bodies, point->id) : NULL;
    if (!body || !was_moved_in_tick(game, body))
        game->out_of_memory |= !list_push(&game->memory, &game->hits, point, sizeof *point);
    return !game->out_of_memory;
}

static bool collect_hit_body(const octree_body *body, void *context)
{
    const octree_point point = point_of_body(body);
    return collect_hit(&point, context);
}

/* Collect the points of the tree that collide with the player. If the session has swept collisions, bodies that this
 * tick has moved are left out. Returns false if memory runs out. */
static bool collect_hit_points(octree_game *game, const octree_point *self)
{
    const octree_tick *tick = &game->tick;
    const double *from = tick->swept ? tick->from : tick->attempt;
    const double size = game->session->player.box_size;
    octree_search how = game_make_search_options(game, &game->tick.hit_cost);
    /* The arguments are valid, so the searches cannot fail. */
    if (!game->bodies.extended) {
        octree_collide_swept(game->tree, from, tick->attempt, size, self, &how, collect_hit, game);
        return !game->out_of_memory;
    }
    octree_region box = {.kind = OCTREE_REGION_SWEPT, .half = {size, size, size}};
    memcpy(box.from, from, sizeof box.from);
    memcpy(box.to, tick->attempt, sizeof box.to);
    how.skip = OCTREE_SKIP_ID;
    how.skip_id = self->id;
    game_update_reach(game);
    octree_bodies_search(&game->shown, &box, &how, collect_hit_body, game);
    return !game->out_of_memory;
}

/* Collect the bodies that this tick has moved and that collide with the player. Returns false if memory runs out. */
static bool collect_hit_moved_bodies(octree_game *game)
{
    const sweep box = {game->tick.from, game->tick.attempt, game->session->player.box_size};
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        const moving_body *body = &bodies_items(&game->bodies)[i];
        if (!was_moved_in_tick(game, body) || body->id == game->session->player.id)
            continue;
        game->tick.hit_cost.points++;
        if (!sweep_touches(&box, body->before, body->position, body->half))
            continue;
        octree_point hit = {.id = body->id};
        memcpy(hit.position, body->position, sizeof hit.position);
        if (!list_push(&game->memory, &game->hits, &hit, sizeof hit))
            return false;
    }
    return true;
}

/* For each hit, in the order of the hits, list the position that its point had before the tick. Returns false if memory
 * runs out. */
static bool list_hit_origins(octree_game *game)
{
    const octree_point *hits = game->hits.items;
    game->hit_from.count = 0;
    for (size_t i = 0; i < game->hits.count; i++) {
        /* The body is not null: every point except the player's is a body. */
        const moving_body *body = bodies_find(&game->bodies, hits[i].id);
        const double *from = was_moved_in_tick(game, body) ? body->before : hits[i].position;
        if (!list_push(&game->memory, &game->hit_from, from, sizeof(double[3])))
            return false;
    }
    return true;
}

/* Collect the points that collide with the player into `hits`, sorted by id. Without swept collisions, the player's box
 * is tested at the position `to`. With swept collisions, the box is tested on its whole path to `to`. Returns false if
 * memory runs out. */
static bool test_collision(octree_game *game, const double to[3])
{
    octree_tick *tick = &game->tick;
    octree_point self = {.id = game->session->player.id};
    memcpy(self.position, tick->player, sizeof self.position);
    memcpy(tick->attempt, to, sizeof tick->attempt);
    tick->hit_cost = (octree_cost){0};
    game->hits.count = game->visits.count = 0;
    const bool ok = collect_hit_points(game, &self) && (!tick->swept || collect_hit_moved_bodies(game));
    sort_points(&game->hits, 0);
    if (game->hits.count)
        tick->events |= OCTREE_EVENT_COLLIDED;
    return ok && (!tick->swept || list_hit_origins(game));
}

/* ---- The player's step -------------------------------------------------------------------------------------- */

/* Returns the direction in which a key moves the player along an axis: 1, -1 or 0. */
static int key_direction(char key, int axis)
{
    return (key == "dwe"[axis]) - (key == "asf"[axis]);
}

/* Record that the player's step was refused, so that the player stays where it is. In a session with swept collisions,
 * repeat the collision test for a player at rest, to find the bodies that move into the player. Returns false if memory
 * runs out. */
static bool refuse_player_step(octree_game *game, octree_status why, const double to[3])
{
    return game_record_refusal(game, game->session->player.id, why, to) &&
           (!game->session->player.sweep || test_collision(game, game->tick.player));
}

/* Make a step whose end is inside the world and free of hits. A full leaf can still refuse the step. Returns false if
 * memory runs out. */
static bool make_player_step(octree_game *game, const int64_t steps[3], const double to[3])
{
    const uint64_t id = game->session->player.id;
    const octree_status status = game_move_point(game, game->tick.player, id, to);
    if (status != OCTREE_OK)
        return status != OCTREE_NO_MEMORY && refuse_player_step(game, status, to);
    memcpy(game->steps, steps, sizeof game->steps);
    memcpy(game->tick.player, to, sizeof game->tick.player);
    game->tick.events |= OCTREE_EVENT_MOVED;
    return true;
}

/* Store the player's positions before and after the tick. If the player is a body, edits and motion have already moved
 * the player. */
static void store_player_positions(octree_game *game)
{
    octree_tick *tick = &game->tick;
    const octree_player *player = &game->session->player;
    const moving_body *body = player->kind == OCTREE_PLAYER_BODY ? bodies_find(&game->bodies, player->id) : NULL;
    if (body)
        memcpy(tick->player, body->position, sizeof tick->player);
    tick->has_player = body || player->kind == OCTREE_PLAYER_KEYS;
    memcpy(tick->from, body && body->moved == tick->number ? body->before : tick->player, sizeof tick->from);
    memcpy(tick->attempt, tick->player, sizeof tick->attempt);
    tick->swept = tick->has_player && player->sweep;
    tick->hit_cost = (octree_cost){0};
}

/* Make the player's step for the tick's key, unless the collision test or the tree prevents the step. Returns false if
 * memory runs out. */
static bool step_player(octree_game *game)
{
    store_player_positions(game);
    if (!game->tick.has_player)
        return true;
    const octree_player *player = &game->session->player;
    if (player->kind != OCTREE_PLAYER_KEYS)
        return test_collision(game, game->tick.player);
    int64_t steps[3];
    double to[3];
    for (int i = 0; i < 3; i++) {
        steps[i] = game->steps[i] + key_direction(game->tick.key, i);
        to[i] = player->position[i] + (double)steps[i] * player->step;
    }
    if (memcmp(steps, game->steps, sizeof steps) == 0)
        return test_collision(game, game->tick.player);
    if (check_position(game->tree, to) != OCTREE_OK) {
        game->tick.events |= OCTREE_EVENT_REFUSED;
        return test_collision(game, game->tick.player);
    }
    return test_collision(game, to) && (game->hits.count > 0 || make_player_step(game, steps, to));
}

/* ---- The end of a tick -------------------------------------------------------------------------------------- */

static bool list_shapes(octree_game *game, const octree_shape *shapes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        octree_shape shape = shapes[i];
        shape.tick = game->tick.number;
        if (!list_push(&game->memory, &game->shapes, &shape, sizeof shape))
            return false;
    }
    return true;
}

static bool find_point_by_id(const void *game, uint64_t id, octree_point *point)
{
    return octree_game_find(game, id, point);
}

audited_points game_audited_points(const octree_game *game)
{
    const octree_player *player = &game->session->player;
    return (audited_points){.tree = game->tree,
                            .bodies = &game->shown,
                            .find = find_point_by_id,
                            .context = game,
                            .own_id = player->kind == OCTREE_PLAYER_KEYS ? &player->id : NULL};
}

static bool replace_and_check_foreign_nodes(octree_game *game, const octree_foreign_tree *replacement)
{
    const audited_points points = game_audited_points(game);
    return (!replacement || foreign_set_nodes(&game->foreign, replacement)) &&
           foreign_check_nodes(&game->foreign, &points);
}

/* Check the foreign nodes. Then ask the queries and list the shapes. Queries and shapes of this tick come first.
 * Queries and shapes that belong to every tick follow. Returns false if memory runs out. */
static bool run_queries_and_list_shapes(octree_game *game, const octree_input *input)
{
    const octree_input always = session_input(game->session, OCTREE_EVERY_TICK);
    game_update_reach(game);
    return replace_and_check_foreign_nodes(game, input->foreign) && game_run_query_of_key(game) &&
           game_run_queries(game, input->queries, input->query_count) &&
           game_run_queries(game, always.queries, always.query_count) && game_finish_queries(game) &&
           list_shapes(game, input->shapes, input->shape_count) && list_shapes(game, always.shapes, always.shape_count);
}

/* Store the splits and merges of the tick, and the digest and the statistics of the tree. Returns false if memory runs
 * out. */
static bool summarize_tree(octree_game *game)
{
    tree_summary *summary = &game->summary;
    const bool first = game->tick.number == 0;
    if (!first && summary->version == octree_version(game->tree))
        return true;
    const bool ok =
        tree_summary_update(summary, &game->memory, game->tree) &&
        (first || tree_summary_list_splits_and_merges(summary, &game->memory, &game->splits, &game->merges));
    game->tick.events |= game->splits.count ? OCTREE_EVENT_SPLIT : 0;
    game->tick.events |= game->merges.count ? OCTREE_EVENT_MERGED : 0;
    game->tick.stats = summary->stats;
    game->tick.tree_digest = summary->digest;
    return ok;
}

/* Set the pointers and counts of octree_tick to the game's lists. The lists must not grow any more in this tick. */
static void publish_tick(octree_game *game)
{
#define PUBLISH(name, shown_count, type)                                                                               \
    game->tick.name = game->name.items;                                                                                \
    game->tick.shown_count = game->name.count;
    GAME_SHOWN_LISTS(PUBLISH)
#undef PUBLISH
    game->tick.hit_from = game->tick.swept ? game->hit_from.items : NULL;
    foreign_update_state(&game->foreign);
    game->tick.foreign = game->foreign.state;
    if (game->tick.foreign.wrong_count)
        game->tick.events |= OCTREE_EVENT_WRONG;
}

/* Finish a tick. In a gap, no collision is tested, no query asked and no shape listed. Returns OK or NO_MEMORY. */
static octree_status run_queries_and_publish_tick(octree_game *game, const octree_input *input)
{
    bool ok = true;
    game->tick.gap = input->gap ? strcpy(game->gap, input->gap->why) : NULL;
    if (game->tick.number == 0 && game->tick.has_player && !input->gap)
        ok = test_collision(game, game->tick.player);
    ok = ok && (input->gap ? game_finish_queries(game) : run_queries_and_list_shapes(game, input));
    ok = ok && (input->gap || game_list_pairs(game, input->foreign_pairs)) && summarize_tree(game);
    if (ok) {
        game_settle_movers(game);
        publish_tick(game);
    }
    return ok ? OCTREE_OK : OCTREE_NO_MEMORY;
}

/* ---- The beginning and the end of a game -------------------------------------------------------------------- */

/* Store the player's first position, or the center of the world if the player is not moved by keys, and insert a player
 * that is moved by keys into the tree. The center is a sum of halves, so that nothing overflows. */
static octree_status place_player(octree_game *game)
{
    const octree_player *player = &game->session->player;
    const octree_box *world = &game->session->tree.world;
    for (int i = 0; i < 3; i++)
        game->tick.player[i] = world->min[i] / 2 + world->max[i] / 2;
    if (player->kind != OCTREE_PLAYER_KEYS)
        return OCTREE_OK;
    memcpy(game->tick.player, player->position, sizeof game->tick.player);
    return game_insert_point(game, player->position, player->id);
}

static octree_status start_game(octree_game *game)
{
    const octree_session *session = game->session;
    octree_status status = game_check_session(session, game->tree);
    if (status == OCTREE_OK)
        status = place_player(game);
    if (status == OCTREE_OK)
        status = game_load_bodies(game);
    if (status != OCTREE_OK)
        return status;
    game_update_reach(game); /* the queries of a gap are asked later, if at all */
    store_player_positions(game);
    if (!game_list_movers(game))
        return OCTREE_NO_MEMORY;
    const octree_input input = session_input(session, 0);
    return run_queries_and_publish_tick(game, &input);
}

octree_status octree_game_create(const octree_session *session, octree_game **game)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_game_create, session, game);
    if (!game)
        return OCTREE_NULL_ARGUMENT;
    *game = NULL;
    if (!session || (!session->bodies && session->body_count))
        return OCTREE_NULL_ARGUMENT;
    octree *tree;
    octree_status status = octree_create(&session->tree, &tree);
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = octree_definition(tree).allocator};
    octree_game *made = arena_allocate(&memory, sizeof *made);
    if (!made) {
        octree_destroy(tree);
        return OCTREE_NO_MEMORY;
    }
    *made = (octree_game){.session = session, .tree = tree, .memory = memory};
    made->foreign.memory = made->judge.memory = &made->memory;
    game_show_bodies(made);
    status = start_game(made);
    if (status == OCTREE_OK)
        *game = made;
    else
        octree_game_destroy(made);
    return status;
}

void octree_game_destroy(octree_game *game)
{
    if (!game)
        return;
    octree_destroy(game->tree);
    bodies_release(&game->bodies, &game->memory);
    tree_summary_release(&game->summary, &game->memory);
    foreign_release(&game->foreign);
    judge_release(&game->judge);
    arena memory = game->memory;
#define RELEASE(name, shown_count, type) list_release(&memory, &game->name, sizeof(type));
    GAME_LISTS(RELEASE)
#undef RELEASE
    arena_free(&memory, game, sizeof *game);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

static void begin_tick(octree_game *game, char key)
{
#define CLEAR(name, shown_count, type) game->name.count = 0;
    GAME_LISTS(CLEAR)
#undef CLEAR
    game->tick.number++;
    game->tick.key = key;
    game->tick.events = 0;
    game->tick.edit_count = 0;
    game->judge.given.count = game->judge.wrong.count = 0;
    game->tick.foreign_pairs = (octree_pair_judgement){.judged = false};
    foreign_begin_tick(&game->foreign);
}

/* Record the number of edits in a tick, and the bounding box of the positions of the edits. */
static void record_edits(octree_tick *tick, const octree_input *input)
{
    octree_box *box = &tick->edited;
    tick->edit_count = input->edit_count;
    *box = (octree_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < input->edit_count; i++) {
        const double *to = input->edits[i].body.position;
        for (int axis = 0; axis < 3 && input->edits[i].kind != OCTREE_EDIT_REMOVE; axis++) {
            box->min[axis] = to[axis] < box->min[axis] ? to[axis] : box->min[axis];
            box->max[axis] = to[axis] > box->max[axis] ? to[axis] : box->max[axis];
        }
    }
}

static bool apply_changes(octree_game *game, const octree_input *input)
{
    record_edits(&game->tick, input);
    return game_apply_edits(game, input) && game_list_movers(game) && game_move_bodies(game) && step_player(game);
}

/* Play one tick. `given` is the input of the tick; if `given` is null, the session's input is used. */
static octree_status play_tick(octree_game *game, char key, const octree_input *given)
{
    if (is_running_callback(game->tree))
        return OCTREE_BUSY;
    if (key == 'q') {
        game->quit = true;
        return OCTREE_OK;
    }
    if (!is_game_key(key))
        return OCTREE_BAD_KEY;
    const octree_input own = session_input(game->session, game->tick.number + 1), *input = given ? given : &own;
    begin_tick(game, input->gap ? '.' : key);
    /* in a gap nothing moves */
    if (input->gap)
        store_player_positions(game);
    if (!(input->gap ? game_list_movers(game) : apply_changes(game, input)))
        return OCTREE_NO_MEMORY;
    return run_queries_and_publish_tick(game, input);
}

octree_status octree_game_step(octree_game *game, char key)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_game_step, game, key);
    return game ? play_tick(game, key, NULL) : OCTREE_NULL_ARGUMENT;
}

octree_status octree_game_play(octree_game *game, const octree_input *input)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_game_play, game, input);
    if (!game || !input)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = octree_input_check(input);
    return status == OCTREE_OK ? play_tick(game, input->key ? input->key : '.', input) : status;
}

octree_status octree_game_ask(octree_game *game, const octree_query *queries, size_t count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_game_ask, game, queries, count);
    if (!game || (!queries && count))
        return OCTREE_NULL_ARGUMENT;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = octree_query_check(&queries[i]);
    if (status != OCTREE_OK)
        return status;
    game->hit_leaves.count = 0;
    if (!game_run_queries(game, queries, count) || !game_finish_queries(game))
        return OCTREE_NO_MEMORY;
    publish_tick(game);
    return OCTREE_OK;
}

bool octree_game_over(const octree_game *game)
{
    return !game || game->quit || game->tick.number >= octree_session_length(game->session);
}

octree_status octree_game_advance(octree_game *game)
{
    if (!game)
        return OCTREE_NULL_ARGUMENT;
    if (octree_game_over(game))
        return OCTREE_NOT_FOUND;
    const char *keys = game->session->keys;
    const size_t key_count = keys ? strlen(keys) : 0;
    return octree_game_step(game, game->tick.number < key_count ? keys[game->tick.number] : '.');
}

const octree_tick *octree_game_tick(const octree_game *game)
{
    return game ? &game->tick : NULL;
}

const octree *octree_game_tree(const octree_game *game)
{
    return game ? game->tree : NULL;
}

const octree_bodies *octree_game_bodies(const octree_game *game)
{
    return game ? &game->shown : NULL;
}

const octree_session *octree_game_session(const octree_game *game)
{
    return game ? game->session : NULL;
}

double octree_game_fastest(const octree_game *game)
{
    return game ? game->fastest : 0;
}
