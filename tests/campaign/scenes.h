/* SPDX-License-Identifier: MIT */
/* scenes.h - worlds, and the places in them where a campaign puts its points: ordinary and extreme ones. */
#ifndef CAMPAIGN_SCENES_H
#define CAMPAIGN_SCENES_H

#include "octree/octree.h"

enum { PLACES_AT_MOST = 1024 };

typedef struct scene {
    const char *name;
    octree_box world;
    double places[PLACES_AT_MOST][3]; /* places in the world, which points share and queries use */
    size_t count;
    double focus[3]; /* centre of mirrored places; in other scenes any place of the world */
} scene;

/* The number of scenes, and the name of each: null from there on. */
size_t scene_kinds(void);
const char *scene_name(size_t kind);

/* Fill a scene with at most PLACES_AT_MOST places. */
void scene_make(scene *s, size_t kind, size_t count, uint64_t *random);

/* The double a number of steps up or down, zeros of either sign being one, and not beyond the finite ones. */
double scene_nudge(double value, int steps);

#endif
