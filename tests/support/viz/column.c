/* SPDX-License-Identifier: MIT */
/* column.c - see column.h. */
#include "column.h"
#include "fixture.h"
#include "layer.h"
#include "layout.h"
#include "legend.h"

#include <string.h>

const scene_label *find_text(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_TEXT && strstr(s->labels.items[i].text, text))
            return &s->labels.items[i];
    return NULL;
}

int find_legend_text_x(const scene *s)
{
    return (LAYOUT_MARGIN + LEGEND_WORDS) * s->text.width;
}

bool has_swatch(const scene *s, unsigned role)
{
    for (size_t i = 0; i < s->panels.count; i++)
        if (s->panels.items[i].style.role == role)
            return true;
    return false;
}

bool is_in_caption(const scene *s, const scene_label *label)
{
    return label->style.layer == LAYER_TEXT && layout_caption_height(&s->view) > 0 &&
           label->at[0] >= layout_panel_width(&s->view);
}

void assert_inside_column(const scene *s)
{
    const int width = layout_panel_width(&s->view), strip = s->view.height - layout_caption_height(&s->view);
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->style.layer != LAYER_TEXT)
            continue;
        assert_non_null(memchr(label->text, 0, SCENE_TEXT));
        assert_false(label->in_world);
        assert_true(label->at[0] >= 0 && label->at[1] >= 0);
        assert_true(width == 0 || label->at[0] < width || (label->at[1] >= strip && label->at[0] < s->view.width));
        for (size_t j = 0; j < i; j++)
            assert_true(s->labels.items[j].style.layer != LAYER_TEXT || s->labels.items[j].id != label->id);
    }
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        if (panel->style.layer != LAYER_TEXT)
            continue;
        assert_true(panel->x >= 0 && panel->width > 0 && panel->height > 0);
        assert_true(panel->x + panel->width <= (width > 0 && panel->y >= strip ? s->view.width : width));
        for (size_t j = 0; j < i; j++)
            assert_true(s->panels.items[j].style.layer != LAYER_TEXT || s->panels.items[j].id != panel->id);
    }
}

bool has_label_with(const scene *s, const char *text)
{
    return find_text(s, text) != NULL;
}
