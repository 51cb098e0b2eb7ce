/* SPDX-License-Identifier: MIT */
/* inspect_view.h - chooses the colours and the shading of a cloud's picture when the command line does not. */
#ifndef REPLAY_INSPECT_VIEW_H
#define REPLAY_INSPECT_VIEW_H

#include "inspect.h"
#include "view.h"

/* Choose the view options that were not given, and describe the choice in `said`.
 *   Colours: by leaf if there are more points than pixels, because points then hide the boxes of the nodes, and if each
 * leaf has at least 32 pixels; else the colours of the cloud if it has any; else by height.
 *   Shade: eye-dome lighting if neighbouring points touch on the screen and so form surfaces; else bands. Points with
 * --color-points plain get bands. Nothing is chosen if no points are drawn.
 * False: out of memory. */
#define INSPECT_CHOICE 320
bool inspect_choose_view(const inspection *made, bool color_given, bool shade_given, view *v, char said[INSPECT_CHOICE],
                         octreel_error *error);

#endif
