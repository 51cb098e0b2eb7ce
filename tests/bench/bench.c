/* bench.c - octree-bench: its command line, and the workloads one after the other. */
#include "report.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_DONE = 0, EXIT_FINDING = 1, EXIT_TROUBLE = 2 };
enum { COUNTS_AT_MOST = 16, POINTS_AT_LEAST = 100, POINTS_AT_MOST = 100000000 };

typedef struct options {
    size_t counts[COUNTS_AT_MOST];
    int count;
    bool sets[OCTREE_SAMPLE_KINDS];
    bool ops[OPS];
    int rounds;
    bool json;
} options;

static int trouble(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("octree-bench: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return EXIT_TROUBLE;
}

static void print_help(void)
{
    puts("octree-bench - every operation of the octree, timed beside nanoflann and Boost.Geometry where those are\n"
         "installed: in one process, in turn, on the same points, the answers compared\n\n"
         "usage: octree-bench [OPTION ...]\n\n"
         "      --n LIST      numbers of points, with commas between (default 1e4,1e5,1e6; from 100 to 1e8)");
    fputs("      --set LIST    of", stdout);
    for (int i = 0; i < OCTREE_SAMPLE_KINDS; i++)
        printf(" %s", octree_sample_name((octree_sample_kind)i));
    fputs(" (default all)\n      --op LIST     of", stdout);
    for (int i = 0; i < OPS; i++)
        printf("%s%s", i % 6 == 5 ? "\n                    " : " ", all_ops[i].name);
    printf(
        " (default all)\n"
        "      --rounds N    measure each N times and take the median (default 5; at most %d)\n"
        "      --json        a line for each operation and tree, for programs\n"
        "  -h, --help\n\n"
        "A ratio is the best other's time to the octree's. nearest_batch asks %d targets a call, nearest_all all of\n"
        "them; those two, nearest_fast and nearest_churned compare the octree with itself, and the auto_ operations "
        "one\n"
        "that has chosen its leaf capacity by the operation with fixed capacities from 8 to 256.\n"
        "Exit status: 0 done, 1 two trees answer differently, 2 trouble.\n",
        ROUNDS_AT_MOST, PEER_BATCH);
}

/* Take in one entry of a list. False when it does not fit, which has been said. */
typedef bool take_entry(options *o, const char *entry);

static bool take_count(options *o, const char *entry)
{
    char *end;
    const double n = strtod(entry, &end);
    if (end == entry || *end || !(n >= POINTS_AT_LEAST && n <= POINTS_AT_MOST) || n != floor(n)) {
        trouble("--n takes whole numbers from %d to %d, such as 1e6, not \"%s\"", POINTS_AT_LEAST, POINTS_AT_MOST,
                entry);
        return false;
    }
    if (o->count == COUNTS_AT_MOST) {
        trouble("--n takes at most %d numbers", COUNTS_AT_MOST);
        return false;
    }
    o->counts[o->count++] = (size_t)n;
    return true;
}

static bool take_set(options *o, const char *entry)
{
    octree_sample_kind kind;
    if (!octree_sample_parse(entry, &kind)) {
        trouble("there is no set \"%s\"; --help lists them", entry);
        return false;
    }
    o->sets[kind] = true;
    return true;
}

static bool take_op(options *o, const char *entry)
{
    for (int i = 0; i < OPS; i++) {
        if (strcmp(all_ops[i].name, entry) == 0) {
            o->ops[i] = true;
            return true;
        }
    }
    trouble("there is no operation \"%s\"; --help lists them", entry);
    return false;
}

/* Takes the list apart, in place. */
static bool take_list(options *o, char *list, take_entry *take)
{
    for (char *entry = list; entry;) {
        char *comma = strchr(entry, ',');
        if (comma)
            *comma = 0;
        if (!take(o, entry))
            return false;
        entry = comma ? comma + 1 : NULL;
    }
    return true;
}

static bool take_rounds(options *o, const char *text)
{
    char *end;
    errno = 0;
    const long rounds = strtol(text, &end, 10);
    if (errno || end == text || *end || rounds < 1 || rounds > ROUNDS_AT_MOST) {
        trouble("--rounds takes a whole number from 1 to %d, not \"%s\"", ROUNDS_AT_MOST, text);
        return false;
    }
    o->rounds = (int)rounds;
    return true;
}

/* What no option named is all of it. */
static void fill_defaults(options *o)
{
    static const size_t counts[] = {10000, 100000, 1000000};
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

/* -1 to go on, or the exit status. */
static int read_options(int argc, char **argv, options *o)
{
    static const struct option names[] = {
        {"n", required_argument, NULL, 'n'},
        {"set", required_argument, NULL, 's'},
        {"op", required_argument, NULL, 'o'},
        {"rounds", required_argument, NULL, 'r'},
        {"json", no_argument, NULL, 'j'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    *o = (options){.rounds = 5};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;) {
        if (name == 'h') {
            print_help();
            return EXIT_DONE;
        }
        o->json |= name == 'j';
        if (name == '?' || (name == 'n' && !take_list(o, optarg, take_count)) ||
            (name == 's' && !take_list(o, optarg, take_set)) || (name == 'o' && !take_list(o, optarg, take_op)) ||
            (name == 'r' && !take_rounds(o, optarg)))
            return EXIT_TROUBLE;
    }
    if (optind < argc)
        return trouble("there is no argument \"%s\"; try --help", argv[optind]);
    fill_defaults(o);
    return -1;
}

static int run_workload(const options *o, octree_sample_kind set, size_t count)
{
    workload w;
    outcome result = OUT_OF_MEMORY;
    if (workload_make(&w, set, count)) {
        if (!o->json)
            report_heading(&w, o->rounds);
        result = run_ops(o->ops, &w, o->rounds, o->json ? report_json : report_row, NULL);
        workload_free(&w);
    }
    if (result == OUT_OF_MEMORY)
        return trouble("there is no memory for %zu points", count);
    return result == UNLIKE ? EXIT_FINDING : EXIT_DONE;
}

int main(int argc, char **argv)
{
    options o;
    int status = read_options(argc, argv, &o);
    if (status >= 0)
        return status;
    status = EXIT_DONE;
    for (int set = 0; status == EXIT_DONE && set < OCTREE_SAMPLE_KINDS; set++)
        for (int i = 0; status == EXIT_DONE && o.sets[set] && i < o.count; i++)
            status = run_workload(&o, (octree_sample_kind)set, o.counts[i]);
    if (fflush(stdout) != 0 || ferror(stdout))
        return trouble("the results cannot be written to standard output");
    return status;
}
