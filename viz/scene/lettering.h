/* SPDX-License-Identifier: MIT */
/* lettering.h - how large a picture's letters are: the faces that there are, and which of them a picture has by its
 * height. A face is a bitmap, drawn in whole pixels: its letters are multiplied, never scaled.
 */
#ifndef SCENE_LETTERING_H
#define SCENE_LETTERING_H

#include "view.h"

/* Pixels of a letter's cell, across and down. All letters of a face have the same. */
#define FACE_MAP(X) X(5, 8) X(6, 12) X(8, 16) X(12, 24) X(16, 32)

typedef enum text_face {
#define FACE_ENUM(width, height) FACE_##width##X##height,
    FACE_MAP(FACE_ENUM)
#undef FACE_ENUM
        FACE_COUNT
} text_face;

typedef struct lettering {
    text_face face;
    int multiple;      /* pixels a pixel of the face */
    int width, height; /* of a cell, in pixels */
    int line;          /* pixels from a line of text to the next */
} lettering;

/* The letters of text, or of a title, of which one is about twice as large. */
lettering lettering_of_text(const view *v);
lettering lettering_of_title(const view *v);

#endif
