/* SPDX-License-Identifier: MIT */
#include "pen.h"
#include "layer.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

size_t text_room(int x, int size)
{
    const size_t fits = (size_t)((COLUMN - x) / (LETTER * size));
    return fits < SCENE_TEXT ? fits : SCENE_TEXT - 1;
}

void write_text(pen *p, int x, theme_role role, int size, const char *text)
{
    const scene *s = p->scene;
    scene_label label = {.id = p->next_id++,
                         .at = {x * s->unit, p->y * s->unit},
                         .style = {.layer = LAYER_TEXT, .role = (uint8_t)role, .width = (uint8_t)size}};
    const int fits = (int)text_room(x, size);
    snprintf(label.text, SCENE_TEXT, "%.*s", fits, text);
    if (strlen(text) > (size_t)fits)
        memcpy(label.text + fits - 2, "..", 2);
    scene_add_label(p->scene, label);
}

void write_line(pen *p, int x, theme_role role, const char *text)
{
    write_text(p, x, role, 1, text);
    p->y += LINE;
}

void write_row(pen *p, const char *name, const char *format, ...)
{
    char value[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    write_text(p, MARGIN, p->name, 1, name);
    write_line(p, VALUE, p->value, value);
}

void write_ids(pen *p, const char *name, const octree_point *points, size_t count)
{
    char text[SCENE_TEXT], more[SCENE_TEXT], longer[SCENE_TEXT * 2];
    size_t told = 0;
    snprintf(text, sizeof text, "%zu", count);
    more[0] = 0;
    for (; told < count && told < PEN_MOST_IDS; told++) {
        char rest[SCENE_TEXT] = "";
        if (told + 1 < count)
            snprintf(rest, sizeof rest, " +%zu", count - told - 1);
        snprintf(longer, sizeof longer, "%s%s %" PRIu64, text, told ? "" : ":", points[told].id);
        if (strlen(longer) + strlen(rest) > text_room(VALUE, 1))
            break;
        strcpy(text, longer);
        strcpy(more, rest);
    }
    write_row(p, name, "%s%s", text, more);
}

void fill(pen *p, int x, int y, int width, int height, unsigned role)
{
    const int unit = p->scene->unit;
    scene_add_rectangle(p->scene, p->next_id++, (int[]){x * unit, y * unit}, (int[]){width * unit, height * unit},
                        LAYER_TEXT, role);
}
