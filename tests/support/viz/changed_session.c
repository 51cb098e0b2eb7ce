/* SPDX-License-Identifier: MIT */
/* changed_session.c - see changed_session.h. */
#include "changed_session.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "fixture.h"
#include "game_fixture.h"
#include "number.h"

static const char *place_text(const double place[3], char text[3 * NUMBER_TEXT + 8])
{
    char numbers[3][NUMBER_TEXT];
    for (int axis = 0; axis < 3; axis++)
        number_print(place[axis], numbers[axis]);
    sprintf(text, "(%s, %s, %s)", numbers[0], numbers[1], numbers[2]);
    return text;
}

static void expect(changed_session *t, const char *where, cause_change change, uint64_t tick, uint64_t id)
{
    t->where = where;
    t->change = change;
    t->tick = tick;
    t->id = id;
}

/* Behind all other edits of its tick. */
static void add_edit(changed_session *t, const octree_edit *edit, const char *name)
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
    expect(t, "edits", CAUSE_MORE, edit->tick, edit->body.id);
    sprintf(t->text, "one more edit at tick %" PRIu64 " (%s id %" PRIu64 ", position %s); ", edit->tick, name,
            edit->body.id, place_text(edit->body.position, place));
}

/* Some point as it is before a tick, the player left out; false where there is no other. */
static bool random_point(const octree_session *session, uint64_t tick, uint64_t *state, octree_point *point)
{
    static const octree_box all = {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
    octree_game *game = start_game(session);
    while (octree_game_tick(game)->number + 1 < tick)
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
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

bool move_by_one_step(changed_session *t, uint64_t tick, uint64_t *state)
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
    add_edit(t, &edit, "move");
    return true;
}

bool add_one_point(changed_session *t, uint64_t tick, uint64_t *state)
{
    const octree_box *world = &t->made.session.tree.world;
    octree_edit edit = {.tick = tick, .kind = OCTREE_EDIT_INSERT, .body.id = 5000};
    for (int axis = 0; axis < 3; axis++)
        edit.body.position[axis] =
            world->min[axis] + (double)random_below(state, (uint64_t)(world->max[axis] - world->min[axis]));
    add_edit(t, &edit, "insert");
    return true;
}

bool change_capacity(changed_session *t, uint64_t tick, uint64_t *state)
{
    const size_t old = t->made.session.tree.leaf_capacity;
    const size_t new = old > 1 && random_below(state, 2) ? old - 1 : old + 1 + random_below(state, 3);
    (void)tick;
    t->changed.tree.leaf_capacity = new;
    expect(t, "tree.capacity", CAUSE_OTHER, CAUSE_NO_TICK, CAUSE_NO_ID);
    sprintf(t->text, "another leaf capacity (%zu, was %zu): ", new, old);
    return true;
}

bool change_step(changed_session *t, uint64_t tick, uint64_t *state)
{
    const double old = t->made.session.player.step, new = old + (double)(1 + random_below(state, 8)) / 4;
    char texts[2][NUMBER_TEXT];
    (void)tick;
    t->changed.player.step = new;
    expect(t, "player.step", CAUSE_OTHER, CAUSE_NO_TICK, CAUSE_NO_ID);
    number_print(old, texts[0]);
    number_print(new, texts[1]);
    sprintf(t->text, "another step of the player (%s, was %s): ", texts[1], texts[0]);
    return true;
}

static const char *const kinds[] = {
    [OCTREE_PLAYER_KEYS] = "keys", [OCTREE_PLAYER_BODY] = "body", [OCTREE_PLAYER_NONE] = "none"};

/* Step and start, which not both kinds read, differ too, and are not named. */
bool change_kind(changed_session *t, uint64_t tick, uint64_t *state)
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
    expect(t, "player.kind", CAUSE_OTHER, CAUSE_NO_TICK, CAUSE_NO_ID);
    sprintf(t->text, "another kind of player (%s, was %s): ", kinds[new], kinds[old]);
    return true;
}

/* Change a vector of a body at the start, which has this offset in octree_game_body. */
static bool change_vector(changed_session *t, uint64_t *state, size_t offset, const char *where, const char *noun)
{
    const octree_session *session = &t->made.session;
    char texts[2][3 * NUMBER_TEXT + 8];
    if (session->body_count == 0)
        return false;
    const size_t i = random_below(state, session->body_count);
    memcpy(t->bodies, session->bodies, session->body_count * sizeof *t->bodies);
    t->changed.bodies = t->bodies;
    octree_game_body *body = &t->bodies[i];
    double *vector = (double *)((char *)body + offset);
    expect(t, where, CAUSE_OTHER, CAUSE_NO_TICK, body->id);
    place_text(vector, texts[0]);
    vector[random_below(state, 3)] += 0.25 * (double)(1 + random_below(state, 8));
    sprintf(t->text, "another %s (point %" PRIu64 ": %s, was %s); ", noun, body->id, place_text(vector, texts[1]),
            texts[0]);
    return true;
}

bool change_velocity(changed_session *t, uint64_t tick, uint64_t *state)
{
    (void)tick;
    return change_vector(t, state, offsetof(octree_game_body, velocity), "points.velocity", "velocity of a point");
}

bool change_half(changed_session *t, uint64_t tick, uint64_t *state)
{
    (void)tick;
    return change_vector(t, state, offsetof(octree_game_body, half), "points.half", "half extent of a body");
}

bool change_pairs(changed_session *t, uint64_t tick, uint64_t *state)
{
    const bool listed = t->made.session.pairs;
    (void)tick, (void)state;
    t->changed.pairs = !listed;
    expect(t, "session.pairs", CAUSE_OTHER, CAUSE_NO_TICK, CAUSE_NO_ID);
    sprintf(t->text, "another detection of overlaps (%s, was %s): ", listed ? "off" : "on", listed ? "on" : "off");
    return true;
}

/* A shape of some kind, somewhere. */
static octree_shape random_shape(uint64_t *state, uint64_t tick)
{
    octree_shape shape = {.tick = tick, .kind = (octree_shape_kind)random_below(state, OCTREE_SHAPE_KINDS)};
    for (int axis = 0; axis < 3; axis++) {
        shape.at[axis] = (double)random_below(state, 40) - 20;
        shape.to[axis] = shape.at[axis] + (double)random_below(state, 20);
    }
    sprintf(shape.text, "text %d", (int)random_below(state, 1000));
    return shape;
}

/* Some in both: at ticks, and at every one. */
static void give_shapes(changed_session *t, uint64_t *state)
{
    uint64_t tick = 0;
    for (size_t i = 0; i < CHANGED_SHAPES; i++) {
        tick = i < CHANGED_SHAPES - 3 ? tick + random_below(state, 3) : OCTREE_EVERY_TICK;
        t->shapes[0][i] = t->shapes[1][i] = random_shape(state, tick);
    }
    t->made.session.shapes = t->shapes[0];
    t->changed.shapes = t->shapes[1];
    t->made.session.shape_count = t->changed.shape_count = CHANGED_SHAPES;
}

/* As a sentence has it. */
static void shape_text(const octree_shape *shape, char text[256])
{
    char ends[2][3 * NUMBER_TEXT + 8];
    place_text(shape->at, ends[0]);
    place_text(shape->to, ends[1]);
    if (shape->kind == OCTREE_SHAPE_LABEL)
        sprintf(text, "label \"%s\", at %s", shape->text, ends[0]);
    else if (shape->kind == OCTREE_SHAPE_POINT)
        sprintf(text, "point %s", ends[0]);
    else
        sprintf(text, "%s %s to %s", octree_shape_name(shape->kind), ends[0], ends[1]);
}

/* One of the reference, or of the changed session, or of both. */
static void expect_shape(changed_session *t, const octree_shape *a, const octree_shape *b)
{
    const octree_shape *some = b ? b : a;
    char texts[2][256], when[32] = "every tick";
    const bool always = some->tick == OCTREE_EVERY_TICK;
    expect(t, "shapes",
           !a   ? CAUSE_MORE
           : !b ? CAUSE_LESS
                : CAUSE_OTHER,
           always ? CAUSE_NO_TICK : some->tick, CAUSE_NO_ID);
    if (a)
        shape_text(a, texts[0]);
    if (b)
        shape_text(b, texts[1]);
    if (!always)
        sprintf(when, "tick %" PRIu64, some->tick);
    if (a && b && b->kind == OCTREE_SHAPE_LABEL)
        sprintf(t->text, "another shape shown at %s (label \"%s\", was \"%s\", at ", when, b->text, a->text);
    else if (a && b)
        sprintf(t->text, "another shape shown at %s (%s, was %s); ", when, texts[1], strchr(texts[0], ' ') + 1);
    else
        sprintf(t->text, "one %sshape shown%s at %s (%s); ", b ? "more " : "", b ? "" : " fewer", when,
                texts[b ? 1 : 0]);
}

/* One more, or one fewer: the one is the other seen from its other side. */
bool change_number_of_shapes(changed_session *t, uint64_t tick, uint64_t *state)
{
    give_shapes(t, state);
    const size_t i = random_below(state, CHANGED_SHAPES);
    const bool more = random_below(state, 2) == 0;
    octree_session *shorter = more ? &t->made.session : &t->changed;
    octree_shape *shapes = t->shapes[more ? 0 : 1];
    const octree_shape *gone = &t->shapes[more ? 1 : 0][i];
    (void)tick;
    memmove(shapes + i, shapes + i + 1, (CHANGED_SHAPES - i - 1) * sizeof *shapes);
    shorter->shape_count--;
    expect_shape(t, more ? NULL : gone, more ? gone : NULL);
    return true;
}

bool change_shape(changed_session *t, uint64_t tick, uint64_t *state)
{
    give_shapes(t, state);
    octree_shape *shape = &t->shapes[1][random_below(state, CHANGED_SHAPES)];
    (void)tick;
    if (shape->kind == OCTREE_SHAPE_LABEL)
        strcat(shape->text, "!");
    else
        shape->at[random_below(state, 3)] -= 0.5;
    expect_shape(t, &t->shapes[0][shape - t->shapes[1]], shape);
    return true;
}

bool try_change(changed_session *t, uint64_t seed, session_change *change)
{
    uint64_t state = seed ^ 0x5eed;
    *t = (changed_session){.text = ""};
    random_session_mixed(&t->made, seed);
    t->changed = t->made.session;
    const uint64_t tick = 1 + random_below(&state, octree_session_length(&t->made.session));
    return change(t, tick, &state);
}
