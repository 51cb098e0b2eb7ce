/* SPDX-License-Identifier: MIT */
/* filmed_scenes.c - see filmed_scenes.h. */
#include "filmed_scenes.h"
#include "octree/sample.h"

#include <stdlib.h>
#include <string.h>

const filmed_scene filmed_scenes[FILMED_SCENES] = {
    {"S", "the default session, still camera", 0, CAMERA_ISO, 2, 250000, 10, 0, true, 1, 10, 60, 253, 400, 0},
    {"M", "2,000 clustered points, orbiting camera", 2000, CAMERA_ORBIT, 2, 250000, 10, 0, true, 1, 10, 60, 10000, 0,
     100},
    {"L", "100,000 points, orbiting camera, nothing left out", 100000, CAMERA_ORBIT, 0, 0, 8, 0, true, 2, 15, 15, 0, 0,
     0},
    {"L-lod2", "the same with --lod 2", 100000, CAMERA_ORBIT, 2, 250000, 16, 0, true, 2, 15, 0, 0, 0, 0},
    {"1M-lod2", "1,000,000 points, orbiting camera, --lod 2", 1000000, CAMERA_ORBIT, 2, 250000, 0, 5, false, 10, 20, 0,
     0, 0, 0},
};

view filmed_view(const filmed_scene *scene)
{
    view v = view_default();
    v.width = 1280;
    v.height = 720;
    v.camera = scene->camera;
    v.lod = scene->lod;
    v.budget = scene->budget;
    return v;
}

view filmed_whole_view(const filmed_scene *scene)
{
    view v = filmed_view(scene);
    v.lod = 0;
    v.budget = 0;
    return v;
}

/* Every key that a session has, again and again, without the one that ends it. */
static char *repeat_keys(const char *keys, uint64_t count)
{
    char *repeated = calloc(count + 1, 1);
    const size_t length = strlen(keys);
    for (uint64_t i = 0; repeated && i < count; i++)
        repeated[i] = keys[i % length];
    return repeated;
}

static bool scatter(filmed_session *made, size_t count)
{
    double(*positions)[3] = malloc(count * sizeof *positions);
    made->bodies = calloc(count, sizeof *made->bodies);
    const bool ok = positions && made->bodies &&
                    octree_sample(OCTREE_SAMPLE_CLUSTERED, 1, &made->session.tree.world, count, positions) == OCTREE_OK;
    for (size_t i = 0; ok && i < count; i++) {
        made->bodies[i].id = i + 1;
        memcpy(made->bodies[i].position, positions[i], sizeof positions[i]);
    }
    free(positions);
    return ok;
}

bool filmed_session_make(filmed_session *made, const filmed_scene *scene, uint64_t ticks)
{
    const octree_session paper = octree_session_default();
    *made = (filmed_session){.session = paper};
    made->keys = repeat_keys(scene->points ? "wdwdenasasfn" : paper.keys, ticks - 1);
    bool ok = made->keys != NULL;
    if (scene->points) {
        made->session = (octree_session){.tree = octree_def_default(), .player = {.step = 5, .box_size = 3}};
        made->session.tree.leaf_capacity = 8;
        made->session.tree.full_leaf = OCTREE_GROW;
        ok = ok && scatter(made, scene->points);
        made->session.bodies = made->bodies;
        made->session.body_count = scene->points;
    }
    made->session.keys = made->keys;
    if (!ok)
        filmed_session_release(made);
    return ok;
}

void filmed_session_release(filmed_session *made)
{
    free(made->bodies);
    free(made->keys);
    *made = (filmed_session){0};
}
