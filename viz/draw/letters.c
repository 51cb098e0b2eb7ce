/* SPDX-License-Identifier: MIT */
#include "letters.h"
#include "project.h"

#include <math.h>
#include <stb_easy_font.h>
#include <string.h>

#define QUADS_A_LABEL (SCENE_TEXT * 16) /* the font needs about 11 quads a letter at most */

/* Text that begins so many pixels away does not reach into a picture. */
#define FARTHEST 1e6

/* What stb_easy_font writes for a corner. */
typedef struct corner {
    float x, y, z;
    unsigned char color[4];
} corner;

/* The pixel of the text's top left corner; false when its position is not visible. Text begins at whole pixels under
 * anti-aliasing too, and stays crisp. */
static bool place(const scene *s, const scene_label *label, int *x, int *y)
{
    double pixel[2] = {label->at[0], label->at[1]};
    unsigned band;
    if (label->in_world) {
        if (!project_point(s, label->at, pixel, &band))
            return false;
        pixel[0] = pixel[0] / view_samples(&s->view) + 3 * s->unit;
        pixel[1] = pixel[1] / view_samples(&s->view) - 4 * s->unit;
    }
    if (!(fabs(pixel[0]) < FARTHEST && fabs(pixel[1]) < FARTHEST))
        return false;
    *x = (int)floor(pixel[0]);
    *y = (int)floor(pixel[1]);
    return true;
}

void letters_add(quad_list *list, const scene *s, const scene_label *label)
{
    corner corners[QUADS_A_LABEL * 4];
    char text[SCENE_TEXT];
    int left, top;
    if (!place(s, label, &left, &top))
        return;
    memcpy(text, label->text, sizeof text);
    const int count = stb_easy_font_print(0, 0, text, NULL, corners, sizeof corners);
    const int pixel = QUAD_SUBPIXELS * view_samples(&s->view), scale = s->unit * label->style.width * pixel;
    quad q = {.color = theme_index(label->style.role, 0), .order = quad_order_of_text(label->style.layer)};
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < 4; j++) {
            q.x[j] = left * pixel + (int)corners[4 * i + j].x * scale;
            q.y[j] = top * pixel + (int)corners[4 * i + j].y * scale;
        }
        quads_add(list, &q);
    }
}

/* The box around a label's letters; false when it is not visible. */
static bool find_box(const scene *s, const scene_label *label, draw_box *box)
{
    char text[SCENE_TEXT];
    if (!place(s, label, &box->x, &box->y))
        return false;
    memcpy(text, label->text, sizeof text);
    const int scale = s->unit * label->style.width;
    box->width = stb_easy_font_width(text) * scale;
    box->height = stb_easy_font_height(text) * scale;
    return true;
}

void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context)
{
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        const draw_box box = {panel->x, panel->y, panel->width, panel->height};
        visit(&box, context);
    }
    const scene fine = project_samples(s);
    for (size_t i = 0; i < s->labels.count; i++) {
        draw_box box;
        if (find_box(&fine, &s->labels.items[i], &box))
            visit(&box, context);
    }
}
