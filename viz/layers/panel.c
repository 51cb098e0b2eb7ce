/* SPDX-License-Identifier: MIT */
/* panel.c - the text layer: the column at the left, which describes the tick. */
#include "judgement_words.h"
#include "layer_type.h"
#include "layout.h"
#include "number.h"
#include "text.h"

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

/* Whether the player is moved by keys. */
static bool has_keys(const layer_source *in)
{
    return in->session->player.kind == OCTREE_PLAYER_KEYS;
}

static const char *key_meaning(char key)
{
    static const char *const meanings[] = {"w+y", "s-y", "d+x", "a-x", "e+z", "f-z", "nnearest", ".wait"};
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i][0] == key)
            return meanings[i] + 1;
    return "";
}

/* The words for a tick without events. */
static const char *quiet_word(const layer_source *in)
{
    if (in->tick->key == 'n')
        return "asked";
    return !in->tick->number ? "start" : has_keys(in) ? "waited" : "no event";
}

/* What the tick did, in words; the most urgent gives the colour. */
static void write_events(pen *p, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    char words[SCENE_TEXT] = "";
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        if (tick->events >> i & 1) {
            strncat(words, words[0] ? ", " : "", sizeof words - strlen(words) - 1);
            strncat(words, octree_event_name(1u << i), sizeof words - strlen(words) - 1);
        }
    }
    const bool warns = tick->events & (OCTREE_EVENT_REFUSED | OCTREE_EVENT_FULL | OCTREE_EVENT_WRONG);
    const theme_role role = tick->hit_count ? ROLE_COLLISION : warns ? ROLE_WARNING : ROLE_TEXT;
    write_line(p, MARGIN, role, words[0] ? words : quiet_word(in));
}

/* In the colours of the answers' layers. */
static void write_answers(pen *p, const layer_source *in)
{
    for (size_t i = 0; i < in->answer_count; i++) {
        const view_layer layer = layer_of_query(in->answers[i].kind);
        p->name = view_shows(&p->scene->view, layer) ? (theme_role)layer_rows[layer].role : ROLE_FAINT;
        layer_types[layer]->write_answer(p, &in->answers[i]);
    }
    p->name = ROLE_FAINT;
}

/* "1 of 3: nearest", with the kind where it fits, and what is wrong with the worst of the program's answers. */
static void write_wrong(pen *p, const layer_source *in)
{
    char count[2 * SCENE_TEXT], kind[SCENE_TEXT], words[JUDGEMENT_WORDS];
    size_t judged = 0, worst;
    const size_t wrong = judgement_count(in->answers, in->answer_count, &worst);
    if (wrong == 0)
        return;
    for (size_t i = 0; i < in->answer_count; i++)
        judged += in->answers[i].judgement.judged;
    snprintf(count, sizeof count, "%zu of %zu", wrong, judged);
    snprintf(kind, sizeof kind, ": %s", octree_query_name(in->answers[worst].kind));
    if (strlen(count) + strlen(kind) <= text_room(VALUE, 1))
        strcat(count, kind);
    p->name = ROLE_WRONG;
    write_row(p, "wrong", "%s", count);
    write_row(p, "", "%s", judgement_words(&in->answers[worst].judgement, words));
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

/* A few keys before and after this tick's, which is in brackets. */
static void write_keys(pen *p, const layer_source *in)
{
    const uint64_t now = in->tick->number;
    const char *keys = in->session->keys ? in->session->keys : "";
    const size_t count = strlen(keys);
    char text[SCENE_TEXT];
    size_t used = 0;
    for (uint64_t tick = now > 5 ? now - 5 : 1; tick <= now + 6 && tick <= count; tick++)
        used += (size_t)snprintf(text + used, sizeof text - used, tick == now ? "[%c] " : "%c ", keys[tick - 1]);
    if (used) {
        text[used - 1] = 0; /* the last blank */
        write_line(p, MARGIN, ROLE_FAINT, text);
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
        write_line(p, MARGIN, role, line);
        text += length + (text[length] == ' ');
    }
}

static void write_broken(pen *p, const layer_source *in)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (!in->broken)
        return;
    p->y += LINE / 2;
    write_row(p, "broken", "%s", octree_address_format(in->broken_at, text));
    write_wrapped(p, ROLE_WARNING, in->broken);
}

static void write_title(pen *p, const char *text)
{
    const bool fits = strlen(text) <= (COLUMN - MARGIN) / (2 * LETTER);
    write_text(p, MARGIN, ROLE_TEXT, fits ? 2 : 1, text);
    p->y += 2 * LINE;
}

/* ---- What the view leaves out ------------------------------------------------------------------------------- */

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

static void write_budget(pen *p, const scene_tally *tally)
{
    const bool nodes = tally->beyond > 0, points = tally->thinned > 0;
    if (nodes && tally->deepest < 0)
        write_row(p, "budget", "no nodes");
    else if (nodes)
        write_row(p, "budget", "nodes to depth %d", tally->deepest);
    if (points)
        write_row(p, nodes ? "" : "budget", "1 point in %" PRIu64, tally->one_in);
    if (tally->arrows.thinned)
        write_row(p, "arrows", "1 in %" PRIu64, tally->arrows.one_in);
}

static void write_folded(pen *p, const scene_tally *tally)
{
    if (tally->folded && tally->folded_from == tally->folded_to)
        write_row(p, "folded", "depth %u", tally->folded_from);
    else if (tally->folded)
        write_row(p, "folded", "depths %u to %u", tally->folded_from, tally->folded_to);
}

/* "12 below 2 px"; what is no node in words that fit, "12 met < 2 px", or on a line of its own, "and 12 met". */
static void write_small(pen *p, const scene_tally *tally)
{
    const size_t counts[] = {tally->small, tally->small_met, tally->arrows.small};
    const char *const words[] = {"", " met", tally->arrows.small == 1 ? " arrow" : " arrows"};
    char lod[NUMBER_TEXT], text[SCENE_TEXT * 2];
    const char *name = "lod";
    number_text(p->scene->view.lod, 3, lod);
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        if (!counts[i])
            continue;
        if (*name)
            snprintf(text, sizeof text, i ? "%zu%s < %s px" : "%zu%s below %s px", counts[i], words[i], lod);
        else
            snprintf(text, sizeof text, "and %zu%s", counts[i], words[i]);
        if (i && *name && strlen(text) > text_room(VALUE, 1))
            text[strlen(text) - strlen(" px")] = 0;
        write_row(p, name, "%s", text);
        name = "";
    }
}

/* How many nodes and points are shown, if not all. */
static void write_shown(pen *p, const scene_tally *tally)
{
    const view *v = &p->scene->view;
    if (!filter_is_on(&v->filter) && !tally->small && !tally->beyond && !tally->thinned)
        return;
    write_filter(p, &v->filter);
    if (view_shows(v, LAYER_NODES))
        write_row(p, "shown", "%zu node%s", tally->nodes, plural(tally->nodes));
    if (view_shows(v, LAYER_POINTS))
        write_row(p, view_shows(v, LAYER_NODES) ? "" : "shown", "%zu point%s", tally->points, plural(tally->points));
}

/* A line for each thing that leaves something out or folds it, and how much is shown. */
static void write_left_out(pen *p)
{
    const scene_tally *tally = &p->scene->tally;
    const int before = p->y;
    p->y += LINE / 2;
    const int begin = p->y;
    p->value = ROLE_WARNING;
    write_folded(p, tally);
    p->value = ROLE_TEXT;
    write_shown(p, tally);
    write_small(p, tally);
    p->value = ROLE_WARNING;
    write_budget(p, tally);
    p->value = ROLE_TEXT;
    if (p->scene->view.labels && tally->labels < tally->nodes)
        write_row(p, "labels", "%zu of %zu fit", tally->labels, tally->nodes);
    p->y = p->y == begin ? before : p->y; /* nothing is left out */
}

/* ---- The column --------------------------------------------------------------------------------------------- */

/* Rows that do not fit are replaced by a line that counts them. */
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
    write_line(p, MARGIN, ROLE_WARNING, text);
}

/* If the session has a player. */
static void write_player(pen *p, const layer_source *in)
{
    if (in->tick->has_player)
        write_position(p, "player", in->tick->player);
    else if (in->session->player.kind != OCTREE_PLAYER_NONE)
        write_row(p, "player", "away");
}

static void write_tick_rows(pen *p, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    if (tick->key && (has_keys(in) || tick->key == 'n'))
        write_row(p, "key", "%c  %s", tick->key, key_meaning(tick->key));
    write_keys(p, in);
    write_player(p, in);
    if (tick->swept)
        write_row(p, "tested", "the whole way");
    p->y += LINE / 2;
    write_statistics(p, in->tree, &tick->stats);
    write_left_out(p);
    p->y += LINE / 2;
    if (tick->hit_count)
        write_ids(p, "hits", tick->hits, tick->hit_count);
    write_wrong(p, in);
    write_answers(p, in);
    write_refusals(p, tick);
}

static void write_tree_rows(pen *p, const layer_source *in)
{
    octree_stats stats;
    octree_statistics(in->tree, &stats);
    write_statistics(p, in->tree, &stats);
    write_left_out(p);
    p->y += LINE / 2;
    write_world(p, &in->world);
    if (in->answer_count)
        p->y += LINE / 2;
    write_answers(p, in);
}

/* When there is no room for the column, its most important lines are written on the picture. */
static void add_lines(scene *s, const layer_source *in, const char *title)
{
    pen p = {.scene = s, .y = 4, .name = ROLE_FAINT, .value = ROLE_TEXT};
    if (in->tick) {
        write_text(&p, 4, ROLE_TEXT, 1, title);
        p.y += LINE;
        write_events(&p, in);
        write_wrong(&p, in);
    }
    write_left_out(&p);
    write_broken(&p, in);
    end_rows(&p);
}

static void add(scene *s, const layer_source *in, view_layer own)
{
    (void)own;
    char tick[SCENE_TEXT];
    const char *title = in->tick ? tick : in->title;
    if (in->tick)
        snprintf(tick, sizeof tick, "tick %" PRIu64, in->tick->number);
    if (panel_width(&s->view) == 0) {
        add_lines(s, in, title);
        return;
    }
    pen p = {.scene = s, .y = MARGIN, .name = ROLE_FAINT, .value = ROLE_TEXT};
    fill(&p, 0, 0, COLUMN, s->view.height / s->unit + 1, ROLE_PANEL);
    write_title(&p, title);
    if (in->tick) {
        write_events(&p, in);
        p.y += LINE / 2;
        write_tick_rows(&p, in);
    } else {
        write_tree_rows(&p, in);
    }
    write_broken(&p, in);
    end_rows(&p);
    write_legend(&p, in);
}

static void describe(description *d, const described *element)
{
    if (element->kind == SCENE_PANEL)
        say(d, element->style.role == ROLE_PANEL ? "the panel that the text is on" : "a sign in the panel");
}

const layer_type layer_TEXT = {.add = add, .describe = describe};
