/* shape_layer.c - see shape_layer.h. */
#include "shape_layer.h"
#include "layer.h"

#include <stdio.h>
#include <string.h>

static scene_style shape_style(unsigned width)
{
    return layer_style(LAYER_SHAPES, STROKE_SOLID, width);
}

static void add_box(scene *s, uint64_t id, const octree_shape *shape)
{
    scene_box box = {.id = id, .style = shape_style(2)};
    memcpy(box.box.min, shape->at, sizeof box.box.min);
    memcpy(box.box.max, shape->to, sizeof box.box.max);
    scene_add_box(s, box);
}

static void add_segment(scene *s, uint64_t id, const octree_shape *shape)
{
    scene_segment line = {.id = id, .style = shape_style(2)};
    memcpy(line.ends[0], shape->at, sizeof line.ends[0]);
    memcpy(line.ends[1], shape->to, sizeof line.ends[1]);
    scene_add_segment(s, line);
}

static void add_point(scene *s, uint64_t id, const octree_shape *shape)
{
    scene_marker marker = {.id = id, .style = shape_style(3), .shape = SHAPE_SQUARE};
    memcpy(marker.at, shape->at, sizeof marker.at);
    scene_add_marker(s, marker);
}

static void add_label(scene *s, uint64_t id, const octree_shape *shape)
{
    _Static_assert(OCTREE_SHAPE_TEXT < SCENE_TEXT, "a label holds a shape's text and a blank before it");
    scene_label label = {.id = id, .in_world = true, .style = shape_style(1)};
    memcpy(label.at, shape->at, sizeof label.at);
    snprintf(label.text, sizeof label.text, " %s", shape->text); /* the blank keeps clear of a marker */
    scene_add_label(s, label);
}

void add_shapes(scene *s, const octree_tick *tick)
{
    static void (*const adders[OCTREE_SHAPE_KINDS])(scene *, uint64_t, const octree_shape *) = {
        [OCTREE_SHAPE_BOX] = add_box,
        [OCTREE_SHAPE_SEGMENT] = add_segment,
        [OCTREE_SHAPE_POINT] = add_point,
        [OCTREE_SHAPE_LABEL] = add_label,
    };
    for (size_t i = 0; i < tick->shape_count; i++)
        adders[tick->shapes[i].kind](s, i, &tick->shapes[i]);
}
