/* number_text.h - numbers as people read them in a picture. Private to scene. */
#ifndef SCENE_NUMBER_TEXT_H
#define SCENE_NUMBER_TEXT_H

#define NUMBER_WORDS 32

/* At most so many significant digits, with a point whatever the locale. Returns `text`. */
const char *number_text(double value, int digits, char text[NUMBER_WORDS]);

#endif
