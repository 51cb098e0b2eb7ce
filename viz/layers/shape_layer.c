/* SPDX-License-Identifier: MIT */
/* shape_layer.c - the layer of a session's shapes: boxes, segments, points and labels that it draws beside its points.
 * An element's id is the index of its shape in the tick. */
#include "layer_type.h"
#include "layout.h"
#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define MARK 3 /* half the size of a point's marker, in half units */

static bool applies(const layer_source *in)
{
    return in->game && in->tick->shape_count > 0;
}

static void add_box(scene *s, uint64_t id, const octree_shape *shape, scene_style style)
{
    scene_box box = {.id = id, .style = style};
    memcpy(box.box.min, shape->at, sizeof box.box.min);
    memcpy(box.box.max, shape->to, sizeof box.box.max);
    scene_add_box(s, box);
}

/* Write a label beside its position where there is room; otherwise on top of the picture. */
static void add_label(scene *s, text_space *words, uint64_t id, const octree_shape *shape, scene_style style)
{
    _Static_assert(OCTREE_SHAPE_TEXT < SCENE_TEXT, "a label must hold a shape's text and one blank before it");
    scene_label label = {.id = id, .style = style};
    label.style.width = 1;
    snprintf(label.text, sizeof label.text, "%s", shape->text);
    if (text_add_beside(words, s, label, shape->at, MARK))
        return;
    label.in_world = true;
    memcpy(label.at, shape->at, sizeof label.at);
    snprintf(label.text, sizeof label.text, " %s", shape->text); /* the blank leaves room for a marker */
    scene_add_label(s, label);
}

static void add_shapes(scene *s, const layer_source *in, view_layer own)
{
    text_space words = {.count = 0}; /* empty: label positions must not depend on the other layers */
    for (size_t i = 0; i < in->tick->shape_count; i++) {
        const octree_shape *shape = &in->tick->shapes[i];
        const scene_style style = layer_style(own, STROKE_SOLID, 2);
        if (shape->kind == OCTREE_SHAPE_BOX)
            add_box(s, i, shape, style);
        else if (shape->kind == OCTREE_SHAPE_SEGMENT)
            scene_add_line(s, i, shape->at, shape->to, style);
        else if (shape->kind == OCTREE_SHAPE_POINT)
            scene_add_mark(s, i, shape->at, SHAPE_SQUARE, layer_style(own, STROKE_SOLID, MARK));
        else
            add_label(s, &words, i, shape, style);
    }
}

static void add_legend(legend *l, const layer_source *in)
{
    legend_add(l, SIGN_BOLD, "%zu shape%s", in->tick->shape_count, plural(in->tick->shape_count));
}

static void describe(description *d, const described_element *element)
{
    const octree_shape *shape = &d->tick->shapes[element->id];
    const bool label = shape->kind == OCTREE_SHAPE_LABEL;
    const char *ground = element->kind == SCENE_PANEL ? "the background of " : label ? ", " : "";
    append_text(d, "%sshape %" PRIu64 " of the session, %s %s", ground, element->id, octree_shape_name(shape->kind),
                label ? "at " : "");
    append_position(d, shape->at);
    if (shape->kind == OCTREE_SHAPE_BOX || shape->kind == OCTREE_SHAPE_SEGMENT) {
        append_text(d, " to ");
        append_position(d, shape->to);
    }
}

const layer_type layer_SHAPES = {
    .applies = applies, .add = add_shapes, .legend_place = 160, .legend = add_legend, .describe = describe};
