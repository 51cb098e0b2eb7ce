/* SPDX-License-Identifier: MIT */
/* campaign.c - octree-campaign: random operations on trees of every scene; each answer is compared with a scan of all
 * points. */
#include "octree/digest.h"
#include "operations.h"
#include "program.h"

#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char program_name[] = "octree-campaign";

enum { OPERATIONS_A_TREE = 1000, AUDIT_EVERY = 50 };

/* One kind of operation, and how often it is drawn beside the others. */
typedef struct kind {
    const char *name;
    operation *run;
    unsigned weight;
} kind;

static const kind kinds[] = {
    {"insert or remove", change_one, 240},
    {"move", change_move, 130},
    {"insert_many", change_insert_many, 25},
    {"remove_many", change_remove_many, 20},
    {"move_many", change_move_many, 25},
    {"reworld", change_reworld, 8},
    {"clear", change_clear, 1},
    {"find", ask_find, 45},
    {"contains", ask_contains, 40},
    {"locate, statistics", ask_look, 20},
    {"range", ask_range, 60},
    {"range, stopped", ask_range_stopped, 20},
    {"range_count", ask_range_count, 40},
    {"range_collect", ask_range_collect, 30},
    {"range_collect_sorted", ask_range_collect_sorted, 20},
    {"collide", ask_collide, 50},
    {"collide_swept", ask_collide_swept, 55},
    {"nearest", ask_nearest, 60},
    {"nearest_k", ask_nearest_k, 50},
    {"nearest_within", ask_nearest_within, 40},
    {"nearest_batch", ask_nearest_batch, 9},
    {"radius", ask_radius, 40},
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

typedef struct options {
    uint64_t operations, seed, from;
    size_t scene; /* scene_kinds() for all */
} options;

typedef struct tally {
    uint64_t done[KINDS], answers[KINDS];
} tally;

static void print_help(void)
{
    fputs(
        "octree-campaign - random operations on octrees: insertions, removals, moves, batches, new worlds, and every\n"
        "kind of query, on ordinary and on extreme points; each answer is held against a scan of all points that\n"
        "decides by the real numbers, and the nodes against the validator and against a tree built anew\n\n"
        "usage: octree-campaign [OPTION ...]\n\n"
        "      --operations N   number of operations (default 1e6)\n"
        "      --seed S         a whole number (default 1); each gives a different campaign\n"
        "      --from N         begin at operation N (default 0), to split a campaign among processes\n"
        "      --scene NAME     use only point sets of this kind:",
        stdout);
    for (size_t i = 0, width = 0; i < scene_kinds(); i++) {
        width += strlen(scene_name(i)) + 1;
        printf("%s %s", i == 0 || width > 90 ? "\n                      " : "", scene_name(i));
        width = width > 90 ? strlen(scene_name(i)) + 1 : width;
    }
    printf("\n  -h, --help\n\n"
           "Each %d operations work on one new tree, which depends only on the seed and on its first operation. The "
           "first\n"
           "wrong answer ends the campaign; a message says how to replay it.\n"
           "Exit status: 0 all answers were right, 1 one was wrong, 2 trouble.\n",
           OPERATIONS_A_TREE);
}

/* A whole number below 2^64, also as in 1e9. */
static uint64_t read_number(const char *text, const char *option)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 0 && value < 0x1p64) || value != floor(value))
        stop_with_error("--%s takes a whole number, such as 1000 or 1e9, not \"%s\"", option, text);
    return strspn(text, "0123456789") == strlen(text) ? strtoull(text, NULL, 10) : (uint64_t)value;
}

static size_t read_scene(const char *text)
{
    for (size_t i = 0; i < scene_kinds(); i++)
        if (strcmp(scene_name(i), text) == 0)
            return i;
    stop_with_error("unknown scene \"%s\"; --help lists all scenes", text);
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {
        {"operations", required_argument, NULL, 'o'},
        {"seed", required_argument, NULL, 's'},
        {"from", required_argument, NULL, 'f'},
        {"scene", required_argument, NULL, 'c'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    options o = {.operations = 1000000, .seed = 1, .scene = scene_kinds()};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;) {
        switch (name) {
        case 'o':
            o.operations = read_number(optarg, "operations");
            break;
        case 's':
            o.seed = read_number(optarg, "seed");
            break;
        case 'f':
            o.from = read_number(optarg, "from");
            break;
        case 'c':
            o.scene = read_scene(optarg);
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
    return o;
}

static size_t any_kind(trial *t)
{
    size_t total = 0, at = 0;
    for (size_t i = 0; i < KINDS; i++)
        total += kinds[i].weight;
    for (size_t left = below(t, total); left >= kinds[at].weight; at++)
        left -= kinds[at].weight;
    return at;
}

/* Run the first `count` operations on a tree. Returns the number of right ones. */
static uint64_t play(trial *t, uint64_t seed, size_t scene, uint64_t count, tally *sums)
{
    uint64_t done = 0;
    bool ok = trial_begin(t, seed, scene);
    while (ok && done < count) {
        const size_t i = any_kind(t);
        t->operation = kinds[i].name;
        t->answers = 0;
        ok = kinds[i].run(t);
        sums->done[i]++;
        sums->answers[i] += t->answers;
        ok = ok && ((done + 1) % AUDIT_EVERY != 0 || trial_audit(t));
        done += ok;
    }
    ok = ok && trial_audit(t);
    return trial_end(t) && ok ? done : done - (done == count);
}

static void report_finding(const trial *t, const options *o, uint64_t tree, uint64_t at)
{
    const octree_def *def = &t->def;
    const uint64_t first = tree * OPERATIONS_A_TREE;
    printf("operation %" PRIu64 " of seed %" PRIu64 " (%s), scene %s, capacity %zu, depth %zu, %s:\n%s\nreplay: "
           "octree-campaign --seed %" PRIu64 " --from %" PRIu64 " --operations %" PRIu64 "%s%s\n",
           at, o->seed, t->operation, t->scene.name, def->leaf_capacity, def->max_depth,
           def->full_leaf == OCTREE_GROW ? "grow" : "refuse", t->fault, o->seed, first, at - first + 1,
           o->scene < scene_kinds() ? " --scene " : "", o->scene < scene_kinds() ? scene_name(o->scene) : "");
}

static void report_tally(const tally *sums, uint64_t operations)
{
    printf("%-22s %14s %16s\n", "operation", "times", "points answered");
    for (size_t i = 0; i < KINDS; i++)
        printf("%-22s %14" PRIu64 " %16" PRIu64 "\n", kinds[i].name, sums->done[i], sums->answers[i]);
    printf("%" PRIu64 " operations: 0 wrong answers, 0 broken invariants\n", operations);
}

static void show_progress(uint64_t done, uint64_t total)
{
    if (isatty(STDERR_FILENO))
        fprintf(stderr, done < total ? "\r%" PRIu64 " of %" PRIu64 " operations" : "\r\033[K", done, total);
}

static int run(const options *o, trial *t)
{
    tally sums = {0};
    const uint64_t first = o->from / OPERATIONS_A_TREE, skipped = o->from % OPERATIONS_A_TREE;
    const uint64_t total = o->operations + skipped;
    for (uint64_t done = 0, tree = first; done < total; tree++) {
        const uint64_t left = total - done, count = left < OPERATIONS_A_TREE ? left : OPERATIONS_A_TREE;
        const uint64_t seed = octree_digest_word(octree_digest_word(OCTREE_DIGEST_START, o->seed), tree);
        const uint64_t right = play(t, seed, o->scene, count, &sums);
        if (right < count) {
            report_finding(t, o, tree, tree * OPERATIONS_A_TREE + right);
            return EXIT_FINDING;
        }
        done += count;
        if (tree % 16 == 0 || done == total)
            show_progress(done, total);
    }
    report_tally(&sums, total);
    return EXIT_DONE;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    trial *t = resize_memory(NULL, sizeof *t);
    memset(t, 0, sizeof *t);
    const int status = run(&o, t);
    free(t);
    exit_with_status(status);
}
