/* SPDX-License-Identifier: MIT */
/* knob_breaks.c - where indexes break: each index under each stress, with the smallest example of a wrong answer.
 *
 * A scene of this chapter is "stress / query", a variant is an index. Each cell runs in a process of its own. When an
 * answer is wrong, points are removed while it stays wrong; what remains becomes a session that plays. */
#include <math.h>
#include <string.h>

#include "apart.h"
#include "index.h"
#include "answer_error.h"
#include "knob.h"
#include "octree/octree.h"
#include "program.h"
#include "session_file.h"
#include "stress.h"

enum { RIGHT, WRONG, REFUSED, HUNG, CRASHED, OPEN, TRIALS_MOST = 400, EXAMPLE_MOST = 16 };

static const column columns[] = {
    {"verdict", "0 right, 1 wrong, 2 refused, 3 hung, 4 crashed, 5 right if regions are open", NULL},
    {"excess", "neighbours: the largest distance found / the true one, - 1", NULL},
    {"missing", "points, or ranks of neighbours, that are wrong or missing in all answers", NULL},
    {"extra", "points that are in no right answer, or occur twice", NULL},
    {"example", "points of the smallest example that was found, at most 16; 0: none", NULL},
    {"broken", "1: the index answered wrongly, hung or crashed", "bound_broken"},
    {"bound_broken", "proven for Octreel", NULL},
};

static const chart charts[] = {{.title = "What each index does", .matrix = true, .by_variant = true}};

/* The outcome of one cell, or of one trial with fewer points. */
typedef struct outcome {
    int verdict;
    double excess;
    size_t missing, extra;
    size_t first_wrong; /* the number of the first query whose answer is wrong */
} outcome;

typedef struct cell {
    const stress *stress;
    const spatial_index *index;
    stress_set set;
    apart_answer answers[STRESS_QUERIES];
} cell;

static void add_error(outcome *o, const answer_error *e, size_t query)
{
    const bool open = e->boundary && e->extra == 0 && e->unknown == 0;
    if (!is_right(e) && (o->verdict == RIGHT || (o->verdict == OPEN && !open))) {
        o->verdict = open ? OPEN : WRONG;
        o->first_wrong = query;
    }
    o->excess = fmax(o->excess, e->ratio - 1);
    o->missing += e->missing;
    o->extra += e->extra + e->unknown;
}

/* Ask `count` queries about the cell's points. */
static outcome ask(cell *c, const octree_query *queries, size_t count)
{
    static const int verdicts[] = {
        [APART_ANSWERED] = RIGHT, [APART_REFUSED] = REFUSED, [APART_HUNG] = HUNG, [APART_CRASHED] = CRASHED};
    const apart_question question = {c->set.world, c->set.count, count, c->stress->flush};
    const apart_result result =
        ask_apart(c->stress->program, c->index->name, &question, c->set.points, queries, c->answers);
    outcome o = {.verdict = verdicts[result]};
    for (size_t i = 0; result == APART_ANSWERED && i < count; i++) {
        const apart_answer *a = &c->answers[i];
        const answer_error e = find_answer_error(&queries[i], c->set.points, c->set.count, a->ids,
                                                 a->count < APART_IDS ? a->count : APART_IDS, NULL);
        add_error(&o, &e, i);
    }
    return o;
}

/* ---- The smallest example ----------------------------------------------------------------------------------- */

/* Remove points[first .. first + count - 1]. The ids stay places. */
static void remove_points(stress_set *set, size_t first, size_t count)
{
    memmove(&set->points[first], &set->points[first + count], (set->count - first - count) * sizeof *set->points);
    set->count -= count;
    for (size_t i = 0; i < set->count; i++)
        set->points[i].id = i;
}

/* Remove points, at first many at once, as long as the answer to the query stays wrong. */
static void shrink(cell *c, const octree_query *query)
{
    int trials = 0;
    for (size_t size = c->set.count / 2; size > 0; size /= 2)
        for (size_t first = 0; first + size <= c->set.count && trials < TRIALS_MOST;) {
            const stress_set before = c->set;
            remove_points(&c->set, first, size);
            trials++;
            if (c->set.count > 0 && ask(c, query, 1).verdict == WRONG)
                continue;
            c->set = before;
            first += size;
        }
}

/* Append a line to the notes: the cell's session in JSON, with the wrong answer. */
static void note_example(table *t, cell *c, const char *scene, octree_query query)
{
    octree_game_body bodies[STRESS_POINTS] = {{.id = 0}};
    octree_session session = {.tree = octree_def_default(), .bodies = bodies, .body_count = c->set.count, .ticks = 1};
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        stop_with_error("out of memory");
    for (size_t i = 0; i < c->set.count; i++) {
        bodies[i].id = i;
        memcpy(bodies[i].position, c->set.points[i].position, sizeof bodies[i].position);
    }
    session.tree.world = c->set.world;
    session.tree.leaf_capacity = 4;
    session.tree.full_leaf = OCTREE_GROW;
    session.player.kind = OCTREE_PLAYER_NONE;
    query.tick = 1;
    query.answered = true;
    query.answer = c->answers[0].ids;
    query.answer_count = c->answers[0].count < APART_IDS ? c->answers[0].count : APART_IDS;
    session.queries = &query;
    session.query_count = 1;
    if (!session_write(&session, NULL, out) || fclose(out) != 0)
        stop_with_error("out of memory");
    table_note(t, scene, c->index->name, text);
    free(text);
}

/* Returns the number of points of the example; 0 if there is none. */
static size_t find_example(table *t, cell *c, const char *scene, const outcome *o)
{
    if (o->verdict != WRONG || !c->set.finite || c->stress->program != APART_PLAIN)
        return 0;
    const octree_query query = c->set.queries[o->first_wrong];
    shrink(c, &query);
    if (c->set.count > EXAMPLE_MOST)
        return 0;
    ask(c, &query, 1); /* for the answer */
    note_example(t, c, scene, query);
    return c->set.count;
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

static void measure_cell(const run *r, table *t, const stress *s, octree_query_kind kind, const spatial_index *index)
{
    static cell c;
    char scene[TABLE_NAME];
    c.stress = s;
    c.index = index;
    stress_make(s, kind, &c.set);
    snprintf(scene, sizeof scene, "%s / %s", s->name, octree_query_name(kind));
    const outcome o = ask(&c, c.set.queries, STRESS_QUERIES);
    const double broken = o.verdict == WRONG || o.verdict == HUNG || o.verdict == CRASHED;
    const double example = r->quick ? 0 : (double)find_example(t, &c, scene, &o);
    table_add(t, scene, index->name,
              (double[]){o.verdict, o.excess, (double)o.missing, (double)o.extra, example, broken,
                         index == &index_octreel ? 0 : NAN});
}

static void measure(const run *r, table *t)
{
    for (size_t i = 0; i < stress_count; i++)
        for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++)
            for (size_t j = 0; all_indexes[j]; j++)
                if (all_indexes[j]->kinds >> kind & 1)
                    measure_cell(r, t, &stresses[i], (octree_query_kind)kind, all_indexes[j]);
}

/* ---- In a sentence ------------------------------------------------------------------------------------------ */

static size_t count_verdict(const table *t, const char *variant, int verdict)
{
    return table_count(t, (pick){.variant = variant, .setting = verdict});
}

static void tell(const table *t, FILE *out)
{
    const size_t octreel = table_count(t, (pick){.variant = "octreel", .setting = NAN});
    const size_t right = count_verdict(t, "octreel", RIGHT), refused = count_verdict(t, "octreel", REFUSED);
    const size_t others = t->count - octreel, wrong = octreel - right - refused;
    fprintf(
        out,
        "Octreel and %zu other libraries ran the same %zu tests with difficult points, such as coordinates of 1e300 or "
        "NaN. Octreel is right in %zu, refuses %zu (points that are not finite), and is wrong in %zu. The others are "
        "right in %zu of %zu.",
        octreel ? others / octreel : 0, octreel, right, refused, wrong, count_verdict(t, NULL, RIGHT) - right, others);
}

static void defend(const table *t, FILE *out)
{
    fprintf(
        out,
        "Right is what real numbers say about the points as they are. An index in floats holds other points; %zu of "
        "its %zu combinations are right.",
        count_verdict(t, "nanoflann-float", RIGHT),
        table_count(t, (pick){.variant = "nanoflann-float", .setting = NAN}));
}

const knob knob_breaks = {
    .name = "breaks",
    .title = "Where it breaks: indexes under stress",
    .trades = "The choice of a library, and of compiler options, for extreme points.",
    .preset = "each library with its defaults",
    .proven = "Octreel: every answer is right, or the points are refused.",
    .truth = "All points, compared by real numbers (GMP). Points at equal distances are equally right; regions are "
             "closed. Points that are not finite belong to no right answer. Each cell has 24 queries about 200 points.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
