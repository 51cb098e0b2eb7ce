/* SPDX-License-Identifier: MIT */
/* ops.c - the operations of the bench, and the trees on which each is measured. */
#include "ops.h"

#include "peers.h"

/* The goal was 1.5 when a search took twice as long; now each single search prefetches what only a batch shared before.
 */
#define SINGLE_SEARCHES "no goal on one thread: single searches prefetch as well; an executor divides a batch"
#define GRID "where so much moves each tick and points are spread evenly, use a grid that is built anew"

const op all_ops[OPS] = {
    {"build", STAGE_FILL, .change = PEER_BUILD, .goal = {AT_LEAST, 3}},
    {"insert", STAGE_FILL, .change = PEER_INSERT, .goal = {AT_LEAST, 3}},
    {"remove", STAGE_DYNAMIC, .change = PEER_REMOVE, .goal = {AT_LEAST, 3}},
    {"move", STAGE_DYNAMIC, .change = PEER_MOVE, .goal = {AT_LEAST, 4}},
    {"move_far", STAGE_DYNAMIC, .change = PEER_MOVE, .far = true, .goal = {AT_LEAST, 3}},
    {"find", STAGE_STATIC, .ask = PEER_FIND, .most = 100000, .stored = true, .goal = {AT_LEAST, 2}},
    {"find_miss", STAGE_STATIC, .ask = PEER_FIND, .most = 100000, .goal = {AT_LEAST, 2}},
    {"box10", STAGE_STATIC, .ask = PEER_BOX, .most = 50000, .hits = 10, .goal = {AT_LEAST, 2}},
    {"box1000", STAGE_STATIC, .ask = PEER_BOX, .most = 5000, .hits = 1000, .goal = {AT_LEAST, 2}},
    {"radius100", STAGE_STATIC, .ask = PEER_RADIUS, .most = 20000, .hits = 100, .goal = {AT_LEAST, 2}},
    {"collide", STAGE_STATIC, .ask = PEER_COLLIDE, .most = 50000, .hits = 10},
    {"nearest", STAGE_STATIC, .ask = PEER_NEAREST, .most = 100000, .goal = {AT_LEAST, 1}},
    {"knn8", STAGE_STATIC, .ask = PEER_KNN, .most = 50000, .goal = {AT_LEAST, 1}},
    {"nearest_sorted", STAGE_STATIC, .ask = PEER_NEAREST, .most = 100000, .sorted = true, .goal = {AT_LEAST, 1}},
    {"knn8_sorted", STAGE_STATIC, .ask = PEER_KNN, .most = 50000, .sorted = true, .goal = {AT_LEAST, 1}},
    {"nearest_first", STAGE_STATIC, .ask = PEER_NEAREST, .most = 100, .cold = true, .goal = {AT_LEAST, 1}},
    {"knn8_first", STAGE_STATIC, .ask = PEER_KNN, .most = 100, .cold = true, .goal = {AT_LEAST, 1}},
    {"nearest_batch", STAGE_STATIC, .ask = PEER_NEAREST_BATCH, .most = 100000, .rival = "octree-singly",
     .rival_ask = PEER_NEAREST, .note = SINGLE_SEARCHES},
    {"nearest_all", STAGE_STATIC, .ask = PEER_NEAREST_ALL, .most = 100000, .rival = "octree-singly",
     .rival_ask = PEER_NEAREST, .note = SINGLE_SEARCHES},
    {"nearest_fast", STAGE_STATIC, .ask = PEER_NEAREST_FAST, .most = 100000, .rival = "octree-exact",
     .rival_ask = PEER_NEAREST, .goal = {AT_MOST, 1.1}},
    {"nearest_churned", STAGE_CHURNED, .ask = PEER_NEAREST, .most = 100000, .goal = {AT_LEAST, 1 / 1.15}},
    {"insert_1%", STAGE_BATCHES, .batch = BATCH_INSERT, .percent = 1, .goal = {AT_LEAST, 1.5}},
    {"insert_10%", STAGE_BATCHES, .batch = BATCH_INSERT, .percent = 10, .goal = {AT_LEAST, 1.5}},
    {"remove_1%", STAGE_BATCHES, .batch = BATCH_REMOVE, .percent = 1, .goal = {AT_LEAST, 1.5}},
    {"remove_10%", STAGE_BATCHES, .batch = BATCH_REMOVE, .percent = 10, .goal = {AT_LEAST, 1.5}},
    {"move_1%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 1, .goal = {AT_LEAST, 1 / 1.15}},
    {"move_5%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 5, .goal = {AT_LEAST, 1 / 1.15}},
    {"move_20%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 20, .goal = {AT_LEAST, 1 / 1.15}},
    {"move_30%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 30, .goal = {AT_LEAST, 1}},
    {"move_50%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 50, .goal = {AT_LEAST, 1.5}},
    {"move_100%", STAGE_BATCHES, .batch = BATCH_MOVE, .percent = 100, .goal = {AT_LEAST, 1.5}},
    {"frame_1%", STAGE_BATCHES, .batch = BATCH_FRAME, .percent = 1},
    {"frame_10%", STAGE_BATCHES, .batch = BATCH_FRAME, .percent = 10, .note = GRID},
    {"frame_100%", STAGE_BATCHES, .batch = BATCH_FRAME, .percent = 100, .note = GRID},
    {"auto_mixed", STAGE_TUNED, .ask = PEER_MIXED, .most = 50000, .hits = 10, .mix = {1, 1, 1, 1, 10},
     .goal = {AT_LEAST, 1 / 1.2}},
    {"auto_find", STAGE_TUNED, .ask = PEER_FIND, .most = 100000, .stored = true, .mix = {.changes = 1},
     .goal = {AT_LEAST, 1 / 1.2}},
    {"auto_nearest", STAGE_TUNED, .ask = PEER_NEAREST, .most = 100000, .mix = {.nearest = 1, .k = 1},
     .goal = {AT_LEAST, 1 / 1.2}},
    {"auto_knn8", STAGE_TUNED, .ask = PEER_KNN, .most = 50000, .mix = {.nearest = 1, .k = PEER_NEIGHBORS},
     .goal = {AT_LEAST, 1 / 1.2}},
    {"auto_box1000", STAGE_TUNED, .ask = PEER_BOX, .most = 5000, .hits = 1000, .mix = {.ranges = 1, .hits = 1000},
     .goal = {AT_LEAST, 1 / 1.2}},
};

static bool asks(const op *o)
{
    return o->stage == STAGE_STATIC || o->stage == STAGE_CHURNED || o->stage == STAGE_TUNED;
}

static contender *enter(lineup *l, const char *who, const peer *p, size_t points)
{
    contender *c = &l->of[l->count++];
    *c = (contender){.who = who, .peer = p, .points = points};
    return c;
}

static void enter_all(lineup *l, const workload *w)
{
    for (int i = 0; all_peers[i]; i++)
        enter(l, all_peers[i]->name, all_peers[i], w->count);
}

static bool fill(contender *c, const workload *w, peer_change_kind change, const octree_point *points, size_t count)
{
    c->self = c->peer->create(&w->world);
    return c->self && c->peer->change[change](c->self, points, NULL, count) == count;
}

/* Fill the trees of all peers that have this operation. */
static bool fill_all(lineup *l, const workload *w, peer_change_kind change)
{
    for (int i = 0; all_peers[i]; i++) {
        const peer *p = all_peers[i];
        if (p->change[change] && !fill(enter(l, p->name, p, w->count), w, change, w->points, w->count))
            return false;
    }
    return true;
}

/* An octree from which half of the points were removed, and one that never held them. */
static bool fill_churned(lineup *l, const workload *w)
{
    const size_t left = w->count - w->half;
    contender *churned = enter(l, peer_octree.name, &peer_octree, left);
    contender *fresh = enter(l, "octree-fresh", &peer_octree, left);
    return fill(churned, w, PEER_INSERT, w->points, w->count) &&
           peer_octree.change[PEER_REMOVE](churned->self, w->picks, NULL, w->half) == w->half &&
           fill(fresh, w, PEER_BUILD, w->picks + w->half, left);
}

/* An octree that is tuned for each operation before it is measured, and octrees of all capacities, which must not be
 * faster. */
static bool fill_tuned(lineup *l, const workload *w)
{
    static const struct {
        size_t capacity;
        const char *who;
    } rivals[] = {
        {64, "octree"},       {8, "octree-of-8"},     {16, "octree-of-16"},   {32, "octree-of-32"},
        {64, "octree-of-64"}, {128, "octree-of-128"}, {256, "octree-of-256"},
    };
    for (size_t i = 0; i < sizeof rivals / sizeof rivals[0]; i++) {
        contender *c = enter(l, rivals[i].who, &peer_octree, w->count);
        c->self = make_octree(&w->world, rivals[i].capacity);
        if (!c->self || peer_octree.change[PEER_BUILD](c->self, w->points, NULL, w->count) != w->count)
            return false;
    }
    return true;
}

static bool fill_stage(lineup *l, stage at, const workload *w)
{
    switch (at) {
    case STAGE_DYNAMIC:
        return fill_all(l, w, PEER_INSERT);
    case STAGE_STATIC:
        return fill_all(l, w, PEER_BUILD);
    case STAGE_CHURNED:
        return fill_churned(l, w);
    case STAGE_TUNED:
        return fill_tuned(l, w);
    case STAGE_BATCHES:
        return true;
    default:
        enter_all(l, w);
        return true;
    }
}

static void empty_stage(lineup *l)
{
    for (int i = 0; i < l->count; i++)
        if (l->of[i].self)
            l->of[i].peer->destroy(l->of[i].self);
}

/* The contenders of the stage that have this operation; the octree is first in every stage. */
static lineup choose(const op *o, const lineup *all)
{
    lineup chosen = {0};
    for (int i = 0; i < all->count; i++) {
        contender c = all->of[i];
        c.ask = c.peer->ask[o->ask];
        if (asks(o) ? c.ask != NULL : c.peer->change[o->change] != NULL)
            chosen.of[chosen.count++] = c;
    }
    if (o->rival) {
        chosen.of[1] = chosen.of[0];
        chosen.of[1].who = o->rival;
        chosen.of[1].ask = chosen.of[1].peer->ask[o->rival_ask];
        chosen.count = 2;
    }
    return chosen;
}

static outcome run_asks(const op *o, lineup *l, workload *w, int rounds)
{
    if (o->hits && !workload_size_targets(w, o->ask, o->hits))
        return OUT_OF_MEMORY;
    const questions asked = {.op = o->name,
                             .queries = o->stored   ? w->stored
                                        : o->sorted ? w->sorted
                                                    : w->targets,
                             .count = w->query_count < o->most ? w->query_count : o->most,
                             .cold = o->cold};
    return measure_asks(l, w, &asked, rounds);
}

static outcome run_changes(const op *o, lineup *l, const workload *w, int rounds)
{
    const bool fills = o->stage == STAGE_FILL;
    const changes asked = {.op = o->name,
                           .kind = o->change,
                           .points = fills ? w->points : w->picks,
                           .to = o->far ? w->far : w->near,
                           .count = fills ? w->count : w->query_count};
    return measure_changes(l, w, &asked, rounds);
}

static outcome run_op(const op *o, lineup *l, workload *w, int rounds)
{
    if (o->stage == STAGE_BATCHES)
        return measure_batches(l, w, o->name, o->batch, o->percent, rounds);
    return asks(o) ? run_asks(o, l, w, rounds) : run_changes(o, l, w, rounds);
}

static bool stage_is_wanted(const bool wanted[OPS], stage at)
{
    for (int i = 0; i < OPS; i++)
        if (wanted[i] && all_ops[i].stage == at)
            return true;
    return false;
}

static outcome run_stage(const bool wanted[OPS], stage at, workload *w, int rounds, report_op *report, void *context)
{
    lineup all = {0};
    outcome result = fill_stage(&all, at, w) ? MEASURED : OUT_OF_MEMORY;
    for (int i = 0; result == MEASURED && i < OPS; i++) {
        const op *o = &all_ops[i];
        if (!wanted[i] || o->stage != at)
            continue;
        lineup chosen = choose(o, &all);
        if (at == STAGE_TUNED && octree_tune(all.of[0].self, &o->mix) != OCTREE_OK)
            return OUT_OF_MEMORY;
        result = run_op(o, &chosen, w, rounds);
        if (result == MEASURED)
            report(o, w, &chosen, context);
    }
    empty_stage(&all);
    return result;
}

outcome run_ops(const bool wanted[OPS], workload *w, int rounds, report_op *report, void *context)
{
    /* Changes are checked by queries for the points around the targets. */
    outcome result = workload_size_targets(w, PEER_RADIUS, 20) ? MEASURED : OUT_OF_MEMORY;
    for (int at = 0; result == MEASURED && at < STAGES; at++)
        if (stage_is_wanted(wanted, (stage)at))
            result = run_stage(wanted, (stage)at, w, rounds, report, context);
    return result;
}
