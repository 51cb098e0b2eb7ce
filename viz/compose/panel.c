/* SPDX-License-Identifier: MIT */
/* panel.c - the text layer: the column of text at the left of the picture, which describes the tick, or the tree.
 *
 * Readers compare frames, so a fact should stand at the same place in every frame. The rows have a fixed order: title
 * and key press, events, key presses, player, statistics, elements that the view leaves out, collision hits, wrong
 * answers, answers, refusals. If the player is missing, its rows stay empty. The player's coordinates have the same
 * number of decimals throughout the session. Rows whose number varies come last. The legend fills the bottom of the
 * column.
 *
 * A line has a fixed number of characters, so every value is cut or rounded to fit. If the rows need more lines than
 * the picture has, the last rows are replaced by a line that counts them. A picture without room for the column shows
 * only the most important lines, in its corner.
 *
 * In a page the column is HTML text: if view.text_apart is true, the pen writes the same rows as JSON, and does not cut
 * them. A thin line between rows may then follow another thin line, or come last.
 *
 * This layer is added last, because it counts the elements that the other layers left out (scene_tally). */
#include "caption.h"
#include "foreign_nodes.h"
#include "judgement.h"
#include "layer_type.h"
#include "layout.h"
#include "octree/octree.h"
#include "text.h"
#include "tick_scene.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Numbers in columns ------------------------------------------------------------------------------------- */

#define MOST_DECIMALS 9
#define WORLD_NUMBER 12 /* maximum number of characters of a coordinate of the world or the region */

/* Return the number of decimals that a number needs. The result is greater than MOST_DECIMALS if the number needs an
 * exponent. */
static int count_decimals(double value)
{
    char text[NUMBER_TEXT];
    const char *point = strchr(number_format(value, MOST_DECIMALS, text), '.');
    return strchr(text, 'e') ? MOST_DECIMALS + 1 : point ? (int)strlen(point + 1) : 0;
}

/* Return the number of decimals of the player's coordinates. The number is the same at every tick, so that digits keep
 * their place. If key presses move the player, the decimals suit every position that key presses can reach; the result
 * is greater than MOST_DECIMALS if such a position needs an exponent. For any other player, the world's largest
 * coordinate gets six digits. */
static int count_player_decimals(const layer_source *in)
{
    const octree_player *player = &in->session->player;
    int decimals = 0;
    if (player->kind == OCTREE_PLAYER_KEYS) {
        const double numbers[] = {player->step, player->position[0], player->position[1], player->position[2]};
        for (int i = 0; i < 4; i++)
            decimals = count_decimals(numbers[i]) > decimals ? count_decimals(numbers[i]) : decimals;
        return decimals;
    }
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fmax(fabs(in->world.min[i]), fabs(in->world.max[i])));
    for (double digit = largest * 1e-5; digit < 0.5 && decimals <= MOST_DECIMALS; digit *= 10)
        decimals++;
    return decimals;
}

/* Write a position as three rows, one row for each axis. */
static void write_position(pen *p, const char *name, const double position[3], int decimals)
{
    for (int i = 0; i < 3; i++) {
        char axis[NUMBER_TEXT], text[NUMBER_TEXT];
        snprintf(axis, sizeof axis, "%-7s%c", i ? "" : name, "xyz"[i]);
        if (decimals > MOST_DECIMALS || !(fabs(position[i]) < 1e9))
            number_format(position[i], 9, text);
        else
            snprintf(text, sizeof text, "%.*f", decimals, position[i] + 0.0); /* adding 0.0 turns -0 into 0 */
        write_row(p, axis, "", "%s", text);
    }
}

/* Write the minimum and maximum of a box as three rows, one row for each axis. */
static void write_box_rows(pen *p, const char *name, const octree_box *box)
{
    char from[NUMBER_TEXT], to[NUMBER_TEXT], heading[SCENE_TEXT * 2];
    snprintf(heading, sizeof heading, "%*s %*s", WORLD_NUMBER, "from", WORLD_NUMBER, "to");
    write_text(p, 0, ROLE_FAINT, "%s", name);
    write_right_aligned(p, ROLE_FAINT, heading);
    p->y += p->text.line;
    for (int i = 0; i < 3; i++) {
        const char axis[2] = {(char)('x' + i), 0};
        write_row(p, axis, "", "%*s %*s", WORLD_NUMBER, format_number_within(box->min[i], WORLD_NUMBER, from),
                  WORLD_NUMBER, format_number_within(box->max[i], WORLD_NUMBER, to));
    }
}

/* ---- The tick ------------------------------------------------------------------------------------------------ */

/* Write the statistics of the trees that the view shows: Octreel's own tree, the foreign tree, or both. */
static void write_statistics(pen *p, const layer_source *in, const octree_stats *stats)
{
    const octree_def definition = octree_definition(in->tree);
    write_row(p, "points", "", "%zu", stats->points);
    if (shows_foreign_nodes(in)) {
        write_row(p, "foreign nodes", "", "%zu", in->tick->foreign.node_count);
        write_row(p, "foreign leaves", "", "%zu", in->tick->foreign.leaf_count);
        write_row(p, "foreign depth", "", "%u", in->tick->foreign.depth);
    }
    if (!shows_octreel_nodes(in))
        return;
    write_row(p, "nodes", "", "%zu", stats->nodes);
    write_row(p, "leaves", "", "%zu", stats->leaves);
    write_row(p, "depth", "", "%u of max %zu", stats->depth, definition.max_depth);
    write_row(p, "leaf capacity", "", "%zu", definition.leaf_capacity);
}

/* Return whether key presses move the player. */
static bool is_player_moved_by_keys(const layer_source *in)
{
    return in->session->player.kind == OCTREE_PLAYER_KEYS;
}

static const char *get_key_meaning(char key)
{
    static const char *const meanings[] = {"w+y", "s-y", "d+x", "a-x", "e+z", "f-z", "nnearest", ".wait"};
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++)
        if (meanings[i][0] == key)
            return meanings[i] + 1;
    return "";
}

/* Return the text for a tick without events. */
static const char *no_event_text(const layer_source *in)
{
    if (in->tick->key == 'n')
        return "asked";
    return !in->tick->number ? "start" : is_player_moved_by_keys(in) ? "waited" : "no event";
}

/* Write the names of the tick's events. Splits and merges belong to Octreel's own tree, and are left out if the view
 * does not show that tree. The most urgent event decides the colour. */
static void write_events(pen *p, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    const unsigned events = tick->events & ~(shows_octreel_nodes(in) ? 0u : OCTREE_EVENT_SPLIT | OCTREE_EVENT_MERGED);
    char words[SCENE_TEXT] = "";
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        if (events >> i & 1) {
            strncat(words, words[0] ? ", " : "", sizeof words - strlen(words) - 1);
            strncat(words, octree_event_name(1u << i), sizeof words - strlen(words) - 1);
        }
    }
    const bool warns = tick->events & (OCTREE_EVENT_REFUSED | OCTREE_EVENT_FULL | OCTREE_EVENT_WRONG);
    const theme_role role = tick->hit_count ? ROLE_COLLISION : warns ? ROLE_WARNING : ROLE_TEXT;
    write_wrapped_text(p, role, words[0] ? words : no_event_text(in));
}

/* Write a row for each answer, in the colour of the layer that shows the answer. */
static void write_answers(pen *p, const layer_source *in)
{
    for (size_t i = 0; i < in->answer_count; i++) {
        const view_layer layer = layer_of_query(in->answers[i].kind);
        p->name = view_shows_layer(&p->scene->view, layer) ? (theme_role)layer_rows[layer].role : ROLE_FAINT;
        layer_types[layer]->write_answer(p, &in->answers[i]);
    }
    p->name = ROLE_FAINT;
}

/* Write two rows: the number of wrong foreign answers of all kinds, and the error of the worst one with its query kind,
 * which is cut if there is no room. */
static void write_wrong_answers(pen *p, const layer_source *in)
{
    char words[JUDGEMENT_TEXT];
    size_t judged = 0, worst;
    const size_t wrong = judgement_count_wrong(in->answers, in->answer_count, &worst);
    if (wrong == 0)
        return;
    for (size_t i = 0; i < in->answer_count; i++)
        judged += in->answers[i].judgement.judged;
    p->name = ROLE_WRONG;
    const char *kind = octree_query_name(in->answers[worst].kind);
    write_row(p, "wrong", "answers", "%zu of %zu", wrong, judged);
    write_row(p, "worst", kind, "%s", judgement_text(&in->answers[worst].judgement, words));
    p->name = ROLE_FAINT;
}

/* Write the error of the pairs that the foreign index found. */
static void write_wrong_pairs(pen *p, const layer_source *in)
{
    char words[JUDGEMENT_TEXT];
    if (!in->tick->foreign_pairs.wrong)
        return;
    p->name = ROLE_WRONG;
    write_row(p, "wrong", "", "pairs");
    write_row(p, "", "", "%s", pair_judgement_text(&in->tick->foreign_pairs, words));
    p->name = ROLE_FAINT;
}

/* Write the number of wrong foreign nodes, and the error of the first wrong node. */
static void write_wrong_nodes(pen *p, const layer_source *in)
{
    char text[WRONG_NODE_TEXT];
    if (!shows_foreign_nodes(in) || in->tick->foreign.wrong_count == 0)
        return;
    p->name = ROLE_WRONG;
    write_row(p, "wrong nodes", "", "%zu", in->tick->foreign.wrong_count);
    p->name = ROLE_FAINT;
    write_wrapped_text(p, ROLE_WARNING, wrong_node_text(&in->tick->foreign, text));
}

static void write_refusals(pen *p, const octree_tick *tick)
{
    for (size_t i = 0; i < tick->refusal_count && i < 2; i++) {
        char id[SCENE_TEXT], why[SCENE_TEXT];
        snprintf(id, sizeof id, "#%" PRIu64, tick->refusals[i].id);
        snprintf(why, sizeof why, "%s", octree_status_name(tick->refusals[i].why));
        for (char *c = strchr(why, '_'); c; c = strchr(c, '_'))
            *c = ' ';
        write_row(p, i ? "" : "refused", id, "%s", why);
    }
    if (tick->refusal_count > 2)
        write_row(p, "", "", "and %zu more", tick->refusal_count - 2);
}

/* Write the key press of this tick in brackets, always at the same place, and the key presses of a few ticks before and
 * after this tick. */
static void write_keys(pen *p, const layer_source *in)
{
    const uint64_t now = in->tick->number;
    const char *keys = in->session->keys ? in->session->keys : "";
    const uint64_t count = strlen(keys);
    char text[SCENE_TEXT];
    size_t used = 0;
    if (!count)
        return;
    for (uint64_t i = 0; i <= KEYS_BEHIND + KEYS_AHEAD; i++) {
        /* Tick 1 has the first key press. For a tick before tick 1, `tick - 1` wraps around to a huge number, and a
         * space is written. */
        const uint64_t tick = now + i - KEYS_BEHIND;
        const char key = tick - 1 < count ? keys[tick - 1] : ' ';
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 i != KEYS_BEHIND ? "%c "
                                 : key == ' '     ? " %c  "
                                                  : "[%c] ",
                                 key);
    }
    while (used && text[used - 1] == ' ')
        text[--used] = 0;
    if (used || now < count)
        write_line(p, ROLE_FAINT, text);
}

static void write_broken_node(pen *p, const layer_source *in)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (!in->broken)
        return;
    write_gap(p);
    write_row(p, "broken", "", "%s", octree_address_format(in->broken_at, text));
    write_wrapped_text(p, ROLE_WARNING, in->broken);
}

/* Write a title. Its characters are large if the large title leaves room for `beside` small characters at the right,
 * and small otherwise. Return the height of the characters in pixels. */
static int write_title(pen *p, const char *text, size_t beside)
{
    const scene *s = p->scene;
    const size_t taken = (strlen(text) * (size_t)s->title.width + (size_t)s->text.width - 1) / (size_t)s->text.width;
    const bool fits = taken + (beside ? beside + 1 : 0) <= (size_t)p->letters;
    if (fits)
        write_title_text(p, ROLE_TEXT, text);
    else
        write_text(p, 0, ROLE_TEXT, "%s", text);
    return fits ? s->title.height : s->text.height;
}

/* Write the number of the tick. At the right, write the key that was pressed and the meaning of this key. */
static void write_tick_title(pen *p, const layer_source *in, const char *title)
{
    const char key = in->tick->key;
    const int y = p->y, line = p->scene->text.height;
    char text[SCENE_TEXT] = "";
    if (key && (is_player_moved_by_keys(in) || key == 'n'))
        snprintf(text, sizeof text, "%c %s", key, get_key_meaning(key));
    if (p->rows) {
        write_title_text(p, ROLE_TEXT, title);
        if (*text)
            write_row(p, "key", "", "%s", text);
        return;
    }
    write_title(p, title, strlen(text));
    if (*text) {
        write_right_aligned(p, ROLE_FAINT, "key");
        p->y += line;
        write_right_aligned(p, ROLE_TEXT, text);
    }
    p->y = y + 2 * line + line / 2;
}

/* ---- What the view leaves out ------------------------------------------------------------------------------- */

static void write_filter(pen *p, const view_filter *f)
{
    char at[NUMBER_TEXT];
    if (f->slice)
        write_row(p, "slice", "", "%c = %s", f->slice, number_format(f->slice_at, 9, at));
    if (f->by_depth && f->min_depth == f->max_depth)
        write_row(p, "depth", "", "%u alone", f->min_depth);
    else if (f->by_depth)
        write_row(p, "depths", "", "%u to %u", f->min_depth, f->max_depth);
    if (f->leaves)
        write_row(p, "only", "", "leaves");
    if (f->by_region)
        write_box_rows(p, "region", &f->region);
}

static void write_budget(pen *p, const scene_tally *tally)
{
    const bool nodes = tally->beyond > 0, points = tally->thinned > 0;
    if (nodes && tally->deepest < 0)
        write_row(p, "budget", "", "no nodes");
    else if (nodes)
        write_row(p, "budget", "", "nodes to depth %d", tally->deepest);
    if (points)
        write_row(p, nodes ? "" : "budget", "", "1 point in %" PRIu64, tally->one_in);
    if (tally->arrows.thinned)
        write_row(p, "arrows", "", "1 in %" PRIu64, tally->arrows.one_in);
}

static void write_folded_depths(pen *p, const scene_tally *tally)
{
    if (tally->folded && tally->folded_from == tally->folded_to)
        write_row(p, "drawn as bars", "", "depth %u", tally->folded_from);
    else if (tally->folded)
        write_row(p, "drawn as bars", "", "depths %u to %u", tally->folded_from, tally->folded_to);
}

/* For each kind of element, write a row with the number of elements that are left out because they are smaller than the
 * view's lod, unless the number is 0. */
static void write_small_counts(pen *p, const scene_tally *tally)
{
    const size_t counts[] = {tally->small, tally->small_marked, tally->arrows.small};
    static const char *const words[][2] = {{"node", "nodes"}, {"marked node", "marked nodes"}, {"arrow", "arrows"}};
    char lod[NUMBER_TEXT], name[SCENE_TEXT];
    snprintf(name, sizeof name, "under %s px", number_format(p->scene->view.lod, 3, lod));
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        if (!counts[i])
            continue;
        write_row(p, name, "", "%zu %s", counts[i], words[i][counts[i] != 1]);
        name[0] = 0;
    }
}

/* If the view leaves out nodes or points, write the numbers of shown nodes and points. */
static void write_shown_counts(pen *p, const scene_tally *tally)
{
    const view *v = &p->scene->view;
    if (!filter_is_set(&v->filter) && !tally->small && !tally->beyond && !tally->thinned)
        return;
    write_filter(p, &v->filter);
    if (view_shows_layer(v, LAYER_NODES))
        write_row(p, "shown", "", "%zu node%s", tally->nodes, plural_ending(tally->nodes));
    if (view_shows_layer(v, LAYER_POINTS))
        write_row(p, view_shows_layer(v, LAYER_NODES) ? "" : "shown", "", "%zu point%s", tally->points,
                  plural_ending(tally->points));
}

/* Write a row for each rule of the view that leaves out or folds elements, and rows with the numbers of shown elements.
 * If there is no such row, also omit the thin line above the rows. */
static void write_view_limits(pen *p)
{
    const scene_tally *tally = &p->scene->tally;
    const int before = p->y;
    if (p->rows)
        write_separator_line(p);
    else
        write_gap(p);
    const int begin = p->y;
    p->value = ROLE_WARNING;
    write_folded_depths(p, tally);
    p->value = ROLE_TEXT;
    write_shown_counts(p, tally);
    write_small_counts(p, tally);
    p->value = ROLE_WARNING;
    write_budget(p, tally);
    p->value = ROLE_TEXT;
    if (p->scene->view.labels && tally->labels < tally->nodes)
        write_row(p, "labels", "", "%zu of %zu fit", tally->labels, tally->nodes);
    const int end = p->y;
    p->y = before;
    if (!p->rows && end != begin) {
        write_separator_line(p);
        p->y = end;
    }
}

/* ---- The column --------------------------------------------------------------------------------------------- */

/* Remove the thin lines between rows of the column whose y is at least `from` pixels. */
static void remove_separators_below(scene *s, int from)
{
    size_t kept = 0;
    for (size_t i = 0; i < s->panels.count; i++)
        if (s->panels.items[i].style.layer != LAYER_TEXT || s->panels.items[i].y < from)
            s->panels.items[kept++] = s->panels.items[i];
    s->panels.count = kept;
}

/* If not all rows fit into the picture, replace the last rows by a line that counts them. */
static void replace_rows_beyond_panel(pen *p)
{
    scene *s = p->scene;
    const int last = s->view.height - s->text.height; /* the greatest y at which a row may begin, in pixels */
    const int line = s->text.line;
    size_t kept = 0, rows = 0;
    double at = -1, first = 0;
    if (p->rows || p->y - line <= last)
        return;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label label = s->labels.items[i];
        if (label.style.layer != LAYER_TEXT || label.at[1] <= last - line) {
            s->labels.items[kept++] = label;
            continue;
        }
        first = rows ? first : label.at[1];
        rows += label.at[1] != at;
        at = label.at[1];
    }
    s->labels.count = kept;
    p->y = (int)first < last ? (int)first : last;
    remove_separators_below(s, p->y);
    write_text(p, 0, ROLE_WARNING, "and %zu more", rows);
    p->y += line;
}

/* If the session has a player, write the player's rows. If the player is missing at this tick, leave its rows empty, so
 * that the rows below stay where they are. */
static void write_player(pen *p, const layer_source *in)
{
    const int end = p->y + 3 * p->text.line;
    if (in->session->player.kind == OCTREE_PLAYER_NONE && !in->tick->has_player)
        return;
    if (in->tick->has_player)
        write_position(p, "player", in->tick->player, count_player_decimals(in));
    else
        write_row(p, "player", "", "away");
    p->y = end;
    if (in->tick->swept)
        write_row(p, "box tested", "", "the whole path");
    write_separator_line(p);
}

static void write_tick_rows(pen *p, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    write_events(p, in);
    write_keys(p, in);
    write_separator_line(p);
    write_player(p, in);
    write_statistics(p, in, &tick->stats);
    write_view_limits(p);
    if (tick->hit_count || tick->pair_count || tick->foreign_pairs.wrong || in->answer_count || tick->refusal_count)
        write_separator_line(p);
    if (tick->hit_count)
        write_ids(p, "box hits", tick->hits, tick->hit_count);
    if (tick->pair_count)
        write_row(p, "overlaps", "", "%zu pair%s", tick->pair_count, plural_ending(tick->pair_count));
    write_wrong_answers(p, in);
    write_wrong_pairs(p, in);
    write_wrong_nodes(p, in);
    write_answers(p, in);
    write_refusals(p, tick);
}

static void write_tree_rows(pen *p, const layer_source *in)
{
    octree_stats stats;
    octree_statistics(in->tree, &stats);
    write_statistics(p, in, &stats);
    write_view_limits(p);
    write_separator_line(p);
    write_box_rows(p, "world", &in->world);
    if (in->answer_count)
        write_separator_line(p);
    write_answers(p, in);
}

/* Write only the most important lines, on top of a picture that has no room for the column. */
static void add_corner_lines(scene *s, const layer_source *in, const char *title)
{
    pen p = make_corner_pen(s);
    if (in->tick) {
        write_line(&p, ROLE_TEXT, title);
        write_events(&p, in);
        write_wrong_answers(&p, in);
        write_wrong_pairs(&p, in);
        write_wrong_nodes(&p, in);
    }
    write_view_limits(&p);
    write_broken_node(&p, in);
    replace_rows_beyond_panel(&p);
}

/* Write the caption on a strip below the scene or, for a page, as a row. */
static void add_caption(pen *p, const layer_source *in)
{
    char text[CAPTION_TEXT];
    const scene *s = p->scene;
    const int column = layout_panel_width(&s->view), height = layout_caption_height(&s->view);
    const int x = column - p->left, y = s->view.height - height - p->y;
    if (!p->rows && height == 0)
        return;
    caption_write(in, text);
    make_printable(text);
    if (!p->rows)
        fill_rectangle(p, x, y, s->view.width - column, height, ROLE_PANEL);
    pen strip = *p;
    strip.left = column + LAYOUT_MARGIN * s->text.width;
    strip.y = p->y + y + (height - s->text.height) / 2;
    strip.letters = (s->view.width - column) / s->text.width - 2 * LAYOUT_MARGIN;
    write_caption(&strip, text);
    p->next_id = strip.next_id;
}

static void add_column(scene *s, const layer_source *in, const char *title)
{
    pen p = make_column_pen(s);
    if (!p.rows)
        fill_rectangle(&p, -p.left, -p.y, layout_panel_width(&s->view), s->view.height, ROLE_PANEL);
    if (in->tick) {
        write_tick_title(&p, in, title);
        write_tick_rows(&p, in);
    } else {
        p.y += write_title(&p, title, 0) + s->text.height / 2;
        write_separator_line(&p);
        write_tree_rows(&p, in);
    }
    write_broken_node(&p, in);
    replace_rows_beyond_panel(&p);
    write_legend(&p, in);
    add_caption(&p, in);
}

static void add_panel(scene *s, const layer_source *in, view_layer layer)
{
    (void)layer;
    char title[SCENE_TEXT];
    if (in->tick)
        snprintf(title, sizeof title, "tick %" PRIu64, in->tick->number);
    else
        snprintf(title, sizeof title, "%s", in->title);
    make_printable(title);
    if (s->view.text_apart && !s->rows)
        return;
    if (!s->view.text_apart && layout_panel_width(&s->view) == 0)
        add_corner_lines(s, in, title);
    else
        add_column(s, in, title);
}

static void describe_panel_element(description *d, const described_element *element)
{
    if (element->kind == SCENE_PANEL)
        append_text(d, element->style.role == ROLE_PANEL ? "the background of the panel"
                                                         : "a symbol or a rule in the panel");
}

const layer_type layer_TEXT = {.add = add_panel, .describe = describe_panel_element};
