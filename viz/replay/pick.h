/* SPDX-License-Identifier: MIT */
/* pick.h - lists what is drawn at a pixel of a recorded frame: replays the session to the frame's tick, composes the
 * scene again, and names the elements at the pixel. */
#ifndef REPLAY_PICK_H
#define REPLAY_PICK_H

#include "describe.h"
#include "folder.h"
#include "image.h"
#include "node_reason.h"
#include "pixel.h"
#include "playback.h"

#include <stdio.h>

typedef struct pick_options {
    int x, y;
    /* If nothing is drawn at the pixel (x, y), the nearest drawn pixel up to `radius` pixels away is described. */
    int radius;
    renderer_choice renderer;
    uint64_t max_ticks; /* maximum number of ticks: a longer session is refused; 0: SESSION_MOST_PLAYED */
} pick_options;

/* An element at a pixel. `touch` describes the samples of the pixel that the element covers. */
typedef struct pick_element {
    draw_cover touch;
    scene_kind kind;
    const char *layer;
    bool in_closeup;
    element_subject subject;
    /* Copies of the data to which subject.foreign points. The game, which owns the originals, may end before the pick
     * is released. */
    octree_foreign_place place;
    octree_foreign_node node;
    /* The explanation of the element's node, as data and as a sentence; owned. Several elements may show the same node:
     * only the topmost has the explanation, the others have zero and null. */
    node_reason reason;
    char *explained;
} pick_element;

typedef struct pick {
    const char *path; /* path of the frame; the caller owns it */
    uint64_t tick;
    int width, height;
    int samples;  /* samples per pixel */
    int asked[2]; /* the requested pixel, x and y */
    int pixel[2]; /* the pixel that is described: `asked`, or the nearest drawn pixel */
    int radius;
    image_color color;      /* the colour of the frame at `pixel` */
    pick_element *elements; /* the elements at `pixel`, the topmost first */
    size_t count;           /* number of elements; 0: nothing is drawn within the radius */
} pick;

/* Find what is drawn at a pixel of the frame file `path`. Returns false with an error if the file is not a frame of the
 * recording in its folder, or if the pixel lies outside the frame. */
bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error);
void pick_release(pick *p);

/* Find what is drawn at a pixel of the playback's current scene. The renderer must have the size of the scene. The
 * caller sets asked, pixel, width, height and radius; this function fills in samples, pixel, elements and count. */
bool pick_scene(pick *p, const playback *from, renderer *r, octreel_error *error);

/* Print the pick as text, or as one JSON object on one line. */
void pick_print(FILE *out, const pick *p, bool json);

/* Print the pick as JSON only. The page calls this function, so that its WebAssembly module does not contain the code
 * for text. */
void pick_print_json(FILE *out, const pick *p);

/* Print one element of the playback's tick as a JSON object, like an element of a pick. `name` is "node 0/3",
 * "foreign 12" (a foreign node) or "point 7". A node of Octreel's tree also has the members "children" and "holds" (the
 * ids of a leaf's points, cut after PICK_HELD ids); a point also has "leaf", and the values that the session gives it.
 * Returns false with an error if the tick has no such element. */
#define PICK_HELD 100
bool pick_print_named(FILE *out, const char *name, const playback *from, octreel_error *error);

#endif
