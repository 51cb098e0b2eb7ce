/* SPDX-License-Identifier: MIT */
/* pick.h - lists what is drawn at a pixel of a recorded frame: replays the session to the frame's tick, composes the
 * scene again, and names the elements at the pixel. */
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
    int radius; /* if nothing is drawn at (x, y), the nearest drawn pixel within this distance is described */
    renderer_choice renderer;
} pick_options;

/* An element at a pixel; see draw_cover. */
typedef struct pick_element {
    draw_cover touch;
    scene_kind kind;
    const char *layer;
    bool in_closeup;
    element_subject subject;
    octree_foreign_place place; /* copies of what subject.foreign points to, because the game may end before the pick */
    octree_foreign_node node;
} pick_element;

typedef struct pick {
    const char *path; /* the frame; owned by the caller */
    uint64_t tick;
    int width, height;
    int samples; /* samples per pixel */
    int asked[2];
    int pixel[2]; /* the described pixel: `asked`, or the nearest drawn pixel */
    int radius;
    image_color color;      /* the colour of the frame at `pixel` */
    pick_element *elements; /* topmost first */
    size_t count;           /* 0: nothing is drawn within the radius */
} pick;

/* Fills in *found. False, with an error, if `path` is no frame of the recording in its folder, or the pixel is outside.
 */
bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error);
void pick_release(pick *p);

/* Find what is drawn at a pixel of a playback's current scene. The renderer has the size of the scene. The caller sets
 * asked, pixel, width, height and radius; this fills in samples, pixel, elements and count. */
bool pick_scene(pick *p, const playback *from, renderer *r, octreel_error *error);

/* Print text, or one JSON object on one line. */
void pick_print(FILE *out, const pick *p, bool json);

#endif
