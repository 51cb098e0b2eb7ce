/* SPDX-License-Identifier: MIT */
/* inspect_view.h - how the picture of a cloud shows its points, where nobody says how. */
#ifndef REPLAY_INSPECT_VIEW_H
#define REPLAY_INSPECT_VIEW_H

#include "inspect.h"
#include "view.h"

/* What is not given is chosen:
 *   Colours: "leaf" where there are more points than pixels in the space view, since they hide the boxes of nodes
 * there, and 32 pixels or more for each leaf; else those of the cloud, where it has any; else height. Shade: eye-dome
 * lighting where points are so near to each other, seen as far away as what the camera looks at, that they close
 * surfaces; else bands. Plain points that are asked for have bands, and points that are not shown need neither. False
 * when there is no memory. */
#define INSPECT_CHOICE 240
bool inspect_choose_view(const inspection *made, bool color_given, bool shade_given, view *v, char said[INSPECT_CHOICE],
                         octreel_error *error);

#endif
