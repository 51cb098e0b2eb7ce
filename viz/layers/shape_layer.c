/* SPDX-License-Identifier: MIT */
/* shape_layer.c - the layer of a session's shapes: boxes, segments, points and labels that are neither points of the
 * tree nor nodes. An element's id is the index of its shape in the tick. */
#include "layer_type.h"
#include "layout.h"
#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define MARK 3 /* half the size of a point's marker, in halves of a picture unit */

static bool has_shapes(const layer_source *in)
{
    return in->game && in->tick->shape_count > 0;
}

static void add_box(scene *s, uint64_t id, const octree_shape *shape, scene_style style)
{
    octree_box box;
    memcpy(box.min, shape->at, sizeof box.min);
    memcpy(box.max, shape->to, sizeof box.max);
    scene_add_outline(s, id, &box, style);
}

/* Write the text of a label shape beside its position where there is room. If there is no room, write the text beside
 * its position anyway, over other elements. */
static void add_label(scene *s, text_space *words, uint64_t id, const octree_shape *shape, scene_style style)
{
    _Static_assert(OCTREE_SHAPE_TEXT < SCENE_TEXT,
                   "a label must have room for a shape's text and a space before the text");
    scene_label label = scene_make_label(id, style, "%s", shape->text);
    label.style.width = 1;
    if (text_space_add_label_beside(words, s, label, shape->at, MARK))
        return;
    label.in_world = true;
    memcpy(label.at, shape->at, sizeof label.at);
    /* The space in the text leaves room for the point's marker. */
    snprintf(label.text, sizeof label.text, " %s", shape->text);
    scene_add_label(s, label);
}

static void add_shapes(scene *s, const layer_source *in, view_layer layer)
{
    /* The list of occupied places starts empty, because the positions of shape labels must not depend on other
     * layers. */
    text_space words = {.count = 0};
    for (size_t i = 0; i < in->tick->shape_count; i++) {
        const octree_shape *shape = &in->tick->shapes[i];
        const scene_style style = make_layer_style(layer, STROKE_SOLID, 2);
        if (shape->kind == OCTREE_SHAPE_BOX)
            add_box(s, i, shape, style);
        else if (shape->kind == OCTREE_SHAPE_SEGMENT)
            scene_add_line(s, i, shape->at, shape->to, style);
        else if (shape->kind == OCTREE_SHAPE_POINT)
            scene_add_mark(s, i, shape->at, SHAPE_SQUARE, make_layer_style(layer, STROKE_SOLID, MARK));
        else
            add_label(s, &words, i, shape, style);
    }
}

static void add_shape_legend(legend *l, const layer_source *in)
{
    legend_add(l, SIGN_BOLD, "%zu shape%s", in->tick->shape_count, plural_ending(in->tick->shape_count));
}

static void describe_shape(description *d, const described_element *element)
{
    const octree_shape *shape = &d->tick->shapes[element->id];
    const bool label = shape->kind == OCTREE_SHAPE_LABEL;
    const char *ground = element->kind == SCENE_PANEL ? "the background of " : label ? ", " : "";
    append_text(d, "%sshape %" PRIu64 " of the session, %s", ground, element->id, octree_shape_name(shape->kind));
    append_position(d, label ? " at " : " ", shape->at);
    if (shape->kind == OCTREE_SHAPE_BOX || shape->kind == OCTREE_SHAPE_SEGMENT)
        append_position(d, " to ", shape->to);
}

const layer_type layer_SHAPES = {.applies = has_shapes,
                                 .add = add_shapes,
                                 .legend = {.order = 160, .add_lines = add_shape_legend},
                                 .describe = describe_shape};
