/* panel.c - see panel.h. */
#include "panel.h"
#include "answer_layers.h"
#include "layer.h"
#include "layout.h"
#include "number.h"
#include "panel_legend.h"
#include "panel_pen.h"
#include "panel_view.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define LETTERS 10 /* units from the top of a row to below its letters */

/* On one line where it fits, else on three. */
static void write_position(pen *p, const char *name, const double position[3])
{
    char axes[3][NUMBER_TEXT], line[SCENE_TEXT * 2];
    for (int i = 0; i < 3; i++)
        number_text(position[i], 6, axes[i]);
    snprintf(line, sizeof line, "%s %s %s", axes[0], axes[1], axes[2]);
    if (strlen(line) <= (COLUMN - VALUE) / LETTER) {
        write_row(p, name, "%s", line);
        return;
    }
    for (int i = 0; i < 3; i++)
        write_row(p, i ? "" : name, "%s", number_text(position[i], 9, axes[i]));
}

static void write_world(pen *p, const octree_box *world)
{
    for (int i = 0; i < 3; i++) {
        const char name[2] = {(char)('x' + i), 0};
        char from[NUMBER_TEXT], to[NUMBER_TEXT];
        write_row(p, name, "%s", number_text(world->min[i], 9, from));
        write_row(p, "  to", "%s", number_text(world->max[i], 9, to));
    }
}

static void write_statistics(pen *p, const octree *tree, const octree_stats *stats)
{
    write_row(p, "points", "%zu", stats->points);
    write_row(p, "nodes", "%zu", stats->nodes);
    write_row(p, "leaves", "%zu", stats->leaves);
    write_row(p, "depth", "%u of %zu", stats->depth, octree_definition(tree).max_depth);
    write_row(p, "leaf", "up to %zu", octree_definition(tree).leaf_capacity);
}

/* Whether there is somebody whom keys move. */
static bool has_keys(const octree_game *game)
{
    return octree_game_session(game)->player.kind == OCTREE_PLAYER_KEYS;
}

static const char *key_meaning(char key)
{
    static const char *const meanings[] = {"w+y", "s-y", "d+x", "a-x", "e+z", "f-z", "nnearest", ".wait"};
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i][0] == key)
            return meanings[i] + 1;
    return "";
}

/* What is said of a tick without events. */
static const char *quiet_word(const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    if (tick->key == 'n')
        return "asked";
    return !tick->number ? "start" : has_keys(game) ? "waited" : "no event";
}

/* What the tick did, in words; the most urgent gives the colour. */
static void write_events(pen *p, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    char words[SCENE_TEXT] = "";
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        if (tick->events >> i & 1) {
            strncat(words, words[0] ? ", " : "", sizeof words - strlen(words) - 1);
            strncat(words, octree_event_name(1u << i), sizeof words - strlen(words) - 1);
        }
    }
    const bool stopped = tick->events & (OCTREE_EVENT_REFUSED | OCTREE_EVENT_FULL);
    const theme_role role = tick->hit_count ? ROLE_COLLISION : stopped ? ROLE_WARNING : ROLE_TEXT;
    write_text(p, MARGIN, role, 1, words[0] ? words : quiet_word(game));
    p->y += LINE;
}

/* A row names no more ids than these. */
#define MOST_IDS 3

/* "count: first second +more" of the ids that have room: none is cut. */
static void write_ids(pen *p, const char *name, const octree_point *points, size_t count)
{
    char text[SCENE_TEXT] = "", more[SCENE_TEXT] = "", id[SCENE_TEXT], rest[SCENE_TEXT] = "", number[SCENE_TEXT];
    size_t told = 0, room = text_room(VALUE, 1);
    snprintf(number, sizeof number, "%zu", count);
    for (; told < count && told < MOST_IDS; told++) {
        snprintf(id, sizeof id, " %" PRIu64, points[told].id);
        if (told + 1 < count)
            snprintf(rest, sizeof rest, " +%zu", count - told - 1);
        else
            rest[0] = 0;
        if (strlen(number) + 1 + strlen(text) + strlen(id) + strlen(rest) > room)
            break;
        strcat(text, id);
        strcpy(more, rest);
    }
    write_row(p, name, "%s%s%s%s", number, told ? ":" : "", text, more);
}

static void write_nearest(pen *p, const octree_answer *answer)
{
    char id[SCENE_TEXT], distance[NUMBER_TEXT];
    if (answer->count == 0) {
        write_row(p, "nearest", "none");
        return;
    }
    number_text(answer->neighbors[0].distance, 6, distance);
    snprintf(id, sizeof id, "%" PRIu64, answer->neighbors[0].point.id);
    const bool fits = strlen(id) + strlen(" at ") + strlen(distance) <= text_room(VALUE, 1);
    write_row(p, "nearest", "%s%s%s", id, fits ? " at " : "", fits ? distance : "");
    if (!fits)
        write_row(p, "", "at %s", distance);
}

static void write_knearest(pen *p, const octree_answer *answer)
{
    octree_point first[MOST_IDS];
    for (size_t i = 0; i < answer->count && i < MOST_IDS; i++)
        first[i] = answer->neighbors[i].point;
    write_ids(p, "k near", first, answer->count);
}

static void write_radius(pen *p, const octree_answer *answer)
{
    char radius[NUMBER_TEXT];
    write_row(p, "radius", "%zu within %s", answer->count, number_text(answer->radius, 6, radius));
}

static void write_range(pen *p, const octree_answer *answer)
{
    write_ids(p, "range", answer->points, answer->count);
}

/* In the colours of what is drawn of them. */
static void write_answers(pen *p, const octree_answer *answers, size_t count)
{
    static void (*const writers[OCTREE_QUERY_KINDS])(pen *, const octree_answer *) = {
        [OCTREE_QUERY_RANGE] = write_range,
        [OCTREE_QUERY_NEAREST] = write_nearest,
        [OCTREE_QUERY_KNEAREST] = write_knearest,
        [OCTREE_QUERY_RADIUS] = write_radius,
    };
    for (size_t i = 0; i < count; i++) {
        const view_layer layer = answer_layer(answers[i].kind);
        p->name = view_shows(&p->scene->view, layer) ? (theme_role)layer_rows[layer].role : ROLE_FAINT;
        writers[answers[i].kind](p, &answers[i]);
    }
    p->name = ROLE_FAINT;
}

static void write_refusals(pen *p, const octree_tick *tick)
{
    for (size_t i = 0; i < tick->refusal_count && i < 2; i++)
        write_row(p, i ? "" : "refused", "%" PRIu64 ": %s", tick->refusals[i].id,
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
        text[used - 1] = 0; /* the last blank */
        write_text(p, MARGIN, ROLE_FAINT, 1, text);
        p->y += LINE;
    }
}

/* The sentence in lines that fit the column, broken at blanks. */
static void write_wrapped(pen *p, theme_role role, const char *text)
{
    const size_t most = (COLUMN - MARGIN) / LETTER;
    while (*text) {
        char line[SCENE_TEXT];
        size_t length = strlen(text);
        for (size_t i = length > most ? most : 0; i > 0; i--)
            if (text[i] == ' ') {
                length = i;
                break;
            }
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        write_text(p, MARGIN, role, 1, line);
        p->y += LINE;
        text += length + (text[length] == ' ');
    }
}

static void write_finding(pen *p, const finding *found)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (!found->broken)
        return;
    p->y += LINE / 2;
    write_row(p, "broken", "%s", octree_address_format(found->where, text));
    write_wrapped(p, ROLE_WARNING, found->broken);
}

static void write_title(pen *p, const char *text)
{
    const bool fits = strlen(text) <= (COLUMN - MARGIN) / (2 * LETTER);
    write_text(p, MARGIN, ROLE_TEXT, fits ? 2 : 1, text);
    p->y += 2 * LINE;
}

/* Rows that the picture is too low for are counted in the place of the first. */
static void end_rows(pen *p)
{
    scene *s = p->scene;
    const int last = s->view.height / s->unit - LETTERS; /* where the last row may begin */
    size_t kept = 0, rows = 0;
    double at = -1, first = 0;
    char text[SCENE_TEXT];
    if (p->y - LINE <= last)
        return;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label label = s->labels.items[i];
        if (label.style.layer != LAYER_TEXT || label.at[1] <= (last - LINE) * s->unit) {
            s->labels.items[kept++] = label;
            continue;
        }
        first = rows ? first : label.at[1];
        rows += label.at[1] != at;
        at = label.at[1];
    }
    s->labels.count = kept;
    p->y = (int)first / s->unit < last ? (int)first / s->unit : last;
    snprintf(text, sizeof text, "and %zu more", rows);
    write_text(p, MARGIN, ROLE_WARNING, 1, text);
    p->y += LINE;
}

static pen begin_panel(scene *s)
{
    pen p = {.scene = s, .y = MARGIN, .name = ROLE_FAINT};
    fill(&p, 0, 0, COLUMN, s->view.height / s->unit + 1, ROLE_PANEL);
    return p;
}

/* Where there may be one. */
static void write_player(pen *p, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    if (tick->has_player)
        write_position(p, "player", tick->player);
    else if (octree_game_session(game)->player.kind != OCTREE_PLAYER_NONE)
        write_row(p, "player", "away");
}

void add_tick_panel(scene *s, const octree_game *game, const finding *found)
{
    const octree_tick *tick = octree_game_tick(game);
    char title[SCENE_TEXT];
    snprintf(title, sizeof title, "tick %" PRIu64, tick->number);
    if (panel_width(&s->view) == 0) {
        pen line = {.scene = s, .y = 4, .name = ROLE_FAINT};
        write_text(&line, 4, ROLE_TEXT, 1, title);
        line.y += LINE;
        write_events(&line, game);
        write_left_out(&line);
        write_finding(&line, found);
        end_rows(&line);
        return;
    }
    pen p = begin_panel(s);
    write_title(&p, title);
    write_events(&p, game);
    p.y += LINE / 2;
    if (tick->key && (has_keys(game) || tick->key == 'n'))
        write_row(&p, "key", "%c  %s", tick->key, key_meaning(tick->key));
    write_keys(&p, game);
    write_player(&p, game);
    if (tick->swept)
        write_row(&p, "tested", "the whole way");
    p.y += LINE / 2;
    write_statistics(&p, octree_game_tree(game), &octree_game_tick(game)->stats);
    write_left_out(&p);
    p.y += LINE / 2;
    if (tick->hit_count)
        write_ids(&p, "hits", tick->hits, tick->hit_count);
    write_answers(&p, tick->answers, tick->answer_count);
    write_refusals(&p, tick);
    write_finding(&p, found);
    end_rows(&p);
    write_tick_legend(&p, game);
}

void add_tree_panel(scene *s, const octree *tree, const tree_look *about, const finding *found)
{
    if (panel_width(&s->view) == 0) {
        pen line = {.scene = s, .y = 4, .name = ROLE_FAINT};
        write_left_out(&line);
        write_finding(&line, found);
        end_rows(&line);
        return;
    }
    octree_stats stats;
    pen p = begin_panel(s);
    write_title(&p, about->title);
    octree_statistics(tree, &stats);
    write_statistics(&p, tree, &stats);
    write_left_out(&p);
    p.y += LINE / 2;
    const octree_box world = octree_definition(tree).world;
    write_world(&p, &world);
    if (about->answer_count)
        p.y += LINE / 2;
    write_answers(&p, about->answers, about->answer_count);
    write_finding(&p, found);
    end_rows(&p);
    write_tree_legend(&p, tree, about);
}
