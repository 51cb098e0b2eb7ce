/* SPDX-License-Identifier: MIT */
/* bodies.c - the bodies of a game: a hash table by id, their motion, and the edits of a tick.
 *
 * A position is computed from the origin, the velocity and the number of ticks since then, so that no error adds up
 * over ticks. A body that bounces follows a triangle wave between the two faces of the world (reflect()). Many moves at
 * once go through octree_move_many(), which is faster than single moves from a few hundred points on.
 */
#include "bodies.h"
#include "float_rules.h"
#include "game_state.h"
#include "octree/digest.h"

#include <math.h>

static size_t home_of(const bodies *b, uint64_t id)
{
    return (size_t)octree_digest_word(OCTREE_DIGEST_START, id) & (b->slot_count - 1);
}

/* The slot that holds an id, or the empty slot where it would be inserted. Requires slot_count > 0. */
static size_t slot_of(const bodies *b, uint64_t id)
{
    size_t slot = home_of(b, id);
    while (b->slots[slot] && bodies_items(b)[b->slots[slot] - 1].id != id)
        slot = (slot + 1) & (b->slot_count - 1);
    return slot;
}

void bodies_release(bodies *b, arena *memory)
{
    list_release(memory, &b->items, sizeof(moving_body));
    arena_give(memory, b->slots, b->slot_count * sizeof *b->slots);
}

moving_body *bodies_find(const bodies *b, uint64_t id)
{
    if (b->slot_count == 0)
        return NULL;
    const uint32_t entry = b->slots[slot_of(b, id)];
    return entry ? &bodies_items(b)[entry - 1] : NULL;
}

/* Make room for `count` bodies with at least half of the slots empty. False when there is no memory. */
static bool make_slots(bodies *b, arena *memory, size_t count)
{
    if (2 * count <= b->slot_count)
        return true;
    const size_t slot_count = b->slot_count ? 2 * b->slot_count : 64;
    uint32_t *slots = arena_take(memory, slot_count * sizeof *slots);
    if (!slots)
        return false;
    arena_give(memory, b->slots, b->slot_count * sizeof *slots);
    memset(slots, 0, slot_count * sizeof *slots);
    b->slots = slots;
    b->slot_count = slot_count;
    for (size_t i = 0; i < b->items.count; i++)
        slots[slot_of(b, bodies_items(b)[i].id)] = (uint32_t)(i + 1);
    return true;
}

static bool is_moving(const double velocity[3])
{
    return velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
}

/* Add a body with an unused id. Its motion starts at its position at this tick. False when there is no memory. */
static bool bodies_add(bodies *b, arena *memory, const octree_body *body, uint64_t tick)
{
    if (!make_slots(b, memory, b->items.count + 1))
        return false;
    const size_t slot = slot_of(b, body->id);
    moving_body added = {.id = body->id, .since = tick, .moved = UINT64_MAX};
    memcpy(added.position, body->position, sizeof added.position);
    memcpy(added.origin, body->position, sizeof added.origin);
    memcpy(added.velocity, body->velocity, sizeof added.velocity);
    if (!list_push(memory, &b->items, &added, sizeof added))
        return false;
    b->slots[slot] = (uint32_t)b->items.count;
    b->movers += is_moving(body->velocity);
    return true;
}

/* Empty a slot and close the gap: later entries move up, unless that would put them before their home slot. */
static void clear_slot(bodies *b, size_t gap)
{
    const size_t mask = b->slot_count - 1;
    for (size_t slot = (gap + 1) & mask; b->slots[slot]; slot = (slot + 1) & mask) {
        const size_t home = home_of(b, bodies_items(b)[b->slots[slot] - 1].id);
        if (((slot - home) & mask) >= ((slot - gap) & mask)) {
            b->slots[gap] = b->slots[slot];
            gap = slot;
        }
    }
    b->slots[gap] = 0;
}

/* Remove a body. The last body moves to its index. */
static void bodies_remove(bodies *b, moving_body *body)
{
    b->movers -= is_moving(body->velocity);
    clear_slot(b, slot_of(b, body->id));
    moving_body *last = &bodies_items(b)[b->items.count - 1];
    if (body != last) {
        b->slots[slot_of(b, last->id)] = (uint32_t)(body - bodies_items(b)) + 1;
        *body = *last;
    }
    b->items.count--;
}

/* ---- Motion ------------------------------------------------------------------------------------------------- */

/* Record that the tree stores a body at a new position from this tick on. */
static void body_store(moving_body *body, const double to[3], uint64_t tick)
{
    if (body->moved != tick)
        memcpy(body->before, body->position, sizeof body->before);
    body->moved = tick;
    memcpy(body->position, to, sizeof body->position);
}

/* Fold a straight path into an interval: a triangle wave with period 2 * (max - min). Where the period overflows, the
 * computation uses quarters of all lengths; a path that still overflows stays at its origin. *direction is 1 for the
 * direction of the velocity, -1 for the opposite one, 0 at rest. */
static double reflect(double origin, double velocity, double ticks, double min, double max, int *direction)
{
    const double straight = origin + velocity * ticks;
    *direction = 1;
    if (min <= straight && straight <= max)
        return straight;
    const double unit = isfinite(2 * (max - min)) ? 1 : 0.25;
    const double width = max * unit - min * unit;
    double phase = fmod((origin * unit - min * unit) + velocity * unit * ticks, 2 * width);
    if (!isfinite(phase)) {
        *direction = 0;
        return origin;
    }
    phase = phase < 0 ? phase + 2 * width : phase;
    *direction = phase > width ? -1 : 1;
    const double folded = min * unit + (phase > width ? 2 * width - phase : phase);
    const double position = folded / unit;
    return position < min ? min : position > max ? max : position;
}

/* Compute position and velocity on one axis, reflected at the faces of the world. At a face the velocity already points
 * back into the world. */
static void bounce(const moving_body *body, const octree_box *world, double ticks, int axis, octree_body *now)
{
    const double min = world->min[axis], max = world->max[axis];
    int direction;
    const double at = reflect(body->origin[axis], body->velocity[axis], ticks, min, max, &direction);
    const double velocity = body->velocity[axis] * direction;
    const bool leaves = (at == max && velocity > 0) || (at == min && velocity < 0);
    now->position[axis] = at;
    now->velocity[axis] = (leaves ? -velocity : velocity) + 0.0; /* no minus zero */
}

/* The position and velocity of a body at a tick. Most bodies have not reached a face yet; one test without branches
 * finds that. */
static octree_body body_at(const moving_body *body, const octree_box *world, uint64_t tick)
{
    octree_body now = {.id = body->id};
    const double ticks = (double)(tick - body->since);
    bool within = true;
    for (int i = 0; i < 3; i++) {
        now.position[i] = body->origin[i] + body->velocity[i] * ticks;
        now.velocity[i] = body->velocity[i] + 0.0;
        within &= (now.position[i] > world->min[i]) & (now.position[i] < world->max[i]);
    }
    for (int i = 0; !within && i < 3; i++)
        bounce(body, world, ticks, i, &now);
    return now;
}

/* Restart the motion of a body at another position, with its velocity at this tick. */
static void restart(moving_body *body, const octree_box *world, const double place[3], uint64_t tick)
{
    const octree_body now = body_at(body, world, tick);
    for (int i = 0; i < 3; i++)
        if (now.velocity[i] != 0) /* 0 also stands for a body that is too fast to follow: it keeps its velocity */
            body->velocity[i] = now.velocity[i];
    memcpy(body->origin, place, sizeof body->origin);
    body->since = tick;
}

/* ---- Changes of the tree ------------------------------------------------------------------------------------ */

static void note_change(octree_game *game, const double place[3])
{
    tree_summary_record(&game->summary, &game->memory, game->tree, place);
}

octree_status game_insert(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_insert(game->tree, position, id);
    if (status == OCTREE_OK)
        note_change(game, position);
    return status;
}

static octree_status game_remove(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_remove(game->tree, position, id);
    if (status == OCTREE_OK)
        note_change(game, position);
    return status;
}

octree_status game_move(octree_game *game, const double from[3], uint64_t id, const double to[3])
{
    const octree_status status = octree_move(game->tree, from, id, to);
    if (status != OCTREE_OK)
        return status;
    note_change(game, from);
    note_change(game, to);
    return OCTREE_OK;
}

octree_status game_note_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3])
{
    const octree_refusal refusal = {id, why, {position[0], position[1], position[2]}};
    if (!list_push(&game->memory, &game->refusals, &refusal, sizeof refusal))
        return OCTREE_NO_MEMORY;
    game->tick.events |= why == OCTREE_FULL ? OCTREE_EVENT_FULL : OCTREE_EVENT_REFUSED;
    return OCTREE_OK;
}

/* Record a refusal by the tree, which is part of the game. Success and NO_MEMORY are returned as they are. */
static octree_status note_failure(octree_game *game, uint64_t id, octree_status status, const double position[3])
{
    if (status == OCTREE_OK || status == OCTREE_NO_MEMORY)
        return status;
    const octree_status noted = game_note_refusal(game, id, status, position);
    return noted == OCTREE_OK ? status : noted;
}

/* The tick at which the motion of an edited body starts: edits come before the motion of their tick. */
static uint64_t origin_tick(const octree_game *game)
{
    return game->tick.number ? game->tick.number - 1 : 0;
}

static bool is_players_id(const octree_game *game, uint64_t id)
{
    return game->session->player.kind == OCTREE_PLAYER_KEYS && id == game->session->player.id;
}

bool octree_game_find(const octree_game *game, uint64_t id, octree_point *point)
{
    if (!game || !point)
        return false;
    const bool is_player = is_players_id(game, id);
    const moving_body *body = is_player ? NULL : bodies_find(&game->bodies, id);
    point->id = id;
    if (is_player || body)
        memcpy(point->position, is_player ? game->tick.player : body->position, sizeof point->position);
    return is_player || body;
}

octree_status game_check_body(const octree_game *game, const octree_body *body)
{
    if (is_players_id(game, body->id) || bodies_find(&game->bodies, body->id))
        return OCTREE_DUPLICATE;
    return is_finite(body->velocity) ? OCTREE_OK : OCTREE_NOT_FINITE;
}

octree_status game_add_body(octree_game *game, const octree_body *body, octree_status status)
{
    if (status == OCTREE_OK && !bodies_add(&game->bodies, &game->memory, body, origin_tick(game)))
        return OCTREE_NO_MEMORY;
    return note_failure(game, body->id, status, body->position);
}

static octree_status insert_body(octree_game *game, const octree_body *body)
{
    octree_status status = game_check_body(game, body);
    if (status == OCTREE_OK)
        status = game_insert(game, body->position, body->id);
    return game_add_body(game, body, status);
}

static octree_status remove_body(octree_game *game, const octree_edit *edit)
{
    static const double nowhere[3] = {0, 0, 0}; /* a removal has no position */
    moving_body *body = bodies_find(&game->bodies, edit->body.id);
    octree_status status = OCTREE_NOT_FOUND;
    if (body)
        status = game_remove(game, body->position, body->id);
    if (status == OCTREE_OK)
        bodies_remove(&game->bodies, body);
    return note_failure(game, edit->body.id, status, nowhere);
}

static octree_status move_body(octree_game *game, const octree_edit *edit)
{
    moving_body *body = bodies_find(&game->bodies, edit->body.id);
    octree_status status = OCTREE_NOT_FOUND;
    if (body)
        status = game_move(game, body->position, body->id, edit->body.position);
    if (status == OCTREE_OK) {
        body_store(body, edit->body.position, game->tick.number);
        restart(body, &game->session->tree.world, edit->body.position, origin_tick(game));
    }
    return note_failure(game, edit->body.id, status, edit->body.position);
}

static octree_status apply_edit(octree_game *game, const octree_edit *edit)
{
    switch (edit->kind) {
    case OCTREE_EDIT_INSERT:
        return insert_body(game, &edit->body);
    case OCTREE_EDIT_REMOVE:
        return remove_body(game, edit);
    default:
        return move_body(game, edit);
    }
}

/* ---- Many moves at once --------------------------------------------------------------------------------------- */

/* Moves of different bodies. */
typedef struct motion {
    octree_point *points; /* the bodies as the tree stores them */
    double (*to)[3];
    octree_status *statuses;
    uint32_t *bodies; /* indices of the bodies */
    size_t count, room;
} motion;

static bool motion_allocate(motion *m, arena *memory, size_t room)
{
    *m = (motion){.room = room};
    m->points = arena_take(memory, room * sizeof *m->points);
    m->to = arena_take(memory, room * sizeof *m->to);
    m->statuses = arena_take(memory, room * sizeof *m->statuses);
    m->bodies = arena_take(memory, room * sizeof *m->bodies);
    return m->points && m->to && m->statuses && m->bodies;
}

static void motion_release(motion *m, arena *memory)
{
    arena_give(memory, m->points, m->room * sizeof *m->points);
    arena_give(memory, m->to, m->room * sizeof *m->to);
    arena_give(memory, m->statuses, m->room * sizeof *m->statuses);
    arena_give(memory, m->bodies, m->room * sizeof *m->bodies);
}

static void add_move(motion *m, const bodies *all, size_t index, const double to[3])
{
    const moving_body *body = &bodies_items(all)[index];
    memcpy(m->points[m->count].position, body->position, sizeof body->position);
    m->points[m->count].id = body->id;
    memcpy(m->to[m->count], to, sizeof m->to[m->count]);
    m->bodies[m->count++] = (uint32_t)index;
}

static void collect_motion(const octree_game *game, motion *m)
{
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        const moving_body *body = &bodies_items(&game->bodies)[i];
        if (!is_moving(body->velocity))
            continue; /* keep its bits: body_at() would turn -0.0 into +0.0 */
        const octree_body now = body_at(body, &game->session->tree.world, game->tick.number);
        if (memcmp(now.position, body->position, sizeof now.position) != 0)
            add_move(m, &game->bodies, i, now.position);
    }
}

enum { MANY = 256 }; /* with fewer moves octree_move_many() is not faster */

/* Move the points in the tree only. Returns OK, or NO_MEMORY after which some points may have moved. */
static octree_status move_points(octree *tree, motion *m)
{
    if (m->count >= MANY)
        return octree_move_many(tree, m->points, (const double(*)[3])m->to, m->count, m->statuses, NULL);
    for (size_t i = 0; i < m->count; i++) {
        m->statuses[i] = octree_move(tree, m->points[i].position, m->points[i].id, m->to[i]);
        if (m->statuses[i] == OCTREE_NO_MEMORY)
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

/* Apply the result of a move to its body. */
static octree_status finish_move(octree_game *game, const motion *m, size_t i)
{
    if (m->statuses[i] == OCTREE_OK) {
        note_change(game, m->points[i].position);
        note_change(game, m->to[i]);
        body_store(&bodies_items(&game->bodies)[m->bodies[i]], m->to[i], game->tick.number);
    }
    return note_failure(game, m->points[i].id, m->statuses[i], m->to[i]);
}

/* Collect moves from the first edit on, until an edit moves an unknown body or one that the run moves already. */
static void collect_run(const octree_game *game, const octree_edit *edits, size_t count, size_t *last_run, size_t run,
                        motion *m)
{
    m->count = 0;
    while (m->count < count) {
        const octree_body *to = &edits[m->count].body;
        const moving_body *body = bodies_find(&game->bodies, to->id);
        const size_t index = body ? (size_t)(body - bodies_items(&game->bodies)) : 0;
        if (!body || last_run[index] == run)
            break;
        last_run[index] = run;
        add_move(m, &game->bodies, index, to->position);
    }
}

static octree_status apply_run(octree_game *game, motion *m)
{
    octree_status status = move_points(game->tree, m);
    for (size_t i = 0; status == OCTREE_OK && i < m->count; i++) {
        moving_body *body = &bodies_items(&game->bodies)[m->bodies[i]];
        status = finish_move(game, m, i) == OCTREE_NO_MEMORY ? OCTREE_NO_MEMORY : OCTREE_OK;
        if (m->statuses[i] == OCTREE_OK)
            restart(body, &game->session->tree.world, m->to[i], origin_tick(game));
    }
    return status;
}

/* Apply edits that are all moves, in runs that move no body twice. */
static octree_status apply_moves(octree_game *game, const octree_edit *edits, size_t count)
{
    motion m = {0};
    const size_t size = (game->bodies.items.count + 1) * sizeof(size_t);
    size_t *last_run = arena_take(&game->memory, size); /* by body: the last run that moved it; 0 for none */
    octree_status status = last_run && motion_allocate(&m, &game->memory, count) ? OCTREE_OK : OCTREE_NO_MEMORY;
    if (last_run)
        memset(last_run, 0, size);
    for (size_t run = 1; status == OCTREE_OK && count > 0; run++) {
        collect_run(game, edits, count, last_run, run, &m);
        if (m.count > 0)
            status = apply_run(game, &m);
        else if (apply_edit(game, edits) == OCTREE_NO_MEMORY) /* the body is unknown */
            status = OCTREE_NO_MEMORY;
        edits += m.count ? m.count : 1;
        count -= m.count ? m.count : 1;
    }
    motion_release(&m, &game->memory);
    arena_give(&game->memory, last_run, size);
    return status;
}

static size_t count_moves(const octree_edit *edits, size_t count)
{
    size_t moves = 0;
    while (moves < count && edits[moves].kind == OCTREE_EDIT_MOVE)
        moves++;
    return moves;
}

octree_status game_apply_edits(octree_game *game, const octree_input *input)
{
    const octree_edit *edits = input->edits;
    octree_status status = OCTREE_OK;
    for (size_t left = input->edit_count; status != OCTREE_NO_MEMORY && left > 0;) {
        const size_t moves = count_moves(edits, left), made = moves >= MANY ? moves : 1;
        status = moves >= MANY ? apply_moves(game, edits, moves) : apply_edit(game, edits);
        edits += made;
        left -= made;
    }
    return status == OCTREE_NO_MEMORY ? status : OCTREE_OK;
}

octree_status game_move_bodies(octree_game *game)
{
    motion m;
    octree_status status = OCTREE_NO_MEMORY;
    if (game->bodies.movers == 0)
        return OCTREE_OK;
    if (motion_allocate(&m, &game->memory, game->bodies.movers)) {
        collect_motion(game, &m);
        status = move_points(game->tree, &m);
    }
    for (size_t i = 0; status == OCTREE_OK && i < m.count; i++)
        if (finish_move(game, &m, i) == OCTREE_NO_MEMORY)
            status = OCTREE_NO_MEMORY;
    motion_release(&m, &game->memory);
    return status;
}

octree_status game_list_movers(octree_game *game)
{
    const bodies *all = &game->bodies;
    for (size_t i = 0; all->movers && i < all->items.count; i++) {
        const moving_body *body = &bodies_items(all)[i];
        if (!is_moving(body->velocity))
            continue;
        octree_body now = body_at(body, &game->session->tree.world, game->tick.number);
        memcpy(now.position, body->position,
               sizeof now.position); /* the stored position: a full leaf may have refused the move */
        if (!is_moving(now.velocity))
            continue; /* too fast to follow: it does not move */
        if (!list_push(&game->memory, &game->movers, &now, sizeof now))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}
