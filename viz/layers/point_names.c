/* SPDX-License-Identifier: MIT */
/* point_names.c - writes the ids of points beside the points; see point_names.h. */
#include "point_names.h"
#include "layout.h"
#include "octree/octree.h"

#include <inttypes.h>

void add_point_names(scene *s, const layer_source *in)
{
    const bool has_room = layout_panel_width(&s->view) > 0 || s->view.text_apart || s->times > 0;
    if (!in->game || octree_count(in->tree) > MOST_NAMED_POINTS || !view_shows_layer(&s->view, LAYER_POINTS) ||
        !has_room)
        return;
    text_space taken = text_space_make(s);
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.layer == LAYER_POINTS)
            text_space_reserve_mark(&taken, s, s->markers.items[i].at, s->markers.items[i].style.width);
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *marker = &s->markers.items[i];
        const scene_style style = make_role_style(LAYER_POINTS, ROLE_FAINT, STROKE_SOLID, 1);
        if (marker->style.layer == LAYER_POINTS && marker->id != in->session->player.id)
            text_space_add_label_beside(&taken, s, scene_make_label(marker->id, style, "#%" PRIu64, marker->id),
                                        marker->at, marker->style.width);
    }
}
