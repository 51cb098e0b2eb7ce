/* diagram_legend.h - what the marks of the diagram mean: its lines of the legend. Private to the panel's files. */
#ifndef SCENE_DIAGRAM_LEGEND_H
#define SCENE_DIAGRAM_LEGEND_H

#include "panel_pen.h"

/* The number of lines for the diagram that is in a scene; 0 where there is none. */
int diagram_legend_lines(const scene *s);

void write_diagram_legend(pen *p);

#endif
