/* SPDX-License-Identifier: MIT */
/* lettering.h - the bitmap fonts ("faces"), and the choice of a face for the height of a picture. A face is enlarged
 * only by whole multiples, so that its pixels stay sharp squares. */
#ifndef SCENE_LETTERING_H
#define SCENE_LETTERING_H

#include "view.h"

/* The faces: the width and height of each character, in pixels of the face. */
#define FACE_MAP(X) X(5, 8) X(6, 12) X(8, 16) X(12, 24) X(16, 32)

typedef enum text_face {
#define FACE_ENUM(width, height) FACE_##width##X##height,
    FACE_MAP(FACE_ENUM)
#undef FACE_ENUM
        FACE_COUNT
} text_face;

typedef struct lettering {
    text_face face;
    int multiple;      /* the width and height, in pixels of the picture, of one pixel of the face */
    int width, height; /* the width and height of a character's cell, in pixels of the picture */
    int line;          /* the distance from one line of text to the next, in pixels of the picture */
} lettering;

/* Returns the lettering for text, or, if `title` is true, for titles. Titles are about twice as large as text. */
lettering lettering_choose(const view *v, bool title);

#endif
