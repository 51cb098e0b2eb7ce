/* SPDX-License-Identifier: MIT */
/* peer_campaign.c - octree-peer-campaign: is the judge of other people's answers right? Indexes of other libraries, as
 * they come and with planted faults, answer random queries in games that judge them; each verdict is held against the
 * truth. */
#include "faulty_index.h"
#include "octree/octree.h"
#include "point_sets.h"
#include "program.h"
#include "truth.h"

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char program_name[] = "octree-peer-campaign";

enum { TICKS = 20, QUERIES = 10, ALL_IDS = TRUTH_POINTS };

/* An index computes with rounded numbers. Its promise: distances of neighbours within this ratio, and radii within this
 * share; for floats, in floats. */
#define FLOAT_RATIO 4e-7
#define FLOAT_REACH 2e-6
#define DOUBLE_RATIO 2e-15
#define DOUBLE_REACH 2e-15

static const char *const fault_names[PLANTED_FAULTS] = {
#define PLANTED_FAULT_NAME(name, word, meaning) word,
    PLANTED_FAULT_MAP(PLANTED_FAULT_NAME)
#undef PLANTED_FAULT_NAME
};

/* What came of trials. */
typedef struct tally {
    uint64_t answers, wrong, open; /* by the truth */
    uint64_t trials, bitten;       /* trials in which an answer was wrong */
    uint64_t first_ticks;          /* the sum of the first ticks in which one was */
} tally;

/* A game with an index beside it. */
typedef struct trial {
    const spatial_index *peer;
    planted_fault fault;
    const point_set *set;
    uint64_t seed, random;
    octree_point points[POINT_SET_MOST];
    size_t count;
    octree_session session; /* which the game borrows, with its bodies */
    octree_game_body bodies[POINT_SET_MOST];
    octree_game *game;
    faulty_index *index, *sound; /* with the fault, and without, which answers before the fault begins */
    uint64_t begins;             /* the tick in which it does */
    octree_edit edits[POINT_SET_MOST];
    octree_query queries[QUERIES];
    uint64_t ids[QUERIES][ALL_IDS];
} trial;

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* Some points move, one of them perhaps twice. */
static size_t move_points(trial *t)
{
    const size_t moves = 1 + t->count / 8;
    for (size_t i = 0; i < moves; i++) {
        octree_point *point = &t->points[octree_random(&t->random) % t->count];
        t->set->place(&t->random, point->position);
        t->edits[i] = (octree_edit){.kind = OCTREE_EDIT_MOVE, .body.id = point->id};
        memcpy(t->edits[i].body.position, point->position, sizeof point->position);
    }
    faulty_index_update(t->index, t->points);
    faulty_index_update(t->sound, t->points);
    return moves;
}

static void ask(trial *t, const faulty_index *index, octree_query *query, uint64_t *ids)
{
    const bool floats = t->peer->precision == OCTREE_FLOATS;
    octree_query_kind kind;
    do
        kind = (octree_query_kind)(octree_random(&t->random) % OCTREE_QUERY_KINDS);
    while (!(t->peer->kinds >> kind & 1));
    *query = point_set_ask(t->set, &t->random, kind, t->points, t->count);
    query->answer_count = faulty_index_ask(index, query, ids);
    query->answer = ids;
    query->answered = true;
    query->precision = t->peer->precision;
    if (octree_query_about(kind)->neighbors)
        query->epsilon = floats ? FLOAT_RATIO : DOUBLE_RATIO;
    if (kind == OCTREE_QUERY_RADIUS)
        query->epsilon = (floats ? FLOAT_REACH : DOUBLE_REACH) * query->radius;
}

static _Noreturn void accuse(const trial *t, uint64_t tick, size_t number, const char *what)
{
    const octree_query *q = &t->queries[number];
    const octree_judgement *made = &octree_game_tick(t->game)->answers[number].judgement;
    printf("%s: peer %s, fault %s, set %s, trial %" PRIu64 ", tick %" PRIu64 ", query %zu:\n  %s k %zu radius %.17g at "
           "[%.17g, %.17g, %.17g], box [%.17g, %.17g, %.17g] to [%.17g, %.17g, %.17g], of %zu points; %zu named\n  "
           "judged: %s, %zu missed, %zu extra, rank %zu, ratio %.17g\n",
           what, t->peer->name, fault_names[t->fault], t->set->name, t->seed, tick, number, octree_query_name(q->kind),
           q->k, q->radius, q->target[0], q->target[1], q->target[2], q->box.min[0], q->box.min[1], q->box.min[2],
           q->box.max[0], q->box.max[1], q->box.max[2], t->count, q->answer_count, octree_wrong_name(made->wrong),
           made->missing_count, made->extra_count, made->rank, made->ratio);
    exit_with_status(EXIT_FINDING);
}

/* Whether an answer of the tick is wrong; the tick must have the event then, and not else. */
static bool compare(const trial *t, uint64_t tick, tally *sum)
{
    const octree_tick *played = octree_game_tick(t->game);
    bool any = false, open = false;
    for (size_t i = 0; i < QUERIES; i++) {
        const truth right = truth_of(&t->queries[i], t->points, t->count);
        const bool accused = played->answers[i].judgement.wrong != OCTREE_WRONG_NONE;
        sum->answers++;
        sum->wrong += right == TRUTH_WRONG;
        sum->open += right == TRUTH_OPEN;
        any |= right == TRUTH_WRONG;
        open |= right == TRUTH_OPEN;
        if (right != TRUTH_OPEN && accused != (right == TRUTH_WRONG))
            accuse(t, tick, i, accused ? "a right answer is accused" : "a wrong answer is not found");
    }
    if (!open && any != ((played->events & OCTREE_EVENT_WRONG) != 0))
        accuse(t, tick, 0, "the tick's event is not that of its answers");
    return any;
}

/* ---- A trial ------------------------------------------------------------------------------------------------ */

static void begin(trial *t)
{
    octree_session *session = &t->session;
    *session = (octree_session){.tree = octree_def_default(), .player.kind = OCTREE_PLAYER_NONE, .bodies = t->bodies};
    t->random = t->seed;
    session->body_count = t->count = point_set_fill(t->set, &t->random, t->points);
    session->tree.world = t->set->world;
    session->tree.leaf_capacity = 4;
    session->tree.full_leaf = OCTREE_GROW;
    for (size_t i = 0; i < t->count; i++) {
        t->bodies[i].id = t->points[i].id;
        memcpy(t->bodies[i].position, t->points[i].position, sizeof t->bodies[i].position);
    }
    if (octree_game_create(session, &t->game) != OCTREE_OK)
        stop_with_error("a game of the set %s cannot be made", t->set->name);
    t->index = faulty_index_create(t->peer, t->fault, t->points, t->count, &t->set->world);
    t->sound = faulty_index_create(t->peer, PLANTED_NONE, t->points, t->count, &t->set->world);
    t->begins = octree_random(&t->random) % (TICKS / 2);
}

static void end(trial *t)
{
    octree_game_destroy(t->game);
    faulty_index_destroy(t->index);
    faulty_index_destroy(t->sound);
}

/* Of a planted fault, until it has bitten. */
static void run(trial *t, tally *sum)
{
    begin(t);
    sum->trials++;
    for (uint64_t tick = 1; tick <= TICKS; tick++) {
        octree_input input = {.edits = t->edits, .queries = t->queries, .query_count = QUERIES};
        input.edit_count = move_points(t);
        for (size_t i = 0; i < QUERIES; i++)
            ask(t, tick < t->begins ? t->sound : t->index, &t->queries[i], t->ids[i]);
        if (octree_game_play(t->game, &input) != OCTREE_OK)
            stop_with_error("a tick of the set %s cannot be played", t->set->name);
        if (!compare(t, tick, sum) || tick < t->begins || t->fault == PLANTED_NONE)
            continue;
        sum->bitten++;
        sum->first_ticks += tick;
        break;
    }
    end(t);
}

/* Sets that are too wide for the squares of floats are none for who computes in them. */
static bool fits(const spatial_index *peer, const point_set *set)
{
    return peer->precision == OCTREE_DOUBLES || set->in_floats;
}

/* One trial on each set. */
static void run_sets(trial *t, tally *sum)
{
    for (int i = 0; i < POINT_SETS; i++) {
        t->set = &point_sets[i];
        if (fits(t->peer, t->set))
            run(t, sum);
    }
}

/* ---- The campaign ------------------------------------------------------------------------------------------- */

typedef struct options {
    uint64_t answers, seed, rounds;
} options;

static void print_help(void)
{
    puts("octree-peer-campaign - is the judge of other people's answers right? Octreel and the libraries that were\n"
         "found answer random queries about points that move, in games that judge the answers; each verdict is held\n"
         "against the truth, found by looking at every point with real numbers. Then faults are planted in the "
         "indexes,\n"
         "one at a time and from some tick on: each is to be found in the first tick in which it makes an answer "
         "wrong.\n\n"
         "usage: octree-peer-campaign [OPTION ...]\n\n"
         "      --answers N   check at least N answers of indexes as they come (default 1e6)\n"
         "      --rounds N    trials of each fault on each set (default 20)\n"
         "      --seed S      a whole number (default 1); each gives a different campaign\n"
         "  -h, --help\n\n"
         "The sets:");
    for (int i = 0; i < POINT_SETS; i++)
        printf("      %-8s %s%s\n", point_sets[i].name, point_sets[i].about,
               point_sets[i].in_floats ? "" : "; only in double precision");
    puts("The faults:");
#define PLANTED_FAULT_HELP(name, word, meaning) printf("      %-8s %s\n", word, meaning);
    PLANTED_FAULT_MAP(PLANTED_FAULT_HELP)
#undef PLANTED_FAULT_HELP
    puts("Exit status: 0 every verdict is right, 1 one is not, 2 trouble.");
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {{"answers", required_argument, NULL, 'a'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"seed", required_argument, NULL, 's'},
                                          {"help", no_argument, NULL, 'h'},
                                          {NULL, 0, NULL, 0}};
    options o = {.answers = 1000000, .seed = 1, .rounds = 20};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;)
        if (name == 'a')
            o.answers = (uint64_t)parse_whole_number("--answers", optarg, 1, 1e12);
        else if (name == 'r')
            o.rounds = (uint64_t)parse_whole_number("--rounds", optarg, 1, 1e6);
        else if (name == 's')
            o.seed = (uint64_t)parse_whole_number("--seed", optarg, 0, 1e15);
        else if (name == 'h') {
            print_help();
            exit_with_status(EXIT_DONE);
        } else
            exit(EXIT_TROUBLE); /* getopt has said why */
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    return o;
}

/* The number of indexes. */
static size_t count_peers(void)
{
    size_t count = 0;
    while (all_indexes[count])
        count++;
    return count;
}

/* Indexes as their libraries come. They are wrong where numbers are extreme, and where a ball of theirs is open. */
static void judge_libraries(trial *t, const options *o)
{
    const size_t peers = count_peers();
    tally *sums = calloc(peers, sizeof *sums);
    uint64_t answers = 0;
    if (!sums)
        stop_with_error("out of memory");
    while (answers < o->answers) {
        answers = 0;
        t->seed++;
        for (size_t i = 0; i < peers; i++) {
            t->peer = all_indexes[i];
            run_sets(t, &sums[i]);
            answers += sums[i].answers;
        }
    }
    for (size_t i = 0; i < peers; i++)
        printf("%-16s %9" PRIu64 " answers, %9" PRIu64 " wrong and accused, %" PRIu64 " at the edge of the promise\n",
               all_indexes[i]->name, sums[i].answers, sums[i].wrong, sums[i].open);
    printf("%" PRIu64 " answers of indexes as they come: every verdict is right\n\n", answers);
    free(sums);
}

/* Whether a fault can make an answer of the index wrong. */
static bool can_have(const spatial_index *peer, planted_fault fault)
{
    const unsigned regions = 1u << OCTREE_QUERY_RANGE | 1u << OCTREE_QUERY_RADIUS;
    return fault == PLANTED_ROUNDED  ? peer->precision == OCTREE_DOUBLES
           : fault == PLANTED_STRICT ? (peer->kinds & regions) != 0
           : fault == PLANTED_FEWER  ? (peer->kinds >> OCTREE_QUERY_KNEAREST & 1) != 0
                                     : true;
}

static void judge_fault(trial *t, const options *o)
{
    tally sum = {0};
    for (uint64_t round = 0; round < o->rounds; round++) {
        t->seed++;
        run_sets(t, &sum);
    }
    if (sum.bitten == 0)
        stop_with_error("peer %s: the fault %s makes no answer wrong", t->peer->name, fault_names[t->fault]);
    printf("%-16s %-8s %5" PRIu64 " of %5" PRIu64
           " trials had a wrong answer, the first in tick %4.1f; all were found in "
           "it\n",
           t->peer->name, fault_names[t->fault], sum.bitten, sum.trials, (double)sum.first_ticks / (double)sum.bitten);
}

int main(int argc, char **argv)
{
    static trial t;
    const options o = read_options(argc, argv);
    t.seed = o.seed << 32;
    judge_libraries(&t, &o);
    for (size_t i = 0; all_indexes[i]; i++)
        for (int fault = PLANTED_NONE + 1; fault < PLANTED_FAULTS; fault++) {
            t.peer = all_indexes[i];
            t.fault = (planted_fault)fault;
            if (can_have(t.peer, t.fault))
                judge_fault(&t, &o);
        }
    exit_with_status(EXIT_DONE);
}
