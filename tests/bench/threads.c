/* SPDX-License-Identifier: MIT */
/* threads.c - times the bulk operations of the octree with several threads.
 *
 * Problem: on a shared machine the clock also measures the neighbours' work, so a ratio of two times says little about
 * the tree.
 *
 * Idea: an executor of threads that measures itself. For each run of tasks it adds up the processor time that the
 * busiest thread took: that is the time which more threads could not have saved. The critical path is this sum and the
 * processor time of the calling thread outside of the runs, which is the serial part. Without other load on the
 * machine, the time by the clock is the critical path and the time that threads take to wake up.
 */
#include "threads.h"
#include "measuring.h"
#include "program.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double read_clock(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

/* ---- The executor ------------------------------------------------------------------------------------------- */

/* A pool of threads that wait for work. The calling thread works, too. */
typedef struct team {
    pthread_mutex_t lock;
    pthread_cond_t work_begins, work_ends;
    pthread_t threads[BENCH_THREADS_AT_MOST];
    unsigned count; /* threads, without the calling thread */
    unsigned busy;  /* threads that have not finished the current run */
    size_t run;     /* the number of the current run */
    bool stops;
    octree_task *task;
    void *task_context;
    size_t task_count;
    atomic_size_t next;
    double longest;           /* processor time of the busiest thread in the current run */
    double in_runs, critical; /* sums over runs: the calling thread's time, and the busiest thread's time */
} team;

/* Take tasks until none is left. Returns the processor time of the calling thread for them. */
static double take_tasks(team *t)
{
    const double start = read_clock(CLOCK_THREAD_CPUTIME_ID);
    for (size_t i; (i = atomic_fetch_add(&t->next, 1)) < t->task_count;)
        t->task(i, t->task_context);
    return read_clock(CLOCK_THREAD_CPUTIME_ID) - start;
}

static void *run_member(void *context)
{
    team *t = context;
    pthread_mutex_lock(&t->lock);
    for (size_t seen = 0;; seen = t->run) {
        while (t->run == seen && !t->stops)
            pthread_cond_wait(&t->work_begins, &t->lock);
        if (t->stops)
            break;
        pthread_mutex_unlock(&t->lock);
        const double took = take_tasks(t);
        pthread_mutex_lock(&t->lock);
        t->longest = fmax(t->longest, took);
        if (--t->busy == 0)
            pthread_cond_signal(&t->work_ends);
    }
    pthread_mutex_unlock(&t->lock);
    return NULL;
}

static void run_by_team(octree_task *task, size_t count, void *task_context, void *context)
{
    team *t = context;
    pthread_mutex_lock(&t->lock);
    t->task = task;
    t->task_context = task_context;
    t->task_count = count;
    atomic_store(&t->next, 0);
    t->longest = 0;
    t->busy = t->count;
    t->run++;
    pthread_cond_broadcast(&t->work_begins);
    pthread_mutex_unlock(&t->lock);
    const double own = take_tasks(t);
    pthread_mutex_lock(&t->lock);
    while (t->busy > 0)
        pthread_cond_wait(&t->work_ends, &t->lock);
    t->in_runs += own;
    t->critical += fmax(own, t->longest);
    pthread_mutex_unlock(&t->lock);
}

static void team_end(team *t)
{
    pthread_mutex_lock(&t->lock);
    t->stops = true;
    pthread_cond_broadcast(&t->work_begins);
    pthread_mutex_unlock(&t->lock);
    for (unsigned i = 0; i < t->count; i++)
        pthread_join(t->threads[i], NULL);
    pthread_cond_destroy(&t->work_begins);
    pthread_cond_destroy(&t->work_ends);
    pthread_mutex_destroy(&t->lock);
}

static bool team_begin(team *t, unsigned threads)
{
    *t = (team){.count = 0};
    pthread_mutex_init(&t->lock, NULL);
    pthread_cond_init(&t->work_begins, NULL);
    pthread_cond_init(&t->work_ends, NULL);
    while (t->count + 1 < threads && pthread_create(&t->threads[t->count], NULL, run_member, t) == 0)
        t->count++;
    if (t->count + 1 == threads)
        return true;
    team_end(t);
    return false;
}

/* ---- The operations ----------------------------------------------------------------------------------------- */

enum { BUILD, MOVE_ALL, REPLACE_ALL, NEAREST_ALL, BULK_OPS };

static const char *const bulk_names[BULK_OPS] = {"build", "move_all", "replace_all", "nearest_all"};

/* A tree whose points all move by one mean spacing in a tick of a game, and move back in the next tick. */
typedef struct game {
    const workload *w;
    octree *tree;
    team team;
    octree_point *ends[2];  /* all points before and after a tick */
    double (*places[2])[3]; /* their positions */
    octree_neighbor *neighbors;
    bool *found;
    bool moved; /* true: the tree holds ends[1] */
} game;

static bool run_bulk_op(game *g, int op)
{
    const workload *w = g->w;
    size_t done = w->count;
    octree_status status = OCTREE_OK;
    if (op == MOVE_ALL || op == REPLACE_ALL)
        g->moved = !g->moved;
    if (op == BUILD)
        status = octree_insert_many(g->tree, g->ends[g->moved], w->count, NULL, &done);
    else if (op == MOVE_ALL)
        status = octree_move_many(g->tree, g->ends[!g->moved], (const double(*)[3])g->places[g->moved], w->count, NULL,
                                  &done);
    else if (op == REPLACE_ALL)
        status = octree_replace_all(g->tree, g->ends[g->moved], w->count, NULL, &done);
    else
        status = octree_nearest_batch(g->tree, (const double(*)[3])g->places[!g->moved], w->count, NULL, g->neighbors,
                                      g->found);
    return status == OCTREE_OK && done == w->count;
}

static bool game_begin(game *g, const workload *w, unsigned threads)
{
    uint64_t random = 2;
    *g = (game){.w = w};
    for (int end = 0; end < 2; end++) {
        g->ends[end] = malloc(w->count * sizeof *g->ends[end]);
        g->places[end] = malloc(w->count * sizeof *g->places[end]);
    }
    g->neighbors = malloc(w->count * sizeof *g->neighbors);
    g->found = malloc(w->count * sizeof *g->found);
    if (!g->ends[0] || !g->ends[1] || !g->places[0] || !g->places[1] || !g->neighbors || !g->found)
        return false;
    for (size_t i = 0; i < w->count; i++) {
        g->ends[0][i] = w->points[i];
        g->ends[1][i] = workload_step(w, &w->points[i], &random);
        for (int end = 0; end < 2; end++)
            memcpy(g->places[end][i], g->ends[end][i].position, sizeof g->places[end][i]);
    }
    octree_def def = octree_def_default();
    def.world = w->world;
    if (threads > 1 && !team_begin(&g->team, threads))
        return false;
    if (threads > 1)
        def.executor = (octree_executor){run_by_team, &g->team};
    return octree_create(&def, &g->tree) == OCTREE_OK;
}

static void game_end(game *g)
{
    octree_destroy(g->tree);
    if (g->team.count > 0)
        team_end(&g->team);
    for (int end = 0; end < 2; end++) {
        free(g->ends[end]);
        free(g->places[end]);
    }
    free(g->neighbors);
    free(g->found);
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

/* The times of an operation in nanoseconds: by the clock, of the serial part, and of the critical path. */
typedef struct bulk_time {
    double clock, serial, critical;
} bulk_time;

static bool time_bulk_op(game *g, int op, bulk_time *time)
{
    if (op == BUILD)
        octree_clear(g->tree);
    g->team.in_runs = g->team.critical = 0;
    const double clock = read_clock(CLOCK_MONOTONIC), own = read_clock(CLOCK_THREAD_CPUTIME_ID);
    const bool ok = run_bulk_op(g, op);
    time->clock = read_clock(CLOCK_MONOTONIC) - clock;
    time->serial = read_clock(CLOCK_THREAD_CPUTIME_ID) - own - g->team.in_runs;
    time->critical = time->serial + g->team.critical;
    return ok;
}

/* Store the median of the rounds in *middle. The first, untimed round makes the tree and touches its memory. */
static bool time_rounds(game *games, int count, int op, int rounds, bulk_time *middle)
{
    double values[BENCH_THREAD_COUNTS][3][ROUNDS_AT_MOST];
    for (int round = -1; round < rounds; round++)
        for (int i = 0; i < count; i++) {
            bulk_time time;
            if (!time_bulk_op(&games[i], op, &time))
                return false;
            if (round < 0)
                continue;
            values[i][0][round] = time.clock;
            values[i][1][round] = time.serial;
            values[i][2][round] = time.critical;
        }
    for (int i = 0; i < count; i++) {
        middle[i].clock = median(values[i][0], (size_t)rounds);
        middle[i].serial = median(values[i][1], (size_t)rounds);
        middle[i].critical = median(values[i][2], (size_t)rounds);
    }
    return true;
}

static void report_op_by_threads(const workload *w, int op, const unsigned *threads, const bulk_time *times, int count,
                                 bool json)
{
    const double points = (double)w->count;
    for (int i = 0; i < count; i++) {
        const bulk_time *t = &times[i];
        if (json)
            printf("{\"op\":\"%s\",\"set\":\"%s\",\"n\":%zu,\"threads\":%u,\"clock_ns\":%.2f,\"serial_ns\":%.2f,"
                   "\"critical_ns\":%.2f}\n",
                   bulk_names[op], w->name, w->count, threads[i], t->clock / points, t->serial / points,
                   t->critical / points);
        else
            printf("%-12s %7u %10.2f %6.2f %10.2f %10.2f %6.2f\n", bulk_names[op], threads[i], t->clock / points,
                   times[0].clock / t->clock, t->serial / points, t->critical / points,
                   times[0].critical / t->critical);
    }
    fflush(stdout);
}

bool measure_threads(const workload *w, const unsigned *threads, int count, int rounds, bool json)
{
    game games[BENCH_THREAD_COUNTS];
    bulk_time times[BENCH_THREAD_COUNTS];
    int begun = 0;
    bool ok = true;
    if (!json)
        printf("\n%zu %s points: nanoseconds a point, the median of %d round%s\n%-12s %7s %10s %6s %10s %10s %6s\n",
               w->count, w->name, rounds, rounds == 1 ? "" : "s", "operation", "threads", "clock", "ratio", "serial",
               "critical", "ratio");
    while (ok && begun < count) {
        ok = game_begin(&games[begun], w, threads[begun]);
        begun++;
    }
    for (int op = 0; ok && op < BULK_OPS; op++) {
        ok = time_rounds(games, count, op, rounds, times);
        if (ok)
            report_op_by_threads(w, op, threads, times, count, json);
    }
    for (int i = 0; i < begun; i++)
        game_end(&games[i]);
    return ok;
}
