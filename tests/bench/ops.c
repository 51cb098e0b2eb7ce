/* ops.c - the operations of the bench, and the trees that each is measured on. */
#include "ops.h"

#include "peers.h"

const op all_ops[OPS] = {
    {"build", STAGE_FILL, .change = PEER_BUILD, .goal = {AT_LEAST, 3}},
    {"insert", STAGE_FILL, .change = PEER_INSERT, .goal = {AT_LEAST, 3}},
    {"remove", STAGE_DYNAMIC, .change = PEER_REMOVE, .goal = {AT_LEAST, 3}},
    {"move", STAGE_DYNAMIC, .change = PEER_MOVE, .goal = {AT_LEAST, 4}},
    {"move_far", STAGE_DYNAMIC, .change = PEER_MOVE, .far = true, .goal = {AT_LEAST, 3}},
    {"find", STAGE_STATIC, ASKS, PEER_FIND, .stored = true, .most = 100000, .goal = {AT_LEAST, 2}},
    {"find_miss", STAGE_STATIC, ASKS, PEER_FIND, .most = 100000, .goal = {AT_LEAST, 2}},
    {"box10", STAGE_STATIC, ASKS, PEER_BOX, .hits = 10, .most = 50000, .goal = {AT_LEAST, 2}},
    {"box1000", STAGE_STATIC, ASKS, PEER_BOX, .hits = 1000, .most = 5000, .goal = {AT_LEAST, 2}},
    {"radius100", STAGE_STATIC, ASKS, PEER_RADIUS, .hits = 100, .most = 20000, .goal = {AT_LEAST, 2}},
    {"collide", STAGE_STATIC, ASKS, PEER_COLLIDE, .hits = 10, .most = 50000},
    {"nearest", STAGE_STATIC, ASKS, PEER_NEAREST, .most = 100000, .goal = {AT_LEAST, 2}},
    {"knn8", STAGE_STATIC, ASKS, PEER_KNN, .most = 50000, .goal = {AT_LEAST, 2}},
    {"nearest_batch", STAGE_STATIC, ASKS, PEER_NEAREST_BATCH, "octree-singly", PEER_NEAREST, .most = 100000,
     .goal = {AT_LEAST, 1.5}},
    {"nearest_all", STAGE_STATIC, ASKS, PEER_NEAREST_ALL, "octree-singly", PEER_NEAREST, .most = 100000},
    {"nearest_fast", STAGE_STATIC, ASKS, PEER_NEAREST_FAST, "octree-exact", PEER_NEAREST, .most = 100000,
     .goal = {AT_MOST, 1.1}},
    {"nearest_churned", STAGE_CHURNED, ASKS, PEER_NEAREST, "octree-fresh", PEER_NEAREST, .most = 100000,
     .goal = {AT_LEAST, 1 / 1.15}},
};

static bool asks(const op *o)
{
    return o->change == PEER_CHANGES;
}

static void enter(lineup *l, const char *who, const peer *p)
{
    l->of[l->count++] = (contender){.who = who, .peer = p};
}

/* Fill the trees of all peers that can be filled in this way. False when there is no memory. */
static bool fill_all(lineup *l, peer_change_kind change, const workload *w)
{
    *l = (lineup){0};
    for (int i = 0; all_peers[i]; i++) {
        const peer *p = all_peers[i];
        if (!p->change[change])
            continue;
        enter(l, p->name, p);
        contender *c = &l->of[l->count - 1];
        c->self = p->create(&w->world);
        if (!c->self || p->change[change](c->self, w->points, NULL, w->count) != w->count)
            return false;
    }
    return true;
}

/* An octree from which the picks were removed again, and one that holds what is left from the beginning. */
static bool fill_churned(lineup *l, const workload *w)
{
    *l = (lineup){0};
    enter(l, peer_octree.name, &peer_octree);
    enter(l, "octree-fresh", &peer_octree);
    void *churned = l->of[0].self = peer_octree.create(&w->world);
    void *fresh = l->of[1].self = peer_octree.create(&w->world);
    if (!churned || !fresh)
        return false;
    return peer_octree.change[PEER_INSERT](churned, w->points, NULL, w->count) == w->count &&
           peer_octree.change[PEER_REMOVE](churned, w->picks, NULL, w->pick_count) == w->pick_count &&
           peer_octree.change[PEER_BUILD](fresh, w->rest, NULL, w->count - w->pick_count) == w->count - w->pick_count;
}

static bool fill_stage(lineup *l, stage at, const workload *w)
{
    switch (at) {
    case STAGE_DYNAMIC:
        return fill_all(l, PEER_INSERT, w);
    case STAGE_STATIC:
        return fill_all(l, PEER_BUILD, w);
    case STAGE_CHURNED:
        return fill_churned(l, w);
    default:
        *l = (lineup){0};
        return true;
    }
}

static void empty_stage(lineup *l)
{
    for (int i = 0; i < l->count; i++)
        if (l->of[i].self)
            l->of[i].peer->destroy(l->of[i].self);
}

/* Those of the stage that can do it; the octree is the first in every stage. */
static lineup choose(const op *o, const lineup *all)
{
    lineup chosen = {0};
    for (int i = 0; o->stage == STAGE_FILL && all_peers[i]; i++)
        if (all_peers[i]->change[o->change])
            enter(&chosen, all_peers[i]->name, all_peers[i]);
    for (int i = 0; i < all->count; i++) {
        contender c = all->of[i];
        c.ask = asks(o) ? c.peer->ask[o->ask] : NULL;
        if ((asks(o) && !c.ask) || (o->stage == STAGE_STATIC && o->rival && i))
            continue;
        chosen.of[chosen.count++] = c;
    }
    if (o->stage == STAGE_STATIC && o->rival) {
        chosen.of[1] = chosen.of[0];
        chosen.of[1].who = o->rival;
        chosen.of[1].ask = chosen.of[0].peer->ask[o->rival_ask];
        chosen.count = 2;
    }
    return chosen;
}

static outcome run_asks(const op *o, lineup *l, workload *w, int rounds)
{
    if (o->hits && !workload_size_targets(w, o->ask, o->hits))
        return OUT_OF_MEMORY;
    const questions asked = {.op = o->name,
                             .queries = o->stored ? w->stored : w->targets,
                             .count = w->query_count < o->most ? w->query_count : o->most};
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

static bool stage_is_wanted(const bool wanted[OPS], stage at)
{
    for (int i = 0; i < OPS; i++)
        if (wanted[i] && all_ops[i].stage == at)
            return true;
    return false;
}

static outcome run_stage(const bool wanted[OPS], stage at, workload *w, int rounds, report_op *report, void *context)
{
    lineup all;
    outcome result = fill_stage(&all, at, w) ? MEASURED : OUT_OF_MEMORY;
    for (int i = 0; result == MEASURED && i < OPS; i++) {
        const op *o = &all_ops[i];
        if (!wanted[i] || o->stage != at)
            continue;
        lineup chosen = choose(o, &all);
        result = asks(o) ? run_asks(o, &chosen, w, rounds) : run_changes(o, &chosen, w, rounds);
        if (result == MEASURED)
            report(o, w, &chosen, context);
    }
    empty_stage(&all);
    return result;
}

outcome run_ops(const bool wanted[OPS], workload *w, int rounds, report_op *report, void *context)
{
    /* Changes are proved by asking for the points about the targets. */
    outcome result = workload_size_targets(w, PEER_RADIUS, 20) ? MEASURED : OUT_OF_MEMORY;
    for (int at = 0; result == MEASURED && at < STAGES; at++)
        if (stage_is_wanted(wanted, (stage)at))
            result = run_stage(wanted, (stage)at, w, rounds, report, context);
    return result;
}
