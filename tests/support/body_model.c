/* SPDX-License-Identifier: MIT */
/* body_model.c - random changes of a set of bodies and of a list. */
#include "body_model.h"

#include <string.h>

#include "fixture.h"

enum { ROOM = BODY_MODEL_ROOM, BATCH = 40 };

static size_t find_in_model(const body_model *m, const octree_body *body)
{
    size_t i = 0;
    while (i < m->count && octree_compare_bodies(&m->bodies[i], body) != 0)
        i++;
    return i;
}

static octree_status insert_into_model(body_model *m, const octree_body *body)
{
    if (find_in_model(m, body) < m->count)
        return OCTREE_DUPLICATE;
    assert_true(m->count < ROOM);
    m->bodies[m->count++] = *body;
    return OCTREE_OK;
}

static octree_status remove_from_model(body_model *m, const octree_body *body)
{
    const size_t at = find_in_model(m, body);
    if (at == m->count)
        return OCTREE_NOT_FOUND;
    m->bodies[at] = m->bodies[--m->count];
    return OCTREE_OK;
}

static octree_status move_in_model(body_model *m, const octree_body *from, const octree_body *to)
{
    const size_t at = find_in_model(m, from), other = find_in_model(m, to);
    if (at == m->count)
        return OCTREE_NOT_FOUND;
    if (other < m->count && other != at)
        return OCTREE_DUPLICATE;
    m->bodies[at] = *to;
    return OCTREE_OK;
}

/* The set holds the bodies of the model, and is in the same state as a set that is built from them at once. */
void body_model_assert_same(const octree_bodies *set, const body_model *m)
{
    octree_bodies *built;
    const octree_def def = octree_bodies_definition(set);
    const char *violation = octree_bodies_check(set);
    if (violation)
        fail_msg("%s", violation);
    assert_int_equal(octree_bodies_count(set), m->count);
    for (size_t i = 0; i < m->count; i++)
        assert_true(octree_bodies_contain(set, &m->bodies[i]));
    assert_int_equal(octree_bodies_create(&def, &built), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(built, m->bodies, m->count, NULL, NULL), OCTREE_OK);
    assert_true(octree_bodies_digest(built) == octree_bodies_digest(set));
    octree_bodies_destroy(built);
}

void body_model_compact(octree_bodies *set, const body_model *m)
{
    octree_bodies *built;
    const octree_def def = octree_bodies_definition(set);
    assert_int_equal(octree_bodies_compact(set), OCTREE_OK);
    assert_int_equal(octree_bodies_create(&def, &built), OCTREE_OK);
    assert_int_equal(octree_bodies_insert_many(built, m->bodies, m->count, NULL, NULL), OCTREE_OK);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++) {
        double reach[3] = {0}, expected[3] = {0};
        const octree *a = octree_bodies_level(set, i, reach), *b = octree_bodies_level(built, i, expected);
        assert_int_equal(octree_count(a), octree_count(b));
        assert_true(octree_count(a) == 0 || node_count(a) == node_count(b));
        assert_memory_equal(reach, expected, sizeof reach);
    }
    octree_bodies_destroy(built);
}

/* A body that is stored, with probability 3/4, or a random one. */
static octree_body pick_body(const body_model *m, scene_numbers numbers, uint64_t *seed)
{
    if (m->count > 0 && random_below(seed, 4) > 0)
        return m->bodies[random_below(seed, m->count)];
    return random_body(numbers, seed, random_below(seed, 5));
}

/* A place for a body: near or far, with the same extent or another one. */
static octree_body pick_destination(const octree_body *from, scene_numbers numbers, uint64_t *seed)
{
    octree_body to = random_body(numbers, seed, from->id);
    if (random_below(seed, 3) > 0)
        memcpy(to.half, from->half, sizeof to.half);
    if (random_below(seed, 4) == 0)
        memcpy(to.position, from->position, sizeof to.position);
    return to;
}

void body_model_change_one(octree_bodies *set, body_model *m, scene_numbers numbers, uint64_t *seed)
{
    const octree_body body = pick_body(m, numbers, seed), to = pick_destination(&body, numbers, seed);
    const uint64_t kind = random_below(seed, m->count > ROOM / 2 ? 3 : 4);
    if (kind == 0)
        assert_int_equal(octree_bodies_remove(set, &body), remove_from_model(m, &body));
    else if (kind == 1)
        assert_int_equal(octree_bodies_move(set, &body, &to), move_in_model(m, &body, &to));
    else if (m->count < ROOM - 1)
        assert_int_equal(octree_bodies_insert(set, &to), insert_into_model(m, &to));
}

void body_model_change_many(octree_bodies *set, body_model *m, scene_numbers numbers, uint64_t *seed)
{
    octree_body from[BATCH], to[BATCH];
    octree_status statuses[BATCH];
    size_t changed, expected = 0;
    const size_t count = random_below(seed, BATCH + 1);
    const uint64_t kind = m->count + BATCH > ROOM ? 0 : random_below(seed, 3);
    for (size_t i = 0; i < count; i++) {
        from[i] = pick_body(m, numbers, seed);
        to[i] = pick_destination(&from[i], numbers, seed);
    }
    if (kind == 0)
        assert_int_equal(octree_bodies_remove_many(set, from, count, statuses, &changed), OCTREE_OK);
    else if (kind == 1)
        assert_int_equal(octree_bodies_move_many(set, from, to, count, statuses, &changed), OCTREE_OK);
    else
        assert_int_equal(octree_bodies_insert_many(set, to, count, statuses, &changed), OCTREE_OK);
    for (size_t i = 0; i < count; i++) {
        const octree_status status = kind == 0   ? remove_from_model(m, &from[i])
                                     : kind == 1 ? move_in_model(m, &from[i], &to[i])
                                                 : insert_into_model(m, &to[i]);
        assert_int_equal(statuses[i], status);
        expected += status == OCTREE_OK;
    }
    assert_int_equal(changed, expected);
}
