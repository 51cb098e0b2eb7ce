/* SPDX-License-Identifier: MIT */
/* workload.c - see workload.h. */
#include "workload.h"

#include <math.h>
#include <string.h>

#include "fixture.h"
#include "point_world.h"
#include "quick_oracle.h"
#include "must.h"

enum { SEED = 7, SESSION_TICKS = 24 };

static workload allocate(const char *name, octree_box world, size_t points, size_t targets)
{
    workload w = {.name = name, .world = world, .count = points, .target_count = targets};
    w.points = resize_memory(NULL, points * sizeof *w.points);
    w.targets = resize_memory(NULL, targets * sizeof *w.targets);
    return w;
}

void workload_free(workload *w)
{
    free(w->points);
    free(w->targets);
    free(w->truth);
    *w = (workload){0};
}

const true_neighbors *workload_truth(workload *w)
{
    if (w->truth)
        return (const true_neighbors *)w->truth;
    if (w->count < TRUE_NEIGHBORS)
        stop_with_error("%s has %zu points; at least %d are needed", w->name, w->count, TRUE_NEIGHBORS);
    w->truth = resize_memory(NULL, w->target_count * sizeof *w->truth);
    for (size_t i = 0; i < w->target_count; i++)
        quick_nearest_k(w->points, w->count, w->targets[i], TRUE_NEIGHBORS, w->truth[i]);
    return (const true_neighbors *)w->truth;
}

octree *workload_tree(const workload *w, size_t capacity, size_t depth)
{
    const octree_def def = define(w->world, capacity, depth, OCTREE_GROW);
    octree *tree;
    size_t inserted;
    must(octree_create(&def, &tree));
    must(octree_insert_many(tree, w->points, w->count, NULL, &inserted));
    if (inserted != w->count)
        stop_with_error("%s: the tree took %zu of %zu points", w->name, inserted, w->count);
    return tree;
}

static void keep_inside(double at[3], const octree_box *world)
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = fmin(fmax(at[axis], world->min[axis]), world->max[axis]);
}

workload workload_sample(const char *name, octree_sample_kind kind, octree_box world, size_t points, size_t targets)
{
    workload w = allocate(name, world, points, targets);
    double(*rows)[3] = resize_memory(NULL, (points + targets) * sizeof *rows);
    must(octree_sample(kind, SEED, &world, points + targets, rows));
    for (size_t i = 0; i < points; i++) {
        w.points[i].id = i;
        memcpy(w.points[i].position, rows[i], sizeof rows[i]);
    }
    memcpy(w.targets, rows + points, targets * sizeof *rows);
    free(rows);
    return w;
}

/* Targets halfway between two points: ties, in exact numbers. */
static workload make_lattice(const char *name, size_t points, size_t targets)
{
    workload w = workload_sample(name, OCTREE_SAMPLE_LATTICE, cube(-1000, 1000), points, targets);
    uint64_t random = SEED;
    for (size_t i = 0; i < targets; i++) {
        const octree_point *p = &w.points[random_below(&random, points - 1)];
        for (int axis = 0; axis < 3; axis++)
            w.targets[i][axis] = (p[0].position[axis] + p[1].position[axis]) / 2;
    }
    return w;
}

/* i * 0.1 and, for targets, (i + 1/2) * 0.1: what would be eight ties, and rounding makes near ties. */
static workload make_tenths(const char *name, size_t points, size_t targets)
{
    const size_t side = (size_t)cbrt((double)points);
    uint64_t random = SEED;
    workload w = allocate(name, cube(0, (double)side * 0.1), side * side * side, targets);
    for (size_t i = 0; i < w.count; i++)
        w.points[i] = (octree_point){
            {(double)(i / side / side) * 0.1, (double)(i / side % side) * 0.1, (double)(i % side) * 0.1}, i};
    for (size_t i = 0; i < targets; i++)
        for (int axis = 0; axis < 3; axis++)
            w.targets[i][axis] = ((double)random_below(&random, side - 1) + 0.5) * 0.1;
    return w;
}

/* ---- A session ---------------------------------------------------------------------------------------------- */

static octree_game *start(const octree_session *session)
{
    octree_game *game;
    must(octree_game_create(session, &game));
    return game;
}

/* All points of a game's tree, by id. */
static size_t collect(const octree_game *game, octree_point *points, size_t room)
{
    size_t count;
    const octree_box world = octree_definition(octree_game_tree(game)).world;
    must(octree_range_collect_sorted(octree_game_tree(game), &world, NULL, points, room, &count));
    return count < room ? count : room;
}

/* Take in the player's place and those of some points. */
static void add_targets(workload *w, size_t room, const octree_game *game, const octree_point *points, size_t count,
                        size_t share)
{
    if (w->target_count < room)
        memcpy(w->targets[w->target_count++], octree_game_tick(game)->player, sizeof *w->targets);
    for (size_t i = 0; i < share && w->target_count < room; i++)
        memcpy(w->targets[w->target_count++], points[i * count / share].position, sizeof *w->targets);
}

static workload play(const char *name, const octree_session *session, size_t targets)
{
    octree_game *game = start(session);
    const octree_box world = octree_definition(octree_game_tree(game)).world;
    const size_t room = session->body_count + session->edit_count + 1;
    const uint64_t ticks = octree_session_length(session) + 1;
    workload w = allocate(name, world, room, targets);
    w.target_count = 0;
    while (w.count = collect(game, w.points, room), !octree_game_over(game)) {
        const size_t share = targets / (size_t)ticks;
        add_targets(&w, targets, game, w.points, w.count, share < w.count ? share : w.count);
        must(octree_game_advance(game));
    }
    octree_game_destroy(game);
    if (w.target_count == 0)
        stop_with_error("the session has no tick before its last: there is no place to ask about");
    for (size_t i = 0; i < w.count; i++)
        w.points[i].id = i;
    return w;
}

/* Clusters that come apart, and a player among them. */
static workload play_clusters(const char *name, size_t points, size_t targets)
{
    static const char keys[SESSION_TICKS + 1] = "ddddwwwweeeeaaaassssffff";
    octree_game_body *bodies = resize_memory(NULL, points * sizeof *bodies);
    workload sample = workload_sample(name, OCTREE_SAMPLE_CLUSTERED, cube(-1000, 1000), points, 1);
    uint64_t random = SEED;
    for (size_t i = 0; i < points; i++) {
        bodies[i] = (octree_game_body){.id = i + 1};
        memcpy(bodies[i].position, sample.points[i].position, sizeof bodies[i].position);
        for (int axis = 0; axis < 3; axis++)
            bodies[i].velocity[axis] = random_between(&random, -4, 4);
    }
    octree_session session = {.tree = define(cube(-1000, 1000), 64, 21, OCTREE_GROW), .bodies = bodies, .keys = keys};
    session.body_count = points;
    session.player = (octree_player){.step = 40, .box_size = 8};
    workload w = play(name, &session, targets);
    workload_free(&sample);
    free(bodies);
    return w;
}

/* ---- A cloud ------------------------------------------------------------------------------------------------ */

/* Some of its points are targets, and others the points. */
static workload divide_cloud(const char *name, const cloud *read, size_t points, size_t targets)
{
    size_t *order = resize_memory(NULL, read->count * sizeof *order);
    uint64_t random = SEED;
    for (size_t i = 0; i < read->count; i++) {
        const size_t j = random_below(&random, i + 1);
        order[i] = order[j];
        order[j] = i;
    }
    targets = targets < read->count / 4 ? targets : read->count / 4;
    points = points < read->count - targets ? points : read->count - targets;
    workload w =
        allocate(name, find_point_world(read->positions, sizeof *read->positions, read->count), points, targets);
    for (size_t i = 0; i < points; i++) {
        memcpy(w.points[i].position, read->positions[order[i]], sizeof w.points[i].position);
        w.points[i].id = i;
    }
    for (size_t i = 0; i < targets; i++)
        memcpy(w.targets[i], read->positions[order[points + i]], sizeof *w.targets);
    free(order);
    return w;
}

/* ---- All of them -------------------------------------------------------------------------------------------- */

static void add(workloads *all, workload w, bool ordinary)
{
    for (size_t i = 0; i < w.target_count; i++)
        keep_inside(w.targets[i], &w.world);
    w.ordinary = ordinary;
    all->of[all->count++] = w;
}

void workloads_make(workloads *all, size_t points, size_t targets, const octree_session *session, const cloud *read)
{
    static const struct {
        const char *name;
        octree_sample_kind kind;
        octree_box world;
        bool ordinary;
    } samples[] = {
        {"uniform", OCTREE_SAMPLE_UNIFORM, {{-1000, -1000, -1000}, {1000, 1000, 1000}}, true},
        {"gaussian", OCTREE_SAMPLE_GAUSSIAN, {{-1000, -1000, -1000}, {1000, 1000, 1000}}, true},
        {"clustered", OCTREE_SAMPLE_CLUSTERED, {{-1000, -1000, -1000}, {1000, 1000, 1000}}, true},
        {"surface", OCTREE_SAMPLE_SURFACE, {{-1000, -1000, -1000}, {1000, 1000, 1000}}, true},
        {"offset-1e12", OCTREE_SAMPLE_CLUSTERED, {{1e12, 1e12, 1e12}, {1e12 + 1000, 1e12 + 1000, 1e12 + 1000}}, false},
        {"scale-1e-310", OCTREE_SAMPLE_UNIFORM, {{-1e-310, -1e-310, -1e-310}, {1e-310, 1e-310, 1e-310}}, false},
        {"scale-1e200", OCTREE_SAMPLE_CLUSTERED, {{-1e200, -1e200, -1e200}, {1e200, 1e200, 1e200}}, false},
    };
    *all = (workloads){0};
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++)
        add(all, workload_sample(samples[i].name, samples[i].kind, samples[i].world, points, targets),
            samples[i].ordinary);
    add(all, make_lattice("lattice", points, targets), false);
    add(all, make_tenths("lattice-0.1", points, targets), false);
    add(all, session ? play("session", session, targets) : play_clusters("session", points, targets), true);
    if (read)
        add(all, divide_cloud("cloud", read, points, targets), true);
}

void workloads_free(workloads *all)
{
    for (size_t i = 0; i < all->count; i++)
        workload_free(&all->of[i]);
}
