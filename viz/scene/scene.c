/* SPDX-License-Identifier: MIT */
/* scene.c - appends elements to the arrays of a scene, and numbers them. */
#include "scene.h"
#include "array.h"
#include "kept_tree.h"
#include "layer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void scene_clear(scene *s)
{
    s->boxes.count = s->segments.count = s->markers.count = s->labels.count = s->panels.count = 0;
    s->tally = (scene_tally){0};
    s->spacing = 0;
    s->refused = 0;
    s->out_of_memory = s->has_closeup = false;
    s->times = 0;
    if (s->kept)
        kept_tree_remove_runs(s->kept);
}

void scene_release(scene *s)
{
    free(s->boxes.items);
    free(s->segments.items);
    free(s->markers.items);
    free(s->labels.items);
    free(s->panels.items);
    if (s->closeup)
        scene_release(s->closeup);
    free(s->closeup);
    if (s->kept)
        kept_tree_release(s->kept);
    free(s->kept);
    memset(s, 0, sizeof *s);
}

/* Append an item to one of the scene's arrays. */
#define APPEND(s, array, item)                                                                                         \
    do {                                                                                                               \
        if (ARRAY_GROW(&(array), 1))                                                                                   \
            (array).items[(array).count++] = (item);                                                                   \
        else                                                                                                           \
            (s)->out_of_memory = true;                                                                                 \
    } while (0)

static bool are_all_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

/* Returns whether the scene accepts an element: the view shows the element's layer, and the element's geometry is
 * finite. Elements that are not finite are counted in s->refused. */
static bool accepts_element(scene *s, scene_style style, bool finite)
{
    if (!view_shows_layer(&s->view, style.layer))
        return false;
    s->refused += !finite;
    return finite;
}

void scene_add_box(scene *s, scene_box box)
{
    if (accepts_element(s, box.style, are_all_finite(box.box.min, 3) && are_all_finite(box.box.max, 3)))
        APPEND(s, s->boxes, box);
}

void scene_add_segment(scene *s, scene_segment segment)
{
    if (accepts_element(s, segment.style, are_all_finite(segment.ends[0], 3) && are_all_finite(segment.ends[1], 3)))
        APPEND(s, s->segments, segment);
}

void scene_add_marker(scene *s, scene_marker marker)
{
    if (accepts_element(s, marker.style, are_all_finite(marker.at, 3)))
        APPEND(s, s->markers, marker);
}

scene_label scene_make_label(uint64_t id, scene_style style, const char *format, ...)
{
    scene_label label = {.id = id, .style = style};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(label.text, sizeof label.text, format, arguments);
    va_end(arguments);
    return label;
}

void scene_add_outline(scene *s, uint64_t id, const octree_box *box, scene_style style)
{
    scene_add_box(s, (scene_box){.id = id, .box = *box, .style = style});
}

void scene_add_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style)
{
    scene_add_segment(
        s, (scene_segment){.id = id, .ends = {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}}, .style = style});
}

void scene_add_picture_line(scene *s, uint64_t id, const double from[2], const double to[2], scene_style style)
{
    scene_add_segment(s, (scene_segment){id, style, true, {{from[0], from[1]}, {to[0], to[1]}}});
}

void scene_add_mark(scene *s, uint64_t id, const double at[3], scene_shape shape, scene_style style)
{
    scene_add_marker(s, (scene_marker){.id = id, .at = {at[0], at[1], at[2]}, .style = style, .shape = (uint8_t)shape});
}

static bool grow_markers(scene *s, size_t count)
{
    const bool grown = ARRAY_GROW(&s->markers, count);
    s->out_of_memory |= !grown;
    return grown;
}

/* Reserve room for all points once. Calling scene_add_marker() for each point took 2 % more instructions to draw the
 * picture of a point cloud. */
void scene_add_points(scene *s, const octree_point *points, size_t count, scene_shape shape, scene_style style)
{
    if (!view_shows_layer(&s->view, style.layer) || !grow_markers(s, count))
        return;
    for (size_t i = 0; i < count; i++) {
        const double *at = points[i].position;
        const bool finite = are_all_finite(at, 3);
        s->markers.items[s->markers.count] =
            (scene_marker){.id = points[i].id, .at = {at[0], at[1], at[2]}, .style = style, .shape = (uint8_t)shape};
        s->markers.count += finite;
        s->refused += !finite;
    }
}

void scene_add_markers(scene *s, const scene_marker *markers, size_t count)
{
    if (count == 0 || !grow_markers(s, count))
        return;
    memcpy(s->markers.items + s->markers.count, markers, count * sizeof *markers);
    s->markers.count += count;
}

void scene_add_rectangle(scene *s, uint64_t id, const int at[2], const int size[2], unsigned layer, unsigned role)
{
    scene_add_panel(s, (scene_panel){.id = id,
                                     .x = at[0],
                                     .y = at[1],
                                     .width = size[0],
                                     .height = size[1],
                                     .style = make_role_style((view_layer)layer, (theme_role)role, STROKE_SOLID, 0)});
}

void scene_set_view(scene *s, const view *v)
{
    s->view = *v;
    s->unit = view_pixels_per_unit(v);
    s->text = lettering_choose(v, false);
    s->title = lettering_choose(v, true);
}

void scene_add_label(scene *s, scene_label label)
{
    if (accepts_element(s, label.style, are_all_finite(label.at, 3)))
        APPEND(s, s->labels, label);
}

void scene_add_panel(scene *s, scene_panel panel)
{
    if (accepts_element(s, panel.style, true))
        APPEND(s, s->panels, panel);
}

static const char *const kind_names[SCENE_KINDS] = {"box", "segment", "marker", "panel", "label"};

const char *scene_kind_name(scene_kind kind)
{
    return kind_names[kind];
}

static size_t count_elements_of_kind(const scene *s, scene_kind kind)
{
    const size_t counts[SCENE_KINDS] = {s->boxes.count, s->segments.count, s->markers.count, s->panels.count,
                                        s->labels.count};
    return counts[kind];
}

size_t scene_count_elements(const scene *s)
{
    return s->boxes.count + s->segments.count + s->markers.count + s->panels.count + s->labels.count;
}

scene_element scene_element_at(const scene *s, uint32_t number)
{
    scene_element element = {SCENE_BOX, number - 1, s->has_closeup && number > scene_count_elements(s)};
    element.index -= element.in_closeup ? scene_count_elements(s) : 0;
    s = scene_containing(s, element);
    while (element.kind < SCENE_LABEL && element.index >= count_elements_of_kind(s, element.kind))
        element.index -= count_elements_of_kind(s, element.kind++);
    return element;
}

uint32_t scene_element_number(const scene *s, scene_element element)
{
    size_t number = element.index + 1 + (element.in_closeup ? scene_count_elements(s) : 0);
    s = scene_containing(s, element);
    for (scene_kind kind = SCENE_BOX; kind < element.kind; kind++)
        number += count_elements_of_kind(s, kind);
    return (uint32_t)number;
}

scene_head scene_element_head(const scene *s, scene_element element)
{
    s = scene_containing(s, element);
    const void *const arrays[SCENE_KINDS] = {s->boxes.items, s->segments.items, s->markers.items, s->panels.items,
                                             s->labels.items};
    static const size_t sizes[SCENE_KINDS] = {sizeof(scene_box), sizeof(scene_segment), sizeof(scene_marker),
                                              sizeof(scene_panel), sizeof(scene_label)};
    scene_head head;
    memcpy(&head, (const char *)arrays[element.kind] + element.index * sizes[element.kind], sizeof head);
    return head;
}
