/* panel_legend.c - see panel_legend.h. */
#include "panel_legend.h"
#include "answer_layers.h"
#include "diagram_legend.h"
#include "heat_layers.h"
#include "layer.h"
#include "panel_view.h"
#include "text.h"
#include "velocity_layer.h"

#include <assert.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define WORDS (MARGIN + SWATCH + 6) /* where they begin */

/* What a line of the legend shows before its words. */
typedef enum swatch {
    SWATCH_NODES,   /* the ramp of the colours of nodes */
    SWATCH_DIAGRAM, /* the lines of diagram_legend.h */
    SWATCH_HEAT,    /* the same ramp, growing */
    SWATCH_LINE,
    SWATCH_DASHES,
    SWATCH_BOLD,
    SWATCH_PLUS,
    SWATCH_DASHED_PLUS,
    SWATCH_FRAME,
    SWATCH_DOT,
    SWATCH_SQUARE,
    SWATCH_ARROW,
    SWATCH_CROSS,
} swatch;

typedef struct legend_entry {
    view_layer layer;
    swatch swatch;
    const char *text; /* null: it has a number in it */
    bool plain;       /* says little that the picture does not say by itself */
    bool answer;      /* its answer is told in the same colour */
    bool swept;       /* in sessions alone that are swept */
} legend_entry;

static const legend_entry legend[] = {
    {.layer = LAYER_NODES, .swatch = SWATCH_NODES, .text = ""},
    {.layer = LAYER_DIAGRAM, .swatch = SWATCH_DIAGRAM, .text = ""},
    {.layer = LAYER_VISITED, .swatch = SWATCH_BOLD},
    {.layer = LAYER_PRUNED, .swatch = SWATCH_DASHES},
    {.layer = LAYER_HIT, .swatch = SWATCH_FRAME},
    {.layer = LAYER_SPLITS, .swatch = SWATCH_PLUS},
    {.layer = LAYER_MERGES, .swatch = SWATCH_DASHED_PLUS},
    {.layer = LAYER_ASKED, .swatch = SWATCH_BOLD},
    {.layer = LAYER_VISIT_HEAT, .swatch = SWATCH_HEAT},
    {.layer = LAYER_POINT_HEAT, .swatch = SWATCH_HEAT},
    {.layer = LAYER_POINTS, .swatch = SWATCH_DOT, .text = "point", .plain = true},
    {.layer = LAYER_VELOCITIES, .swatch = SWATCH_ARROW},
    {.layer = LAYER_PLAYER, .swatch = SWATCH_SQUARE, .text = "player and its box", .plain = true},
    {.layer = LAYER_BOX, .swatch = SWATCH_CROSS, .text = "collision, crossed"},
    {.layer = LAYER_BOX, .swatch = SWATCH_DASHES, .text = "way to a hit, dashed", .swept = true},
    {.layer = LAYER_RANGE, .swatch = SWATCH_DASHES, .text = "range query, dashed", .answer = true},
    {.layer = LAYER_RADIUS, .swatch = SWATCH_LINE, .text = "radius query, round", .answer = true},
    {.layer = LAYER_KNEAREST, .swatch = SWATCH_LINE, .text = "k nearest, numbered", .answer = true},
    {.layer = LAYER_NEAREST, .swatch = SWATCH_DASHES, .text = "nearest point, dashed", .answer = true},
    {.layer = LAYER_SHAPES, .swatch = SWATCH_BOLD},
};

#define LEGEND_ENTRIES (sizeof legend / sizeof legend[0])

/* What a legend is about. */
typedef struct legend_subject {
    unsigned layers;         /* that there can be, as bits */
    size_t max_depth;        /* of the tree */
    bool swept;              /* the session is */
    const octree_tick *tick; /* null for a tree alone */
    unsigned velocity_ticks; /* whose way an arrow shows */
    octree_address asked;    /* of a tree alone: the node, or 0 */
} legend_subject;

static bool has_movers(const octree_game *game)
{
    return octree_game_tick(game)->mover_count > 0 || octree_game_fastest(game) > 0;
}

/* Of a session that keys play, those of queries that it never asks are left out; the nearest point is asked for by a
 * key too. What else a session will ask may not be known yet: then those of queries that it has not asked so far. */
static unsigned layers_of(const octree_game *game)
{
    const octree_session *session = octree_game_session(game);
    const bool known = session->player.kind == OCTREE_PLAYER_KEYS;
    unsigned asked = known ? 1u << LAYER_NEAREST : 0, others = VIEW_ALL_LAYERS & ~(1u << LAYER_ASKED);
    for (size_t i = 0; i < OCTREE_QUERY_KINDS; i++) {
        others &= ~(1u << answer_layer((octree_query_kind)i));
        if (octree_game_tick(game)->asked >> i & 1)
            asked |= 1u << answer_layer((octree_query_kind)i);
    }
    for (size_t i = 0; known && i < session->query_count; i++)
        asked |= 1u << answer_layer(session->queries[i].kind);
    if (octree_game_tick(game)->shape_count == 0)
        others &= ~(1u << LAYER_SHAPES);
    if (session->player.kind == OCTREE_PLAYER_NONE)
        others &= ~(1u << LAYER_PLAYER | 1u << LAYER_BOX);
    if (!has_movers(game))
        others &= ~(1u << LAYER_VELOCITIES);
    return asked | others;
}

/* And those of a tree alone. */
static unsigned layers_of_tree(const tree_look *about)
{
    unsigned layers = 1u << LAYER_NODES | 1u << LAYER_POINTS;
    for (size_t i = 0; i < about->answer_count; i++)
        layers |= 1u << answer_layer(about->answers[i].kind);
    if (about->node)
        layers |= 1u << LAYER_ASKED;
    return layers;
}

/* The colours of nodes are those of the diagram too, and so is what tells how they were met. */
static bool is_diagrams(const scene *s, const legend_entry *entry)
{
    return entry->layer == LAYER_DIAGRAM || (entry->layer == LAYER_NODES && view_shows(&s->view, LAYER_DIAGRAM)) ||
           (entry->layer == LAYER_VISITED && s->tally.marked_visited) ||
           (entry->layer == LAYER_PRUNED && s->tally.marked_pruned);
}

static bool is_listed(const scene *s, const legend_entry *entry, const legend_subject *about)
{
    const bool shown = (about->layers & s->view.layers) >> entry->layer & 1;
    return is_diagrams(s, entry) || (shown && (about->swept || !entry->swept));
}

/* Whether this frame has anything in a layer. */
static bool is_in_frame(const scene *s, view_layer layer)
{
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].style.layer == layer)
            return true;
    for (size_t i = 0; i < s->segments.count; i++)
        if (s->segments.items[i].style.layer == layer)
            return true;
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.layer == layer)
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
    const theme_role role = (theme_role)layer_rows[entry->layer].role;
    switch (entry->swatch) {
    case SWATCH_NODES:
    case SWATCH_DIAGRAM:
        break; /* drawn with their words */
    case SWATCH_HEAT:
        for (int step = 0; step < THEME_NODE_DEPTHS; step++)
            fill(p, MARGIN + step * 2, p->y + 4 - step / 2, 2, step + 1, theme_node_role((unsigned)step));
        break;
    case SWATCH_LINE:
        fill(p, MARGIN, p->y + 4, SWATCH, 1, role);
        break;
    case SWATCH_BOLD:
        fill(p, MARGIN, p->y + 3, SWATCH, 2, role);
        break;
    case SWATCH_DASHES:
        fill_dashes(p, 1, role);
        break;
    case SWATCH_PLUS:
        fill_plus(p, 11, role);
        break;
    case SWATCH_DASHED_PLUS:
        fill_plus(p, 3, role);
        break;
    case SWATCH_FRAME:
        fill_square(p, 7, role);
        fill_square(p, 5, ROLE_PANEL);
        break;
    case SWATCH_DOT:
        fill_square(p, 2, role);
        break;
    case SWATCH_SQUARE:
        fill_square(p, 5, role);
        break;
    case SWATCH_CROSS:
        for (int i = -4; i <= 4; i++)
            for (int side = -1; side <= (i ? 1 : -1); side += 2)
                fill(p, MARGIN + SWATCH / 2 + i, p->y + 4 + side * i, 1, 1, role);
        break;
    case SWATCH_ARROW:
        fill(p, MARGIN, p->y + 4, SWATCH, 1, role);
        for (int i = 1; i <= 3; i++)
            fill(p, MARGIN + SWATCH - 1 - 2 * i, p->y + 4 - i, 2, 2 * i + 1, role);
        break;
    }
}

/* Letters that an entry has room for. */
static size_t words_room(void)
{
    return text_room(WORDS, 1);
}

/* "2 split .. 7/7/0", with the address of the last where there is room for all of it. */
static void count_changes(char text[SCENE_TEXT], const char *word, const octree_address *nodes, size_t count)
{
    char last[OCTREE_ADDRESS_TEXT] = "";
    snprintf(text, SCENE_TEXT, "%zu %s", count, word);
    if (count)
        octree_address_format(nodes[count - 1], last);
    const size_t used = strlen(text);
    if (count && used + strlen(last) + (count > 1 ? 4 : 1) <= words_room())
        snprintf(text + used, SCENE_TEXT - used, "%s%.24s", count > 1 ? " .. " : " ", last);
}

/* What was taken whole has a line of its own where one has no room for both counts. */
static bool count_visits(char text[SCENE_TEXT], char rest[SCENE_TEXT], const octree_tick *tick)
{
    const size_t taken = tick->touched[OCTREE_TOUCH_TAKEN];
    snprintf(text, SCENE_TEXT, "%zu visited", tick->touched[OCTREE_TOUCH_VISITED]);
    snprintf(rest, SCENE_TEXT, "%zu taken", taken);
    const bool together = strlen(text) + strlen(", ") + strlen(rest) <= words_room();
    if (taken && together)
        snprintf(text, SCENE_TEXT, "%zu visited, %zu taken", tick->touched[OCTREE_TOUCH_VISITED], taken);
    return taken && !together;
}

/* The words of an entry with a number: mostly what the tick counts. */
static void count_in_words(char text[SCENE_TEXT], view_layer layer, const legend_subject *about)
{
    const octree_tick *tick = about->tick;
    char rest[SCENE_TEXT], address[OCTREE_ADDRESS_TEXT];
    switch (layer) {
    case LAYER_VISITED:
        count_visits(text, rest, tick);
        break;
    case LAYER_PRUNED:
        snprintf(text, SCENE_TEXT, "%zu pruned", tick->touched[OCTREE_TOUCH_PRUNED]);
        break;
    case LAYER_HIT:
        snprintf(text, SCENE_TEXT, "%zu %s hit", tick->hit_leaf_count, tick->hit_leaf_count == 1 ? "leaf" : "leaves");
        break;
    case LAYER_VISIT_HEAT:
        snprintf(text, SCENE_TEXT, "[] 1-%" PRIu64 "+ visits", HEAT_LAST(HEAT_VISITS_SHIFT));
        break;
    case LAYER_POINT_HEAT:
        snprintf(text, SCENE_TEXT, "<> 1-%" PRIu64 "+ points", HEAT_LAST(HEAT_POINTS_SHIFT));
        break;
    case LAYER_SHAPES:
        snprintf(text, SCENE_TEXT, "%zu shape%s", tick->shape_count, plural(tick->shape_count));
        break;
    case LAYER_ASKED:
        snprintf(text, SCENE_TEXT, "node %.42s", octree_address_format(about->asked, address));
        break;
    case LAYER_VELOCITIES:
        snprintf(text, SCENE_TEXT, "velocity, %u tick%s", about->velocity_ticks, plural(about->velocity_ticks));
        break;
    case LAYER_SPLITS:
        count_changes(text, "split", tick->splits, tick->split_count);
        break;
    case LAYER_MERGES:
        count_changes(text, "merged", tick->merges, tick->merge_count);
        break;
    default:
        assert(!"a line without words has a number, which is told above");
    }
}

static void write_entry(pen *p, const legend_entry *entry, const legend_subject *about)
{
    char text[SCENE_TEXT] = "", rest[SCENE_TEXT];
    if (entry->swatch == SWATCH_NODES) {
        write_node_legend(p, about->max_depth);
        return;
    }
    if (entry->swatch == SWATCH_DIAGRAM) {
        write_diagram_legend(p);
        return;
    }
    fill_swatch(p, entry);
    if (!entry->text)
        count_in_words(text, entry->layer, about);
    write_text(p, WORDS, ROLE_FAINT, 1, entry->text ? entry->text : text);
    p->y += LINE;
    if (entry->layer == LAYER_VISITED && count_visits(text, rest, about->tick)) {
        write_text(p, WORDS, ROLE_FAINT, 1, rest);
        p->y += LINE;
    }
}

static int lines_of(const scene *s, const legend_entry *entry, const legend_subject *about)
{
    char text[SCENE_TEXT], rest[SCENE_TEXT];
    if (entry->swatch == SWATCH_DIAGRAM)
        return diagram_legend_lines(s);
    return entry->layer == LAYER_VISITED && count_visits(text, rest, about->tick) ? 2 : 1;
}

/* The legend while it is made to fit. */
typedef struct legend_list {
    const scene *scene;
    const legend_subject *about;
    bool has[LEGEND_ENTRIES];
    size_t dropped; /* that are needed, and that a last line counts */
    int room;       /* lines */
} legend_list;

static int count_lines(const legend_list *l)
{
    int lines = l->dropped > 0;
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        lines += l->has[i] ? lines_of(l->scene, &legend[i], l->about) : 0;
    return lines;
}

static bool is_needed(const legend_list *l, const legend_entry *entry)
{
    return is_in_frame(l->scene, entry->layer) || is_diagrams(l->scene, entry);
}

/* What has nothing in the frame goes first, then what explains itself, then what is told beside its answer; and
 * then those of the others that have no room below the first. */
static void make_fit(legend_list *l)
{
    int lines = 0;
    for (size_t i = 0; count_lines(l) > l->room && i < LEGEND_ENTRIES; i++)
        l->has[i] = l->has[i] && is_needed(l, &legend[i]);
    for (size_t i = 0; count_lines(l) > l->room && i < LEGEND_ENTRIES; i++)
        l->has[i] = l->has[i] && !legend[i].plain;
    for (size_t i = 0; count_lines(l) > l->room && i < LEGEND_ENTRIES; i++)
        l->has[i] = l->has[i] && !legend[i].answer;
    if (count_lines(l) <= l->room)
        return;
    for (size_t i = 0; i < LEGEND_ENTRIES; i++) {
        const int own = l->has[i] ? lines_of(l->scene, &legend[i], l->about) : 0;
        l->has[i] = own && lines + own <= l->room - 1; /* but for the line that says how many more there are */
        lines += l->has[i] ? own : 0;
        l->dropped += l->has[i] ? 0 : (size_t)own;
    }
}

static void write_more(pen *p, size_t count)
{
    char text[SCENE_TEXT];
    snprintf(text, sizeof text, "and %zu more", count);
    write_text(p, WORDS, ROLE_FAINT, 1, text);
}

static void write_legend(pen *p, const legend_subject *about)
{
    const scene *s = p->scene;
    const int foot = s->view.height / s->unit - MARGIN;
    legend_list l = {.scene = s, .about = about, .room = (foot - p->y - LINE / 2) / LINE};
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        l.has[i] = is_listed(s, &legend[i], about);
    make_fit(&l);
    const int lines = count_lines(&l);
    if (lines > l.room || lines == (l.dropped > 0))
        return; /* not one has room */
    p->y = foot - lines * LINE;
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        if (l.has[i])
            write_entry(p, &legend[i], about);
    if (l.dropped)
        write_more(p, l.dropped);
}

void write_tick_legend(pen *p, const octree_game *game)
{
    const octree_session *session = octree_game_session(game);
    write_legend(p, &(legend_subject){.layers = layers_of(game),
                                      .max_depth = session->tree.max_depth,
                                      .swept = session->player.sweep,
                                      .tick = octree_game_tick(game),
                                      .velocity_ticks = velocity_ticks(game)});
}

void write_tree_legend(pen *p, const octree *tree, const tree_look *about)
{
    write_legend(p, &(legend_subject){.layers = layers_of_tree(about),
                                      .max_depth = octree_definition(tree).max_depth,
                                      .asked = about->node});
}
