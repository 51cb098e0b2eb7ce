/* panel_view.h - the words about the view itself: what it leaves out, and what the colours of nodes mean. Private to
 * the panel's files. */
#ifndef SCENE_PANEL_VIEW_H
#define SCENE_PANEL_VIEW_H

#include "panel_pen.h"

/* A line for each thing that leaves something out or folds it, and how much is shown; nothing where all is shown. */
void write_left_out(pen *p);

/* The legend's line of the colours of nodes. */
void write_node_legend(pen *p, size_t max_depth);

#endif
