/* SPDX-License-Identifier: MIT */
/* bodies_bench.c - octree-bodies-bench: operations on bodies, timed beside other indexes of boxes, answers compared. */
#include "body_peer.h"
#include "measuring.h"
#include "octree/sample.h"
#include "program.h"

#include <getopt.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char program_name[] = "octree-bodies-bench";

enum { COUNTS_AT_MOST = 8, ROUNDS_AT_MOST = 99, QUERIES = 4000, PEERS_AT_MOST = 16, PLANES = 6 };

#define WORLD 1000.0

static const body_peer *const all_peers[] = {&body_peer_octree, &body_peer_points,
#ifdef BENCH_BOOST
                                             &body_peer_boost,
#endif
#ifdef BENCH_EMBREE
                                             &body_peer_embree,
#endif
#define ADD_PEER(name) &body_peer_##name,
                                             BENCH_MORE_BODY_PEERS(ADD_PEER)
#undef ADD_PEER
};
enum { PEERS = sizeof all_peers / sizeof all_peers[0] };

/* The sizes of bodies: all equal, or spread over three decades, as many in each; or those of a street. */
typedef enum body_sizes { SIZES_EQUAL, SIZES_DECADES, SIZES_STREET, SIZES } body_sizes;
static const char *const size_names[SIZES] = {"equal", "decades", "street"};

typedef struct workload {
    octree_box world;
    size_t count;
    double spacing; /* of bodies, if they were a lattice */
    octree_body *bodies, *to;
    octree_region regions[BODY_ASKS][QUERIES];
    octree_half_space planes[QUERIES][PLANES];
} workload;

/* ---- Workloads ---------------------------------------------------------------------------------------------- */

static double clamp(double x)
{
    return x < -WORLD ? -WORLD : x > WORLD ? WORLD : x;
}

/* Things in a street along x, in units of their spacing: half extents, and how many of 20 things they are. */
static const struct {
    double half[3];
    int share;
} things[] = {
    {{0.5, 0.22, 0.18}, 8}, /* cars */
    {{0.02, 0.02, 0.6}, 5}, /* poles */
    {{3, 0.03, 0.02}, 3},   /* kerbs */
    {{2, 0.05, 0.8}, 3},    /* walls */
    {{1.5, 1.5, 2}, 1},     /* houses */
};

/* Put a thing on the ground beside one of 40 streets, half of which run along x and half along y. */
static void place_in_street(octree_body *b, double spacing, uint64_t *seed)
{
    const int along = octree_random_unit(seed) < 0.5 ? 0 : 1, across = 1 - along;
    int kind = 0, left = (int)(octree_random_unit(seed) * 20);
    while (left >= things[kind].share)
        left -= things[kind++].share;
    const double street = WORLD * (floor(octree_random_unit(seed) * 20) - 9.5) / 10;
    b->position[across] = clamp(street + WORLD / 40 * (octree_random_unit(seed) - 0.5));
    for (int k = 0; k < 3; k++)
        b->half[k] = spacing *
                     things[kind].half[k == along    ? 0
                                       : k == across ? 1
                                                     : 2] *
                     (0.75 + octree_random_unit(seed) / 2);
    b->position[2] = b->half[2];
}

/* The volume of all bodies together is such that a body overlaps about one other in a uniform set. */
static void make_bodies(workload *w, octree_sample_kind set, body_sizes sizes, uint64_t *seed)
{
    double(*rows)[3] = resize_memory(NULL, w->count * sizeof *rows);
    if (octree_sample(set, 1, &w->world, w->count, rows) != OCTREE_OK)
        stop_with_error("cannot make %zu points", w->count);
    const double spacing = w->spacing;
    for (size_t i = 0; i < w->count; i++) {
        octree_body *b = &w->bodies[i], *to = &w->to[i];
        *b = (octree_body){.id = i};
        const double size = sizes == SIZES_EQUAL ? 0.4 : 2 * pow(1000, -octree_random_unit(seed));
        for (int k = 0; k < 3; k++) {
            b->position[k] = rows[i][k];
            b->half[k] = spacing * size * (0.75 + octree_random_unit(seed) / 2);
        }
        if (sizes == SIZES_STREET)
            place_in_street(b, spacing, seed);
        *to = *b;
        for (int k = 0; k < 3; k++)
            to->position[k] = clamp(b->position[k] + spacing * (octree_random_unit(seed) - 0.5));
    }
    free(rows);
}

/* A camera at a place: near and far planes, and four sides. */
static void make_frustum(octree_half_space planes[PLANES], const double at[3], double depth, uint64_t *seed)
{
    const int axis = (int)(octree_random_unit(seed) * 3);
    for (int i = 0; i < PLANES; i++) {
        octree_half_space *p = &planes[i];
        const int side = i % 2 ? 1 : -1, other = (axis + 1 + (i - 2) / 2) % 3;
        *p = (octree_half_space){0};
        p->normal[axis] = i < 2 ? side : -0.5;
        if (i >= 2)
            p->normal[other] = side;
        for (int k = 0; k < 3; k++)
            p->offset += p->normal[k] * at[k];
        p->offset += i == 0 ? -depth / 20 : i == 1 ? depth : 0;
    }
}

static void make_regions(workload *w, uint64_t *seed)
{
    const double spacing = w->spacing;
    for (int i = 0; i < QUERIES; i++) {
        const octree_body *near = &w->bodies[(size_t)(octree_random_unit(seed) * (double)w->count)];
        octree_region r = {
            .half_spaces = w->planes[i], .half_space_count = PLANES, .length = HUGE_VAL, .radius = spacing};
        for (int k = 0; k < 3; k++) {
            r.center[k] = clamp(near->position[k] + spacing * (octree_random_unit(seed) - 0.5));
            r.box.min[k] = r.center[k] - spacing;
            r.box.max[k] = r.center[k] + spacing;
            r.origin[k] = WORLD * (2 * octree_random_unit(seed) - 1);
            r.direction[k] = r.center[k] - r.origin[k];
        }
        make_frustum(w->planes[i], r.center, 5 * spacing, seed);
        static const octree_region_kind kinds[BODY_ASKS] = {OCTREE_REGION_BOX,         OCTREE_REGION_BALL,
                                                            OCTREE_REGION_HALF_SPACES, OCTREE_REGION_RAY,
                                                            OCTREE_REGION_BALL,        OCTREE_REGION_BOX};
        for (int ask = 0; ask < BODY_ASKS; ask++) {
            w->regions[ask][i] = r;
            w->regions[ask][i].kind = kinds[ask];
        }
    }
}

static workload *make_workload(octree_sample_kind set, body_sizes sizes, size_t count)
{
    uint64_t seed = 12345;
    workload *w = resize_memory(NULL, sizeof *w);
    w->world = (octree_box){{-WORLD, -WORLD, -WORLD}, {WORLD, WORLD, WORLD}};
    w->count = count;
    w->spacing = 2 * WORLD / (sizes == SIZES_STREET ? sqrt((double)count) : cbrt((double)count));
    w->bodies = resize_memory(NULL, count * sizeof *w->bodies);
    w->to = resize_memory(NULL, count * sizeof *w->to);
    make_bodies(w, set, sizes, &seed);
    make_regions(w, &seed);
    return w;
}

static void free_workload(workload *w)
{
    free(w->bodies);
    free(w->to);
    free(w);
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

/* The times of one operation: the median of the rounds for each peer; 0: the peer does not have it. */
typedef struct row {
    const char *name;
    double ns[PEERS];
} row;

static void print_row(const row *r)
{
    printf("  %-10s", r->name);
    for (size_t i = 0; i < PEERS; i++)
        if (r->ns[i] > 0)
            printf("  %s %.0f", all_peers[i]->name, r->ns[i]);
    double best = HUGE_VAL;
    for (size_t i = 1; i < PEERS; i++) /* the tree of points is no rival, but what a body is compared with */
        if (r->ns[i] > 0 && all_peers[i] != &body_peer_points && r->ns[i] < best)
            best = r->ns[i];
    if (best < HUGE_VAL)
        printf("  ratio %.2f", best / r->ns[0]);
    putchar('\n');
}

static void *create_peer(const body_peer *p, const workload *w)
{
    void *self = p->create(&w->world);
    if (!self)
        stop_with_error("out of memory");
    return self;
}

/* Time a change of one peer. Removals and moves start from a full index, and all others from an empty one. */
static double time_change(const body_peer *p, const workload *w, body_change change)
{
    void *self = create_peer(p, w);
    if (change >= BODY_REMOVE)
        p->change[p->change[BODY_INSERT] ? BODY_INSERT : BODY_BUILD](self, w->bodies, NULL, w->count);
    const double start = processor_time();
    p->change[change](self, w->bodies, w->to, w->count);
    const double ns = (processor_time() - start) / (double)w->count;
    p->destroy(self);
    return ns;
}

static void measure_change(const workload *w, body_change change, int rounds)
{
    static const char *const names[BODY_CHANGES] = {"build", "insert", "remove", "move", "move_all"};
    row r = {.name = names[change]};
    for (size_t i = 0; i < PEERS; i++) {
        double times[ROUNDS_AT_MOST];
        for (int round = 0; round < rounds && all_peers[i]->change[change]; round++)
            times[round] = time_change(all_peers[i], w, change);
        r.ns[i] = all_peers[i]->change[change] ? median(times, (size_t)rounds) : 0;
    }
    print_row(&r);
}

/* Returns whether two answers agree; floats decide differently only where a ray grazes a box. */
static bool agree(const body_peer *p, const body_answer *a, const body_answer *b)
{
    return a->count == b->count && (a->ids == b->ids || p->error > 0) &&
           fabs(a->at - b->at) <= (p->error + 1e-9) * fmax(fabs(a->at), 1);
}

/* Returns whether the answers of a peer agree with the octree's. Of an index in floats, one answer of 100 may not. */
static bool compare_answers(const body_peer *p, const char *name, const body_answer *expected, const body_answer *given,
                            size_t count)
{
    size_t unlike = 0;
    for (size_t i = 0; i < count; i++)
        unlike += !agree(p, &expected[i], &given[i]);
    if (unlike <= (p->error > 0 ? count / 100 : 0))
        return true;
    fprintf(stderr, "octree-bodies-bench: %s: %zu of %zu answers of %s differ from the octree's\n", name, unlike, count,
            p->name);
    return false;
}

static bool measure_ask(const workload *w, void *const selves[PEERS], body_ask ask, int rounds)
{
    static const char *const names[BODY_ASKS] = {"box", "ball", "frustum", "ray_first", "nearest", "pairs"};
    static body_answer expected[QUERIES], given[QUERIES];
    const size_t count = ask == BODY_PAIRS ? 1 : QUERIES;
    double times[PEERS][ROUNDS_AT_MOST];
    row r = {.name = names[ask]};
    for (int round = 0; round < rounds; round++)
        for (size_t i = 0; i < PEERS; i++) {
            if (!all_peers[i]->ask[ask])
                continue;
            body_answer *answers = i == 0 ? expected : given;
            const double start = processor_time();
            all_peers[i]->ask[ask](selves[i], w->regions[ask], count, answers);
            times[i][round] = (processor_time() - start) / (double)(ask == BODY_PAIRS ? w->count : count);
            if (i > 0 && !compare_answers(all_peers[i], r.name, expected, given, count))
                return false;
        }
    for (size_t i = 0; i < PEERS; i++)
        r.ns[i] = all_peers[i]->ask[ask] ? median(times[i], (size_t)rounds) : 0;
    print_row(&r);
    return true;
}

static bool measure_asks(const workload *w, int rounds)
{
    void *selves[PEERS];
    bool alike = true;
    for (size_t i = 0; i < PEERS; i++) {
        selves[i] = create_peer(all_peers[i], w);
        all_peers[i]->change[BODY_BUILD](selves[i], w->bodies, NULL, w->count);
        if (all_peers[i]->memory)
            printf("%s  %s %.1f", i == 0 ? "  bytes     " : "", all_peers[i]->name,
                   (double)all_peers[i]->memory(selves[i]) / (double)w->count);
    }
    putchar('\n');
    for (int ask = 0; ask < BODY_ASKS && alike; ask++)
        alike = measure_ask(w, selves, (body_ask)ask, rounds);
    for (size_t i = 0; i < PEERS; i++)
        all_peers[i]->destroy(selves[i]);
    return alike;
}

/* ---- The program -------------------------------------------------------------------------------------------- */

typedef struct options {
    size_t counts[COUNTS_AT_MOST];
    int count;
    bool sets[OCTREE_SAMPLE_KINDS];
    bool any_set;
    int rounds;
} options;

static void print_help(void)
{
    puts("octree-bodies-bench - operations on bodies (boxes), timed beside Boost.Geometry's R-tree and Embree where\n"
         "those are installed: in one process, in turn, on the same bodies, the answers compared\n\n"
         "usage: octree-bodies-bench [OPTION ...]\n\n"
         "      --n LIST      numbers of bodies, separated by commas (100 to 1e7; default 1e4,1e5,1e6)");
    fputs("      --set LIST    of", stdout);
    for (int i = 0; i < OCTREE_SAMPLE_KINDS; i++)
        printf(" %s", octree_sample_name((octree_sample_kind)i));
    puts(" (default uniform,clustered)\n"
         "      --rounds N    measure each N times and take the median (default 5)\n"
         "  -h, --help\n\n"
         "Each set is measured with bodies of equal size, with sizes spread over three decades, and as the cars, "
         "poles,\n"
         "kerbs, walls and houses of a city (street; only the set's positions along the streets). Times are "
         "nanoseconds\n"
         "of processor time: for changes and pairs per body, for other queries per query. move_all replaces all "
         "bodies. A\n"
         "ratio is the fastest other index's time divided by the octree's; \"points\" is an octree of the positions "
         "alone.\n"
         "Exit status: 0 done, 1 two indexes answer differently, 2 trouble.");
}

static void take_count(void *to, const char *entry)
{
    options *o = to;
    if (o->count == COUNTS_AT_MOST)
        stop_with_error("--n takes at most %d numbers", COUNTS_AT_MOST);
    o->counts[o->count++] = (size_t)parse_whole_number("--n", entry, 100, 1e7);
}

static void take_set(void *to, const char *entry)
{
    options *o = to;
    octree_sample_kind kind;
    if (!octree_sample_parse(entry, &kind))
        stop_with_error("unknown set \"%s\"; --help lists all sets", entry);
    o->sets[kind] = o->any_set = true;
}

static options read_options(int argc, char **argv)
{
    static const struct option names[] = {{"n", required_argument, NULL, 'n'},
                                          {"set", required_argument, NULL, 's'},
                                          {"rounds", required_argument, NULL, 'r'},
                                          {"help", no_argument, NULL, 'h'},
                                          {NULL, 0, NULL, 0}};
    options o = {.rounds = 5};
    for (int name; (name = getopt_long(argc, argv, "h", names, NULL)) != -1;) {
        if (name == 'n')
            parse_list(&o, optarg, take_count);
        else if (name == 's')
            parse_list(&o, optarg, take_set);
        else if (name == 'r')
            o.rounds = (int)parse_whole_number("--rounds", optarg, 1, ROUNDS_AT_MOST);
        else if (name == 'h') {
            print_help();
            exit_with_status(EXIT_DONE);
        } else
            exit(EXIT_TROUBLE); /* getopt has said why */
    }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    static const size_t counts[] = {10000, 100000, 1000000};
    if (o.count == 0) {
        memcpy(o.counts, counts, sizeof counts);
        o.count = sizeof counts / sizeof counts[0];
    }
    if (!o.any_set)
        o.sets[OCTREE_SAMPLE_UNIFORM] = o.sets[OCTREE_SAMPLE_CLUSTERED] = true;
    return o;
}

static bool measure(octree_sample_kind set, body_sizes sizes, size_t count, int rounds)
{
    workload *w = make_workload(set, sizes, count);
    printf("%zu %s bodies, sizes %s\n", count, octree_sample_name(set), size_names[sizes]);
    for (int change = 0; change < BODY_CHANGES; change++)
        measure_change(w, (body_change)change, rounds);
    const bool alike = measure_asks(w, rounds);
    free_workload(w);
    return alike;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    bool alike = true;
    for (int set = 0; set < OCTREE_SAMPLE_KINDS; set++)
        for (int i = 0; o.sets[set] && i < o.count; i++)
            for (int sizes = 0; sizes < SIZES && alike; sizes++)
                alike = measure((octree_sample_kind)set, (body_sizes)sizes, o.counts[i], o.rounds);
    exit_with_status(alike ? EXIT_DONE : EXIT_FINDING);
}
