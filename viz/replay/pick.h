/* pick.h - what is drawn at a pixel of a recording's frame: the session is played to its tick, the scene is made anew,
 * and the elements of that pixel are named. */
#ifndef RECORD_PICK_H
#define RECORD_PICK_H

#include "element_words.h"
#include "folder.h"
#include "image.h"

#include <stdio.h>

typedef struct pick_options {
    int x, y;
    int radius; /* pixels: where nothing is drawn, the nearest that is something within this distance */
    renderer_choice renderer;
} pick_options;

/* An element of a pixel, from the top one on; see draw_touch. */
typedef struct pick_element {
    draw_touch touch;
    scene_kind kind;
    const char *layer;
    element_subject subject;
} pick_element;

typedef struct pick {
    char *path; /* of the frame */
    uint64_t tick;
    int width, height;
    int samples; /* of a pixel */
    int asked[2];
    int pixel[2]; /* the one that was looked at: the same, or the nearest on which anything is drawn */
    int radius;
    image_color color; /* of the frame at `pixel` */
    pick_element *elements;
    size_t count; /* 0: nothing is drawn within the radius */
} pick;

/* False, with a sentence, when `path` is no frame of a recording, the recording beside it is not the one that it is of,
 * or the pixel is outside. */
bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error);
void pick_release(pick *p);

/* For people; or one JSON object on one line. */
void pick_print(FILE *out, const pick *p, bool json);

#endif
