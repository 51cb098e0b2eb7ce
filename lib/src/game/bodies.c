/* SPDX-License-Identifier: MIT */
#include "bodies.h"
#include "float_rules.h"
#include "game_state.h"
#include "octree/digest.h"

#include <math.h>

static size_t home_of(const bodies *b, uint64_t id)
{
    return (size_t)octree_digest_word(OCTREE_DIGEST_START, id) & (b->slot_count - 1);
}

/* The slot of an id, or the empty one where the search ends. Precondition: slot_count > 0. */
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

/* Keep at least half of the slots empty. */
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

/* Add a body whose id is not in use, which starts from its position at this tick. False when there is no memory. */
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

/* Empty a slot and close the gap: entries after it move up unless that would take them before their home. */
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

/* Take a body out; the last one takes its place. */
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

/* Note that a body is stored elsewhere from this tick on. */
static void body_store(moving_body *body, const double to[3], uint64_t tick)
{
    if (body->moved != tick)
        memcpy(body->before, body->position, sizeof body->before);
    body->moved = tick;
    memcpy(body->position, to, sizeof body->position);
}

/* Fold a straight path into an interval: a triangle wave of period 2 * (max - min). Quarters where that overflows; a
 * path that overflows all the same stays at its origin. *direction: 1 as the velocity says, -1 turned, 0 at rest. */
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

/* On one axis: reflected at the world's faces as often as it must be, and turned where it bounced and where it is about
 * to. */
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

/* Where a body is at a tick and how it goes on. Most have met no face so far, which takes no branch to see. */
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

/* Let a body go on from another place, with the velocity that it has at this tick. */
static void restart(moving_body *body, const octree_box *world, const double place[3], uint64_t tick)
{
    const octree_body now = body_at(body, world, tick);
    for (int i = 0; i < 3; i++)
        if (now.velocity[i] != 0) /* 0 is also what is said of one that is too fast to follow */
            body->velocity[i] = now.velocity[i];
    memcpy(body->origin, place, sizeof body->origin);
    body->since = tick;
}

/* ---- Changes of the tree ------------------------------------------------------------------------------------ */

static void touch(octree_game *game, const double place[3])
{
    tree_summary_touch(&game->summary, &game->memory, game->tree, place);
}

octree_status game_insert(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_insert(game->tree, position, id);
    if (status == OCTREE_OK)
        touch(game, position);
    return status;
}

static octree_status game_remove(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_remove(game->tree, position, id);
    if (status == OCTREE_OK)
        touch(game, position);
    return status;
}

octree_status game_move(octree_game *game, const double from[3], uint64_t id, const double to[3])
{
    const octree_status status = octree_move(game->tree, from, id, to);
    if (status != OCTREE_OK)
        return status;
    touch(game, from);
    touch(game, to);
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

/* A refusal by the tree is part of the game; no memory is the end of it. */
static octree_status note_unless_done(octree_game *game, uint64_t id, octree_status status, const double position[3])
{
    if (status == OCTREE_OK || status == OCTREE_NO_MEMORY)
        return status;
    const octree_status noted = game_note_refusal(game, id, status, position);
    return noted == OCTREE_OK ? status : noted;
}

/* An edit comes before the motion of its own tick: what it places moves on from there at once. */
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
    return note_unless_done(game, body->id, status, body->position);
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
    static const double nowhere[3] = {0, 0, 0}; /* a removal says no place: only its id is read */
    moving_body *body = bodies_find(&game->bodies, edit->body.id);
    octree_status status = OCTREE_NOT_FOUND;
    if (body)
        status = game_remove(game, body->position, body->id);
    if (status == OCTREE_OK)
        bodies_remove(&game->bodies, body);
    return note_unless_done(game, edit->body.id, status, nowhere);
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
    return note_unless_done(game, edit->body.id, status, edit->body.position);
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

/* No body twice. */
typedef struct motion {
    octree_point *points; /* where the bodies are stored */
    double (*to)[3];
    octree_status *statuses;
    uint32_t *bodies; /* by their index */
    size_t count, room;
} motion;

static bool motion_take(motion *m, arena *memory, size_t room)
{
    *m = (motion){.room = room};
    m->points = arena_take(memory, room * sizeof *m->points);
    m->to = arena_take(memory, room * sizeof *m->to);
    m->statuses = arena_take(memory, room * sizeof *m->statuses);
    m->bodies = arena_take(memory, room * sizeof *m->bodies);
    return m->points && m->to && m->statuses && m->bodies;
}

static void motion_give(motion *m, arena *memory)
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
            continue; /* its bits stay too: -0.0 plus nothing would be +0.0 */
        const octree_body now = body_at(body, &game->session->tree.world, game->tick.number);
        if (memcmp(now.position, body->position, sizeof now.position) != 0)
            add_move(m, &game->bodies, i, now.position);
    }
}

enum { MANY = 256 }; /* of fewer the single moves cost no more */

/* The tree alone. NO_MEMORY, after which some may have moved, or OK. */
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

/* What a move did to a body. */
static octree_status note_move(octree_game *game, const motion *m, size_t i)
{
    if (m->statuses[i] == OCTREE_OK) {
        touch(game, m->points[i].position);
        touch(game, m->to[i]);
        body_store(&bodies_items(&game->bodies)[m->bodies[i]], m->to[i], game->tick.number);
    }
    return note_unless_done(game, m->points[i].id, m->statuses[i], m->to[i]);
}

/* The moves from the first edit on of bodies that are there, each once: of one that comes again the next run tells. */
static void collect_run(const octree_game *game, const octree_edit *edits, size_t count, size_t *seen, size_t run,
                        motion *m)
{
    m->count = 0;
    while (m->count < count) {
        const octree_body *to = &edits[m->count].body;
        const moving_body *body = bodies_find(&game->bodies, to->id);
        const size_t index = body ? (size_t)(body - bodies_items(&game->bodies)) : 0;
        if (!body || seen[index] == run)
            break;
        seen[index] = run;
        add_move(m, &game->bodies, index, to->position);
    }
}

static octree_status make_run(octree_game *game, motion *m)
{
    octree_status status = move_points(game->tree, m);
    for (size_t i = 0; status == OCTREE_OK && i < m->count; i++) {
        moving_body *body = &bodies_items(&game->bodies)[m->bodies[i]];
        status = note_move(game, m, i) == OCTREE_NO_MEMORY ? OCTREE_NO_MEMORY : OCTREE_OK;
        if (m->statuses[i] == OCTREE_OK)
            restart(body, &game->session->tree.world, m->to[i], origin_tick(game));
    }
    return status;
}

/* Edits that are all moves. */
static octree_status apply_moves(octree_game *game, const octree_edit *edits, size_t count)
{
    motion m = {0};
    const size_t size = (game->bodies.items.count + 1) * sizeof(size_t);
    size_t *seen = arena_take(&game->memory, size); /* the last run that moved a body */
    octree_status status = seen && motion_take(&m, &game->memory, count) ? OCTREE_OK : OCTREE_NO_MEMORY;
    if (seen)
        memset(seen, 0, size);
    for (size_t run = 1; status == OCTREE_OK && count > 0; run++) {
        collect_run(game, edits, count, seen, run, &m);
        if (m.count > 0)
            status = make_run(game, &m);
        else if (apply_edit(game, edits) == OCTREE_NO_MEMORY) /* there is no such body */
            status = OCTREE_NO_MEMORY;
        edits += m.count ? m.count : 1;
        count -= m.count ? m.count : 1;
    }
    motion_give(&m, &game->memory);
    arena_give(&game->memory, seen, size);
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
    if (motion_take(&m, &game->memory, game->bodies.movers)) {
        collect_motion(game, &m);
        status = move_points(game->tree, &m);
    }
    for (size_t i = 0; status == OCTREE_OK && i < m.count; i++)
        if (note_move(game, &m, i) == OCTREE_NO_MEMORY)
            status = OCTREE_NO_MEMORY;
    motion_give(&m, &game->memory);
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
        memcpy(now.position, body->position, sizeof now.position); /* a full leaf may have refused the move */
        if (!is_moving(now.velocity))
            continue; /* it is so fast that it stays where it is */
        if (!list_push(&game->memory, &game->movers, &now, sizeof now))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}
