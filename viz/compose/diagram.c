/* SPDX-License-Identifier: MIT */
/* diagram.c - the layer of the diagram. The diagram shows the tree as Figure 2 of "3D Spatial Partitioning and
 * Collision Detection using Octrees" does: the root at the top, and each level in a row below it.
 *
 * The problem: a reader wants to see the whole structure, but a tree of 40,000 leaves has more nodes than the picture
 * has pixels across. The idea: draw the nodes of the upper levels one by one, and fold the lower levels.
 *    - diagram_slots.h chooses the position of each node and the levels that have room.
 *    - A node that has room is a square; the side of a leaf is half as long. Nodes have the colours of the space view,
 *      or are grey if the view's filter hides them. A line connects each node with its parent. The line is bold if
 *      a query visited the node, and dashed if a query pruned the node.
 *    - The other levels are folded into bars. A bar represents the nodes of one level in a column two units wide. The
 *      height of a bar is logarithmic: if the number of nodes doubles, the bar grows by a sixteenth of the row.
 *    - The path from the root to the player's leaf, or to the requested node, is drawn on top of nodes and bars.
 * In a game, rows are added four at a time, so that they seldom move when the tree becomes deeper. The cost is at most
 * two walks over the tree for the slots and one walk for the bars. */
#include "diagram_slots.h"
#include "foreign_nodes.h"
#include "layer_type.h"
#include "layout.h"
#include "node_boxes.h"
#include "number.h"
#include "octree/octree.h"
#include "text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sizes in picture units. */
#define NODE 6 /* side of an inner node; the side of a leaf is half as long */
/* A node on the path has a dark gap around it, which is this much wider than the node, and a ring around the gap, which
 * is this much wider than the gap. */
#define RING 2
#define EDGE 8      /* margin of the diagram; above and below, only if there is no text */
#define NARROWEST 2 /* minimum width of one share of a node's slot */
#define BAR 2       /* width of a bar that represents folded nodes */

/* The margins for text: left and right in characters, above and below in lines. WORDS_WIDTH and WORDS_HEIGHT are the
 * minimum width in characters and height in lines of a diagram with text. */
enum { WORDS_LEFT = 4, WORDS_RIGHT = 8, WORDS_ABOVE = 2, WORDS_BELOW = 2, WORDS_WIDTH = 25, WORDS_HEIGHT = 9 };

#define BAR_STEPS 16       /* number of heights that a bar can have; the tallest bar fills the row */
#define ROWS_AT_ONCE 4     /* in a game the number of rows is a multiple of this, so that rows seldom move */
#define MOST_DIGITS 999999 /* a number larger than this is rounded to three digits */

/* The ids of rectangles. The rectangle of a node has the node's address as its id. The highest set bit of any other id
 * is a bit that cannot be the highest set bit of an address. */
#define GROUND_ID UINT64_C(0)
#define BAR_ID (UINT64_C(1) << 61) /* id of a bar: BAR_ID + (depth << 32) + column */
/* id of a path node's ring: PATH_ID + depth; of the dark gap between node and ring: PATH_ID + depth + 32 */
#define PATH_ID (UINT64_C(1) << 62)

/* The pixels at which lines meet a node: the line from the parent ends at (x, head), and the lines to the children
 * begin at (x, foot). */
typedef struct anchor {
    double x, head, foot;
} anchor;

typedef struct diagram {
    scene *scene;
    const layer_source *in;
    diagram_slots slots;
    size_t capacity;
    camera_window window;
    double left, width; /* left end and width of the area that the slots divide, in pixels */
    double top, pitch;  /* top of the first row, and height of a row, in pixels */
    unsigned rows;
    uint64_t next_label;
    bool has_text;                        /* true: there is room for text */
    octree_address path;                  /* the path: address of the node at its end, or 0 if there is no path */
    octree_node end;                      /* the node at the end of the path */
    anchor anchors[OCTREE_MAX_DEPTH + 1]; /* anchors[d]: the anchor of the path's node at depth d */
} diagram;

/* Return the number of rows of the diagram. For a tree without a game, this is the number of levels. In a game, the
 * number of levels is rounded up to a multiple of ROWS_AT_ONCE. */
static unsigned count_rows(const diagram *d, unsigned depth)
{
    const octree *tree = d->in->tree;
    if (!d->in->tick)
        return depth + 1;
    const unsigned most = (unsigned)octree_definition(tree).max_depth + 1;
    const unsigned rows = (depth + ROWS_AT_ONCE) / ROWS_AT_ONCE * ROWS_AT_ONCE;
    return rows < most ? rows : most;
}

/* Divide the diagram's area of the picture, and arrange the tree in it. Return false if there is no room, or if memory
 * runs out (s->out_of_memory is then true). */
static bool arrange_tree(diagram *d)
{
    scene *s = d->scene;
    const int unit = s->unit;
    const camera_window w = d->window;
    const int letter = s->text.width, line = s->text.line, edge = EDGE * unit;
    d->has_text =
        view_shows_layer(&s->view, LAYER_TEXT) && w.width >= WORDS_WIDTH * letter && w.height >= WORDS_HEIGHT * line;
    const int left = edge + (d->has_text ? WORDS_LEFT * letter : 0);
    const int right = edge + (d->has_text ? WORDS_RIGHT * letter : 0);
    const int above = d->has_text ? WORDS_ABOVE * line : edge, below = d->has_text ? WORDS_BELOW * line : edge;
    d->left = w.x + left;
    d->width = w.width - (left + right);
    d->top = w.y + above;
    if (d->width < NARROWEST * unit || w.height <= above + below)
        return false;
    if (!diagram_arrange(&d->slots, d->in->tree, (size_t)(d->width / (NARROWEST * unit)))) {
        s->out_of_memory = true;
        return false;
    }
    d->rows = count_rows(d, d->slots.stats.depth);
    d->pitch = (w.height - (above + below)) / d->rows;
    return true;
}

/* Return whether a node is on the path. */
static bool is_on_path(const diagram *d, octree_address node, unsigned depth)
{
    const unsigned deep = d->path ? octree_address_depth(d->path) : 0;
    return d->path && depth <= deep && d->path >> 3 * (deep - depth) == node;
}

/* Return the y of the middle of a row, in pixels. */
static double find_row_middle(const diagram *d, unsigned depth)
{
    return d->top + (depth + 0.5) * d->pitch;
}

/* Return the anchor of a node. `middle` is the horizontal position of the node, from 0 (left) to 1; `height` is the
 * height of the node in pixels. */
static anchor make_anchor(const diagram *d, unsigned depth, double middle, double height)
{
    const double y = find_row_middle(d, depth);
    return (anchor){d->left + d->width * middle, y - height / 2, y + height / 2};
}

/* Fill a rectangle centred at a pixel, at least one pixel wide and high. */
static void fill_centered_rectangle(const diagram *d, uint64_t id, double x, double y, double width, double height,
                                    unsigned role)
{
    const int across = width < 1 ? 1 : (int)width, along = height < 1 ? 1 : (int)height;
    scene_add_rectangle(d->scene, id, (int[]){(int)floor(x - across / 2.0 + 0.5), (int)floor(y - along / 2.0 + 0.5)},
                        (int[]){across, along}, LAYER_DIAGRAM, role);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Compare a node's address with the address of a visit, in the order of a walk: each node comes before its children. A
 * comparison function for bsearch(). */
static int compare_in_walk_order(const void *node, const void *visit)
{
    const octree_address a = *(const octree_address *)node, b = ((const octree_visit *)visit)->node;
    const unsigned depth_a = octree_address_depth(a), depth_b = octree_address_depth(b);
    const octree_address p = depth_a < depth_b ? a << 3 * (depth_b - depth_a) : a;
    const octree_address q = depth_b < depth_a ? b << 3 * (depth_a - depth_b) : b;
    return p != q ? (p < q ? -1 : 1) : (depth_a > depth_b) - (depth_a < depth_b);
}

/* Return the style of the line from a node to its parent. As in the space view, the line is bold if a query visited the
 * node, and dashed if a query pruned the node. */
static scene_style choose_edge_style(const diagram *d, octree_address node, unsigned role)
{
    const octree_tick *tick = d->in->tick;
    const octree_visit *visit = NULL;
    if (tick && tick->visit_count)
        visit = bsearch(&node, tick->visits, tick->visit_count, sizeof *tick->visits, compare_in_walk_order);
    const bool was_pruned = visit && visit->touch == OCTREE_TRACE_PRUNED;
    const bool pruned = was_pruned && view_shows_layer(d->in->view, LAYER_PRUNED);
    const bool visited = visit && !was_pruned && view_shows_layer(d->in->view, LAYER_VISITED);
    d->scene->tally.marked_visited += visited;
    d->scene->tally.marked_pruned += pruned;
    return make_role_style(LAYER_DIAGRAM, role, pruned ? STROKE_DASHED : STROKE_SOLID, visited ? 2 : 1);
}

/* Compute the width and height of a node, which are limited by the node's slot and row. A leaf is half as large as an
 * inner node. */
static void measure_node(const diagram *d, const diagram_node *node, double size[2])
{
    const int unit = d->scene->unit;
    const double largest = (node->leaf ? NODE / 2 : NODE) * unit;
    size[0] = fmax(fmin(largest, d->width * (node->right - node->left) - unit), 1);
    size[1] = fmax(fmin(largest, d->pitch - 2 * unit), 1);
}

static unsigned choose_node_role(const diagram *d, const diagram_node *node)
{
    const octree_node asked = {.depth = node->depth, .leaf = node->leaf, .box = node->box};
    return filter_shows_node(&d->scene->view.filter, &d->in->world, &asked)
               ? node_role(&d->scene->view, (node_traits){node->depth, node->points, d->capacity, node->leaf})
               : ROLE_WORLD;
}

/* Add the line from the bottom of a node to the top of its child. */
static void add_line(const diagram *d, octree_address child, const anchor *from, const anchor *to, scene_style style)
{
    scene_add_picture_line(d->scene, child, (double[]){from->x, from->foot}, (double[]){to->x, to->head}, style);
}

/* Draw a ring around a node on the path, with a dark gap between the node and the ring. */
static void add_ring(const diagram *d, unsigned depth, double x, const double size[2])
{
    const double y = find_row_middle(d, depth);
    for (int dark = 0; dark < 2; dark++) {
        const double more = (dark ? RING : 2 * RING) * d->scene->unit;
        fill_centered_rectangle(d, PATH_ID | (dark ? 32 : 0) | depth, x, y, size[0] + more, size[1] + more,
                                dark ? ROLE_BACKGROUND : ROLE_PLAYER);
    }
}

/* Draw the nodes that are not folded, and the lines to their parents. If `on_path` is true, draw only the nodes on the
 * path; otherwise draw only the other nodes. The nodes on the path are drawn last. */
static void add_nodes(diagram *d, bool on_path)
{
    /* anchors[d] is the anchor of the current node's ancestor at depth d. Parents come before their children in the
     * list. */
    anchor anchors[OCTREE_MAX_DEPTH + 1];
    for (size_t i = 0; i < d->slots.count; i++) {
        const diagram_node *node = &d->slots.nodes[i];
        const unsigned depth = node->depth, role = choose_node_role(d, node);
        double size[2];
        measure_node(d, node, size);
        anchors[depth] = make_anchor(d, depth, (node->left + node->right) / 2, size[1]);
        if (is_on_path(d, node->address, depth) != on_path)
            continue;
        if (on_path)
            d->anchors[depth] = anchors[depth];
        else if (depth)
            add_line(d, node->address, &anchors[depth - 1], &anchors[depth], choose_edge_style(d, node->address, role));
        if (on_path)
            add_ring(d, depth, anchors[depth].x, size);
        fill_centered_rectangle(d, node->address, anchors[depth].x, find_row_middle(d, depth), size[0], size[1], role);
        d->scene->tally.drawn++;
    }
}

/* Draw the path from the root on top of the other lines and the bars. */
static void add_path(const diagram *d)
{
    const unsigned deep = octree_address_depth(d->path);
    for (unsigned depth = 0; depth <= deep; depth++) {
        const anchor *at = &d->anchors[depth];
        if (depth)
            add_line(d, d->path >> 3 * (deep - depth), at - 1, at,
                     make_role_style(LAYER_DIAGRAM, ROLE_PLAYER, STROKE_SOLID, 2));
        if (depth > d->slots.deepest)
            fill_centered_rectangle(d, PATH_ID | depth, at->x, find_row_middle(d, depth), RING * d->scene->unit,
                                    at->foot - at->head, ROLE_PLAYER);
        d->scene->tally.path++;
    }
}

/* ---- Folded levels ------------------------------------------------------------------------------------------- */

/* The nodes of one level in one column of the diagram. */
typedef struct bar {
    size_t nodes, leaves;
    size_t points; /* number of points in the leaves of the bar */
    bool shown;    /* true: the view's filter shows at least one of the nodes */
} bar;

typedef struct folding {
    diagram *d;
    bar *bars; /* all bars, row after row, beginning with the first folded level; a row has `columns` bars */
    size_t columns;
} folding;

static void add_node_to_bar(const octree_node *node, double middle, void *context)
{
    folding *f = context;
    diagram *d = f->d;
    const size_t column = (size_t)(middle * (double)f->columns);
    bar *b =
        &f->bars[(node->depth - d->slots.deepest - 1) * f->columns + (column < f->columns ? column : f->columns - 1)];
    b->nodes++;
    b->leaves += node->leaf;
    b->points += node->leaf ? node->count : 0;
    b->shown = b->shown || filter_shows_node(&d->scene->view.filter, &d->in->world, node);
    if (is_on_path(d, node->address, node->depth))
        d->anchors[node->depth] = make_anchor(d, node->depth, middle, fmin(NODE * d->scene->unit, d->pitch));
}

/* Return the height of a bar in steps of a sixteenth of the row: 1 for one node, 2 for two or three nodes, 3 for four
 * to seven ... */
static unsigned count_bar_steps(size_t nodes)
{
    unsigned steps = 0;
    for (; nodes && steps < BAR_STEPS; nodes /= 2)
        steps++;
    return steps;
}

static void add_bar(const folding *f, unsigned depth, size_t column, const bar *b)
{
    const diagram *d = f->d;
    const double unit = d->scene->unit, width = d->width / (double)f->columns;
    const double height = fmax(floor((d->pitch - 2 * unit) * count_bar_steps(b->nodes) / BAR_STEPS), 1);
    const double x = d->left + ((double)column + 0.5) * width;
    const node_traits look = {depth, b->leaves ? b->points / b->leaves : 0, d->capacity, b->leaves > 0};
    fill_centered_rectangle(d, BAR_ID | (uint64_t)depth << 32 | (uint64_t)column, x, find_row_middle(d, depth),
                            fmax(width - unit / 2, 1), height,
                            b->shown ? node_role(&d->scene->view, look) : ROLE_WORLD);
    d->scene->tally.folded += b->nodes;
}

/* Count the nodes in each column, draw the bars, and compute the anchors of the path at the folded levels. */
static void add_bars(diagram *d)
{
    const diagram_slots *slots = &d->slots;
    const unsigned levels = slots->stats.depth - slots->deepest;
    folding f = {.d = d, .columns = (size_t)fmax(d->width / (BAR * d->scene->unit), 1)};
    f.bars = levels ? calloc(levels * f.columns, sizeof *f.bars) : NULL;
    if (levels && !f.bars)
        d->scene->out_of_memory = true;
    if (!f.bars)
        return;
    d->scene->tally.folded_from = slots->deepest + 1;
    d->scene->tally.folded_to = slots->stats.depth;
    diagram_visit_folded(slots, d->in->tree, add_node_to_bar, &f);
    for (size_t i = 0; i < levels * f.columns; i++)
        if (f.bars[i].nodes)
            add_bar(&f, slots->deepest + 1 + (unsigned)(i / f.columns), i % f.columns, &f.bars[i]);
    free(f.bars);
}

/* ---- Text ---------------------------------------------------------------------------------------------------- */

static void add_text(diagram *d, double x, double y, theme_role role, const char *text)
{
    const scene_style style = make_role_style(LAYER_DIAGRAM, role, STROKE_SOLID, 1);
    scene_label label = scene_make_label(d->next_label++, style, "%s", text);
    label.at[0] = floor(x);
    label.at[1] = floor(y);
    scene_add_label(d->scene, label);
}

/* Return the x at which a text must begin so that it ends at the right edge. */
static double right_aligned_x(const diagram *d, const char *text)
{
    const scene *s = d->scene;
    return d->window.x + d->window.width - EDGE * s->unit - (double)strlen(text) * s->text.width;
}

static void write_depths_and_counts(diagram *d)
{
    const scene *s = d->scene;
    const double left = d->window.x + EDGE * s->unit, top = d->window.y + s->text.line / 2;
    /* If rows are lower than a line of text, only every n-th row has text. */
    const unsigned row_step = (unsigned)ceil(s->text.height / d->pitch);
    /* The diagram always shows Octreel's own tree. The heading says so if the space view shows foreign nodes. */
    add_text(d, left, top, ROLE_FAINT, shows_octreel_nodes(d->in) ? "depth" : "Octreel's depth");
    add_text(d, right_aligned_x(d, "nodes"), top, ROLE_FAINT, "nodes");
    for (unsigned depth = 0; depth <= d->slots.stats.depth; depth += row_step) {
        const double y = find_row_middle(d, depth) - s->text.height / 2;
        char number[NUMBER_TEXT];
        snprintf(number, sizeof number, "%u", depth);
        add_text(d, left, y, ROLE_FAINT, number);
        const size_t count = d->slots.stats.nodes_at_depth[depth];
        number_format((double)count, count <= MOST_DIGITS ? 6 : 3, number);
        if (count)
            add_text(d, right_aligned_x(d, number), y, ROLE_TEXT, number);
    }
}

/* Describe the node at the end of the path. A long address is cut, because the diagram shows the whole path anyway. */
static void write_path_end(diagram *d)
{
    const octree_node *end = &d->end;
    const int unit = d->scene->unit;
    const lettering *font = &d->scene->text;
    const size_t letters = (size_t)((d->window.width - 2 * EDGE * unit) / font->width);
    const double foot = d->window.y + d->window.height - font->line / 2 - font->height;
    char address[OCTREE_ADDRESS_TEXT], text[SCENE_TEXT * 2];
    const size_t length =
        (size_t)snprintf(text, sizeof text, "%s of %zu point%s: %s", end->leaf ? "leaf" : "node", end->count,
                         plural_ending(end->count), octree_address_format(end->address, address));
    const size_t room = letters < SCENE_TEXT ? letters : SCENE_TEXT - 1;
    if (length > room)
        memcpy(text + room - 3, "...", 4);
    add_text(d, d->window.x + EDGE * unit, foot, ROLE_PLAYER, text);
}

/* ---- The layer ---------------------------------------------------------------------------------------------- */

/* Find the end of the path: the player's leaf or, without a game, the requested node. */
static void find_path(diagram *d)
{
    const layer_source *in = d->in;
    const bool found = in->tick
                           ? in->tick->has_player && octree_locate(in->tree, in->tick->player, &d->end) == OCTREE_OK
                           : in->requested && octree_node_at(in->tree, in->requested, &d->end) == OCTREE_OK;
    d->path = found ? d->end.address : 0;
}

static void add_diagram(scene *s, const layer_source *in, view_layer layer)
{
    diagram d = {.scene = s, .in = in, .window = layout_diagram_area(&s->view)};
    d.capacity = octree_definition(in->tree).leaf_capacity;
    if (!view_shows_layer(&s->view, layer))
        return;
    /* The background covers elements of the space view that reach into the diagram. */
    scene_add_rectangle(s, GROUND_ID, (int[]){(int)d.window.x, (int)d.window.y},
                        (int[]){(int)d.window.width, (int)d.window.height}, layer, ROLE_BACKGROUND);
    if (!arrange_tree(&d))
        return;
    find_path(&d);
    add_bars(&d);
    add_nodes(&d, false);
    add_nodes(&d, true);
    if (d.path)
        add_path(&d);
    if (d.has_text) {
        write_depths_and_counts(&d);
        if (d.path)
            write_path_end(&d);
    }
    diagram_slots_release(&d.slots);
}

static void add_diagram_legend(legend *l, const layer_source *in)
{
    const scene_tally *tally = &l->scene->tally;
    (void)in;
    if (tally->drawn)
        legend_add(l, SIGN_NODES, "inner node, leaf")->role = ROLE_NODE_PLAIN;
    if (tally->path)
        legend_add(l, SIGN_LINE, "path from the root")->role = ROLE_PLAYER;
    if (tally->folded)
        legend_add(l, SIGN_BARS, "bars: many nodes, log2")->role = ROLE_NODE_PLAIN;
    if (filter_is_set(&l->scene->view.filter))
        legend_add(l, SIGN_NODE, "node filtered out")->role = ROLE_WORLD;
}

static void describe_panel(description *d, uint64_t id)
{
    if (id == GROUND_ID) {
        append_text(d, "the background of the diagram");
    } else if (id / BAR_ID == 1) {
        append_text(d, "in the diagram, a bar: nodes of depth %u, too many to draw one by one",
                    (unsigned)(id >> 32 & 255));
    } else if (id / PATH_ID == 1) {
        append_text(d, "in the diagram, the path to the player");
    } else {
        describe_node(d, "in the diagram, ", id);
    }
}

static void describe_diagram_element(description *d, const described_element *element)
{
    if (element->kind == SCENE_PANEL) {
        describe_panel(d, element->id);
    } else if (element->kind == SCENE_LABEL) {
        append_text(d, " of the diagram");
    } else {
        append_text(d, "in the diagram, %s", element->style.role == ROLE_PLAYER ? "the path to the player: " : "");
        describe_node(d, "the line from its parent to ", element->id);
    }
}

const layer_type layer_DIAGRAM = {.add = add_diagram,
                                  .legend = {.order = 190, .add_lines = add_diagram_legend},
                                  .describe = describe_diagram_element};
