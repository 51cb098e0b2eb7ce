/* diagram_bars.c - the levels of the diagram that are folded: how many nodes stand in each column of the picture. */
#include "diagram.h"
#include "diagram_place.h"
#include "element_ids.h"
#include "filter.h"
#include "tree_nodes.h"

#include <math.h>
#include <stdlib.h>

#define COLUMN 2 /* units */
#define STEPS 16 /* of a bar's height; as high as a row */

/* What stands in a column of a level. */
typedef struct bar {
    size_t nodes, points;
    bool shown; /* some of them, by the view's filter */
} bar;

typedef struct folding {
    diagram_place *place;
    octree_box world;
    bar *bars; /* of a level after the other, from the first that is folded */
    size_t columns;
} folding;

static void count_node(const octree_node *node, double middle, void *context)
{
    folding *f = context;
    diagram_place *p = f->place;
    const size_t column = (size_t)(middle * (double)f->columns);
    bar *b =
        &f->bars[(node->depth - p->slots.deepest - 1) * f->columns + (column < f->columns ? column : f->columns - 1)];
    b->nodes++;
    b->points += node->count;
    b->shown = b->shown || filter_shows_node(&p->scene->view.filter, &f->world, node);
    if (diagram_on_way(p, node->address, node->depth))
        p->stops[node->depth] = diagram_stop_at(p, node->depth, middle, fmin(DIAGRAM_NODE * p->scene->unit, p->pitch));
}

/* 1 for a node, 2 for two or three, 3 for four to seven ... */
static unsigned steps_of(size_t nodes)
{
    unsigned steps = 0;
    for (; nodes && steps < STEPS; nodes /= 2)
        steps++;
    return steps;
}

static void add_bar(const folding *f, unsigned depth, size_t column, const bar *b)
{
    const diagram_place *p = f->place;
    const view *v = &p->scene->view;
    const double unit = p->scene->unit, width = p->width / (double)f->columns;
    const double height = fmax(floor((p->pitch - 2 * unit) * steps_of(b->nodes) / STEPS), 1);
    const double x = p->left + ((double)column + 0.5) * width;
    diagram_fill(p, diagram_bar_id(depth, column), x, diagram_row(p, depth), fmax(width - unit / 2, 1), height,
                 b->shown ? node_role(v, depth, b->points / b->nodes) : ROLE_WORLD);
    p->scene->tally.folded += b->nodes;
}

void add_diagram_bars(diagram_place *place, const octree *tree)
{
    const diagram_slots *slots = &place->slots;
    const unsigned levels = slots->stats.depth - slots->deepest;
    folding f = {.place = place, .world = octree_definition(tree).world};
    f.columns = (size_t)fmax(place->width / (COLUMN * place->scene->unit), 1);
    f.bars = levels ? calloc(levels * f.columns, sizeof *f.bars) : NULL;
    if (levels && !f.bars)
        place->scene->out_of_memory = true;
    if (!f.bars)
        return;
    place->scene->tally.folded_from = slots->deepest + 1;
    place->scene->tally.folded_to = slots->stats.depth;
    diagram_visit_folded(slots, tree, count_node, &f);
    for (size_t i = 0; i < levels * f.columns; i++)
        if (f.bars[i].nodes)
            add_bar(&f, slots->deepest + 1 + (unsigned)(i / f.columns), i % f.columns, &f.bars[i]);
    free(f.bars);
}
