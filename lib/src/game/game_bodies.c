/* SPDX-License-Identifier: MIT */
/* game_bodies.c - the bodies of a game: a hash table by id, their motion, and the edits of a tick.
 *
 * Many moves at once go through octree_move_many(), which is faster than single moves from a few hundred points on. How
 * a body moves by its velocity is in motion.c.
 */
#include "game_bodies.h"
#include "../bodies/set.h"
#include "game_state.h"
#include "motion.h"
#include "octree/digest.h"

static size_t find_home_slot(const bodies *b, uint64_t id)
{
    return (size_t)octree_digest_word(OCTREE_DIGEST_START, id) & (b->slot_count - 1);
}

/* Returns the slot that holds an id, or the empty slot into which the id would be inserted. slot_count must be above
 * 0. */
static size_t find_body_slot(const bodies *b, uint64_t id)
{
    size_t slot = find_home_slot(b, id);
    while (b->slots[slot] && bodies_items(b)[b->slots[slot] - 1].id != id)
        slot = (slot + 1) & (b->slot_count - 1);
    return slot;
}

void bodies_release(bodies *b, arena *memory)
{
    list_release(memory, &b->items, sizeof(moving_body));
    arena_free(memory, b->slots, b->slot_count * sizeof *b->slots);
}

moving_body *bodies_find(const bodies *b, uint64_t id)
{
    if (b->slot_count == 0)
        return NULL;
    const uint32_t entry = b->slots[find_body_slot(b, id)];
    return entry ? &bodies_items(b)[entry - 1] : NULL;
}

/* Make room in the hash table for `count` bodies, so that at least half of the slots stay empty. Returns false if
 * memory runs out. */
static bool make_room_in_slots(bodies *b, arena *memory, size_t count)
{
    if (2 * count <= b->slot_count)
        return true;
    const size_t slot_count = b->slot_count ? 2 * b->slot_count : 64;
    uint32_t *slots = arena_allocate(memory, slot_count * sizeof *slots);
    if (!slots)
        return false;
    arena_free(memory, b->slots, b->slot_count * sizeof *slots);
    memset(slots, 0, slot_count * sizeof *slots);
    b->slots = slots;
    b->slot_count = slot_count;
    for (size_t i = 0; i < b->items.count; i++)
        slots[find_body_slot(b, bodies_items(b)[i].id)] = (uint32_t)(i + 1);
    return true;
}

/* Add a body whose id is not in use. The motion of the body starts at its position, at the tick `tick`. Returns false
 * if memory runs out. */
static bool bodies_add(bodies *b, arena *memory, const octree_game_body *body, uint64_t tick)
{
    if (!make_room_in_slots(b, memory, b->items.count + 1))
        return false;
    const size_t slot = find_body_slot(b, body->id);
    moving_body added = {.id = body->id, .since = tick, .moved = UINT64_MAX};
    memcpy(added.position, body->position, sizeof added.position);
    memcpy(added.origin, body->position, sizeof added.origin);
    memcpy(added.velocity, body->velocity, sizeof added.velocity);
    memcpy(added.half, body->half, sizeof added.half);
    if (!list_push(memory, &b->items, &added, sizeof added))
        return false;
    b->slots[slot] = (uint32_t)b->items.count;
    b->movers += is_moving(body->velocity);
    b->extended += has_extent(body->half);
    for (int i = 0; i < 3; i++)
        b->reach[i] = body->half[i] > b->reach[i] ? body->half[i] : b->reach[i];
    return true;
}

/* Empty a slot of the hash table and close the gap. Each entry after the gap moves into the gap, unless the gap lies
 * before the slot to which the entry's hash value points. */
static void clear_slot(bodies *b, size_t gap)
{
    const size_t mask = b->slot_count - 1;
    for (size_t slot = (gap + 1) & mask; b->slots[slot]; slot = (slot + 1) & mask) {
        const size_t home = find_home_slot(b, bodies_items(b)[b->slots[slot] - 1].id);
        if (((slot - home) & mask) >= ((slot - gap) & mask)) {
            b->slots[gap] = b->slots[slot];
            gap = slot;
        }
    }
    b->slots[gap] = 0;
}

/* Remove a body from the array. The last body of the array takes the index of the removed body. */
static void bodies_remove(bodies *b, moving_body *body)
{
    b->movers -= is_moving(body->velocity);
    b->extended -= has_extent(body->half);
    b->reach_stale |= has_extent(body->half);
    clear_slot(b, find_body_slot(b, body->id));
    moving_body *last = &bodies_items(b)[b->items.count - 1];
    if (body != last) {
        b->slots[find_body_slot(b, last->id)] = (uint32_t)(body - bodies_items(b)) + 1;
        *body = *last;
    }
    b->items.count--;
}

/* ---- Changes of the tree ------------------------------------------------------------------------------------ */

static void record_changed_position(octree_game *game, const double place[3])
{
    tree_summary_record_change(&game->summary, &game->memory, game->tree, place);
}

octree_status game_insert_point(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_insert(game->tree, position, id);
    if (status == OCTREE_OK)
        record_changed_position(game, position);
    return status;
}

static octree_status game_remove_point(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_remove(game->tree, position, id);
    if (status == OCTREE_OK)
        record_changed_position(game, position);
    return status;
}

octree_status game_move_point(octree_game *game, const double from[3], uint64_t id, const double to[3])
{
    const octree_status status = octree_move(game->tree, from, id, to);
    if (status != OCTREE_OK)
        return status;
    record_changed_position(game, from);
    record_changed_position(game, to);
    return OCTREE_OK;
}

bool game_record_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3])
{
    const octree_refusal refusal = {id, why, {position[0], position[1], position[2]}};
    game->tick.events |= why == OCTREE_FULL ? OCTREE_EVENT_FULL : OCTREE_EVENT_REFUSED;
    return list_push(&game->memory, &game->refusals, &refusal, sizeof refusal);
}

/* If `status` is an error other than NO_MEMORY, record in the tick that the tree refused the point. Returns false if
 * memory runs out, and also if `status` is NO_MEMORY. */
static bool record_if_refused(octree_game *game, uint64_t id, octree_status status, const double position[3])
{
    return status == OCTREE_OK || (status != OCTREE_NO_MEMORY && game_record_refusal(game, id, status, position));
}

/* Returns the tick at which the motion of an edited body starts. This is the tick before the current one, because a
 * tick applies its edits before it moves the bodies. */
static uint64_t motion_start_tick(const octree_game *game)
{
    return game->tick.number ? game->tick.number - 1 : 0;
}

bool octree_game_find_body(const octree_game *game, uint64_t id, octree_body *body)
{
    if (!game || !body)
        return false;
    const bool is_player = is_players_id(game, id);
    const moving_body *found = is_player ? NULL : bodies_find(&game->bodies, id);
    *body = (octree_body){.id = id};
    if (found)
        memcpy(body->half, found->half, sizeof body->half);
    if (is_player || found)
        memcpy(body->position, is_player ? game->tick.player : found->position, sizeof body->position);
    return is_player || found;
}

bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point)
{
    octree_body body;
    if (!point || !octree_game_find_body(game, id, &body))
        return false;
    *point = point_of_body(&body);
    return true;
}

octree_status check_numbers_of_body(const octree_game_body *body)
{
    return is_finite_position(body->velocity) ? check_half_extents(body->half) : OCTREE_NOT_FINITE;
}

octree_status game_check_body(const octree_game *game, const octree_game_body *body)
{
    if (is_players_id(game, body->id) || bodies_find(&game->bodies, body->id))
        return OCTREE_DUPLICATE;
    return check_numbers_of_body(body);
}

bool game_add_body(octree_game *game, const octree_game_body *body, octree_status status)
{
    if (status == OCTREE_OK)
        return bodies_add(&game->bodies, &game->memory, body, motion_start_tick(game));
    return record_if_refused(game, body->id, status, body->position);
}

static bool insert_body(octree_game *game, const octree_game_body *body)
{
    octree_status status = game_check_body(game, body);
    if (status == OCTREE_OK)
        status = game_insert_point(game, body->position, body->id);
    return game_add_body(game, body, status);
}

static bool remove_body(octree_game *game, uint64_t id)
{
    /* the position in the refusal of a removal: a removal has no position */
    static const double nowhere[3] = {0, 0, 0};
    moving_body *body = bodies_find(&game->bodies, id);
    const octree_status status = body ? game_remove_point(game, body->position, id) : OCTREE_NOT_FOUND;
    if (status == OCTREE_OK)
        bodies_remove(&game->bodies, body);
    return record_if_refused(game, id, status, nowhere);
}

static bool move_body(octree_game *game, uint64_t id, const double to[3])
{
    moving_body *body = bodies_find(&game->bodies, id);
    const octree_status status = body ? game_move_point(game, body->position, id, to) : OCTREE_NOT_FOUND;
    if (status == OCTREE_OK) {
        store_body_position(body, to, game->tick.number);
        restart_motion(body, &game->session->tree.world, to, motion_start_tick(game));
    }
    return record_if_refused(game, id, status, to);
}

static bool apply_edit(octree_game *game, const octree_edit *edit)
{
    switch (edit->kind) {
    case OCTREE_EDIT_INSERT:
        return insert_body(game, &edit->body);
    case OCTREE_EDIT_REMOVE:
        return remove_body(game, edit->body.id);
    default:
        return move_body(game, edit->body.id, edit->body.position);
    }
}

/* ---- Many moves at once --------------------------------------------------------------------------------------- */

/* A list of moves of different bodies, as arrays for octree_move_many(). */
typedef struct motion {
    octree_point *points; /* the moving points, at the positions that the tree stores */
    double (*to)[3];
    octree_status *statuses;
    uint32_t *bodies; /* bodies[i]: the body of move i, as an index in the list of bodies */
    size_t count, room;
} motion;

#define MOVE_SIZE (sizeof(octree_point) + sizeof(double[3]) + sizeof(octree_status) + sizeof(uint32_t))

/* Allocate the four arrays in one memory block, which begins with the points. Returns false if memory runs out. */
static bool motion_allocate(motion *m, arena *memory, size_t room)
{
    *m = (motion){.room = room, .points = arena_allocate(memory, room * MOVE_SIZE)};
    if (!m->points)
        return false;
    m->to = (double(*)[3])(m->points + room);
    m->statuses = (octree_status *)(m->to + room);
    m->bodies = (uint32_t *)(m->statuses + room);
    return true;
}

static void motion_release(motion *m, arena *memory)
{
    arena_free(memory, m->points, m->room * MOVE_SIZE);
}

static void add_move(motion *m, const bodies *all, size_t index, const double to[3])
{
    const moving_body *body = &bodies_items(all)[index];
    memcpy(m->points[m->count].position, body->position, sizeof body->position);
    m->points[m->count].id = body->id;
    memcpy(m->to[m->count], to, sizeof m->to[m->count]);
    m->bodies[m->count++] = (uint32_t)index;
}

/* Collect the moves of the game's movers, which game_list_movers() has listed. */
static void collect_moves_by_velocity(const octree_game *game, motion *m)
{
    const octree_game_body *now = game->movers.items;
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        const moving_body *body = &bodies_items(&game->bodies)[i];
        if (!is_moving(body->velocity))
            continue;
        if (memcmp(now->position, body->position, sizeof now->position) != 0)
            add_move(m, &game->bodies, i, now->position);
        now++;
    }
}

enum { MANY = 256 }; /* from this number of moves on, octree_move_many() is faster than single moves */

/* Move the points in the tree, without changing the bodies. Returns false if memory runs out; some points may have
 * moved then. */
static bool move_points(octree *tree, motion *m)
{
    if (m->count >= MANY)
        return octree_move_many(tree, m->points, (const double(*)[3])m->to, m->count, m->statuses, NULL) == OCTREE_OK;
    bool ok = true;
    for (size_t i = 0; ok && i < m->count; i++) {
        m->statuses[i] = octree_move(tree, m->points[i].position, m->points[i].id, m->to[i]);
        ok = m->statuses[i] != OCTREE_NO_MEMORY;
    }
    return ok;
}

/* Move the points in the tree and then the bodies. `edited` is true if the moves are edits; an edit restarts the motion
 * of its body. Returns false if memory runs out. */
static bool apply_motion(octree_game *game, motion *m, bool edited)
{
    bool ok = move_points(game->tree, m);
    for (size_t i = 0; ok && i < m->count; i++) {
        moving_body *body = &bodies_items(&game->bodies)[m->bodies[i]];
        if (m->statuses[i] == OCTREE_OK) {
            record_changed_position(game, m->points[i].position);
            record_changed_position(game, m->to[i]);
            store_body_position(body, m->to[i], game->tick.number);
            if (edited)
                restart_motion(body, &game->session->tree.world, m->to[i], motion_start_tick(game));
        }
        ok = record_if_refused(game, body->id, m->statuses[i], m->to[i]);
    }
    return ok;
}

/* Collect a run of moves: from the first edit on, up to an edit that moves an unknown body, or a body that the run
 * already moves. */
static void collect_run_of_moves(octree_game *game, const octree_edit *edits, size_t count, motion *m)
{
    const size_t run = ++game->bodies.runs;
    m->count = 0;
    while (m->count < count) {
        const octree_game_body *to = &edits[m->count].body;
        moving_body *body = bodies_find(&game->bodies, to->id);
        if (!body || body->run == run)
            break;
        body->run = run;
        add_move(m, &game->bodies, (size_t)(body - bodies_items(&game->bodies)), to->position);
    }
}

/* Apply a list of edits that are all moves. The list is divided into runs; a run moves no body twice. Returns false if
 * memory runs out. */
static bool apply_move_edits(octree_game *game, const octree_edit *edits, size_t count)
{
    motion m;
    bool ok = motion_allocate(&m, &game->memory, count);
    for (size_t done = 0; ok && done < count; done += m.count ? m.count : 1) {
        collect_run_of_moves(game, edits + done, count - done, &m);
        /* If a run has no moves, its first edit moves an unknown body. apply_edit() refuses such an edit. */
        ok = m.count > 0 ? apply_motion(game, &m, true) : apply_edit(game, edits + done);
    }
    motion_release(&m, &game->memory);
    return ok;
}

static size_t count_leading_moves(const octree_edit *edits, size_t count)
{
    size_t moves = 0;
    while (moves < count && edits[moves].kind == OCTREE_EDIT_MOVE)
        moves++;
    return moves;
}

bool game_apply_edits(octree_game *game, const octree_input *input)
{
    bool ok = true;
    for (size_t i = 0, done; ok && i < input->edit_count; i += done) {
        const size_t moves = count_leading_moves(input->edits + i, input->edit_count - i);
        done = moves >= MANY ? moves : 1;
        ok = moves >= MANY ? apply_move_edits(game, input->edits + i, moves) : apply_edit(game, input->edits + i);
    }
    return ok;
}

bool game_list_movers(octree_game *game)
{
    const bodies *all = &game->bodies;
    for (size_t i = 0; all->movers && i < all->items.count; i++) {
        const moving_body *body = &bodies_items(all)[i];
        /* Skip bodies at rest: body_at_tick() would turn a coordinate of -0.0 into +0.0. */
        if (!is_moving(body->velocity))
            continue;
        const octree_game_body now = body_at_tick(body, &game->session->tree.world, game->tick.number);
        if (!list_push(&game->memory, &game->movers, &now, sizeof now))
            return false;
    }
    return true;
}

bool game_move_bodies(octree_game *game)
{
    motion m;
    if (game->bodies.movers == 0)
        return true;
    bool ok = motion_allocate(&m, &game->memory, game->bodies.movers);
    if (ok) {
        collect_moves_by_velocity(game, &m);
        ok = apply_motion(game, &m, false);
    }
    motion_release(&m, &game->memory);
    return ok;
}

void game_settle_movers(octree_game *game)
{
    octree_game_body *movers = game->movers.items;
    const moving_body *body = bodies_items(&game->bodies);
    size_t kept = 0;
    for (size_t i = 0; i < game->movers.count; i++, body++) {
        while (!is_moving(body->velocity))
            body++;
        if (!is_moving(movers[i].velocity))
            continue;
        movers[kept] = movers[i];
        memcpy(movers[kept++].position, body->position, sizeof body->position);
    }
    game->movers.count = kept;
}
