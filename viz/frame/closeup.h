/* SPDX-License-Identifier: MIT */
/* closeup.h - what is around the player, larger, in a part of the picture. */
#ifndef FRAME_CLOSEUP_H
#define FRAME_CLOSEUP_H

#include "layer_type.h"

/* How many times as large a close-up of these shows them, a round number; 0 where there is none: the view wants none,
 * the picture is too small, there is nothing to look at, or it is large enough already. It depends on the session and
 * the view alone, and so is the same at every tick. */
double closeup_times(const scene *s, const layer_source *in);

/* Begin the close-up of a scene whose camera is set: s->closeup is empty, with a view and a camera of its own. False
 * when there is no memory. `close` becomes what it is filled from. */
bool closeup_begin(scene *s, const layer_source *in, double times, layer_source *close);

#endif
