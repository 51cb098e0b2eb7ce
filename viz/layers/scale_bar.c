/* SPDX-License-Identifier: MIT */
/* scale_bar.c - draws a bar with a round length; see scale_bar.h. */
#include "scale_bar.h"
#include "layer.h"
#include "number.h"

#include <math.h>
#include <string.h>

/* Return the largest length of the form 1, 2 or 5 times a power of ten that is not above `limit`. Return 0 if the
 * length is too small for a double. */
static double round_down_length(double limit)
{
    double power = 1;
    while (power > limit)
        power /= 10;
    while (power > 0 && power * 10 <= limit)
        power *= 10;
    return limit >= 5 * power ? 5 * power : limit >= 2 * power ? 2 * power : power;
}

/* Remove the labels that a rectangle would cover completely or in part, and the backgrounds of these labels. */
static void drop_covered_labels(scene *s, const int corner[2], const int size[2])
{
    size_t kept = 0;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const double right = label->at[0] + (double)strlen(label->text) * s->text.width;
        const bool apart = right < corner[0] || label->at[0] > corner[0] + size[0] ||
                           label->at[1] + s->text.height < corner[1] || label->at[1] > corner[1] + size[1];
        if (label->in_world || apart) {
            s->labels.items[kept++] = *label;
            continue;
        }
        for (size_t k = 0; k < s->panels.count; k++)
            if (s->panels.items[k].id == label->id && s->panels.items[k].style.layer == label->style.layer)
                s->panels.items[k].width = 0;
    }
    s->labels.count = kept;
}

void scale_bar_add(scene *s, unsigned layer, uint64_t id, const int corner[2], double longest, const char *words)
{
    const int unit = s->unit;
    const double pixel = camera_world_length_of_pixel(&s->camera);
    const double length = isfinite(longest * pixel) ? round_down_length(longest * pixel) : 0;
    const double end = corner[0] + floor(length / pixel);
    const int thick = unit / 2 > 1 ? unit / 2 : 1, rise = 3 * unit, x = corner[0], y = corner[1];
    char number[NUMBER_TEXT];
    if (!(length > 0) || !isfinite(end))
        return;
    scene_label label = scene_make_label(id, make_role_style((view_layer)layer, ROLE_TEXT, STROKE_SOLID, 1), "%s%s",
                                         number_format(length, 6, number), words);
    label.at[0] = corner[0];
    label.at[1] = corner[1] - s->text.height - 3 * unit;
    const int wide = (int)fmax(end - corner[0], (double)strlen(label.text) * s->text.width);
    const int ground[2] = {corner[0] - unit, (int)label.at[1] - unit};
    const int size[2] = {wide + 2 * unit, corner[1] + 2 * unit - (int)label.at[1] + unit};
    drop_covered_labels(s, ground, size);
    scene_add_rectangle(s, id, ground, size, layer, ROLE_BACKGROUND);
    const int bars[][4] = {{x, y, (int)end - x + thick, thick},
                           {x, y - rise, thick, rise + thick},
                           {(int)end, y - rise, thick, rise + thick}};
    for (size_t i = 0; i < sizeof bars / sizeof bars[0]; i++)
        scene_add_rectangle(s, id + 1 + i, bars[i], bars[i] + 2, layer, ROLE_TEXT);
    scene_add_label(s, label);
}
