/* bodies.c - see bodies.h. */
#include "bodies.h"
#include "float_rules.h"
#include "octree/digest.h"

#include <math.h>

static size_t home_of(const bodies *b, uint64_t id)
{
    return (size_t)octree_digest_word(OCTREE_DIGEST_START, id) & (b->slot_count - 1);
}

/* The slot of an id, or the empty one where the search ends. There are slots. */
static size_t slot_of(const bodies *b, uint64_t id)
{
    size_t slot = home_of(b, id);
    while (b->slots[slot] && bodies_items(b)[b->slots[slot] - 1].id != id)
        slot = (slot + 1) & (b->slot_count - 1);
    return slot;
}

void bodies_release(bodies *b)
{
    list_release(b->memory, &b->items, sizeof(moving_body));
    arena_give(b->memory, b->slots, b->slot_count * sizeof *b->slots);
    *b = (bodies){.memory = b->memory};
}

moving_body *bodies_find(const bodies *b, uint64_t id)
{
    if (b->slot_count == 0)
        return NULL;
    const uint32_t entry = b->slots[slot_of(b, id)];
    return entry ? &bodies_items(b)[entry - 1] : NULL;
}

/* Keep at least half of the slots empty. */
static bool make_slots(bodies *b, size_t count)
{
    if (2 * count <= b->slot_count)
        return true;
    const size_t slot_count = b->slot_count ? 2 * b->slot_count : 64;
    uint32_t *slots = arena_take(b->memory, slot_count * sizeof *slots);
    if (!slots)
        return false;
    arena_give(b->memory, b->slots, b->slot_count * sizeof *slots);
    memset(slots, 0, slot_count * sizeof *slots);
    b->slots = slots;
    b->slot_count = slot_count;
    for (size_t i = 0; i < b->items.count; i++)
        slots[slot_of(b, bodies_items(b)[i].id)] = (uint32_t)(i + 1);
    return true;
}

bool is_moving(const double velocity[3])
{
    return velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
}

bool is_finite_velocity(const double velocity[3])
{
    return isfinite(velocity[0]) && isfinite(velocity[1]) && isfinite(velocity[2]);
}

bool bodies_add(bodies *b, const octree_body *body, uint64_t tick)
{
    if (!make_slots(b, b->items.count + 1))
        return false;
    const size_t slot = slot_of(b, body->id);
    moving_body *added = list_append(b->memory, &b->items, sizeof *added);
    if (!added)
        return false;
    *added = (moving_body){.id = body->id, .since = tick, .moved = UINT64_MAX};
    memcpy(added->position, body->position, sizeof added->position);
    memcpy(added->origin, body->position, sizeof added->origin);
    memcpy(added->velocity, body->velocity, sizeof added->velocity);
    b->slots[slot] = (uint32_t)b->items.count;
    b->movers += is_moving(body->velocity);
    return true;
}

/* Empty a slot and close the gap: entries behind it move up unless that would take them before their home. */
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

void bodies_remove(bodies *b, moving_body *body)
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

void body_store(moving_body *body, const double to[3], uint64_t tick)
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

static double ticks_since(const moving_body *body, uint64_t tick)
{
    return (double)(tick - body->since);
}

void body_position(const moving_body *body, const octree_box *world, uint64_t tick, double position[3])
{
    int direction;
    for (int i = 0; i < 3; i++)
        position[i] = reflect(body->origin[i], body->velocity[i], ticks_since(body, tick), world->min[i], world->max[i],
                              &direction);
}

void body_velocity(const moving_body *body, const octree_box *world, uint64_t tick, double velocity[3])
{
    int direction;
    for (int i = 0; i < 3; i++) {
        const double at = reflect(body->origin[i], body->velocity[i], ticks_since(body, tick), world->min[i],
                                  world->max[i], &direction);
        const double now = body->velocity[i] * direction;
        const bool leaves = (at == world->max[i] && now > 0) || (at == world->min[i] && now < 0);
        velocity[i] = (leaves ? -now : now) + 0.0; /* no minus zero */
    }
}
