/* panel_legend.c - see panel_legend.h. */
#include "panel_legend.h"
#include "diagram_legend.h"
#include "panel_view.h"

#include <stdio.h>
#include <string.h>

/* What a line of the legend shows before its words. */
typedef enum swatch {
    SWATCH_NODES, /* the ramp of the colours of nodes */
    SWATCH_HEAT,  /* the same ramp, growing */
    SWATCH_LINE,
    SWATCH_DASHES,
    SWATCH_BOLD,
    SWATCH_PLUS,
    SWATCH_DASHED_PLUS,
    SWATCH_FRAME,
    SWATCH_DOT,
    SWATCH_SQUARE,
} swatch;

typedef struct legend_entry {
    unsigned layer;
    theme_role role;
    swatch swatch;
    const char *text; /* null: what the tick counts */
    bool plain;       /* says little that the picture does not say by itself */
    bool swept;       /* in sessions alone that are swept */
} legend_entry;

static const legend_entry legend[] = {
    {.layer = LAYER_NODES, .swatch = SWATCH_NODES, .text = ""},
    {.layer = LAYER_VISITED, .role = ROLE_NODE + 2, .swatch = SWATCH_BOLD},
    {.layer = LAYER_PRUNED, .role = ROLE_NODE + 2, .swatch = SWATCH_DASHES},
    {.layer = LAYER_HIT, .role = ROLE_POINT, .swatch = SWATCH_FRAME},
    {.layer = LAYER_SPLITS, .role = ROLE_POINT, .swatch = SWATCH_PLUS},
    {.layer = LAYER_MERGES, .role = ROLE_POINT, .swatch = SWATCH_DASHED_PLUS},
    {.layer = LAYER_VISIT_HEAT, .swatch = SWATCH_HEAT, .text = "[] 1-512+ visits"},
    {.layer = LAYER_POINT_HEAT, .swatch = SWATCH_HEAT, .text = "<> 1-262144+ points"},
    {.layer = LAYER_POINTS, .role = ROLE_POINT, .swatch = SWATCH_DOT, .text = "point", .plain = true},
    {.layer = LAYER_PLAYER, .role = ROLE_PLAYER, .swatch = SWATCH_SQUARE, .text = "player and its box", .plain = true},
    {.layer = LAYER_BOX, .role = ROLE_COLLISION, .swatch = SWATCH_SQUARE, .text = "collision, crossed"},
    {.layer = LAYER_BOX,
     .role = ROLE_COLLISION,
     .swatch = SWATCH_DASHES,
     .text = "way to a hit, dashed",
     .swept = true},
    {.layer = LAYER_RANGE, .role = ROLE_RANGE, .swatch = SWATCH_DASHES, .text = "range query, dashed"},
    {.layer = LAYER_RADIUS, .role = ROLE_RADIUS, .swatch = SWATCH_LINE, .text = "radius query, round"},
    {.layer = LAYER_KNEAREST, .role = ROLE_KNEAREST, .swatch = SWATCH_LINE, .text = "k nearest, numbered"},
    {.layer = LAYER_NEAREST, .role = ROLE_NEAREST, .swatch = SWATCH_DASHES, .text = "nearest point, dashed"},
    {.layer = LAYER_SHAPES, .role = ROLE_SHAPE, .swatch = SWATCH_BOLD},
};

#define LEGEND_ENTRIES (sizeof legend / sizeof legend[0])

/* What a legend is about. */
typedef struct legend_subject {
    unsigned layers;         /* that there can be, as bits */
    size_t max_depth;        /* of the tree */
    bool swept;              /* the session is */
    const octree_tick *tick; /* null for a tree alone */
} legend_subject;

/* The layer of each kind of query. */
static const view_layer query_layers[OCTREE_QUERY_KINDS] = {
    [OCTREE_QUERY_RANGE] = LAYER_RANGE,
    [OCTREE_QUERY_NEAREST] = LAYER_NEAREST,
    [OCTREE_QUERY_KNEAREST] = LAYER_KNEAREST,
    [OCTREE_QUERY_RADIUS] = LAYER_RADIUS,
};

/* Of a session that keys play, those of queries that it never asks are left out; the nearest point is asked for by a
 * key too. What else a session will ask may not be known yet: then those of queries that it has not asked so far. */
static unsigned layers_of(const octree_game *game)
{
    const octree_session *session = octree_game_session(game);
    const bool known = session->player.kind == OCTREE_PLAYER_KEYS;
    unsigned asked = known ? 1u << LAYER_NEAREST : 0, others = VIEW_ALL_LAYERS;
    for (size_t i = 0; i < OCTREE_QUERY_KINDS; i++) {
        others &= ~(1u << query_layers[i]);
        if (octree_game_tick(game)->asked >> i & 1)
            asked |= 1u << query_layers[i];
    }
    for (size_t i = 0; known && i < session->query_count; i++)
        asked |= 1u << query_layers[session->queries[i].kind];
    if (octree_game_tick(game)->shape_count == 0)
        others &= ~(1u << LAYER_SHAPES);
    if (session->player.kind == OCTREE_PLAYER_NONE)
        others &= ~(1u << LAYER_PLAYER | 1u << LAYER_BOX);
    return asked | others;
}

/* And those of a tree alone. */
static unsigned layers_of_tree(const tree_look *about)
{
    unsigned layers = 1u << LAYER_NODES | 1u << LAYER_POINTS;
    for (size_t i = 0; i < about->answer_count; i++)
        layers |= 1u << query_layers[about->answers[i].kind];
    return layers;
}

/* The colours of nodes are those of the diagram too. */
static bool is_diagrams(const scene *s, const legend_entry *entry)
{
    return entry->layer == LAYER_NODES && view_shows(&s->view, LAYER_DIAGRAM);
}

static bool is_listed(const scene *s, const legend_entry *entry, const legend_subject *about)
{
    const bool shown = (about->layers & s->view.layers) >> entry->layer & 1;
    return is_diagrams(s, entry) || (shown && (about->swept || !entry->swept));
}

/* Whether this frame has anything in a layer. */
static bool is_in_frame(const scene *s, unsigned layer)
{
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].look.layer == layer)
            return true;
    for (size_t i = 0; i < s->segments.count; i++)
        if (s->segments.items[i].look.layer == layer)
            return true;
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].look.layer == layer)
            return true;
    return false;
}

static void fill_dashes(pen *p, int height, theme_role role)
{
    for (int x = 0; x < SWATCH; x += 8)
        fill(p, MARGIN + x, p->y + 4, 5, height, role);
}

static void fill_square(pen *p, int side, theme_role role)
{
    fill(p, MARGIN + (SWATCH - side) / 2, p->y + 4 - side / 2, side, side, role);
}

/* Two lines of 11 units that cross, in dashes of a length. */
static void fill_plus(pen *p, int dash, theme_role role)
{
    const int middle = MARGIN + SWATCH / 2;
    for (int at = -5; at <= 5; at += dash + 1) {
        fill(p, middle + at, p->y + 4, dash, 1, role);
        fill(p, middle, p->y + 4 + at, 1, dash, role);
    }
}

static void fill_swatch(pen *p, const legend_entry *entry)
{
    switch (entry->swatch) {
    case SWATCH_NODES:
        break; /* drawn with its words */
    case SWATCH_HEAT:
        for (int step = 0; step < THEME_NODE_DEPTHS; step++)
            fill(p, MARGIN + step * 2, p->y + 4 - step / 2, 2, step + 1, theme_node_role((unsigned)step));
        break;
    case SWATCH_LINE:
        fill(p, MARGIN, p->y + 4, SWATCH, 1, entry->role);
        break;
    case SWATCH_BOLD:
        fill(p, MARGIN, p->y + 3, SWATCH, 2, entry->role);
        break;
    case SWATCH_DASHES:
        fill_dashes(p, 1, entry->role);
        break;
    case SWATCH_PLUS:
        fill_plus(p, 11, entry->role);
        break;
    case SWATCH_DASHED_PLUS:
        fill_plus(p, 3, entry->role);
        break;
    case SWATCH_FRAME:
        fill_square(p, 7, entry->role);
        fill_square(p, 5, ROLE_PANEL);
        break;
    case SWATCH_DOT:
        fill_square(p, 2, entry->role);
        break;
    case SWATCH_SQUARE:
        fill_square(p, 5, entry->role);
        break;
    }
}

/* "2 split 7/7/0", with the address of the last. */
static void count_changes(char text[SCENE_TEXT], const char *word, const octree_address *nodes, size_t count)
{
    char last[OCTREE_ADDRESS_TEXT] = "";
    if (count)
        octree_address_format(nodes[count - 1], last);
    snprintf(text, SCENE_TEXT, "%zu %s%s%s", count, word, count > 1 ? " .. " : " ", last);
}

/* The words of an entry that counts. */
static void count_in_words(char text[SCENE_TEXT], unsigned layer, const octree_tick *tick)
{
    const size_t taken = tick->touched[OCTREE_TOUCH_TAKEN];
    switch (layer) {
    case LAYER_VISITED:
        snprintf(text, SCENE_TEXT, "%zu visited", tick->touched[OCTREE_TOUCH_VISITED]);
        if (taken)
            snprintf(text + strlen(text), SCENE_TEXT - strlen(text), ", %zu taken", taken);
        break;
    case LAYER_PRUNED:
        snprintf(text, SCENE_TEXT, "%zu pruned", tick->touched[OCTREE_TOUCH_PRUNED]);
        break;
    case LAYER_HIT:
        snprintf(text, SCENE_TEXT, "%zu %s hit", tick->hit_leaf_count, tick->hit_leaf_count == 1 ? "leaf" : "leaves");
        break;
    case LAYER_SHAPES:
        snprintf(text, SCENE_TEXT, "%zu shape%s", tick->shape_count, tick->shape_count == 1 ? "" : "s");
        break;
    case LAYER_SPLITS:
        count_changes(text, "split", tick->splits, tick->split_count);
        break;
    default:
        count_changes(text, "merged", tick->merges, tick->merge_count);
        break;
    }
}

static void write_entry(pen *p, const legend_entry *entry, const legend_subject *about)
{
    char text[SCENE_TEXT];
    if (entry->swatch == SWATCH_NODES) {
        write_node_legend(p, about->max_depth);
        write_diagram_legend(p);
        return;
    }
    fill_swatch(p, entry);
    if (!entry->text)
        count_in_words(text, entry->layer, about->tick);
    write_text(p, MARGIN + SWATCH + 6, ROLE_FAINT, 1, entry->text ? entry->text : text);
    p->y += LINE;
}

/* Where the legend begins, or -1 where it does not fit. */
static int top_of(const pen *p, const bool listed[])
{
    int lines = diagram_legend_lines(p->scene);
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        lines += listed[i];
    const int top = p->scene->view.height / p->scene->unit - MARGIN - lines * LINE;
    return top < p->y + LINE / 2 ? -1 : top;
}

static void write_legend(pen *p, const legend_subject *about)
{
    const scene *s = p->scene;
    bool listed[LEGEND_ENTRIES];
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        listed[i] = is_listed(s, &legend[i], about);
    for (size_t i = 0; top_of(p, listed) < 0 && i < LEGEND_ENTRIES; i++)
        listed[i] = listed[i] && (is_in_frame(s, legend[i].layer) || is_diagrams(s, &legend[i]));
    for (size_t i = 0; top_of(p, listed) < 0 && i < LEGEND_ENTRIES; i++)
        listed[i] = listed[i] && !legend[i].plain;
    const int top = top_of(p, listed);
    if (top < 0)
        return;
    p->y = top;
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        if (listed[i])
            write_entry(p, &legend[i], about);
}

void write_tick_legend(pen *p, const octree_game *game)
{
    const octree_session *session = octree_game_session(game);
    write_legend(p, &(legend_subject){.layers = layers_of(game),
                                      .max_depth = session->tree.max_depth,
                                      .swept = session->player.sweep,
                                      .tick = octree_game_tick(game)});
}

void write_tree_legend(pen *p, const octree *tree, const tree_look *about)
{
    write_legend(p, &(legend_subject){.layers = layers_of_tree(about), .max_depth = octree_definition(tree).max_depth});
}
