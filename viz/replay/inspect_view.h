/* SPDX-License-Identifier: MIT */
/* inspect_view.h - chooses the colours and the shading of a cloud's picture when the command line does not. */
#ifndef REPLAY_INSPECT_VIEW_H
#define REPLAY_INSPECT_VIEW_H

#include "inspect.h"
#include "view.h"

/* Choose the view options that the user did not give, and describe the choice in `said`.
 *
 * Colours: by leaf if there are more points than pixels (points then hide the boxes of the nodes) and each leaf has at
 * least 32 pixels. Otherwise the colours of the cloud if it has any, otherwise by height.
 *
 * Shading: eye-dome lighting if neighbouring points touch on the screen and so form surfaces, otherwise bands. Points
 * with --color-points plain get bands. Nothing is chosen if no points are drawn. Returns false if memory runs out. */
#define INSPECT_CHOICE 320
bool inspect_choose_view(const inspection *made, bool color_given, bool shade_given, view *v, char said[INSPECT_CHOICE],
                         octreel_error *error);

#endif
