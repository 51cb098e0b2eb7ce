/* SPDX-License-Identifier: MIT */
/* recorder_bench.c - octreel-recorder-bench: the time that the embedded recorder takes from the program's thread,
 * beside the time of the program's own tick. */
#include "measuring.h"
#include "octreel/recorder.h"
#include "octree/octree.h"
#include "octree/sample.h"
#include "program.h"
#include "run_program.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

const char program_name[] = "octreel-recorder-bench";

enum { TICKS = 60 };

/* A program with a number of points, of which a number move at each tick. The goals are upper limits for the recorder's
 * time in the program's thread; 0: no goal. */
typedef struct program {
    size_t points, moved;
    double tick_us, worst_ms;
} program;

static const program programs[] = {
    {1000, 10, 10, 0}, {10000, 100, 0, 0}, {100000, 1000, 500, 10}, {100000, 100000, 0, 10}};

typedef struct times {
    double recorder[TICKS], own[TICKS]; /* microseconds of processor time */
    double worst_ms;                    /* the longest call of octreel_recorder_tick(), by the clock */
    int worst_tick;
} times;

static double clock_ns(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

static octree *make_tree(const program *p, double (*places)[3])
{
    octree_def def = octree_def_default();
    octree *tree;
    def.leaf_capacity = 8;
    def.full_leaf = OCTREE_GROW;
    if (octree_create(&def, &tree) != OCTREE_OK ||
        octree_sample(OCTREE_SAMPLE_CLUSTERED, 1, &def.world, p->points, places) != OCTREE_OK)
        stop_with_error("out of memory");
    for (size_t i = 0; i < p->points; i++)
        if (octree_insert(tree, places[i], i) != OCTREE_OK)
            stop_with_error("a point is refused");
    return tree;
}

/* Every so many-th point goes a small way, and others at the next tick. */
static void move_some(octree *tree, const program *p, double (*places)[3], int tick)
{
    const size_t step = p->points / p->moved;
    for (size_t i = (size_t)tick % step; i < p->points; i += step) {
        double to[3];
        for (int axis = 0; axis < 3; axis++)
            to[axis] = places[i][axis] + (places[i][axis] < 0 ? 3 : -3);
        if (octree_move(tree, places[i], i, to) != OCTREE_OK)
            stop_with_error("a move is refused");
        memcpy(places[i], to, sizeof to);
    }
}

static void record_tick_from(octreel_recorder *recorder, const octree *tree)
{
    if (octreel_recorder_tick(recorder, tree, NULL) != OCTREEL_OK)
        stop_with_error("%s", octreel_recorder_error(recorder));
}

static void record(const program *p, const char *folder, times *t)
{
    double(*places)[3] = resize_memory(NULL, p->points * sizeof *places);
    octree *tree = make_tree(p, places);
    octreel_recorder_def def = octreel_recorder_def_default();
    octreel_recorder *recorder;
    octreel_error why;
    def.folder = folder;
    def.replace = true;
    def.tree = octree_definition(tree);
    def.every = 2 * TICKS;   /* the worker draws only the first frame, because this bench does not measure the worker */
    def.queue_ticks = TICKS; /* with a smaller queue, the program would wait for the worker */
    def.queue_bytes = SIZE_MAX;
    if (octreel_recorder_open(&def, &recorder, &why) != OCTREEL_OK)
        stop_with_error("%s", why.text);
    t->worst_ms = 0;
    for (int tick = 0; tick < TICKS; tick++) {
        const double before = clock_ns(CLOCK_THREAD_CPUTIME_ID);
        if (tick > 0)
            move_some(tree, p, places, tick);
        const double between = clock_ns(CLOCK_THREAD_CPUTIME_ID), start = clock_ns(CLOCK_MONOTONIC);
        record_tick_from(recorder, tree);
        const double wall_ms = (clock_ns(CLOCK_MONOTONIC) - start) / 1e6;
        t->own[tick] = (between - before) / 1e3;
        t->recorder[tick] = (clock_ns(CLOCK_THREAD_CPUTIME_ID) - between) / 1e3;
        if (wall_ms > t->worst_ms) {
            t->worst_ms = wall_ms;
            t->worst_tick = tick;
        }
    }
    if (octreel_recorder_close(recorder) != OCTREEL_OK)
        stop_with_error("%s", octreel_recorder_error(recorder));
    octreel_recorder_destroy(recorder);
    octree_destroy(tree);
    free(places);
}

static void print_program(const program *p, times *t)
{
    const double own = median(t->own, TICKS), recorder = median(t->recorder, TICKS);
    printf("%8zu %8zu %12.1f %12.1f", p->points, p->moved, own, recorder);
    if (p->tick_us > 0)
        printf(" <= %5g %-6s", p->tick_us, recorder <= p->tick_us ? "holds" : "missed");
    else
        printf(" %15s", "");
    printf(" %9.1f %6d", t->worst_ms, t->worst_tick);
    if (p->worst_ms > 0)
        printf("  <= %g %s", p->worst_ms, t->worst_ms <= p->worst_ms ? "holds" : "missed");
    putchar('\n');
}

int main(int argc, char **argv)
{
    static const struct option options[] = {
        {"quick", no_argument, NULL, 'q'}, {"help", no_argument, NULL, 'h'}, {NULL, 0, NULL, 0}};
    size_t count = sizeof programs / sizeof *programs;
    char folder[] = "recorder_bench_XXXXXX";
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == '?')
            return EXIT_TROUBLE; /* getopt has said why */
        if (option == 'h') {
            puts("octreel-recorder-bench - what the embedded recorder takes from the thread of a program that hands "
                 "its\n"
                 "tree over\n\n"
                 "usage: octreel-recorder-bench [--quick]\n\n"
                 "      --quick   measure only the smallest program: times are meaningless\n"
                 "  -h, --help\n\n"
                 "own us       processor time of the program's own work in a tick, single moves: the median\n"
                 "recorder us  processor time to hand the tree to the recorder: the median\n"
                 "worst ms     the longest call that hands the tree over, by the clock, and its tick\n"
                 "Exit status: 0 done, even if goals were missed; 2 trouble.");
            exit_with_status(EXIT_DONE);
        }
        count = 1;
    }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    if (!mkdtemp(folder))
        stop_with_error("cannot create a folder for the recording: %s", strerror(errno));
    printf("%8s %8s %12s %12s %15s %9s %6s  %s\n", "points", "moved", "own us", "recorder us", "goal", "worst ms",
           "tick", "goal");
    for (size_t i = 0; i < count; i++) {
        times t;
        record(&programs[i], folder, &t);
        print_program(&programs[i], &t);
    }
    const char *const clean_up[] = {"rm", "-r", folder, NULL};
    program_run run;
    if (!run_program(clean_up, &run) || run.status != 0)
        stop_with_error("cannot remove %s", folder);
    exit_with_status(EXIT_DONE);
}
