/* SPDX-License-Identifier: MIT */
/* pen.c - writes texts, rows and rectangles into the text column. */
#include "pen.h"
#include "layer.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

pen make_column_pen(scene *s)
{
    const int margin = LAYOUT_MARGIN * s->text.width;
    const bool apart = s->view.text_apart;
    return (pen){.scene = s,
                 .text = apart ? PEN_ROW_LETTERING : s->text,
                 .rows = apart ? s->rows : NULL,
                 .left = margin,
                 .y = margin,
                 .letters = apart ? SCENE_TEXT - 1 : LAYOUT_LETTERS,
                 .name = ROLE_FAINT,
                 .value = ROLE_TEXT};
}

pen make_corner_pen(scene *s)
{
    pen p = make_column_pen(s);
    p.left = p.y = s->text.width;
    const int fits = (s->view.width - 2 * p.left) / s->text.width;
    p.letters = fits < 1 ? 1 : fits < LAYOUT_LETTERS ? fits : LAYOUT_LETTERS;
    return p;
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

/* Write the colour of a role as a member, unless the role is `usual`. */
static void write_color(pen *p, const char *key, theme_role role, theme_role usual)
{
    char text[THEME_COLOR_TEXT];
    if (role != usual)
        json_write_text_member(p->rows, key, theme_print_color(theme_color_at(theme_color_index(role, 0)), text));
}

static void write_text_row(pen *p, const char *key, theme_role role, const char *text)
{
    json_write_begin_object(p->rows);
    json_write_text_member(p->rows, key, text);
    write_color(p, "color", role, ROLE_TEXT);
    json_write_end_object(p->rows);
}

static void write_row_object(pen *p, const char *name, const char *detail, const char *value)
{
    json_write_begin_object(p->rows);
    json_write_text_member(p->rows, "name", name);
    if (*detail)
        json_write_text_member(p->rows, "detail", detail);
    json_write_text_member(p->rows, "value", value);
    write_color(p, "name_color", p->name, ROLE_FAINT);
    write_color(p, "color", p->value, ROLE_TEXT);
    json_write_end_object(p->rows);
}

static void write_rectangle(pen *p, int x, int y, int width, int height, theme_color color)
{
    char text[THEME_COLOR_TEXT];
    json_write_begin_array(p->rows);
    json_write_elements(p->rows, (double[]){x, y, width, height}, 4);
    json_write_string(p->rows, theme_print_color(color, text));
    json_write_end_array(p->rows);
}

void begin_sign(pen *p)
{
    json_write_begin_object(p->rows);
    json_begin_array_member(p->rows, "sign");
}

void end_sign(pen *p, const char *text)
{
    json_write_end_array(p->rows);
    json_write_text_member(p->rows, "text", text);
    json_write_end_object(p->rows);
}

/* ---- Lines --------------------------------------------------------------------------------------------------- */

/* Cut a text to `room` characters. A text that is cut ends in two dots. */
static void shorten_text(char *text, size_t room)
{
    if (strlen(text) <= room)
        return;
    text[room] = 0;
    if (room > 2)
        memcpy(text + room - 2, "..", 2);
}

/* Write a label x pixels to the right of the pen. A text longer than `room` characters is cut. */
static void add_text(pen *p, int x, theme_role role, unsigned size, size_t room, const char *text)
{
    scene_label label =
        scene_make_label(p->next_id++, make_role_style(LAYER_TEXT, role, STROKE_SOLID, size), "%s", text);
    label.at[0] = p->left + x;
    label.at[1] = p->y;
    shorten_text(label.text, room);
    scene_add_label(p->scene, label);
}

void write_text(pen *p, int at, theme_role role, const char *format, ...)
{
    char text[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (p->rows)
        write_text_row(p, "text", role, text);
    else
        add_text(p, at * p->text.width, role, 1, at < p->letters ? (size_t)(p->letters - at) : 1, text);
}

void write_text_at(pen *p, int x, theme_role role, const char *text)
{
    if (!p->rows) {
        add_text(p, x, role, 1, SCENE_TEXT, text);
        return;
    }
    json_write_begin_array(p->rows);
    json_write_number(p->rows, x);
    json_write_string(p->rows, text);
    json_write_end_array(p->rows);
}

void write_right_aligned(pen *p, theme_role role, const char *text)
{
    const int length = (int)strlen(text);
    if (p->rows)
        write_row(p, "", "", "%s", text);
    else
        write_text(p, length < p->letters ? p->letters - length : 0, role, "%s", text);
}

void write_title_text(pen *p, theme_role role, const char *text)
{
    if (p->rows)
        write_text_row(p, "title", role, text);
    else
        add_text(p, 0, role, 2, (size_t)(p->letters * p->text.width / p->scene->title.width), text);
}

void write_caption(pen *p, const char *text)
{
    char line[SCENE_TEXT * 8];
    if (p->rows) {
        write_text_row(p, "caption", ROLE_TEXT, text);
        return;
    }
    snprintf(line, sizeof line, "%s", text);
    shorten_text(line, (size_t)p->letters);
    for (size_t at = 0; at < strlen(line); at += SCENE_TEXT - 1)
        add_text(p, (int)at * p->text.width, ROLE_TEXT, 1, SCENE_TEXT - 1, line + at);
}

void write_line(pen *p, theme_role role, const char *text)
{
    write_text(p, 0, role, "%s", text);
    p->y += p->text.line;
}

void write_row(pen *p, const char *name, const char *detail, const char *format, ...)
{
    char value[SCENE_TEXT], between[SCENE_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    if (p->rows) {
        write_row_object(p, name, detail, value);
        return;
    }
    snprintf(between, sizeof between, "%s", detail);
    shorten_text(between, (size_t)detail_room(p, strlen(value)));
    const int taken = *between ? DETAIL + (int)strlen(between) : (int)strlen(name);
    /* A value that is cut to one or two characters would be useless. Such a value is therefore not cut, and covers the
     * row's name. */
    if (p->letters - taken - 1 > 2)
        shorten_text(value, (size_t)(p->letters - taken - 1));
    write_text(p, 0, p->name, "%s", name);
    if (*between)
        write_text(p, DETAIL, ROLE_FAINT, "%s", between);
    write_right_aligned(p, p->value, value);
    p->y += p->text.line;
}

void write_gap(pen *p)
{
    p->y += p->text.line / 2;
}

void write_separator_line(pen *p)
{
    const lettering *text = &p->text;
    if (p->rows) {
        json_write_begin_object(p->rows);
        json_write_bool_member(p->rows, "rule", true);
        json_write_end_object(p->rows);
    } else if (layout_panel_width(&p->scene->view)) {
        fill_rectangle(p, 0, text->line / 4, p->letters * text->width, text->height < 48 ? 1 : text->height / 24,
                       ROLE_WORLD);
    }
    write_gap(p);
}

const char *format_number_within(double value, size_t letters, char text[NUMBER_TEXT])
{
    for (int digits = 9; digits > 0 && strlen(number_format(value, digits, text)) > letters; digits--)
        continue;
    return text;
}

void write_ids(pen *p, const char *name, const octree_point *points, size_t count)
{
    char text[SCENE_TEXT * 2];
    const int room = detail_room(p, (size_t)snprintf(NULL, 0, "%zu found", count));
    size_t shown = count < PEN_MOST_IDS ? count : PEN_MOST_IDS;
    do {
        size_t used = 0;
        text[0] = 0;
        for (size_t i = 0; i < shown; i++)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s#%" PRIu64, i ? " " : "", points[i].id);
        if (shown && shown < count)
            snprintf(text + used, sizeof text - used, " +%zu", count - shown);
    } while (shown-- > 0 && (int)strlen(text) > room);
    write_row(p, name, text, "%zu found", count);
}

void fill_rectangle(pen *p, int x, int y, int width, int height, unsigned role)
{
    if (p->rows)
        write_rectangle(p, x, y, width, height, theme_color_at(theme_color_index(role, 0)));
    else
        scene_add_rectangle(p->scene, p->next_id++, (int[]){p->left + x, p->y + y}, (int[]){width, height}, LAYER_TEXT,
                            role);
}

void write_wrapped_text(pen *p, theme_role role, const char *text)
{
    const size_t most = (size_t)p->letters;
    if (p->rows) {
        write_text_row(p, "text", role, text);
        return;
    }
    while (*text) {
        char line[SCENE_TEXT];
        const size_t left = strlen(text);
        size_t length = left > most ? most : left;
        while (left > most && length > 0 && text[length] != ' ')
            length--;
        length = length > 0 ? length : left; /* a word longer than the line is cut at the end of the line */
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        write_line(p, role, line);
        text += length + (text[length] == ' ');
    }
}

void fill_rectangle_in_color(pen *p, int x, int y, int width, int height, theme_color color)
{
    const scene_style style = make_role_style(LAYER_TEXT, ROLE_OWN, STROKE_SOLID, 0);
    if (p->rows)
        write_rectangle(p, x, y, width, height, color);
    else
        scene_add_panel(p->scene, (scene_panel){p->next_id++, style, color, p->left + x, p->y + y, width, height});
}
