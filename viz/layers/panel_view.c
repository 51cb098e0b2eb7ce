/* panel_view.c - see panel_view.h. */
#include "panel_view.h"
#include "filter.h"
#include "layer.h"
#include "number.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* "from to to" of one axis of the region. */
static void write_region_axis(pen *p, const char *name, const octree_box *region, int axis)
{
    char from[NUMBER_TEXT], to[NUMBER_TEXT];
    write_row(p, name, "%c %s to %s", "xyz"[axis], number_text(region->min[axis], 6, from),
              number_text(region->max[axis], 6, to));
}

static void write_filter(pen *p, const view_filter *f)
{
    char at[NUMBER_TEXT];
    if (f->slice)
        write_row(p, "slice", "%c = %s", f->slice, number_text(f->slice_at, 9, at));
    if (f->by_depth && f->min_depth == f->max_depth)
        write_row(p, "depth", "%u alone", f->min_depth);
    else if (f->by_depth)
        write_row(p, "depths", "%u to %u", f->min_depth, f->max_depth);
    if (f->leaves)
        write_row(p, "only", "leaves");
    for (int axis = 0; f->by_region && axis < 3; axis++)
        write_region_axis(p, axis ? "" : "region", &f->region, axis);
}

/* A value that is not to be passed over. */
static void write_warning(pen *p, const char *name, const char *value)
{
    write_text(p, MARGIN, ROLE_FAINT, 1, name);
    write_text(p, VALUE, ROLE_WARNING, 1, value);
    p->y += LINE;
}

static void write_budget(pen *p, const scene_tally *tally)
{
    char text[SCENE_TEXT];
    if (tally->beyond) {
        snprintf(text, sizeof text, tally->deepest < 0 ? "no nodes" : "nodes to depth %d", tally->deepest);
        write_warning(p, "budget", text);
    }
    if (tally->thinned) {
        snprintf(text, sizeof text, "1 point in %" PRIu64, tally->one_in);
        write_warning(p, tally->beyond ? "" : "budget", text);
    }
    if (tally->arrows.thinned) {
        snprintf(text, sizeof text, "1 arrow in %" PRIu64, tally->arrows.one_in);
        write_warning(p, tally->beyond || tally->thinned ? "" : "budget", text);
    }
}

static void write_folded(pen *p, const scene_tally *tally)
{
    char text[SCENE_TEXT];
    snprintf(text, sizeof text, tally->folded_from == tally->folded_to ? "depth %u" : "depths %u to %u",
             tally->folded_from, tally->folded_to);
    write_warning(p, "folded", text);
}

/* Whether "12 met < 2 px" has. */
static bool has_room(size_t count, const char *what, const char *lod)
{
    char number[SCENE_TEXT];
    snprintf(number, sizeof number, "%zu", count);
    return strlen(number) + strlen(what) + strlen(" < ") + strlen(lod) + strlen(" px") <= text_room(VALUE, 1);
}

/* "lod    12 below 2 px", and what follows in words that fit. */
static void write_small(pen *p, const scene_tally *tally)
{
    const struct {
        size_t count;
        const char *what;
    } kinds[] = {{tally->small, ""},
                 {tally->small_met, " met"},
                 {tally->arrows.small, tally->arrows.small == 1 ? " arrow" : " arrows"}};
    char lod[NUMBER_TEXT];
    bool first = true;
    number_text(p->scene->view.lod, 3, lod);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (!kinds[i].count)
            continue;
        if (i == 0)
            write_row(p, "lod", "%zu below %s px", kinds[i].count, lod);
        else if (first)
            write_row(p, "lod", "%zu%s < %s%s", kinds[i].count, kinds[i].what, lod,
                      has_room(kinds[i].count, kinds[i].what, lod) ? " px" : "");
        else
            write_row(p, "", "and %zu%s", kinds[i].count, kinds[i].what);
        first = false;
    }
}

/* What of the tree is there, where it is not all of it. */
static void write_shown(pen *p, const scene_tally *tally)
{
    const view *v = &p->scene->view;
    if (!filter_is_on(&v->filter) && !tally->small && !tally->beyond && !tally->thinned)
        return;
    write_filter(p, &v->filter);
    if (view_shows(v, LAYER_NODES))
        write_row(p, "shown", "%zu nodes", tally->nodes);
    if (view_shows(v, LAYER_POINTS))
        write_row(p, view_shows(v, LAYER_NODES) ? "" : "shown", "%zu points", tally->points);
}

void write_left_out(pen *p)
{
    const scene_tally *tally = &p->scene->tally;
    const int before = p->y;
    p->y += LINE / 2;
    const int begin = p->y;
    if (tally->folded)
        write_folded(p, tally);
    write_shown(p, tally);
    write_small(p, tally);
    write_budget(p, tally);
    if (p->scene->view.labels && tally->labels < tally->nodes)
        write_row(p, "labels", "%zu of %zu fit", tally->labels, tally->nodes);
    p->y = p->y == begin ? before : p->y; /* all is there */
}

/* One strip of a colour a step, from the ramp's first. */
static void fill_ramp(pen *p, int steps)
{
    for (int step = 0; step < steps; step++)
        fill(p, MARGIN + step * SWATCH / steps, p->y + 1, SWATCH / steps + 1, 6, theme_node_role((unsigned)step));
}

void write_node_legend(pen *p, size_t max_depth)
{
    char text[SCENE_TEXT] = "node";
    switch (p->scene->view.coloring) {
    case COLORING_DEPTH: /* down to the deepest that the tree allows */
        fill_ramp(p, max_depth + 1 < THEME_NODE_DEPTHS ? (int)max_depth + 1 : THEME_NODE_DEPTHS);
        snprintf(text, sizeof text, "node, shallow to deep");
        break;
    case COLORING_OCCUPANCY:
        fill_ramp(p, THEME_NODE_DEPTHS);
        snprintf(text, sizeof text, "node, 0-%u+ points", THEME_MOST_POINTS);
        break;
    default:
        fill(p, MARGIN, p->y + 3, SWATCH, 2, ROLE_NODE_PLAIN);
        break;
    }
    write_text(p, MARGIN + SWATCH + 6, ROLE_FAINT, 1, text);
    p->y += LINE;
}
