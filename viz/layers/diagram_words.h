/* diagram_words.h - the room that the diagram's words take, in units. Private to the diagram's files. */
#ifndef SCENE_DIAGRAM_WORDS_H
#define SCENE_DIAGRAM_WORDS_H

#define WORDS_LEFT 26  /* the depths */
#define WORDS_RIGHT 54 /* the numbers of nodes */
#define WORDS_ABOVE 24
#define WORDS_BELOW 24
#define WORDS_WIDTH 150 /* a diagram smaller than that has none */
#define WORDS_HEIGHT 120

#endif
