/* SPDX-License-Identifier: MIT */
/* measure.c - times one operation on several trees in turn, and compares their answers. */
#include "measure.h"
#include "measuring.h"
#include "program.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PROBES = 200 };

static void tell_medians(lineup *l, int rounds)
{
    for (int i = 0; i < l->count; i++)
        l->of[i].ns = median(l->of[i].round_ns, (size_t)rounds);
}

/* Peers compute distances in doubles or floats, with rounding errors. */
static bool alike(const peer_answer *a, const peer_answer *b, double error)
{
    return a->count == b->count && a->ids == b->ids &&
           fabs(a->distance - b->distance) <= 1e-12 * fmax(a->distance, b->distance) + error * (double)a->count;
}

outcome measure_compare(const lineup *l, int i, const char *op, const workload *w, size_t count,
                        const peer_answer *expected, const peer_answer *given)
{
    for (size_t q = 0; q < count; q++) {
        const peer_answer *a = &expected[q], *b = &given[q];
        if (alike(a, b, l->of[i].peer->error))
            continue;
        fprintf(stderr, "octree-bench: %s of %zu %s points, query %zu: ", op, w->count, w->name, q);
        fprintf(stderr, "%s finds %zu points, ids %" PRIu64 ", distance %.17g; ", l->of[0].who, a->count, a->ids,
                a->distance);
        fprintf(stderr, "%s finds %zu, %" PRIu64 ", %.17g\n", l->of[i].who, b->count, b->ids, b->distance);
        return UNLIKE;
    }
    return MEASURED;
}

/* After a change, compare the points around some targets in every tree. */
static outcome probe(const lineup *l, int i, const char *op, const workload *w, peer_answer (*answers)[PROBES])
{
    const size_t count = w->query_count < PROBES ? w->query_count : PROBES;
    const contender *c = &l->of[i];
    if (!c->peer->ask[PEER_RADIUS])
        return MEASURED;
    c->peer->ask[PEER_RADIUS](c->self, w->targets, count, answers[i]);
    return measure_compare(l, i, op, w, count, answers[0], answers[i]);
}

static outcome check_done(const contender *c, const char *op, size_t done, size_t asked)
{
    if (done == asked)
        return MEASURED;
    fprintf(stderr, "octree-bench: %s: %s did %zu of %zu\n", op, c->who, done, asked);
    return UNLIKE;
}

/* Undo changes: insert removed points again, and move points back. */
static size_t undo(const contender *c, const changes *asked)
{
    return asked->kind == PEER_MOVE ? c->peer->change[PEER_MOVE](c->self, asked->to, asked->points, asked->count)
                                    : c->peer->change[PEER_INSERT](c->self, asked->points, NULL, asked->count);
}

static outcome change_once(lineup *l, int i, const workload *w, const changes *asked, int round,
                           peer_answer (*answers)[PROBES])
{
    contender *c = &l->of[i];
    const bool fills = asked->kind == PEER_BUILD || asked->kind == PEER_INSERT;
    if (fills && !(c->self = c->peer->create(&w->world)))
        return OUT_OF_MEMORY;
    const double start = processor_time();
    const size_t done = c->peer->change[asked->kind](c->self, asked->points, asked->to, asked->count);
    c->round_ns[round] = (processor_time() - start) / (double)asked->count;
    outcome result = check_done(c, asked->op, done, asked->count);
    if (result == MEASURED)
        result = probe(l, i, asked->op, w, answers);
    if (result == MEASURED && !fills)
        result = check_done(c, asked->op, undo(c, asked), asked->count);
    c->memory = c->peer->memory(c->self);
    if (fills) {
        c->peer->destroy(c->self);
        c->self = NULL;
    }
    return result;
}

outcome measure_changes(lineup *l, const workload *w, const changes *asked, int rounds)
{
    peer_answer answers[RIVALS_AT_MOST][PROBES];
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < l->count; i++) {
            const outcome result = change_once(l, i, w, asked, round, answers);
            if (result != MEASURED)
                return result;
        }
    tell_medians(l, rounds);
    return MEASURED;
}

/* Write more memory than the processor's caches hold. */
static void empty_caches(void)
{
    enum { BYTES = 1 << 27, LINE = 64 };
    static volatile unsigned char *memory;
    if (!memory && !(memory = malloc(BYTES)))
        stop_with_error("out of memory");
    for (size_t i = 0; i < BYTES; i += LINE)
        memory[i]++;
}

static outcome ask_in_rounds(lineup *l, const workload *w, const questions *asked, int rounds, peer_answer *expected,
                             peer_answer *given)
{
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < l->count; i++) {
            contender *c = &l->of[i];
            peer_answer *answers = i == 0 ? expected : given;
            if (asked->cold)
                empty_caches();
            const double start = processor_time();
            c->ask(c->self, asked->queries, asked->count, answers);
            c->round_ns[round] = (processor_time() - start) / (double)asked->count;
            if (measure_compare(l, i, asked->op, w, asked->count, expected, answers) != MEASURED)
                return UNLIKE;
        }
    return MEASURED;
}

outcome measure_asks(lineup *l, const workload *w, const questions *asked, int rounds)
{
    peer_answer *expected = malloc(asked->count * sizeof *expected), *given = malloc(asked->count * sizeof *given);
    outcome result = OUT_OF_MEMORY;
    if (expected && given) {
        result = ask_in_rounds(l, w, asked, rounds, expected, given);
        for (int i = 0; i < l->count; i++)
            l->of[i].memory = l->of[i].peer->memory(l->of[i].self);
        tell_medians(l, rounds);
    }
    free(expected);
    free(given);
    return result;
}
