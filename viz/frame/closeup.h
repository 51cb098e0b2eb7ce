/* SPDX-License-Identifier: MIT */
/* closeup.h - what is small in a picture, larger, in a part of it. */
#ifndef FRAME_CLOSEUP_H
#define FRAME_CLOSEUP_H

#include "closeup_course.h"
#include "layer_type.h"

/* Begin the close-up of a scene whose camera is set: s->closeup is empty, with a view and a camera of its own, at the
 * place of its course. False when there is no memory. `close` becomes what it is filled from. */
bool closeup_begin(scene *s, const layer_source *in, const closeup_course *course, layer_source *close);

#endif
