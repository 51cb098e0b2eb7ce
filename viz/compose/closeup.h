/* SPDX-License-Identifier: MIT */
/* closeup.h - the close-up: a part of the picture that shows a small area of the world enlarged. */
#ifndef COMPOSE_CLOSEUP_H
#define COMPOSE_CLOSEUP_H

#include "layer_type.h"

/* Begin the close-up of a scene whose camera is set. s->closeup becomes an empty scene with its own view and camera.
 * The camera shows the position `place` in the world, enlarged `times` times. *close becomes the input for the
 * close-up's layers. Return false if memory runs out. */
bool closeup_begin(scene *s, const layer_source *in, const double place[3], double times, layer_source *close);

#endif
