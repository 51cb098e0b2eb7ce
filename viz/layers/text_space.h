/* text_space.h - room for words among the lines of a picture: none covers another. Private to scene. */
#ifndef SCENE_TEXT_SPACE_H
#define SCENE_TEXT_SPACE_H

#include "scene.h"

#define TEXT_SPACE_MOST 400 /* more words than that are no help */
#define TEXT_LETTER 6       /* units that a letter takes, about */
#define TEXT_HEIGHT 9       /* units from the top of a letter to below its foot */

/* Rectangles that are taken, in pixels: left, top, right, bottom. */
typedef struct text_space {
    double taken[TEXT_SPACE_MOST][4];
    size_t count;
} text_space;

/* Take the room of a text around a place, in pixels, and write where its label begins. False where it would leave the
 * part of the picture that the world is drawn in, or cover another. */
bool text_space_take(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2]);

/* What is behind the letters of a label that has its room: lines and points would make them hard to read. It has the
 * label's id and layer. */
void text_add_ground(scene *s, const scene_label *label, theme_role role);

/* The pixel of a position; false when it is not before the camera. */
bool text_place(const scene *s, const double position[3], double pixel[2]);

#endif
