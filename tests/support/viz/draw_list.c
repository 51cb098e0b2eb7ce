/* SPDX-License-Identifier: MIT */
/* draw_list.c - see draw_list.h. */
#include "draw_list.h"

#include "fixture.h"

const scene_box *find_only_box(const scene *s, unsigned layer, uint64_t id)
{
    const scene_box *found = NULL;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (box->style.layer != layer || box->id != id)
            continue;
        assert_null(found);
        found = box;
    }
    assert_non_null(found);
    return found;
}

size_t count_markers_at(const scene *s, unsigned layer, uint64_t id, const double at[3])
{
    size_t count = 0;
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *marker = &s->markers.items[i];
        count += marker->style.layer == layer && marker->id == id && same_position(marker->at, at);
    }
    return count;
}

layer_counts count_layer(const scene *s, unsigned layer)
{
    layer_counts found = {0};
    for (size_t i = 0; i < s->boxes.count; i++)
        found.boxes += s->boxes.items[i].style.layer == layer;
    for (size_t i = 0; i < s->segments.count; i++)
        found.segments += s->segments.items[i].style.layer == layer;
    for (size_t i = 0; i < s->markers.count; i++)
        found.markers += s->markers.items[i].style.layer == layer;
    for (size_t i = 0; i < s->labels.count; i++)
        found.labels += s->labels.items[i].style.layer == layer;
    for (size_t i = 0; i < s->panels.count; i++)
        found.panels += s->panels.items[i].style.layer == layer;
    return found;
}

bool same_box(const octree_box *a, const octree_box *b)
{
    return same_position(a->min, b->min) && same_position(a->max, b->max);
}

size_t count_lines_between(const scene *s, unsigned layer, uint64_t id, const double from[3], const double to[3])
{
    size_t count = 0;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *line = &s->segments.items[i];
        count += line->style.layer == layer && line->id == id && same_position(line->ends[0], from) &&
                 same_position(line->ends[1], to);
    }
    return count;
}
