/* diagram_place.c - see diagram_place.h. */
#include "diagram_place.h"
#include "diagram_words.h"
#include "layer.h"
#include "layout.h"

#include <math.h>

#define MARGIN 8       /* units around the diagram */
#define NARROWEST 2    /* units of a slot */
#define ROWS_AT_ONCE 4 /* so that rows seldom move when the tree grows deeper */

static unsigned rows_of(const octree *tree, unsigned depth)
{
    const unsigned most = (unsigned)octree_definition(tree).max_depth + 1;
    const unsigned rows = (depth + ROWS_AT_ONCE) / ROWS_AT_ONCE * ROWS_AT_ONCE;
    return rows < most ? rows : most;
}

bool diagram_place_make(diagram_place *place, scene *s, const octree *tree)
{
    const camera_window w = layout_diagram(&s->view);
    const int unit = s->unit;
    *place = (diagram_place){.scene = s};
    place->words = view_shows(&s->view, LAYER_TEXT) && w.width >= WORDS_WIDTH * unit && w.height >= WORDS_HEIGHT * unit;
    const double left = place->words ? WORDS_LEFT : MARGIN, right = place->words ? WORDS_RIGHT : MARGIN;
    const double above = place->words ? WORDS_ABOVE : MARGIN, below = place->words ? WORDS_BELOW : MARGIN;
    place->left = w.x + left * unit;
    place->width = w.width - (left + right) * unit;
    place->top = w.y + above * unit;
    if (place->width < NARROWEST * unit || w.height <= (above + below) * unit)
        return false;
    if (!diagram_arrange(&place->slots, tree, (size_t)(place->width / (NARROWEST * unit)))) {
        s->out_of_memory = true;
        return false;
    }
    place->rows = rows_of(tree, place->slots.stats.depth);
    place->pitch = (w.height - (above + below) * unit) / place->rows;
    return true;
}

bool diagram_on_way(const diagram_place *place, octree_address node, unsigned depth)
{
    const unsigned deep = place->way ? octree_address_depth(place->way) : 0;
    return place->way && depth <= deep && place->way >> 3 * (deep - depth) == node;
}

diagram_stop diagram_stop_at(const diagram_place *place, unsigned depth, double middle, double height)
{
    const double y = diagram_row(place, depth);
    return (diagram_stop){place->left + place->width * middle, y - height / 2, y + height / 2};
}

double diagram_row(const diagram_place *place, unsigned depth)
{
    return place->top + (depth + 0.5) * place->pitch;
}

void diagram_fill(const diagram_place *place, uint64_t id, double x, double y, double width, double height,
                  unsigned role)
{
    const int across = width < 1 ? 1 : (int)width, along = height < 1 ? 1 : (int)height;
    scene_add_panel(place->scene, (scene_panel){.id = id,
                                                .x = (int)floor(x - across / 2.0 + 0.5),
                                                .y = (int)floor(y - along / 2.0 + 0.5),
                                                .width = across,
                                                .height = along,
                                                .style = {.layer = LAYER_DIAGRAM, .role = (uint8_t)role}});
}
