/* SPDX-License-Identifier: MIT */
/* bench.c - octree-bench: its command line, and the workloads one after the other. */
#include "program.h"
#include "report.h"
#include "threads.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char program_name[] = "octree-bench";

enum { COUNTS_AT_MOST = 16 };

typedef struct options {
    size_t counts[COUNTS_AT_MOST];
    int count;
    point_file file; /* points to measure; no rows: the sets are measured */
    bool sets[OCTREE_SAMPLE_KINDS];
    bool ops[OPS];
    unsigned threads[BENCH_THREAD_COUNTS];
    int thread_counts; /* 0: the operations are measured instead */
    int rounds;
    bool json;
} options;

static void print_help(void)
{
    puts("octree-bench - every operation of the octree, timed beside nanoflann and Boost.Geometry where those are\n"
         "installed: in one process, in turn, on the same points, the answers compared\n\n"
         "usage: octree-bench [OPTION ...]\n\n"
         "      --n LIST      numbers of points, separated by commas (100 to 1e8; default\n"
         "                    1e4,1e5,2.5e5,7e5,1e6: the leaves of a tree of 2.5e5 points hold the most)");
    fputs("      --set LIST    of", stdout);
    for (int i = 0; i < OCTREE_SAMPLE_KINDS; i++)
        printf(" %s", octree_sample_name((octree_sample_kind)i));
    fputs(" (default all; a surface is as a scanner sees it)\n"
          "      --points FILE measure points of this file, lines of x y z, instead of sets\n      --op LIST     of",
          stdout);
    for (int i = 0; i < OPS; i++)
        printf("%s%s", i % 6 == 5 ? "\n                    " : " ", all_ops[i].name);
    printf(" (default all)\n"
           "      --threads L   measure the bulk operations with these numbers of threads instead, such as 1,2,4: by\n"
           "                    the clock, and the serial part and the critical path by processor time\n"
           "      --rounds N    measure each N times and take the median (default 5; at most %d)\n"
           "      --json        print one JSON object per operation and tree\n"
           "  -h, --help\n\n"
           "A ratio is the fastest peer's time divided by the octree's. nearest_batch asks %d targets a call, "
           "nearest_all all of\n"
           "them; those two, nearest_fast and nearest_churned compare the octree with itself, and the auto_ operations "
           "one\n"
           "that has chosen its leaf capacity by the operation with fixed capacities from 8 to 256.\n"
           "Exit status: 0 done, 1 two trees answer differently, 2 trouble.\n",
           ROUNDS_AT_MOST, PEER_BATCH);
}

static void take_count(void *to, const char *entry)
{
    options *o = to;
    if (o->count == COUNTS_AT_MOST)
        stop_with_error("--n takes at most %d numbers", COUNTS_AT_MOST);
    o->counts[o->count++] = (size_t)parse_whole_number("--n", entry, POINTS_AT_LEAST, POINTS_AT_MOST);
}

static void take_set(void *to, const char *entry)
{
    options *o = to;
    octree_sample_kind kind;
    if (!octree_sample_parse(entry, &kind))
        stop_with_error("unknown set \"%s\"; --help lists all sets", entry);
    o->sets[kind] = true;
}

static void take_op(void *to, const char *entry)
{
    options *o = to;
    int i = 0;
    while (i < OPS && strcmp(all_ops[i].name, entry) != 0)
        i++;
    if (i == OPS)
        stop_with_error("unknown operation \"%s\"; --help lists all operations", entry);
    o->ops[i] = true;
}

static void take_threads(void *to, const char *entry)
{
    options *o = to;
    if (o->thread_counts == BENCH_THREAD_COUNTS)
        stop_with_error("--threads takes at most %d numbers", BENCH_THREAD_COUNTS);
    o->threads[o->thread_counts++] = (unsigned)parse_whole_number("--threads", entry, 1, BENCH_THREADS_AT_MOST);
}

/* Without options, everything is measured. */
static void fill_defaults(options *o)
{
    static const size_t counts[] = {10000, 100000, 250000, 700000, 1000000};
    if (o->count == 0) {
        o->count = sizeof counts / sizeof counts[0];
        memcpy(o->counts, counts, sizeof counts);
    }
    const bool none[OPS + OCTREE_SAMPLE_KINDS] = {false};
    if (memcmp(o->sets, none, sizeof o->sets) == 0)
        memset(o->sets, true, sizeof o->sets);
    if (memcmp(o->ops, none, sizeof o->ops) == 0)
        memset(o->ops, true, sizeof o->ops);
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {
        {"n", required_argument, NULL, 'n'},
        {"set", required_argument, NULL, 's'},
        {"points", required_argument, NULL, 'p'},
        {"op", required_argument, NULL, 'o'},
        {"threads", required_argument, NULL, 't'},
        {"rounds", required_argument, NULL, 'r'},
        {"json", no_argument, NULL, 'j'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    options o = {.rounds = 5};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;) {
        switch (name) {
        case 'n':
            parse_list(&o, optarg, take_count);
            break;
        case 's':
            parse_list(&o, optarg, take_set);
            break;
        case 'p':
            o.file = read_point_file(optarg);
            break;
        case 'o':
            parse_list(&o, optarg, take_op);
            break;
        case 't':
            parse_list(&o, optarg, take_threads);
            break;
        case 'r':
            o.rounds = (int)parse_whole_number("--rounds", optarg, 1, ROUNDS_AT_MOST);
            break;
        case 'j':
            o.json = true;
            break;
        case 'h':
            print_help();
            exit_with_status(EXIT_DONE);
        default:
            exit(EXIT_TROUBLE); /* getopt has said why */
        }
    }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    fill_defaults(&o);
    return o;
}

static int run_workload(const options *o, octree_sample_kind set, size_t count)
{
    workload w;
    outcome result = OUT_OF_MEMORY;
    if (workload_make(&w, set, o->file.rows ? &o->file : NULL, count) && o->thread_counts > 0) {
        if (measure_threads(&w, o->threads, o->thread_counts, o->rounds, o->json))
            result = MEASURED;
        workload_free(&w);
    } else if (w.count > 0) {
        if (!o->json)
            report_heading(&w, o->rounds);
        result = run_ops(o->ops, &w, o->rounds, o->json ? report_json : report_row, NULL);
        workload_free(&w);
    }
    if (result == OUT_OF_MEMORY)
        stop_with_error("out of memory for %zu points", count);
    return result == UNLIKE ? EXIT_FINDING : EXIT_DONE;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    int status = EXIT_DONE;
    for (int set = 0; status == EXIT_DONE && set < (o.file.rows ? 1 : OCTREE_SAMPLE_KINDS); set++)
        for (int i = 0; status == EXIT_DONE && (o.file.rows || o.sets[set]) && i < o.count; i++)
            status = run_workload(&o, (octree_sample_kind)set, o.counts[i]);
    free(o.file.rows);
    exit_with_status(status);
}
