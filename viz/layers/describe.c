/* SPDX-License-Identifier: MIT */
/* describe.c - appends phrases to the description of an element, and asks the element's layer for its words. */
#include "describe.h"
#include "layer_type.h"
#include "number.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void append_text(description *d, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(d->subject->text + d->length, ELEMENT_TEXT - d->length, format, arguments);
    va_end(arguments);
    d->length += length > 0 ? (size_t)length : 0;
    if (d->length >= ELEMENT_TEXT)
        d->length = ELEMENT_TEXT - 1;
}

void append_number(description *d, double value)
{
    char text[NUMBER_TEXT];
    number_print(value, text);
    append_text(d, "%s", text);
}

void append_position(description *d, const double place[3])
{
    for (int i = 0; i < 3; i++) {
        append_text(d, i ? ", " : "(");
        append_number(d, place[i]);
    }
    append_text(d, ")");
}

void append_box(description *d, const octree_box *box)
{
    append_position(d, box->min);
    append_text(d, " to ");
    append_position(d, box->max);
}

static void find_node(description *d, octree_address address)
{
    element_subject *subject = d->subject;
    const octree *tree = octree_game_tree(d->game);
    subject->has_node = true;
    subject->gone = octree_node_at(tree, address, &subject->node) != OCTREE_OK;
    if (subject->gone) {
        const octree_box world = octree_definition(tree).world;
        subject->node = (octree_node){
            .address = address, .depth = octree_address_depth(address), .box = octree_cell_box(&world, address)};
    }
}

void describe_node(description *d, octree_address address)
{
    char path[OCTREE_ADDRESS_TEXT];
    const octree_node *node = &d->subject->node;
    find_node(d, address);
    append_text(d, "node %s: ", octree_address_format(address, path));
    if (d->subject->gone)
        append_text(d, "an empty cell at depth %u (its node no longer exists)", node->depth);
    else
        append_text(d, "%s at depth %u, %zu point%s", node->leaf ? "leaf" : "inner node", node->depth, node->count,
                    plural(node->count));
    append_text(d, ", box ");
    append_box(d, &node->box);
}

void describe_point(description *d, uint64_t id, const double position[3])
{
    d->subject->has_point = true;
    d->subject->point.id = id;
    memcpy(d->subject->point.position, position, sizeof d->subject->point.position);
    append_text(d, "point %" PRIu64 " at ", id);
    append_position(d, position);
}

static void describe(description *d, const described_element *element)
{
    const layer_type *type = layer_types[element->style.layer];
    const bool found = type->add_answer && element->kind == SCENE_MARKER;
    if (type->describe && !found)
        type->describe(d, element);
    else if (element->kind == SCENE_BOX)
        describe_node(d, element->id);
    else if (element->kind == SCENE_MARKER)
        describe_point(d, element->id, element->at);
    if (found)
        append_text(d, ", found by a %s query", layer_rows[element->style.layer].name);
}

element_subject describe_element(const octree_game *game, const heat *h, const scene *s, scene_element element)
{
    element_subject subject = {.text = ""};
    description d = {game, octree_game_tick(game), h, &subject, 0};
    described_element what = {
        .kind = element.kind, .style = scene_head_of(s, element).style, .id = scene_head_of(s, element).id};
    s = scene_with(s, element);
    if (element.kind == SCENE_BOX) {
        what.box = s->boxes.items[element.index].box;
    } else if (element.kind == SCENE_MARKER) {
        memcpy(what.at, s->markers.items[element.index].at, sizeof what.at);
        what.shape = (scene_shape)s->markers.items[element.index].shape;
    } else if (element.kind == SCENE_LABEL) {
        const char *text = s->labels.items[element.index].text;
        append_text(&d, "text \"%s\"", text + strspn(text, " "));
    }
    describe(&d, &what);
    return subject;
}
