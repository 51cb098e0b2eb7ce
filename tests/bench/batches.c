/* SPDX-License-Identifier: MIT */
/* batches.c - measures the changes of one game tick: by one call, in a loop, and by building the tree anew. */
#include "batches.h"
#include "measuring.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAME_QUERIES = 1000, FRAME_HITS = 10 };

typedef enum manner { AT_ONCE, SINGLY, ANEW } manner;

/* The points that change, with their positions before and after the tick, and all points before and after it. */
typedef struct ticks {
    octree_point *from, *to;      /* `count` of them */
    octree_point *before, *after; /* all points, in the order of the workload */
    double (*places[2])[3];       /* positions of `from` and of `to` */
    size_t count;
    bool back; /* the next tick moves the points back */
} ticks;

static void ticks_free(ticks *t)
{
    free(t->from);
    free(t->to);
    free(t->before);
    free(t->after);
    free(t->places[0]);
    free(t->places[1]);
}

static bool ticks_make(ticks *t, const workload *w, size_t percent)
{
    uint64_t random = 2;
    *t = (ticks){.count = (w->count * percent + 99) / 100};
    t->from = malloc(t->count * sizeof *t->from);
    t->to = malloc(t->count * sizeof *t->to);
    t->before = malloc(w->count * sizeof *t->before);
    t->after = malloc(w->count * sizeof *t->after);
    for (int end = 0; end < 2; end++)
        t->places[end] = malloc(t->count * sizeof *t->places[end]);
    if (!t->from || !t->to || !t->before || !t->after || !t->places[0] || !t->places[1])
        return false;
    memcpy(t->before, w->points, w->count * sizeof *t->before);
    memcpy(t->after, w->points, w->count * sizeof *t->after);
    for (size_t i = 0; i < t->count; i++) {
        t->from[i] = w->picks[i];
        t->to[i] = workload_step(w, &w->picks[i], &random);
        t->after[t->to[i].id] = t->to[i]; /* ids are indices */
        memcpy(t->places[0][i], t->from[i].position, sizeof t->places[0][i]);
        memcpy(t->places[1][i], t->to[i].position, sizeof t->places[1][i]);
    }
    return true;
}

/* ---- A batch of insertions or removals ---------------------------------------------------------------------- */

static double change(contender *c, manner how, batch_kind kind, const ticks *t)
{
    size_t done = 0;
    const double start = processor_time();
    if (how == SINGLY)
        done = c->peer->change[kind == BATCH_INSERT ? PEER_INSERT : PEER_REMOVE](c->self, t->from, NULL, t->count);
    else if (kind == BATCH_INSERT)
        octree_insert_many(c->self, t->from, t->count, NULL, &done);
    else
        octree_remove_many(c->self, t->from, t->count, NULL, &done);
    const double time = processor_time() - start;
    return done == t->count ? time / (double)t->count : NAN;
}

/* Every round does both; the time of the requested one is returned. */
static bool change_in_rounds(contender *c, manner how, batch_kind kind, const ticks *t, int round)
{
    const double removal = change(c, how, BATCH_REMOVE, t), insertion = change(c, how, BATCH_INSERT, t);
    c->round_ns[round] = kind == BATCH_INSERT ? insertion : removal;
    return !isnan(removal) && !isnan(insertion);
}

/* ---- Moves, and a frame --------------------------------------------------------------------------------------------
 */

static size_t move(contender *c, manner how, const ticks *t, size_t all)
{
    const octree_point *from = t->back ? t->to : t->from, *to = t->back ? t->from : t->to;
    size_t done = 0;
    if (how == SINGLY)
        return c->peer->change[PEER_MOVE](c->self, from, to, t->count);
    if (how == AT_ONCE) {
        octree_move_many(c->self, from, (const double(*)[3])t->places[!t->back], t->count, NULL, &done);
        return done;
    }
    const octree_point *points = t->back ? t->before : t->after;
    if (c->peer == &peer_octree)
        octree_replace_all(c->self, points, all, NULL, &done);
    else
        done = c->peer->change[PEER_BUILD](c->self, points, NULL, all);
    return done == all ? t->count : 0;
}

static bool move_once(contender *c, manner how, const workload *w, const ticks *t, int round)
{
    const double start = processor_time();
    const size_t moved = move(c, how, t, w->count);
    c->round_ns[round] = (processor_time() - start) / (double)t->count;
    return moved == t->count;
}

static bool play_frame(contender *c, manner how, const workload *w, const ticks *t, int round, peer_answer *answers)
{
    const size_t queries = w->query_count < FRAME_QUERIES ? w->query_count : FRAME_QUERIES;
    const double start = processor_time();
    const size_t moved = move(c, how == AT_ONCE && t->count == w->count ? ANEW : how, t, w->count);
    c->peer->ask[PEER_BOX](c->self, w->targets, queries, answers);
    c->peer->ask[PEER_NEAREST](c->self, w->targets, queries, answers + FRAME_QUERIES);
    c->round_ns[round] = processor_time() - start;
    return moved == t->count;
}

/* ---- Who takes part ----------------------------------------------------------------------------------------- */

static const struct {
    const char *who;
    const peer *peer;
    manner how;
} entries[] = {{"octree", &peer_octree, AT_ONCE},
               {"octree-singly", &peer_octree, SINGLY},
               {"octree-anew", &peer_octree, ANEW},
               {"grid-anew", &peer_grid, ANEW}};

enum { ENTRIES = sizeof entries / sizeof entries[0] };

static bool enter_entries(lineup *l, const workload *w, batch_kind kind)
{
    for (int i = 0; i < (kind == BATCH_FRAME ? ENTRIES : 2); i++) {
        contender *c = &l->of[l->count++];
        *c = (contender){.who = entries[i].who, .peer = entries[i].peer, .points = w->count};
        c->self = c->peer->create(&w->world);
        if (!c->self || c->peer->change[PEER_BUILD](c->self, w->points, NULL, w->count) != w->count)
            return false;
    }
    return true;
}

static outcome play_rounds(lineup *l, const workload *w, const char *op, batch_kind kind, ticks *t, int rounds)
{
    static peer_answer answers[ENTRIES][2 * FRAME_QUERIES];
    for (int round = 0; round < rounds; round++, t->back = !t->back)
        for (int i = 0; i < l->count; i++) {
            contender *c = &l->of[i];
            const bool done = kind == BATCH_FRAME  ? play_frame(c, entries[i].how, w, t, round, answers[i])
                              : kind == BATCH_MOVE ? move_once(c, entries[i].how, w, t, round)
                                                   : change_in_rounds(c, entries[i].how, kind, t, round);
            if (!done) {
                fprintf(stderr, "octree-bench: %s: %s did not make all changes\n", op, c->who);
                return UNLIKE;
            }
            for (int q = 0; kind == BATCH_FRAME && q < 2; q++)
                if (measure_compare(l, i, op, w, w->query_count < FRAME_QUERIES ? w->query_count : FRAME_QUERIES,
                                    answers[0] + q * FRAME_QUERIES, answers[i] + q * FRAME_QUERIES) != MEASURED)
                    return UNLIKE;
        }
    return MEASURED;
}

outcome measure_batches(lineup *l, workload *w, const char *op, batch_kind kind, size_t percent, int rounds)
{
    ticks t;
    outcome result = OUT_OF_MEMORY;
    if (ticks_make(&t, w, percent) && workload_size_targets(w, PEER_BOX, FRAME_HITS) && enter_entries(l, w, kind))
        result = play_rounds(l, w, op, kind, &t, rounds);
    for (int i = 0; i < l->count; i++) {
        contender *c = &l->of[i];
        c->ns = median(c->round_ns, (size_t)rounds);
        c->memory = c->self ? c->peer->memory(c->self) : 0;
        c->peer->destroy(c->self);
        c->self = NULL;
    }
    ticks_free(&t);
    return result;
}
