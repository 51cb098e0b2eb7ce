/* SPDX-License-Identifier: MIT */
/* pick.h - what is drawn at a pixel of a recording's frame: plays the session to its tick, makes the scene again, and
 * names the elements at that pixel. */
#ifndef REPLAY_PICK_H
#define REPLAY_PICK_H

#include "describe.h"
#include "folder.h"
#include "image.h"
#include "pixel.h"
#include "playback.h"

#include <stdio.h>

typedef struct pick_options {
    int x, y;
    int radius; /* where nothing is drawn at (x, y), the nearest drawn pixel within this distance is taken */
    renderer_choice renderer;
} pick_options;

/* An element at a pixel; see draw_touch. */
typedef struct pick_element {
    draw_touch touch;
    scene_kind kind;
    const char *layer;
    bool in_closeup;
    element_subject subject;
    octree_foreign_place place; /* copies of what subject.foreign shows: the game may end before the pick */
    octree_foreign_node node;
} pick_element;

typedef struct pick {
    const char *path; /* of the frame; the caller's */
    uint64_t tick;
    int width, height;
    int samples; /* of a pixel */
    int asked[2];
    int pixel[2]; /* the pixel that is described: the same, or the nearest on which anything is drawn */
    int radius;
    image_color color;      /* of the frame at `pixel` */
    pick_element *elements; /* from the top down */
    size_t count;           /* 0: nothing is drawn within the radius */
} pick;

/* False with an error where `path` is no frame of a recording, the recording beside it is not the one that it is
 * of, or the pixel is outside. */
bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error);
void pick_release(pick *p);

/* Find what is at a pixel of the scene that a playback has made last, by a renderer of its size: fills samples, pixel,
 * elements and count by what else is set. */
bool pick_scene(pick *p, const playback *from, renderer *r, octreel_error *error);

/* Print for people, or one JSON object on one line. */
void pick_print(FILE *out, const pick *p, bool json);

#endif
