/* SPDX-License-Identifier: MIT */
#include "foreign_session.h"

#define UNDER(id) .has_parent = true, .parent = (id)
#define HOLDS(...)                                                                                                     \
    .has_points = true,                                                                                                \
    .points = {(const uint64_t[]){__VA_ARGS__}, sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t)}

static const octree_game_body bodies[] = {
    {.id = 1, .position = {-900, -700, -800}}, {.id = 2, .position = {-300, 400, -200}},
    {.id = 3, .position = {-700, 100, 300}},   {.id = 4, .position = {-200, -500, 900}},
    {.id = 5, .position = {300, -600, -400}},  {.id = 6, .position = {500, 200, 100}},
    {.id = 7, .position = {700, 800, -900}},   {.id = 8, .position = {900, -100, 600}},
};

static const octree_foreign_node right[FOREIGN_NODES] = {
    {.id = FOREIGN_ROOT, .box = {{-900, -700, -900}, {900, 800, 900}}, .kind = "split x"},
    {.id = FOREIGN_LEFT, UNDER(FOREIGN_ROOT), .box = {{-900, -700, -800}, {-200, 400, 900}}, .kind = "split z"},
    {.id = FOREIGN_RIGHT,
     UNDER(FOREIGN_ROOT),
     .box = {{300, -600, -900}, {900, 800, 600}},
     .kind = "leaf",
     HOLDS(5, 6, 7, 8)},
    {.id = FOREIGN_LOW,
     UNDER(FOREIGN_LEFT),
     .box = {{-900, -700, -800}, {-300, 400, -200}},
     .kind = "leaf",
     HOLDS(1, 2)},
    {.id = FOREIGN_HIGH,
     UNDER(FOREIGN_LEFT),
     .box = {{-700, -500, 300}, {-200, 100, 900}},
     .kind = "leaf",
     HOLDS(3, 4)},
};

static const octree_foreign_node wrong[FOREIGN_NODES] = {
    {.id = FOREIGN_ROOT, .box = {{-900, -700, -900}, {900, 800, 900}}, .kind = "split x"},
    {.id = FOREIGN_LEFT, UNDER(FOREIGN_ROOT), .box = {{-900, -700, -800}, {-200, 400, 900}}, .kind = "split z"},
    {.id = FOREIGN_RIGHT,
     UNDER(FOREIGN_ROOT),
     .box = {{300, -600, -900}, {900, 800, 600}},
     .kind = "leaf",
     HOLDS(5, 6, 7)},
    {.id = FOREIGN_LOW,
     UNDER(FOREIGN_LEFT),
     .box = {{-900, -700, -800}, {100, 400, -200}},
     .kind = "leaf",
     HOLDS(1, 2)},
    {.id = FOREIGN_HIGH,
     UNDER(FOREIGN_LEFT),
     .box = {{-700, -500, 300}, {-200, 100, 900}},
     .kind = "leaf",
     HOLDS(3, 4)},
};

static const octree_foreign_tree trees[] = {{.tick = 0, .nodes = right, .node_count = FOREIGN_NODES},
                                            {.tick = 1, .nodes = wrong, .node_count = FOREIGN_NODES}};

static const uint64_t seen[] = {FOREIGN_ROOT, FOREIGN_LEFT, FOREIGN_HIGH}, left_out[] = {FOREIGN_RIGHT, FOREIGN_LOW},
                      too_many[] = {FOREIGN_RIGHT, FOREIGN_LOW, FOREIGN_HIGH}, found[] = {3}, hit[] = {FOREIGN_HIGH};

#define ASKED .kind = OCTREE_QUERY_RANGE, .box = {{-800, -200, 200}, {-250, 300, 700}}

static const octree_query queries[] = {
    {.tick = 0,
     ASKED,
     .answered = true,
     .answer = found,
     .answer_count = 1,
     .visits = {{seen, 3}, {left_out, 2}, {hit, 1}}},
    {.tick = 1, ASKED, .answered = true, .visits = {{seen, 2}, {too_many, 3}}},
};

octree_session foreign_session(void)
{
    octree_session session = octree_session_default();
    session.player = (octree_player){.kind = OCTREE_PLAYER_NONE};
    session.keys = NULL;
    session.ticks = 1;
    session.bodies = bodies;
    session.body_count = sizeof bodies / sizeof bodies[0];
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    session.foreign = trees;
    session.foreign_count = sizeof trees / sizeof trees[0];
    return session;
}
