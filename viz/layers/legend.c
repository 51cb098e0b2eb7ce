/* SPDX-License-Identifier: MIT */
/* legend.c - collects the lines of the legend, drops lines that do not fit, and draws the other lines.
 *
 * The legend lists only layers that have elements in the frame. It stands at the bottom of the text column, so that the
 * number of rows above it does not move it. The lines of layers that occur in nearly every frame stand lowest, so that
 * lines that come and go do not move them.
 *
 * If there are too many lines, whole groups are dropped; a group is a line with its continuation lines. Groups that
 * readers understand without the legend are dropped first, and then groups of layers whose answer the panel shows. If
 * that is not enough, lines are dropped from the end. A final line counts the dropped lines.
 *
 * The signs are drawn in whole dots from tables of rectangles, so they are sharp at every font size. */
#include "legend.h"
#include "layer_type.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

legend_line *legend_add(legend *l, legend_sign sign, const char *format, ...)
{
    legend_line *line = &l->lines[l->count < LEGEND_MOST_LINES ? l->count++ : LEGEND_MOST_LINES - 1];
    va_list arguments;
    *line = l->next;
    line->sign = sign;
    va_start(arguments, format);
    vsnprintf(line->text, sizeof line->text, format, arguments);
    va_end(arguments);
    return line;
}

/* ---- Choosing lines ------------------------------------------------------------------------------------------ */

/* Return the layers that have elements in this frame or its close-up: bit i for layer i. */
static unsigned find_layers_in_frame(const scene *s)
{
    unsigned layers = 0;
    for (size_t i = 0; i < s->boxes.count; i++)
        layers |= 1u << s->boxes.items[i].style.layer;
    for (size_t i = 0; i < s->segments.count; i++)
        layers |= 1u << s->segments.items[i].style.layer;
    for (size_t i = 0; i < s->markers.count; i++)
        layers |= 1u << s->markers.items[i].style.layer;
    return s->has_closeup ? layers | find_layers_in_frame(s->closeup) : layers;
}

/* Return whether the diagram shows a layer. The diagram uses the colours of nodes, and draws visited and pruned nodes
 * in their own ways. */
static bool is_in_diagram(const scene *s, view_layer layer)
{
    return view_shows_layer(&s->view, LAYER_DIAGRAM) &&
           (layer == LAYER_DIAGRAM || layer == LAYER_NODES || (layer == LAYER_VISITED && s->tally.marked_visited) ||
            (layer == LAYER_PRUNED && s->tally.marked_pruned));
}

static void add_layer_line(legend *l, const layer_source *in, view_layer layer)
{
    const legend_entry *entry = &layer_types[layer]->legend;
    const scene *s = l->scene;
    if (!is_in_diagram(s, layer) && !(layer < LAYER_COUNT && l->in_frame >> layer & 1))
        return;
    l->next =
        (legend_line){.layer = layer, .drop_order = entry->drop_order, .role = (theme_role)layer_rows[layer].role};
    if (entry->add_lines)
        entry->add_lines(l, in);
    else
        legend_add(l, entry->sign, "%s", entry->text);
}

/* Return whether a line continues the line before it. Such a line is dropped or kept together with the line before
 * it. */
static bool is_continuation(const legend_line *line)
{
    return line->sign == SIGN_NONE || line->sign == SIGN_SCALE;
}

/* Remove a line together with its continuation lines. */
static void remove_line(legend *l, size_t place)
{
    size_t end = place + 1;
    while (end < l->count && is_continuation(&l->lines[end]))
        end++;
    memmove(&l->lines[place], &l->lines[end], (l->count - end) * sizeof *l->lines);
    l->count -= end - place;
}

/* Remove lines until the other lines fit into `room` lines, together with a final line that counts the removed lines.
 * Return the number of removed lines, which is 0 if all lines fit. */
static size_t remove_lines_until_fit(legend *l, size_t room)
{
    const size_t needed = l->count, left = room ? room - 1 : 0;
    if (needed <= room)
        return 0;
    for (legend_drop_order least = DROP_FIRST; least > DROP_LAST; least--)
        for (size_t i = 0; i < l->count && l->count > left;)
            if (l->lines[i].drop_order == least)
                remove_line(l, i);
            else
                i++;
    if (l->count > left)
        for (l->count = left; l->count && is_continuation(&l->lines[l->count]);)
            l->count--;
    return needed - l->count;
}

/* ---- Drawing lines ------------------------------------------------------------------------------------------- */

/* Signs are drawn in square dots. The side of a dot is a twelfth of a character's height, rounded down to whole pixels,
 * and at least one pixel. A sign is SWATCH dots wide and SIGN_HEIGHT dots high, and is centred in the height of its
 * line. */
#define SWATCH 18
#define SIGN_HEIGHT 9

/* The rectangles of each sign that consists of rectangles: x, y, width and height, in dots. */
enum { SIGN_PARTS = 10 };
static const int8_t signs[][SIGN_PARTS][4] = {
    [SIGN_LINE] = {{0, 4, SWATCH, 1}},
    [SIGN_BOLD] = {{0, 3, SWATCH, 2}},
    [SIGN_DASHES] = {{0, 4, 4, 1}, {7, 4, 4, 1}, {14, 4, 4, 1}},
    [SIGN_PLUS] = {{4, 4, 11, 1}, {9, -1, 1, 11}},
    [SIGN_DASHED_PLUS] = {{4, 4, 3, 1}, {9, -1, 1, 3}, {8, 4, 3, 1}, {9, 3, 1, 3}, {12, 4, 3, 1}, {9, 7, 1, 3}},
    [SIGN_FRAME] = {{6, 1, 7, 1}, {6, 7, 7, 1}, {6, 2, 1, 5}, {12, 2, 1, 5}},
    [SIGN_RING] = {{8, -1, 5, 2},
                   {8, 7, 5, 2},
                   {5, 2, 2, 4},
                   {14, 2, 2, 4},
                   {6, 0, 2, 2},
                   {13, 0, 2, 2},
                   {6, 6, 2, 2},
                   {13, 6, 2, 2}},
    [SIGN_TRIANGLE] = {{9, 1, 1, 1},
                       {8, 2, 1, 1},
                       {10, 2, 1, 1},
                       {7, 3, 1, 1},
                       {11, 3, 1, 1},
                       {6, 4, 1, 1},
                       {12, 4, 1, 1},
                       {5, 5, 1, 1},
                       {13, 5, 1, 1},
                       {4, 6, 11, 1}},
    [SIGN_WEDGE] = {{9, 6, 1, 1}, {8, 5, 3, 1}, {7, 4, 5, 1}, {6, 3, 7, 1}, {5, 2, 9, 1}, {4, 1, 11, 1}},
    [SIGN_DOT] = {{9, 3, 2, 2}},
    [SIGN_SQUARE] = {{7, 2, 5, 5}},
    [SIGN_ARROW] = {{0, 4, SWATCH, 1}, {15, 3, 2, 3}, {13, 2, 2, 5}, {11, 1, 2, 7}},
    [SIGN_NODES] = {{3, 1, 6, 6}, {14, 3, 3, 3}},
    [SIGN_BARS] = {{6, 3, 2, 2}, {9, 1, 2, 6}, {12, 2, 2, 4}},
    [SIGN_NODE] = {{7, 1, 6, 6}},
};

/* Fill a rectangle of a sign. All numbers are in dots. */
static void fill_dots(pen *p, int x, int y, int width, int height, unsigned role)
{
    const int letter = p->text.height, dot = letter < 24 ? 1 : letter / 12;
    fill_rectangle(p, x * dot, (letter - SIGN_HEIGHT * dot) / 2 + y * dot, width * dot, height * dot, role);
}

static void fill_sign(pen *p, const legend_line *line)
{
    if (line->sign == SIGN_SCALE) {
        write_scale(p, &line->scale);
    } else if (line->sign == SIGN_CHECKS) {
        for (int i = 0; i < 4; i++) /* draw four cells of a chessboard */
            fill_dots(p, 5 + i % 2 * 4, i / 2 * 4, 4, 4, i % 3 ? ROLE_WORLD : ROLE_POINT);
    } else if (line->sign == SIGN_SWATCH) {
        const int side = p->text.height / 2;
        fill_rectangle_in_color(p, SWATCH * side / 12 - side / 2, p->text.height / 4, side, side, line->color);
    } else if (line->sign == SIGN_CROSS) {
        for (int i = -4; i <= 4; i++)
            for (int side = -1; side <= (i ? 1 : -1); side += 2)
                fill_dots(p, SWATCH / 2 + i, 4 + side * i, 1, 1, line->role);
    } else if (line->sign == SIGN_GROWING_RAMP) {
        for (int i = 0; i < THEME_NODE_DEPTHS; i++)
            fill_dots(p, i * SWATCH / THEME_NODE_DEPTHS, 4 - i / 2, 2, i + 1, theme_node_role((unsigned)i));
    } else if (line->sign == SIGN_RAMP) {
        for (int i = 0; i < line->steps; i++) {
            const int from = i * SWATCH / line->steps, to = (i + 1) * SWATCH / line->steps;
            fill_dots(p, from, 1, to - from, 7, theme_node_role((unsigned)i));
        }
    } else {
        const int8_t(*parts)[4] = signs[line->sign];
        for (int i = 0; i < SIGN_PARTS && parts[i][2]; i++)
            fill_dots(p, parts[i][0], parts[i][1], parts[i][2], parts[i][3], line->role);
    }
}

void legend_add_depths(legend *l, const char *what, size_t deepest)
{
    const size_t last = deepest < THEME_NODE_DEPTHS ? deepest : THEME_NODE_DEPTHS - 1;
    char range[NUMBER_TEXT] = "0";
    if (last > 0)
        snprintf(range, sizeof range, "0-%zu%s", last, deepest > last ? "+" : "");
    legend_add(l, SIGN_RAMP, "%s %s", what, range)->steps = (int)last + 1;
}

void legend_add_scale(legend *l, legend_scale scale)
{
    legend_add(l, SIGN_SCALE, "")->scale = scale;
    legend_add(l, SIGN_NONE, "");
}

/* Write a legend line at the position of the pen or, for a page, as a row. */
static void write_legend_line(pen *p, const legend_line *line)
{
    if (p->rows)
        begin_sign(p);
    fill_sign(p, line);
    if (p->rows)
        end_sign(p, line->text);
    else if (*line->text)
        write_text(p, LEGEND_WORDS, ROLE_FAINT, "%s", line->text);
}

void write_legend(pen *p, const layer_source *in)
{
    const scene *s = p->scene;
    const int line = p->text.line, foot = s->view.height - LAYOUT_MARGIN * s->text.width;
    const int room = (foot - p->y - line / 2) / line;
    legend l = {.scene = s, .in_frame = find_layers_in_frame(s)};
    for (int order = LEGEND_LAST; order > 0; order--)
        for (int i = 0; i < LAYER_ALL; i++)
            if (layer_types[i]->legend.order == order)
                add_layer_line(&l, in, (view_layer)i);
    const size_t left_out = p->rows ? 0 : remove_lines_until_fit(&l, room > 0 ? (size_t)room : 0);
    if (l.count == 0)
        return;
    p->y = foot - (int)(l.count + (left_out > 0)) * line - line / 2;
    write_separator_line(p);
    for (size_t i = 0; i < l.count; i++) {
        write_legend_line(p, &l.lines[i]);
        p->y += line;
    }
    if (left_out)
        write_text(p, LEGEND_WORDS, ROLE_FAINT, "and %zu more", left_out);
}
