/* diagram_words.c - the words of the diagram: the depth and the number of nodes of each row, and where the way that is
 * shown leads to. */
#include "diagram_words.h"
#include "diagram_place.h"
#include "layer.h"
#include "layout.h"
#include "number.h"
#include "text.h"
#include "text_space.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define EDGE 8      /* units to the sides of the diagram's part of the picture */
#define MOST 999999 /* a longer number is rounded */

typedef struct writing {
    const diagram_place *place;
    camera_window window;
    uint64_t next_id;
} writing;

static void write_words(writing *w, double x, double y, theme_role role, const char *format, ...)
{
    scene_label label = {.id = w->next_id++,
                         .at = {floor(x), floor(y)},
                         .style = {.layer = LAYER_DIAGRAM, .role = (uint8_t)role, .width = 1}};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(label.text, sizeof label.text, format, arguments);
    va_end(arguments);
    scene_add_label(w->place->scene, label);
}

static void write_count(writing *w, double x, double y, size_t count)
{
    char text[NUMBER_TEXT];
    if (count <= MOST)
        snprintf(text, sizeof text, "%zu", count);
    else
        number_text((double)count, 3, text);
    write_words(w, x, y, ROLE_TEXT, "%s", text);
}

static void write_rows(writing *w)
{
    const diagram_place *p = w->place;
    const int unit = p->scene->unit;
    const double left = w->window.x + EDGE * unit, right = p->left + p->width + EDGE * unit;
    const unsigned each = (unsigned)ceil(TEXT_HEIGHT * unit / p->pitch); /* rows that are too low have words but now and
                                                                            then */
    write_words(w, left, w->window.y + EDGE * unit, ROLE_FAINT, "depth");
    write_words(w, right, w->window.y + EDGE * unit, ROLE_FAINT, "nodes");
    for (unsigned depth = 0; depth < p->rows; depth += each) {
        const double y = diagram_row(p, depth) - 4 * unit;
        write_words(w, left, y, ROLE_FAINT, "%u", depth);
        if (p->slots.stats.nodes_at_depth[depth])
            write_count(w, right, y, p->slots.stats.nodes_at_depth[depth]);
    }
}

/* An address that is too long is cut: the diagram shows all of it. */
static void write_way(writing *w, const octree_node *way)
{
    const int unit = w->place->scene->unit;
    const size_t letters = (size_t)((w->window.width - 2 * EDGE * unit) / (TEXT_LETTER * unit));
    const double foot = w->window.y + w->window.height - (WORDS_BELOW - 6) * unit;
    char address[OCTREE_ADDRESS_TEXT], text[SCENE_TEXT * 2];
    const size_t length =
        (size_t)snprintf(text, sizeof text, "%s of %zu point%s: %s", way->leaf ? "leaf" : "node", way->count,
                         plural(way->count), octree_address_format(way->address, address));
    const size_t room = letters < SCENE_TEXT ? letters : SCENE_TEXT - 1;
    if (length > room)
        memcpy(text + room - 3, "...", 4);
    write_words(w, w->window.x + EDGE * unit, foot, ROLE_PLAYER, "%s", text);
}

void add_diagram_words(const diagram_place *place, const octree_node *way)
{
    writing w = {.place = place, .window = layout_diagram(&place->scene->view)};
    write_rows(&w);
    if (way)
        write_way(&w, way);
}
