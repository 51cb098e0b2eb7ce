/* layout.c - see layout.h. */
#include "layout.h"
#include "layer.h"

int panel_width(const view *v)
{
    const int width = LAYOUT_COLUMN * view_unit(v);
    return view_shows(v, LAYER_TEXT) && v->width >= 2 * width ? width : 0;
}

/* What the column of text leaves. */
static camera_window rest_of(const view *v)
{
    const int column = panel_width(v);
    return (camera_window){column, 0, v->width - column, v->height};
}

camera_window layout_space(const view *v)
{
    camera_window w = rest_of(v);
    const camera_window diagram = layout_diagram(v);
    if (v->diagram == DIAGRAM_BESIDE && diagram.height == w.height)
        w.width -= diagram.width;
    else if (v->diagram == DIAGRAM_BESIDE)
        w.height -= diagram.height;
    return w;
}

camera_window layout_diagram(const view *v)
{
    camera_window w = rest_of(v);
    if (v->diagram == DIAGRAM_NONE)
        return (camera_window){0};
    if (v->diagram == DIAGRAM_ONLY)
        return w;
    double *side = w.width < w.height ? &w.height : &w.width;
    double *corner = w.width < w.height ? &w.y : &w.x;
    const double half = (double)((int)*side / 2);
    *corner += *side - half;
    *side = half;
    return w;
}
