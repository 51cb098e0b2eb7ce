/* diagram_legend.c - see diagram_legend.h. */
#include "diagram_legend.h"
#include "filter.h"
#include "layer.h"

/* What each line stands for, and its swatch: rectangles in a square of SWATCH units, x, y, width and height. */
typedef struct mark {
    const char *text;
    bool (*is_there)(const scene *s);
    theme_role role;
    int parts[3][4];
} mark;

static bool has_nodes(const scene *s)
{
    return s->tally.drawn > 0;
}

static bool has_way(const scene *s)
{
    return s->tally.way > 0;
}

static bool has_bars(const scene *s)
{
    return s->tally.folded > 0;
}

static bool has_filter(const scene *s)
{
    return filter_is_on(&s->view.filter);
}

static const mark marks[] = {
    {"inner node, leaf", has_nodes, ROLE_NODE_PLAIN, {{3, 1, 6, 6}, {14, 3, 3, 3}}},
    {"way from the root", has_way, ROLE_PLAYER, {{0, 4, SWATCH, 1}}},
    {"nodes, log2, folded", has_bars, ROLE_NODE_PLAIN, {{6, 3, 2, 2}, {9, 1, 2, 6}, {12, 2, 2, 4}}},
    {"node filtered out", has_filter, ROLE_WORLD, {{7, 1, 6, 6}}},
};

#define MARKS (sizeof marks / sizeof marks[0])

int diagram_legend_lines(const scene *s)
{
    int lines = 0;
    for (size_t i = 0; view_shows(&s->view, LAYER_DIAGRAM) && i < MARKS; i++)
        lines += marks[i].is_there(s);
    return lines;
}

static void write_mark(pen *p, const mark *m)
{
    for (size_t i = 0; i < sizeof m->parts / sizeof m->parts[0] && m->parts[i][2]; i++)
        fill(p, MARGIN + m->parts[i][0], p->y + m->parts[i][1], m->parts[i][2], m->parts[i][3], m->role);
    write_text(p, MARGIN + SWATCH + 6, ROLE_FAINT, 1, m->text);
    p->y += LINE;
}

void write_diagram_legend(pen *p)
{
    for (size_t i = 0; view_shows(&p->scene->view, LAYER_DIAGRAM) && i < MARKS; i++)
        if (marks[i].is_there(p->scene))
            write_mark(p, &marks[i]);
}
