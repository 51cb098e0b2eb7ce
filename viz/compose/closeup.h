/* SPDX-License-Identifier: MIT */
/* closeup.h - what is small in a picture, larger, in a part of it. */
#ifndef COMPOSE_CLOSEUP_H
#define COMPOSE_CLOSEUP_H

#include "layer_type.h"

/* Begin the close-up of a scene whose camera is set: s->closeup is empty, with a view and a camera of its own, of
 * this place, so many times as large. False when there is no memory. `close` becomes what it is filled from. */
bool closeup_begin(scene *s, const layer_source *in, const double place[3], double times, layer_source *close);

#endif
