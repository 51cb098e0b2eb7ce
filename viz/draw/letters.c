/* SPDX-License-Identifier: MIT */
/* letters.c - turns text into quads, and lists the boxes around a scene's text. */
#include "letters.h"
#include "glyphs.h"
#include "project.h"

#include <math.h>
#include <string.h>

/* Text that begins more than this many pixels away from the origin cannot reach into a picture. */
#define FARTHEST 1e6

/* Replace the pixel of a label's world position by the top left pixel of the text beside this position. If the text of
 * a visible position would extend beyond the right or the lower border of the picture, the text is moved inside. */
static void move_beside_position(const scene *s, const scene_label *label, double pixel[2])
{
    const int aside[2] = {s->text.width / 2, -(s->text.height / 2)};
    const double room[2] = {s->view.width - (double)strlen(label->text) * s->text.width,
                            (double)s->view.height - s->text.height};
    const double limit[2] = {s->view.width, s->view.height};
    for (int i = 0; i < 2; i++) {
        const bool inside = pixel[i] < limit[i];
        pixel[i] += aside[i];
        if (inside && room[i] >= 0 && pixel[i] > room[i])
            pixel[i] = room[i];
    }
}

/* Find the top left pixel of a label's text. Returns false if the label's position is not visible. Text begins at a
 * whole pixel, so that the text stays crisp with anti-aliasing. */
static bool find_text_position(const scene *s, const scene_label *label, int *x, int *y)
{
    double pixel[2] = {label->at[0], label->at[1]};
    unsigned band;
    if (label->in_world) {
        if (!find_pixel_and_band(s, label->at, pixel, &band))
            return false;
        pixel[0] /= s->view.aa;
        pixel[1] /= s->view.aa;
        move_beside_position(s, label, pixel);
    }
    if (!(fabs(pixel[0]) < FARTHEST && fabs(pixel[1]) < FARTHEST))
        return false;
    *x = (int)floor(pixel[0]);
    *y = (int)floor(pixel[1]);
    return true;
}

/* Add the rectangles of a character whose cell begins at (x, y). Each rectangle is enlarged by `rim` on all sides.
 * `pixel` is the size of one pixel of the face. All lengths are in subpixels. A character without a glyph becomes a
 * question mark. */
static void add_letter(quad_list *list, quad *q, const glyph_set *set, char letter, int x, int y, int pixel, int rim)
{
    const unsigned at = (unsigned char)letter - (unsigned)GLYPH_FIRST;
    const unsigned i = at < GLYPH_COUNT ? at : '?' - GLYPH_FIRST;
    for (const glyph_part *part = set->parts + set->first[i]; part < set->parts + set->first[i + 1]; part++) {
        const int left = x + part->x * pixel - rim, top = y + part->y * pixel - rim;
        quads_add_rectangle(list, q, left, top, left + part->width * pixel + 2 * rim,
                            top + part->height * pixel + 2 * rim);
    }
}

/* Returns the width in pixels of the dark rim around a label's characters. */
static int find_rim_width(const scene *s, const scene_label *label)
{
    return label->style.stroke != STROKE_CUT ? 0 : s->unit > 2 ? s->unit / 2 : 1;
}

void add_label_letters(quad_list *list, const scene *s, const scene_label *label)
{
    const lettering *letters = scene_label_lettering(s, label);
    const int sub = QUAD_SUBPIXELS * s->view.aa;
    quad q = {.order = make_text_order(label->style.layer)};
    int left, top;
    if (!find_text_position(s, label, &left, &top))
        return;
    for (int rim = find_rim_width(s, label); rim >= 0; rim = rim > 0 ? 0 : -1) {
        q.color = theme_color_index(rim > 0 ? ROLE_BACKGROUND : label->style.role, 0);
        for (int i = 0; label->text[i]; i++)
            add_letter(list, &q, &glyph_sets[letters->face], label->text[i], (left + i * letters->width) * sub,
                       top * sub, letters->multiple * sub, rim * sub);
    }
}

/* Find the box around a label's text. Returns false if the text is not visible. */
static bool find_text_box(const scene *s, const scene_label *label, draw_box *box)
{
    const lettering *letters = scene_label_lettering(s, label);
    if (!find_text_position(s, label, &box->x, &box->y))
        return false;
    const int rim = find_rim_width(s, label);
    box->x -= rim;
    box->y -= rim;
    box->width = (int)strlen(label->text) * letters->width + 2 * rim;
    box->height = letters->height + 2 * rim;
    return true;
}

void visit_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context)
{
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        const draw_box box = {panel->x, panel->y, panel->width, panel->height};
        visit(&box, context);
    }
    const scene fine = project_scene_to_samples(s);
    for (size_t i = 0; i < s->labels.count; i++) {
        draw_box box;
        if (find_text_box(&fine, &s->labels.items[i], &box))
            visit(&box, context);
    }
}
