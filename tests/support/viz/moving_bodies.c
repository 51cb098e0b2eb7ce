/* SPDX-License-Identifier: MIT */
/* moving_bodies.c - see moving_bodies.h. */
#include "moving_bodies.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "body_sets.h"
#include "files.h"
#include "fixture.h"
#include "session_file.h"

enum { REACH = 8, EDITS = sizeof((moving_bodies *)0)->edits / sizeof(octree_edit) };

/* ---- The program --------------------------------------------------------------------------------------------- */

static void random_place(moving_bodies *m, double position[3])
{
    for (int i = 0; i < 3; i++)
        position[i] = (double)random_below(&m->random, 4 * REACH + 1) / 2 - REACH;
    if (random_below(&m->random, 8) == 0)
        position[random_below(&m->random, 3)] = REACH + 0.5; /* outside the world */
}

static void random_half(moving_bodies *m, double half[3])
{
    const bool point = random_below(&m->random, 3) == 0;
    for (int i = 0; i < 3; i++)
        half[i] = point ? 0 : (double)random_below(&m->random, 9) / 4;
}

static void change_slot(moving_bodies *m, moving_body_slot *slot)
{
    enum { COME_OR_LEAVE = 1, MOVE = 2, RESIZE = 4 };
    const uint64_t change = random_below(&m->random, 3) ? 0 : random_below(&m->random, 8);
    if (change & COME_OR_LEAVE)
        slot->alive = !slot->alive;
    if (change & MOVE)
        random_place(m, slot->body.position);
    if (change & RESIZE)
        random_half(m, slot->body.half);
}

static size_t list_bodies(const moving_bodies *m, octree_body *bodies)
{
    size_t count = 0;
    for (size_t i = MOVING_BODIES_MOST; i-- > 0;)
        if (m->now[i].alive)
            bodies[count++] = m->now[i].body;
    return count;
}

static void update_set(moving_bodies *m)
{
    octree_body bodies[MOVING_BODIES_MOST];
    const size_t count = list_bodies(m, bodies);
    assert_int_equal(octree_bodies_replace_all(m->set, bodies, count, NULL, NULL), OCTREE_OK);
}

void moving_bodies_step(moving_bodies *m)
{
    for (size_t i = 0; i < MOVING_BODIES_MOST; i++)
        change_slot(m, &m->now[i]);
    update_set(m);
}

void moving_bodies_make(moving_bodies *m, uint64_t seed)
{
    *m = (moving_bodies){.random = seed, .set = make_body_set(cube(-2 * REACH, 2 * REACH), 4)};
    for (size_t i = 0; i < MOVING_BODIES_MOST; i++) {
        m->now[i] = (moving_body_slot){.body.id = i * 1000003, .alive = i % 2}; /* ids of more than one byte */
        random_place(m, m->now[i].body.position);
        random_half(m, m->now[i].body.half);
    }
    update_set(m);
}

void moving_bodies_release(moving_bodies *m)
{
    octree_bodies_destroy(m->set);
}

static bool same_half(const octree_body *a, const octree_body *b)
{
    return memcmp(a->half, b->half, sizeof a->half) == 0;
}

/* ---- Recording ----------------------------------------------------------------------------------------------- */

static octree_edit make_edit(octree_edit_kind kind, const octree_body *body)
{
    octree_edit edit = {.tick = 99, .kind = kind, .body = {.id = body->id, .velocity = {1, 2, 3}}};
    memcpy(edit.body.position, body->position, sizeof edit.body.position);
    memcpy(edit.body.half, body->half, sizeof edit.body.half);
    return edit;
}

/* The edits since the last accepted tick, on purpose more than necessary. Returns their number. */
static size_t make_changes(const moving_bodies *m, octree_edit *edits)
{
    static const octree_body passing = {{1, 2, 3}, {4, 5, 6}, 424242};
    size_t count = 0;
    edits[count++] = make_edit(OCTREE_EDIT_INSERT, &passing);
    for (size_t i = MOVING_BODIES_MOST; i-- > 0;) {
        const moving_body_slot *old = &m->recorded[i], *new = &m->now[i];
        const bool again = old->alive && new->alive && (!same_half(&old->body, &new->body) || i % 5 == 0);
        if (old->alive && (again || !new->alive))
            edits[count++] = make_edit(OCTREE_EDIT_REMOVE, &old->body);
        if (new->alive && (again || !old->alive))
            edits[count++] = make_edit(OCTREE_EDIT_INSERT, &new->body);
        if (new->alive && i % 3 == 0) { /* on the way */
            edits[count++] = make_edit(OCTREE_EDIT_MOVE, &passing);
            edits[count - 1].body.id = new->body.id;
        }
        if (new->alive && (i % 3 == 0 || !again))
            edits[count++] = make_edit(OCTREE_EDIT_MOVE, &new->body);
    }
    edits[count++] = make_edit(OCTREE_EDIT_REMOVE, &passing);
    return count;
}

static octreel_status record(const moving_bodies *m, octreel_recorder *recorder, bodies_source source)
{
    octree_edit edits[5 * MOVING_BODIES_MOST];
    octree_body bodies[MOVING_BODIES_MOST];
    octreel_tick_info about = {.body_set = source == BODIES_SET ? m->set : NULL};
    if (source == BODIES_CHANGES) {
        about.changes = edits;
        about.change_count = make_changes(m, edits);
    } else if (source == BODIES_LIST) {
        about.bodies = bodies;
        about.body_count = list_bodies(m, bodies);
    }
    return octreel_recorder_tick(recorder, NULL, &about);
}

/* ---- The expected session ------------------------------------------------------------------------------------ */

static void expect_edit(moving_bodies *m, octree_edit_kind kind, const double position[3], const octree_body *body)
{
    octree_edit *edit = &m->edits[m->session.edit_count++];
    assert_true(m->session.edit_count <= EDITS);
    *edit = (octree_edit){.tick = m->ticks, .kind = kind, .body.id = body->id};
    if (kind != OCTREE_EDIT_REMOVE)
        memcpy(edit->body.position, position, sizeof edit->body.position);
    if (kind == OCTREE_EDIT_INSERT)
        memcpy(edit->body.half, body->half, sizeof edit->body.half);
}

static bool is_shown(const moving_body_slot *slot)
{
    const octree_box world = cube(-REACH, REACH);
    return slot->alive && box_holds(&world, slot->body.position);
}

static void expect_edits_of(moving_bodies *m, octree_edit_kind kind, bool resized)
{
    for (size_t i = 0; i < MOVING_BODIES_MOST; i++) {
        const moving_body_slot *old = &m->recorded[i], *new = &m->now[i];
        const bool stays = is_shown(old) && is_shown(new);
        const bool moved = old->alive && new->alive && !same_position(old->body.position, new->body.position);
        if (resized && stays && !same_half(&old->body, &new->body)) {
            expect_edit(m, OCTREE_EDIT_REMOVE, NULL, &new->body);
            expect_edit(m, OCTREE_EDIT_INSERT, old->body.position, &new->body);
        }
        const bool due = kind == OCTREE_EDIT_REMOVE ? is_shown(old) && !stays
                         : kind == OCTREE_EDIT_MOVE ? stays && moved
                                                    : new->alive && !stays && (moved || !old->alive);
        if (due && !resized)
            expect_edit(m, kind, new->body.position, &new->body);
    }
}

static void expect_first_bodies(moving_bodies *m)
{
    for (size_t i = 0; i < MOVING_BODIES_MOST; i++)
        if (m->now[i].alive)
            m->first[m->session.body_count++] = make_edit(OCTREE_EDIT_INSERT, &m->now[i].body).body;
    for (size_t i = 0; i < m->session.body_count; i++)
        memset(m->first[i].velocity, 0, sizeof m->first[i].velocity);
}

static void expect_tick(moving_bodies *m)
{
    if (m->ticks == 0)
        expect_first_bodies(m);
    else {
        expect_edits_of(m, OCTREE_EDIT_REMOVE, true);
        expect_edits_of(m, OCTREE_EDIT_REMOVE, false);
        expect_edits_of(m, OCTREE_EDIT_MOVE, false);
        expect_edits_of(m, OCTREE_EDIT_INSERT, false);
    }
    memcpy(m->recorded, m->now, sizeof m->recorded);
    m->ticks++;
}

octreel_status moving_bodies_record(moving_bodies *m, octreel_recorder *recorder, bodies_source source)
{
    const octreel_status status = record(m, recorder, source);
    if (status == OCTREEL_OK)
        expect_tick(m);
    return status;
}

void moving_bodies_expect_gap(moving_bodies *m, const char *why)
{
    octree_gap *gap = &m->gaps[m->session.gap_count++];
    gap->tick = m->ticks++;
    snprintf(gap->why, sizeof gap->why, "%s", why);
}

void moving_bodies_forget_ticks(moving_bodies *m)
{
    m->session = (octree_session){.ticks = 0};
    m->ticks = 0;
}

void moving_bodies_assert_recorded(moving_bodies *m, const char *folder)
{
    char *expected;
    size_t expected_size, size;
    FILE *out = open_memstream(&expected, &expected_size);
    octree_session *session = &m->session;
    session->tree = octreel_recorder_def_default().tree;
    session->tree.world = cube(-REACH, REACH);
    session->player.kind = OCTREE_PLAYER_NONE;
    session->bodies = m->first;
    session->edits = m->edits;
    session->gaps = m->gaps;
    session->ticks = m->ticks - 1;
    assert_non_null(out);
    assert_true(session_write(session, NULL, out));
    fclose(out);
    char *found = file_read(place_below(folder, "session.json").path, &size);
    assert_string_equal(found, expected);
    free(found);
    free(expected);
}
