/* element.c - the elements of a scene and their numbers. */
#include "draw.h"

static const char *const names[DRAW_KINDS] = {"box", "segment", "marker", "panel", "label"};

const char *draw_kind_name(draw_kind kind)
{
    return names[kind];
}

static size_t count_of(const scene *s, draw_kind kind)
{
    const size_t counts[DRAW_KINDS] = {s->boxes.count, s->segments.count, s->markers.count, s->panels.count,
                                       s->labels.count};
    return counts[kind];
}

draw_element draw_element_of(const scene *s, uint32_t number)
{
    draw_element element = {DRAW_BOX, number - 1};
    while (element.kind < DRAW_LABEL && element.index >= count_of(s, element.kind))
        element.index -= count_of(s, element.kind++);
    return element;
}

uint32_t draw_number_of(const scene *s, draw_element element)
{
    size_t number = element.index + 1;
    for (draw_kind kind = DRAW_BOX; kind < element.kind; kind++)
        number += count_of(s, kind);
    return (uint32_t)number;
}

scene_look draw_look_of(const scene *s, draw_element element)
{
    switch (element.kind) {
    case DRAW_BOX:
        return s->boxes.items[element.index].look;
    case DRAW_SEGMENT:
        return s->segments.items[element.index].look;
    case DRAW_MARKER:
        return s->markers.items[element.index].look;
    case DRAW_PANEL:
        return s->panels.items[element.index].look;
    default:
        return s->labels.items[element.index].look;
    }
}

uint64_t draw_id_of(const scene *s, draw_element element)
{
    switch (element.kind) {
    case DRAW_BOX:
        return s->boxes.items[element.index].id;
    case DRAW_SEGMENT:
        return s->segments.items[element.index].id;
    case DRAW_MARKER:
        return s->markers.items[element.index].id;
    case DRAW_PANEL:
        return s->panels.items[element.index].id;
    default:
        return s->labels.items[element.index].id;
    }
}
