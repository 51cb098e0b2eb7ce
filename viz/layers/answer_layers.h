/* answer_layers.h - the layers of a tick's queries: what was asked, and what was found. Private. */
#ifndef SCENE_ANSWER_LAYERS_H
#define SCENE_ANSWER_LAYERS_H

#include "octree/game.h"
#include "layer.h"
#include "scene.h"

/* The great circles of a ball, and the chords that each is drawn by. */
#define BALL_CIRCLES 3
#define BALL_CHORDS 96

/* Neighbours are numbered up to this rank. */
#define NUMBERED_RANKS 9

/* The layer of the answers of a kind. */
view_layer answer_layer(octree_query_kind kind);

/* Each answer in its layer. Ids begin with the answer's place among them; markers have their point's. */
void add_answers(scene *s, const octree_answer *answers, size_t count);

#endif
