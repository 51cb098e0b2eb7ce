/* text_boxes.c - where the text of a scene is. */
#include "letters.h"
#include "paint.h"

void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context)
{
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        const draw_box box = {panel->x, panel->y, panel->width, panel->height};
        visit(&box, context);
    }
    const scene fine = paint_samples(s);
    for (size_t i = 0; i < s->labels.count; i++) {
        draw_box box;
        if (letters_box(&fine, &s->labels.items[i], &box))
            visit(&box, context);
    }
}
