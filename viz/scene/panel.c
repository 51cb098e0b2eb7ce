/* panel.c - see panel.h. */
#include "panel.h"
#include "diagram_legend.h"
#include "layout.h"
#include "number_text.h"
#include "panel_pen.h"
#include "panel_view.h"

#include <stdio.h>
#include <string.h>

/* On one line where it fits, else on three. */
static void write_position(pen *p, const char *name, const double position[3])
{
    char axes[3][32], line[SCENE_TEXT * 2];
    for (int i = 0; i < 3; i++)
        number_text(position[i], 6, axes[i]);
    snprintf(line, sizeof line, "%s %s %s", axes[0], axes[1], axes[2]);
    if (strlen(line) <= (COLUMN - VALUE) / LETTER) {
        write_row(p, name, "%s", line);
        return;
    }
    for (int i = 0; i < 3; i++)
        write_row(p, i ? "" : name, "%s", axes[i]);
}

static void write_world(pen *p, const octree_box *world)
{
    for (int i = 0; i < 3; i++) {
        const char name[2] = {(char)('x' + i), 0};
        char from[32], to[32];
        write_row(p, name, "%s", number_text(world->min[i], 9, from));
        write_row(p, "  to", "%s", number_text(world->max[i], 9, to));
    }
}

static void write_statistics(pen *p, const octree *tree)
{
    octree_stats stats;
    octree_statistics(tree, &stats);
    write_row(p, "points", "%zu", stats.points);
    write_row(p, "nodes", "%zu", stats.nodes);
    write_row(p, "leaves", "%zu", stats.leaves);
    write_row(p, "depth", "%u of %zu", stats.depth, octree_definition(tree).max_depth);
    write_row(p, "leaf", "up to %zu", octree_definition(tree).leaf_capacity);
}

static const char *key_meaning(char key)
{
    static const char *const meanings[] = {"w+y", "s-y", "d+x", "a-x", "e+z", "f-z", "nnearest", ".wait"};
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i][0] == key)
            return meanings[i] + 1;
    return "";
}

/* What the tick did, in words; the most urgent gives the colour. */
static void write_events(pen *p, const octree_tick *tick)
{
    char words[SCENE_TEXT] = "";
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        if (tick->events >> i & 1) {
            strncat(words, words[0] ? ", " : "", sizeof words - strlen(words) - 1);
            strncat(words, octree_event_name(i), sizeof words - strlen(words) - 1);
        }
    }
    const bool stopped = tick->events & (OCTREE_EVENT_REFUSED | OCTREE_EVENT_FULL);
    const theme_role role = tick->hit_count ? ROLE_COLLISION : stopped ? ROLE_WARNING : ROLE_TEXT;
    write_text(p, MARGIN, role, 1, words[0] ? words : tick->key == 'n' ? "asked" : tick->number ? "waited" : "start");
    p->y += LINE;
}

/* A row names no more ids than these. */
#define MOST_IDS 3

/* "name  count: first, second ..." of ids. */
static void write_ids(pen *p, const char *name, const octree_point *points, size_t count)
{
    char text[SCENE_TEXT];
    size_t used = (size_t)snprintf(text, sizeof text, "%zu%s", count, count ? ":" : "");
    for (size_t i = 0; i < count && i < MOST_IDS && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, " %llu", (unsigned long long)points[i].id);
    write_row(p, name, "%s%s", text, count > MOST_IDS ? " .." : "");
}

static void write_addresses(pen *p, const char *name, const octree_address *addresses, size_t count)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (count == 0)
        return;
    write_row(p, name, "%s%s", octree_address_format(addresses[count - 1], text), count > 1 ? " .." : "");
}

static void write_nearest(pen *p, const octree_answer *answer)
{
    char distance[32];
    if (answer->count)
        write_row(p, "nearest", "%llu at %s", (unsigned long long)answer->neighbors[0].point.id,
                  number_text(answer->neighbors[0].distance, 6, distance));
    else
        write_row(p, "nearest", "none");
}

static void write_knearest(pen *p, const octree_answer *answer)
{
    octree_point first[MOST_IDS];
    for (size_t i = 0; i < answer->count && i < MOST_IDS; i++)
        first[i] = answer->neighbors[i].point;
    write_ids(p, "nearest", first, answer->count);
}

static void write_radius(pen *p, const octree_answer *answer)
{
    char radius[32];
    write_row(p, "radius", "%zu within %s", answer->count, number_text(answer->radius, 6, radius));
}

static void write_range(pen *p, const octree_answer *answer)
{
    write_ids(p, "range", answer->points, answer->count);
}

static void write_answers(pen *p, const octree_answer *answers, size_t count)
{
    static void (*const writers[OCTREE_QUERY_KINDS])(pen *, const octree_answer *) = {
        [OCTREE_QUERY_RANGE] = write_range,
        [OCTREE_QUERY_NEAREST] = write_nearest,
        [OCTREE_QUERY_KNEAREST] = write_knearest,
        [OCTREE_QUERY_RADIUS] = write_radius,
    };
    for (size_t i = 0; i < count; i++)
        writers[answers[i].kind](p, &answers[i]);
}

static void write_refusals(pen *p, const octree_tick *tick)
{
    for (size_t i = 0; i < tick->refusal_count && i < 2; i++)
        write_row(p, i ? "" : "refused", "%llu: %s", (unsigned long long)tick->refusals[i].id,
                  octree_status_name(tick->refusals[i].why));
    if (tick->refusal_count > 2)
        write_row(p, "", "and %zu more", tick->refusal_count - 2);
}

/* A few keys before and after this tick's, which stands in brackets. */
static void write_keys(pen *p, const octree_game *game)
{
    const octree_session *session = octree_game_session(game);
    const uint64_t now = octree_game_tick(game)->number;
    const size_t count = session->keys ? strlen(session->keys) : 0;
    char text[SCENE_TEXT];
    size_t used = 0;
    for (uint64_t tick = now > 5 ? now - 5 : 1; tick <= now + 6 && tick <= count; tick++)
        used +=
            (size_t)snprintf(text + used, sizeof text - used, tick == now ? "[%c] " : "%c ", session->keys[tick - 1]);
    if (used) {
        write_text(p, MARGIN, ROLE_FAINT, 1, text);
        p->y += LINE;
    }
}

typedef struct legend_entry {
    unsigned layer;
    theme_role role;
    int height; /* of the swatch: 1 is a line, more a square */
    scene_style style;
    const char *text;
    bool swept; /* in sessions alone that are swept */
} legend_entry;

static const legend_entry legend[] = {
    {LAYER_POINTS, ROLE_POINT, 2, STYLE_SOLID, "point", false},
    {LAYER_PLAYER, ROLE_PLAYER, 5, STYLE_SOLID, "player and its box", false},
    {LAYER_BOX, ROLE_COLLISION, 5, STYLE_SOLID, "collision, crossed", false},
    {LAYER_BOX, ROLE_COLLISION, 1, STYLE_DASHED, "way to a hit, dashed", true},
    {LAYER_RANGE, ROLE_RANGE, 1, STYLE_DASHED, "range query, dashed", false},
    {LAYER_RADIUS, ROLE_RADIUS, 1, STYLE_SOLID, "radius query, round", false},
    {LAYER_KNEAREST, ROLE_KNEAREST, 1, STYLE_SOLID, "k nearest, numbered", false},
    {LAYER_NEAREST, ROLE_NEAREST, 1, STYLE_DASHED, "nearest point, dashed", false},
};

#define LEGEND_ENTRIES (sizeof legend / sizeof legend[0])

/* The layer of each kind of query. */
static const view_layer query_layers[OCTREE_QUERY_KINDS] = {
    [OCTREE_QUERY_RANGE] = LAYER_RANGE,
    [OCTREE_QUERY_NEAREST] = LAYER_NEAREST,
    [OCTREE_QUERY_KNEAREST] = LAYER_KNEAREST,
    [OCTREE_QUERY_RADIUS] = LAYER_RADIUS,
};

/* The layers that a session can show, as bits: those of queries that it never asks are left out. The nearest point is
 * asked for by a key too. */
static unsigned layers_of(const octree_session *session)
{
    unsigned asked = 1u << LAYER_NEAREST, others = VIEW_ALL_LAYERS;
    for (size_t i = 0; i < OCTREE_QUERY_KINDS; i++)
        others &= ~(1u << query_layers[i]);
    for (size_t i = 0; i < session->query_count; i++)
        asked |= 1u << query_layers[session->queries[i].kind];
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

static void fill_line(pen *p, theme_role role, scene_style style)
{
    const int step = style == STYLE_DASHED ? 8 : SWATCH;
    for (int x = 0; x < SWATCH; x += step)
        fill(p, MARGIN + x, p->y + 4, style == STYLE_DASHED ? 5 : SWATCH, 1, role);
}

static void write_legend_entry(pen *p, const legend_entry *entry)
{
    const int height = entry->height;
    if (height == 1)
        fill_line(p, entry->role, entry->style);
    else
        fill(p, MARGIN + (SWATCH - height) / 2, p->y + 4 - height / 2, height, height, entry->role);
    write_text(p, MARGIN + SWATCH + 6, ROLE_FAINT, 1, entry->text);
    p->y += LINE;
}

static bool is_listed(const legend_entry *entry, unsigned layers, bool swept)
{
    return (layers >> entry->layer & 1) && (swept || !entry->swept);
}

/* The view's layers, of those that there can be. */
static void write_legend(pen *p, size_t max_depth, unsigned layers, bool swept)
{
    const scene *s = p->scene;
    layers &= s->view.layers;
    if (view_shows(&s->view, LAYER_DIAGRAM))
        layers |= 1u << LAYER_NODES;
    int lines = (int)(layers >> LAYER_NODES & 1) + diagram_legend_lines(s);
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        lines += is_listed(&legend[i], layers, swept);
    const int top = s->view.height / s->unit - MARGIN - lines * LINE;
    if (top < p->y + LINE / 2)
        return; /* a low picture has no room for it */
    p->y = top;
    if (layers >> LAYER_NODES & 1)
        write_node_legend(p, max_depth);
    write_diagram_legend(p);
    for (size_t i = 0; i < LEGEND_ENTRIES; i++)
        if (is_listed(&legend[i], layers, swept))
            write_legend_entry(p, &legend[i]);
}

static void write_title(pen *p, const char *text)
{
    const bool fits = strlen(text) <= (COLUMN - MARGIN) / (2 * LETTER);
    write_text(p, MARGIN, ROLE_TEXT, fits ? 2 : 1, text);
    p->y += 2 * LINE;
}

static pen begin_panel(scene *s)
{
    pen p = {.scene = s, .y = MARGIN};
    fill(&p, 0, 0, COLUMN, s->view.height / s->unit + 1, ROLE_PANEL);
    return p;
}

void add_tick_panel(scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_session *session = octree_game_session(game);
    char title[SCENE_TEXT];
    snprintf(title, sizeof title, "tick %llu", (unsigned long long)tick->number);
    if (panel_width(&s->view) == 0) {
        pen line = {.scene = s, .y = 4};
        write_text(&line, 4, ROLE_TEXT, 1, title);
        line.y += LINE;
        write_events(&line, tick);
        write_left_out(&line);
        return;
    }
    pen p = begin_panel(s);
    write_title(&p, title);
    write_events(&p, tick);
    p.y += LINE / 2;
    if (tick->key)
        write_row(&p, "key", "%c  %s", tick->key, key_meaning(tick->key));
    write_keys(&p, game);
    write_position(&p, "player", tick->player);
    if (tick->swept)
        write_row(&p, "tested", "the whole way");
    p.y += LINE / 2;
    write_statistics(&p, octree_game_tree(game));
    write_left_out(&p);
    p.y += LINE / 2;
    write_ids(&p, "hits", tick->hits, tick->hit_count);
    write_answers(&p, tick->answers, tick->answer_count);
    write_refusals(&p, tick);
    write_addresses(&p, "split", tick->splits, tick->split_count);
    write_addresses(&p, "merged", tick->merges, tick->merge_count);
    write_legend(&p, session->tree.max_depth, layers_of(session), session->player.sweep);
}

void add_tree_panel(scene *s, const octree *tree, const tree_look *about)
{
    if (panel_width(&s->view) == 0) {
        write_left_out(&(pen){.scene = s, .y = 4});
        return;
    }
    pen p = begin_panel(s);
    write_title(&p, about->title);
    write_statistics(&p, tree);
    write_left_out(&p);
    p.y += LINE / 2;
    const octree_box world = octree_definition(tree).world;
    write_world(&p, &world);
    if (about->answer_count)
        p.y += LINE / 2;
    write_answers(&p, about->answers, about->answer_count);
    write_legend(&p, octree_definition(tree).max_depth, layers_of_tree(about), false);
}
