/* SPDX-License-Identifier: MIT */
/* describe.c - appends phrases to the description of an element, and calls the layer that describes the element. */
#include "describe.h"
#include "foreign_nodes.h"
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

void append_number(description *d, const char *before, double value)
{
    char text[NUMBER_TEXT];
    number_print(value, text);
    append_text(d, "%s%s", before, text);
}

void append_position(description *d, const char *before, const double position[3])
{
    append_text(d, "%s", before);
    for (int i = 0; i < 3; i++)
        append_number(d, i ? ", " : "(", position[i]);
    append_text(d, ")");
}

void append_box(description *d, const char *before, const octree_box *box)
{
    append_position(d, before, box->min);
    append_position(d, " to ", box->max);
}

static void set_subject_node(description *d, octree_address address)
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

void describe_node(description *d, const char *before, uint64_t id)
{
    char path[OCTREE_ADDRESS_TEXT];
    const octree_node *node = &d->subject->node;
    if (is_foreign_element(id)) {
        describe_foreign_node(d, before, id);
        return;
    }
    set_subject_node(d, id);
    append_text(d, "%snode %s: ", before, octree_address_format(id, path));
    if (d->subject->gone)
        append_text(d, "an empty cell at depth %u (its node no longer exists)", node->depth);
    else
        append_text(d, "%s at depth %u, %zu point%s", node->leaf ? "leaf" : "inner node", node->depth, node->count,
                    plural_ending(node->count));
    append_box(d, ", box ", &node->box);
}

void describe_point(description *d, const char *before, uint64_t id, const double position[3])
{
    d->subject->has_point = true;
    d->subject->point.id = id;
    memcpy(d->subject->point.position, position, sizeof d->subject->point.position);
    append_text(d, "%spoint %" PRIu64, before, id);
    append_position(d, " at ", position);
}

static void describe(description *d, const described_element *element)
{
    const layer_type *type = layer_types[element->style.layer];
    const bool found = type->add_answer && element->kind == SCENE_MARKER;
    octree_point point; /* it can lie beside the marker, which is where a ray hits the point's body */
    if (type->describe && !found)
        type->describe(d, element);
    else if (element->kind == SCENE_BOX)
        describe_node(d, "", element->id);
    else if (element->kind == SCENE_MARKER)
        describe_point(d, "", element->id,
                       found && octree_game_find(d->game, element->id, &point) ? point.position : element->at);
    if (found)
        append_text(d, ", found by a %s query", layer_rows[element->style.layer].name);
}

element_subject describe_element(const octree_game *game, const heat *h, const scene *s, scene_element element)
{
    element_subject subject = {.text = ""};
    description d = {game, octree_game_tick(game), h, &subject, 0};
    described_element what = {
        .kind = element.kind, .style = scene_element_head(s, element).style, .id = scene_element_head(s, element).id};
    s = scene_containing(s, element);
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
