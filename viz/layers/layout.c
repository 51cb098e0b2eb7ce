/* SPDX-License-Identifier: MIT */
#include "layout.h"
#include "layer.h"

#include <math.h>
#include <string.h>

int panel_width(const view *v)
{
    const int width = (LAYOUT_LETTERS + 2 * LAYOUT_MARGIN) * lettering_of_text(v).width;
    return view_shows(v, LAYER_TEXT) && v->width >= 2 * width ? width : 0;
}

/* The picture without the column of text. */
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

static bool is_free(const text_space *t, const double box[4])
{
    for (size_t i = 0; i < t->count; i++) {
        const double *other = t->taken[i];
        if (box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])
            return false;
    }
    return t->count < TEXT_SPACE_MOST;
}

bool text_space_take(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2])
{
    const double width = (double)strlen(text) * s->text.width, height = s->text.height;
    const double left = floor(middle[0] - width / 2), top = floor(middle[1] - height / 2);
    const double box[4] = {left - s->unit, top - s->unit, left + width + s->unit, top + height};
    const camera_window w = layout_space(&s->view);
    if (!(box[0] >= w.x && box[1] >= w.y && box[2] <= w.x + w.width && box[3] <= w.y + w.height) || !is_free(t, box))
        return false;
    memcpy(t->taken[t->count++], box, sizeof box);
    corner[0] = left;
    corner[1] = top;
    return true;
}

void text_add_on_ground(scene *s, const scene_label *label, theme_role ground)
{
    const int unit = s->unit, letters = (int)strlen(label->text);
    scene_add_rectangle(s, label->id, (int[]){(int)label->at[0] - unit, (int)label->at[1] - unit},
                        (int[]){letters * s->text.width + 2 * unit, s->text.height + unit}, label->style.layer, ground);
    scene_add_label(s, *label);
}
