/* SPDX-License-Identifier: MIT */
/* What a program's index answers, judged in a game: faults planted in a small index are found at their first tick, and
 * a right index is never accused. All coordinates are multiples of 1/8 whose differences are small, so that squares of
 * doubles are exact, and a linear scan knows the truth. */
#include "fixture.h"
#include "octree/game.h"

#include <stdlib.h>
#include <string.h>

#define MOST_POINTS 160
#define TICKS 30
#define QUERIES 8

typedef enum plant { RIGHT, BOUND, CHILD, ROUNDED, STRICT, SHORT, STALE, PLANTS } plant;

/* What moves, and the index that answers: points in eight cells about a middle, each with its bounds. */
typedef struct world_of_points {
    octree_box box;
    octree_game_body points[MOST_POINTS];
    size_t count;
    octree_point held[2 * MOST_POINTS];
    size_t held_count;
    plant planted;
    bool floats; /* the index holds floats */
} world_of_points;

/* ---- The index ---------------------------------------------------------------------------------------------- */

/* volatile: GCC 12 at -O3 leaves out one of three such roundings side by side. */
static double to_float(double x)
{
    const volatile float rounded = (float)x;
    return rounded;
}

static void position_held(const world_of_points *w, const double from[3], double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = w->floats || w->planted == ROUNDED ? to_float(from[i]) : from[i];
}

static void index_points(world_of_points *w)
{
    octree_point kept[MOST_POINTS];
    size_t stale = 0;
    for (size_t i = 0; w->planted == STALE && i < w->held_count && stale < MOST_POINTS; i++) {
        bool there = false;
        for (size_t j = 0; j < w->count; j++)
            there |= w->points[j].id == w->held[i].id;
        if (!there)
            kept[stale++] = w->held[i];
    }
    w->held_count = 0;
    for (size_t i = 0; i < w->count; i++) {
        octree_point *p = &w->held[w->held_count++];
        p->id = w->points[i].id;
        position_held(w, w->points[i].position, p->position);
    }
    memcpy(&w->held[w->held_count], kept, stale * sizeof *kept);
    w->held_count += stale;
}

static unsigned cell_of(const world_of_points *w, const double p[3])
{
    unsigned cell = 0;
    for (int i = 0; i < 3; i++)
        cell |= (p[i] >= (w->box.min[i] + w->box.max[i]) / 2 ? 1u : 0u) << i;
    return cell;
}

static double square(const double a[3], const double b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/* The bounds of a cell's points; BOUND has the upper ones too low by one step. */
static bool bounds_of(const world_of_points *w, unsigned cell, octree_box *bounds)
{
    bool any = false;
    for (size_t i = 0; i < w->held_count; i++) {
        const double *p = w->held[i].position;
        if (cell_of(w, p) != cell)
            continue;
        for (int axis = 0; axis < 3; axis++) {
            bounds->min[axis] = any && bounds->min[axis] < p[axis] ? bounds->min[axis] : p[axis];
            bounds->max[axis] = any && bounds->max[axis] > p[axis] ? bounds->max[axis] : p[axis];
        }
        any = true;
    }
    for (int axis = 0; any && w->planted == BOUND && axis < 3; axis++)
        bounds->max[axis] -= 1;
    return any && !(w->planted == CHILD && cell == 7);
}

/* Whether the cell can hold what is asked. */
static bool is_met(const world_of_points *w, unsigned cell, const octree_query *q)
{
    octree_box b;
    double sum = 0;
    if (!bounds_of(w, cell, &b))
        return false;
    bool meets = true;
    for (int i = 0; i < 3; i++) {
        const double below = b.min[i] - q->target[i], above = q->target[i] - b.max[i];
        const double gap = below > 0 ? below : above > 0 ? above : 0;
        sum += gap * gap;
        meets &= b.min[i] <= q->box.max[i] && b.max[i] >= q->box.min[i];
    }
    return q->kind == OCTREE_QUERY_RANGE ? meets : q->kind != OCTREE_QUERY_RADIUS || sum <= q->radius * q->radius;
}

static bool is_inside(const octree_query *q, const double p[3], bool strict)
{
    if (q->kind == OCTREE_QUERY_RADIUS) {
        const double s = square(p, q->target);
        return strict ? s < q->radius * q->radius : s <= q->radius * q->radius;
    }
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside &= p[i] >= q->box.min[i] && (strict ? p[i] < q->box.max[i] : p[i] <= q->box.max[i]);
    return inside;
}

typedef struct ranked {
    uint64_t id;
    double square;
} ranked;

static int compare_ranked(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    return p->square != q->square ? (p->square > q->square) - (p->square < q->square)
                                  : (p->id < q->id) - (p->id > q->id);
}

static bool is_near(octree_query_kind kind)
{
    return kind == OCTREE_QUERY_NEAREST || kind == OCTREE_QUERY_KNEAREST;
}

/* The query as the index has it: of one in floats, in floats. */
static octree_query held_query(const world_of_points *w, const octree_query *q)
{
    octree_query held = *q;
    position_held(w, q->target, held.target);
    position_held(w, q->box.min, held.box.min);
    position_held(w, q->box.max, held.box.max);
    held.k = q->kind == OCTREE_QUERY_NEAREST ? 1 : q->k;
    return held;
}

/* What the index answers; ties go to the highest id, unlike in the octree. */
static size_t ask_index(const world_of_points *w, const octree_query *asked, uint64_t ids[])
{
    const octree_query q = held_query(w, asked);
    ranked found[2 * MOST_POINTS];
    size_t count = 0;
    for (unsigned cell = 0; cell < 8; cell++)
        for (size_t i = 0; is_met(w, cell, &q) && i < w->held_count; i++) {
            const octree_point *p = &w->held[i];
            if (cell_of(w, p->position) == cell &&
                (is_near(q.kind) || is_inside(&q, p->position, w->planted == STRICT)))
                found[count++] = (ranked){p->id, is_near(q.kind) ? square(p->position, q.target) : 0};
        }
    qsort(found, count, sizeof *found, compare_ranked);
    const size_t k = w->planted == SHORT && q.k > 1 ? q.k - 1 : q.k;
    count = is_near(q.kind) && count > k ? k : count;
    for (size_t i = 0; i < count; i++)
        ids[i] = found[i].id;
    return count;
}

/* ---- The truth, by a linear scan ----------------------------------------------------------------------------- */

static size_t count_id(const uint64_t ids[], size_t count, uint64_t id)
{
    size_t times = 0;
    for (size_t i = 0; i < count; i++)
        times += ids[i] == id;
    return times;
}

/* Whether the squares of what is named, ascending, are the least k. */
static bool has_right_squares(const world_of_points *w, const octree_query *q, const uint64_t ids[], size_t count)
{
    ranked all[MOST_POINTS], named[MOST_POINTS];
    size_t found = 0;
    for (size_t i = 0; i < w->count; i++) {
        double p[3];
        position_held(w, w->points[i].position, p);
        all[i] = (ranked){w->points[i].id, square(p, q->target)};
        if (count_id(ids, count, all[i].id) == 1)
            named[found++] = all[i];
    }
    qsort(all, w->count, sizeof *all, compare_ranked);
    qsort(named, found, sizeof *named, compare_ranked);
    bool right = found == count && count == (q->k < w->count ? q->k : w->count);
    for (size_t i = 0; right && i < count; i++)
        right = all[i].square == named[i].square;
    return right;
}

static bool names_those_inside(const world_of_points *w, const octree_query *q, const uint64_t ids[], size_t count)
{
    size_t inside = 0;
    bool right = true;
    for (size_t i = 0; i < w->count; i++) {
        double p[3];
        position_held(w, w->points[i].position, p);
        const bool in = is_inside(q, p, false);
        right &= count_id(ids, count, w->points[i].id) == in;
        inside += in;
    }
    return right && inside == count;
}

static bool is_right(const world_of_points *of, octree_precision precision, const octree_query *asked,
                     const uint64_t ids[], size_t count)
{
    world_of_points w = *of;
    w.planted = RIGHT;
    w.floats = precision == OCTREE_FLOATS;
    const octree_query q = held_query(&w, asked);
    return is_near(q.kind) ? has_right_squares(&w, &q, ids, count) : names_those_inside(&w, &q, ids, count);
}

/* ---- Sessions ----------------------------------------------------------------------------------------------- */

typedef enum pattern { LATTICE, CLUSTERS, SURVEY, PATTERNS } pattern;

static void random_place(uint64_t *random, pattern pattern, const octree_box *box, double at[3])
{
    for (int i = 0; i < 3; i++) {
        if (pattern == LATTICE)
            at[i] = box->min[i] + (double)random_below(random, 9);
        else if (pattern == CLUSTERS)
            at[i] = box->min[i] + 4 * (double)random_below(random, 2) + (double)random_below(random, 8) / 8;
        else
            at[i] = box->min[i] + (double)random_below(random, 65) / 8;
    }
}

static octree_box box_of(pattern pattern)
{
    static const double survey[3] = {500000, 4649776, 120}; /* UTM, zone 32 */
    octree_box box = cube(0, 8);
    for (int i = 0; pattern == SURVEY && i < 3; i++) {
        box.min[i] = survey[i];
        box.max[i] = survey[i] + 8;
    }
    return box;
}

static octree_query random_query(uint64_t *random, pattern pattern, const octree_box *box)
{
    /* rays have their own test, test_game_rays */
    octree_query q = {.kind = (octree_query_kind)random_below(random, OCTREE_QUERY_RAY), .answered = true};
    random_place(random, pattern, box, q.target);
    random_place(random, pattern, box, q.box.min);
    for (int i = 0; i < 3; i++)
        q.box.max[i] = q.box.min[i] + (double)random_below(random, 5);
    q.k = random_below(random, 12);
    q.radius = (double)random_below(random, 5);
    return q;
}

/* Edits of a tick, made to the points too. */
static size_t random_edits(uint64_t *random, pattern pattern, world_of_points *w, uint64_t *next_id,
                           octree_edit edits[4])
{
    const size_t count = random_below(random, 5);
    for (size_t i = 0; i < count; i++) {
        octree_edit *e = &edits[i];
        *e = (octree_edit){.kind = (octree_edit_kind)random_below(random, 3)};
        const size_t at = w->count ? random_below(random, w->count) : 0;
        if (w->count == 0 || w->count == MOST_POINTS)
            e->kind = w->count ? OCTREE_EDIT_REMOVE : OCTREE_EDIT_INSERT;
        random_place(random, pattern, &w->box, e->body.position);
        e->body.id = e->kind == OCTREE_EDIT_INSERT ? ++*next_id : w->points[at].id;
        if (e->kind == OCTREE_EDIT_INSERT)
            w->points[w->count++] = e->body;
        else if (e->kind == OCTREE_EDIT_MOVE)
            w->points[at] = e->body;
        else
            w->points[at] = w->points[--w->count];
    }
    return count;
}

/* A tick's input, and the arrays that it borrows. */
typedef struct made_tick {
    octree_edit edits[MOST_POINTS];
    octree_query queries[QUERIES];
    uint64_t ids[QUERIES][2 * MOST_POINTS];
    bool wrong[QUERIES]; /* by the linear scan */
    octree_input input;
} made_tick;

static void answer_queries(made_tick *t, const world_of_points *w, pattern pattern, octree_precision precision,
                           uint64_t *random)
{
    for (int i = 0; i < QUERIES; i++) {
        octree_query *q = &t->queries[i];
        *q = random_query(random, pattern, &w->box);
        q->answer = t->ids[i];
        q->answer_count = ask_index(w, q, t->ids[i]);
        q->precision = precision;
        t->wrong[i] = !is_right(w, precision, q, t->ids[i], q->answer_count);
    }
    t->input.queries = t->queries;
    t->input.query_count = QUERIES;
}

/* Whether any answer of the tick is wrong; the judgements are what the scan says. */
static bool assert_judged(const made_tick *made, const octree_tick *tick)
{
    bool any = false;
    assert_int_equal(tick->answer_count, QUERIES);
    for (int i = 0; i < QUERIES; i++) {
        const octree_judgement *j = &tick->answers[i].judgement;
        assert_true(j->judged && j->given_count == made->queries[i].answer_count);
        assert_int_equal(j->wrong != OCTREE_WRONG_NONE, made->wrong[i]);
        assert_true(made->wrong[i] || (j->missing_count == 0 && j->extra_count == 0 && j->rank == 0));
        assert_true(made->wrong[i] || !is_near(made->queries[i].kind) || j->ratio == 1);
        any |= made->wrong[i];
    }
    assert_int_equal((tick->events & OCTREE_EVENT_WRONG) != 0, any);
    return any;
}

static size_t insert_first(uint64_t *random, pattern pattern, world_of_points *w, uint64_t *next_id,
                           octree_edit edits[])
{
    for (size_t i = 0; i < 80; i++) {
        edits[i] = (octree_edit){.kind = OCTREE_EDIT_INSERT, .body.id = ++*next_id};
        random_place(random, pattern, &w->box, edits[i].body.position);
        w->points[w->count++] = edits[i].body;
    }
    return 80;
}

/* Play a session whose every judgement is held against the linear scan. Ticks with wrong answers. */
static size_t play(uint64_t seed, pattern pattern, plant planted, bool floats, octree_precision precision)
{
    uint64_t random = seed, next_id = 0;
    size_t wrong_ticks = 0;
    world_of_points *w = calloc(1, sizeof *w);
    made_tick *t = malloc(sizeof *t);
    assert_true(w && t);
    *w = (world_of_points){.box = box_of(pattern), .planted = planted, .floats = floats};
    const octree_session session = {.tree = define(w->box, 3, 6, OCTREE_GROW), .player.kind = OCTREE_PLAYER_NONE};
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    for (int tick = 0; tick < TICKS; tick++) {
        t->input = (octree_input){.edits = t->edits};
        t->input.edit_count = tick == 0 ? insert_first(&random, pattern, w, &next_id, t->edits)
                                        : random_edits(&random, pattern, w, &next_id, t->edits);
        index_points(w);
        answer_queries(t, w, pattern, precision, &random);
        assert_int_equal(octree_game_play(game, &t->input), OCTREE_OK);
        wrong_ticks += assert_judged(t, octree_game_tick(game));
    }
    octree_game_destroy(game);
    free(t);
    free(w);
    return wrong_ticks;
}

static void a_right_index_is_never_accused(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++)
        for (int pattern = 0; pattern < PATTERNS; pattern++)
            assert_int_equal(play(seed, (enum pattern)pattern, RIGHT, false, OCTREE_DOUBLES), 0);
}

static void an_index_of_floats_is_right_for_floats_alone(void **state)
{
    (void)state;
    size_t wrong = 0;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        assert_int_equal(play(seed, SURVEY, RIGHT, true, OCTREE_FLOATS), 0);
        wrong += play(seed, SURVEY, RIGHT, true, OCTREE_DOUBLES);
    }
    assert_true(wrong > 0);
}

static void every_planted_fault_is_found_in_the_ticks_that_show_it(void **state)
{
    (void)state;
    for (int planted = RIGHT + 1; planted < PLANTS; planted++) {
        const pattern pattern = planted == ROUNDED ? SURVEY : LATTICE;
        size_t wrong = 0;
        for (uint64_t seed = 1; seed <= 5; seed++)
            wrong += play(seed, pattern, (plant)planted, false, OCTREE_DOUBLES);
        assert_true(wrong > 5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_right_index_is_never_accused),
        cmocka_unit_test(an_index_of_floats_is_right_for_floats_alone),
        cmocka_unit_test(every_planted_fault_is_found_in_the_ticks_that_show_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
