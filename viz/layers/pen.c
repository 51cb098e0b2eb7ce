/* panel_pen.c - see panel_pen.h. */
#include "panel_pen.h"
#include "layer.h"

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
                         .style = {.layer = LAYER_TEXT, .role = (uint8_t)role, .width = (uint8_t)size}};
    label.at[0] = x * s->unit;
    label.at[1] = p->y * s->unit;
    const int fits = (int)text_room(x, size);
    snprintf(label.text, SCENE_TEXT, "%.*s", fits, text);
    if (strlen(text) > (size_t)fits)
        memcpy(label.text + fits - 2, "..", 2);
    scene_add_label(p->scene, label);
}

void write_row(pen *p, const char *name, const char *format, ...)
{
    char value[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    write_text(p, MARGIN, p->name, 1, name);
    write_text(p, VALUE, ROLE_TEXT, 1, value);
    p->y += LINE;
}

void fill(pen *p, int x, int y, int width, int height, unsigned role)
{
    const int unit = p->scene->unit;
    scene_add_panel(p->scene, (scene_panel){.id = p->next_id++,
                                            .x = x * unit,
                                            .y = y * unit,
                                            .width = width * unit,
                                            .height = height * unit,
                                            .style = {.layer = LAYER_TEXT, .role = (uint8_t)role}});
}
