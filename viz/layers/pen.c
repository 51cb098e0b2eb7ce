/* SPDX-License-Identifier: MIT */
/* pen.c - writes texts, rows and rectangles into the text column. */
#include "pen.h"
#include "layer.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

pen pen_in_column(scene *s)
{
    const int margin = LAYOUT_MARGIN * s->text.width;
    return (pen){
        .scene = s, .left = margin, .y = margin, .letters = LAYOUT_LETTERS, .name = ROLE_FAINT, .value = ROLE_TEXT};
}

pen pen_in_corner(scene *s)
{
    pen p = pen_in_column(s);
    p.left = p.y = s->text.width;
    const int fits = (s->view.width - 2 * p.left) / s->text.width;
    p.letters = fits < 1 ? 1 : fits < LAYOUT_LETTERS ? fits : LAYOUT_LETTERS;
    return p;
}

static void add_text(pen *p, int x, theme_role role, int size, size_t room, const char *text)
{
    scene_label label = {.id = p->next_id++,
                         .at = {p->left + x, p->y},
                         .style = {.layer = LAYER_TEXT, .role = (uint8_t)role, .width = (uint8_t)size}};
    const int fits = (int)(room < SCENE_TEXT ? room : SCENE_TEXT - 1);
    snprintf(label.text, SCENE_TEXT, "%.*s", fits, text);
    if (strlen(text) > (size_t)fits && fits > 2)
        memcpy(label.text + fits - 2, "..", 2);
    scene_add_label(p->scene, label);
}

void write_text(pen *p, int at, theme_role role, const char *text)
{
    add_text(p, at * p->scene->text.width, role, 1, at < p->letters ? (size_t)(p->letters - at) : 1, text);
}

void write_text_at(pen *p, int x, theme_role role, const char *text)
{
    add_text(p, x, role, 1, SCENE_TEXT - 1, text);
}

void write_right_aligned(pen *p, theme_role role, const char *text)
{
    const int length = (int)strlen(text);
    write_text(p, length < p->letters ? p->letters - length : 0, role, text);
}

void write_title_text(pen *p, theme_role role, const char *text)
{
    add_text(p, 0, role, 2, (size_t)(p->letters * p->scene->text.width / p->scene->title.width), text);
}

void write_line(pen *p, theme_role role, const char *text)
{
    write_text(p, 0, role, text);
    p->y += p->scene->text.line;
}

/* Write a row's value at the right and move to the next line. The value is cut if it does not fit behind the first
 * `taken` letters. */
static void write_row_value(pen *p, size_t taken, char *value)
{
    const size_t room = (size_t)p->letters > taken + 1 ? (size_t)p->letters - taken - 1 : 0;
    if (strlen(value) > room && room > 2)
        memcpy(value + room - 2, "..", 3);
    write_right_aligned(p, p->value, value);
    p->y += p->scene->text.line;
}

void write_row(pen *p, const char *name, const char *format, ...)
{
    char value[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    write_text(p, 0, p->name, name);
    write_row_value(p, strlen(name), value);
}

void write_detailed_row(pen *p, const char *name, const char *detail, const char *format, ...)
{
    char value[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    const int room = p->letters - DETAIL - (int)strlen(value) - 1;
    const int fits = room < 0 ? 0 : room < (int)strlen(detail) ? room : (int)strlen(detail);
    char cut[SCENE_TEXT];
    snprintf(cut, sizeof cut, "%.*s", fits, detail);
    if (detail[fits] && fits > 2)
        memcpy(cut + fits - 2, "..", 2);
    write_text(p, 0, p->name, name);
    if (*cut)
        write_text(p, DETAIL, ROLE_FAINT, cut);
    write_row_value(p, *cut ? DETAIL + strlen(cut) : strlen(name), value);
}

void write_gap(pen *p)
{
    p->y += p->scene->text.line / 2;
}

void write_rule(pen *p)
{
    const scene *s = p->scene;
    if (panel_width(&s->view))
        fill_rectangle(p, 0, s->text.line / 4, p->letters * s->text.width,
                       s->text.height < 48 ? 1 : s->text.height / 24, ROLE_WORLD);
    write_gap(p);
}

const char *format_number_within(double value, size_t letters, char text[NUMBER_TEXT])
{
    for (int digits = 9; digits > 0 && strlen(number_text(value, digits, text)) > letters; digits--)
        continue;
    return text;
}

void write_ids(pen *p, const char *name, const octree_point *points, size_t count)
{
    char text[SCENE_TEXT] = "", more[SCENE_TEXT] = "", longer[SCENE_TEXT * 2], found[SCENE_TEXT];
    const size_t taken = (size_t)snprintf(found, sizeof found, "%zu found", count) + DETAIL + 1;
    size_t shown = 0;
    for (; shown < count && shown < PEN_MOST_IDS; shown++) {
        char rest[SCENE_TEXT] = "";
        if (shown + 1 < count)
            snprintf(rest, sizeof rest, " +%zu", count - shown - 1);
        snprintf(longer, sizeof longer, "%s%s#%" PRIu64, text, shown ? " " : "", points[shown].id);
        if (taken + strlen(longer) + strlen(rest) > (size_t)p->letters)
            break;
        strcpy(text, longer);
        strcpy(more, rest);
    }
    strcat(text, more);
    write_detailed_row(p, name, text, "%s", found);
}

void fill_rectangle(pen *p, int x, int y, int width, int height, unsigned role)
{
    scene_add_rectangle(p->scene, p->next_id++, (int[]){p->left + x, p->y + y}, (int[]){width, height}, LAYER_TEXT,
                        role);
}

void write_wrapped(pen *p, theme_role role, const char *text)
{
    const size_t most = (size_t)p->letters;
    while (*text) {
        char line[SCENE_TEXT];
        size_t length = strlen(text);
        for (size_t i = length > most ? most : 0; i > 0; i--)
            if (text[i] == ' ') {
                length = i;
                break;
            }
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        write_line(p, role, line);
        text += length + (text[length] == ' ');
    }
}

void fill_rectangle_in_color(pen *p, int x, int y, int width, int height, theme_color color)
{
    scene_add_panel(p->scene, (scene_panel){.id = p->next_id++,
                                            .x = p->left + x,
                                            .y = p->y + y,
                                            .width = width,
                                            .height = height,
                                            .color = color,
                                            .style = {.layer = LAYER_TEXT, .role = ROLE_OWN}});
}
