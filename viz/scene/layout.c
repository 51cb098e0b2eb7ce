/* SPDX-License-Identifier: MIT */
/* layout.c - computes the areas of a picture and places labels; see layout.h. */
#include "layout.h"
#include "layer.h"

#include <math.h>
#include <string.h>

/* The close-up lies in a strip at one end of the space view. The strip takes this part of the view's longer side. */
#define CLOSEUP_PART 0.32
/* the ratio of the close-up's longer side to its shorter side; the longer side runs along the strip */
#define CLOSEUP_RATIO 1.3333
#define CLOSEUP_MARGIN 8 /* the margin around the close-up, in picture units */
#define CLOSEUP_LEAST 90 /* the least length of a side, in picture units: a smaller close-up has no room for text */
/* the part of the space view's width that the camera always leaves free at each side of the world */
#define CAMERA_MARGIN 0.045
/* the largest part of the space view's width that is reserved for the numbers at one side */
#define MOST_NUMBERS 0.1

int layout_panel_width(const view *v)
{
    const int width = (LAYOUT_LETTERS + 2 * LAYOUT_MARGIN) * lettering_choose(v, false).width;
    return view_shows_layer(v, LAYER_TEXT) && !v->text_apart && v->width >= 2 * width ? width : 0;
}

int layout_caption_height(const view *v)
{
    const int height = lettering_choose(v, false).line * 3 / 2;
    return layout_panel_width(v) && v->height >= 8 * height ? height : 0;
}

/* Returns the area of the picture without the column of text and the caption. */
static camera_window find_area_beside_text(const view *v)
{
    const int column = layout_panel_width(v);
    return (camera_window){column, 0, v->width - column, v->height - layout_caption_height(v)};
}

/* Returns the area of the picture without the column of text and the diagram. */
static camera_window find_world_area(const view *v)
{
    camera_window w = find_area_beside_text(v);
    const camera_window diagram = layout_diagram_area(v);
    if (v->diagram == DIAGRAM_BESIDE && diagram.height == w.height)
        w.width -= diagram.width;
    else if (v->diagram == DIAGRAM_BESIDE)
        w.height -= diagram.height;
    return w;
}

/* Returns the number of pixels that a close-up takes from the longer side of the space view. */
static double find_closeup_strip_size(const camera_window *space)
{
    return floor(fmax(space->width, space->height) * CLOSEUP_PART);
}

camera_window layout_space_area(const scene *s)
{
    camera_window w = find_world_area(&s->view);
    const double strip = find_closeup_strip_size(&w);
    if (s->has_closeup && w.width >= w.height)
        w.width -= strip;
    else if (s->has_closeup)
        w.height -= strip;
    return w;
}

int layout_count_number_letters(const octree_box *box)
{
    /* MORE: the characters for a sign or a margin, and for the tick mark */
    enum { FEW_DIGITS = 4, LEAST = 6, MOST = 9, MORE = 3 };
    double most = 0;
    int digits = 1;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fmax(box->max[i], -box->min[i]));
    for (; most >= 10 && digits < MOST; most /= 10)
        digits++;
    return digits <= FEW_DIGITS ? LEAST : digits + MORE;
}

camera_window layout_camera_area(const scene *s, const octree_box *world)
{
    camera_window w = layout_space_area(s);
    const int letters = layout_count_number_letters(s->view.fit == FIT_BOX ? &s->view.focus : world);
    const bool numbers = view_shows_layer(&s->view, LAYER_WORLD) && view_shows_layer(&s->view, LAYER_TEXT);
    const double room = numbers ? letters * s->text.width - CAMERA_MARGIN * w.width : 0;
    const double beside = fmax(fmin(room, w.width * MOST_NUMBERS), 0);
    w.x += beside;
    w.width -= 2 * beside;
    if (layout_caption_height(&s->view)) /* the caption takes the room that numbers below the world need */
        w.height -= s->text.height;
    return w;
}

camera_window layout_closeup_area(const view *v)
{
    const camera_window space = find_world_area(v);
    const int margin = CLOSEUP_MARGIN * view_pixels_per_unit(v), least = CLOSEUP_LEAST * view_pixels_per_unit(v);
    const bool beside = space.width >= space.height;
    /* the close-up's side across the strip in which it lies, in pixels */
    const double across = find_closeup_strip_size(&space) - 2 * margin;
    const double along = fmin((beside ? space.height : space.width) - 2 * margin, floor(across * CLOSEUP_RATIO));
    camera_window w = {.width = beside ? across : along, .height = beside ? along : across};
    w.x = beside ? space.x + space.width - margin - w.width : space.x + floor((space.width - w.width) / 2);
    w.y = beside ? space.y + floor((space.height - w.height) / 2) : space.y + space.height - margin - w.height;
    return v->diagram != DIAGRAM_ONLY && w.width >= least && w.height >= least ? w : (camera_window){0};
}

camera_window layout_diagram_area(const view *v)
{
    camera_window w = find_area_beside_text(v);
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

/* Compute the rectangle of a text with its margin: left, top, right and bottom in pixels. `corner` is the text's top
 * left corner. */
static void find_text_box(const scene *s, const char *text, const double corner[2], double box[4])
{
    const double width = (double)strlen(text) * s->text.width;
    memcpy(
        box,
        (double[]){corner[0] - s->unit, corner[1] - s->unit, corner[0] + width + s->unit, corner[1] + s->text.height},
        4 * sizeof *box);
}

static bool is_area_free(const text_space *t, const double box[4])
{
    for (size_t i = 0; i < t->count; i++) {
        const double *other = t->taken[i];
        if (box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])
            return false;
    }
    return t->count < TEXT_SPACE_MOST;
}

text_space text_space_make(const scene *s)
{
    text_space t = {.count = 0};
    for (size_t i = 0; i < s->labels.count && t.count < TEXT_SPACE_MOST; i++) {
        const scene_label *label = &s->labels.items[i];
        if (!label->in_world)
            find_text_box(s, label->text, label->at, t.taken[t.count++]);
    }
    return t;
}

bool text_space_reserve_text(text_space *t, const scene *s, const char *text, const double middle[2], double corner[2])
{
    const double width = (double)strlen(text) * s->text.width, height = s->text.height;
    const double at[2] = {floor(middle[0] - width / 2), floor(middle[1] - height / 2)};
    double box[4];
    const camera_window w = layout_space_area(s);
    find_text_box(s, text, at, box);
    if (!(box[0] >= w.x && box[1] >= w.y && box[2] <= w.x + w.width && box[3] <= w.y + w.height) ||
        !is_area_free(t, box))
        return false;
    memcpy(t->taken[t->count++], box, sizeof box);
    memcpy(corner, at, sizeof at);
    return true;
}

void text_space_reserve_mark(text_space *t, const scene *s, const double at[3], unsigned half)
{
    double pixel[2];
    const double reach = half * s->unit / 2.0;
    if (t->count == TEXT_SPACE_MOST || !camera_find_pixel(&s->camera, at, pixel))
        return;
    const double box[4] = {pixel[0] - reach, pixel[1] - reach, pixel[0] + reach, pixel[1] + reach};
    memcpy(t->taken[t->count++], box, sizeof box);
}

bool text_space_add_label_beside(text_space *t, scene *s, scene_label label, const double at[3], unsigned half)
{
    double pixel[2];
    const camera_window w = layout_space_area(s);
    if (!camera_find_pixel(&s->camera, at, pixel) || pixel[0] < w.x || pixel[1] < w.y || pixel[0] > w.x + w.width ||
        pixel[1] > w.y + w.height)
        return true;
    const double aside = (half / 2.0 + 3) * s->unit + (double)strlen(label.text) * s->text.width / 2;
    const double above = half / 2.0 * s->unit + s->text.height;
    const double offsets[][2] = {{aside, 0}, {-aside, 0}, {0, -above}, {0, above}};
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        const double middle[2] = {pixel[0] + offsets[i][0], pixel[1] + offsets[i][1]};
        if (!text_space_reserve_text(t, s, label.text, middle, label.at))
            continue;
        scene_add_label_on_ground(s, &label, ROLE_BACKGROUND);
        return true;
    }
    return false;
}

void scene_add_label_on_ground(scene *s, const scene_label *label, theme_role ground)
{
    const int unit = s->unit, letters = (int)strlen(label->text);
    scene_add_rectangle(s, label->id, (int[]){(int)label->at[0] - unit, (int)label->at[1] - unit},
                        (int[]){letters * s->text.width + 2 * unit, s->text.height + unit}, label->style.layer, ground);
    scene_add_label(s, *label);
}
