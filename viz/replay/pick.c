/* SPDX-License-Identifier: MIT */
/* pick.c - finds what is drawn at a pixel of a frame, and prints it as text or JSON.
 *
 * The problem: a PNG contains only colours, and many elements have the same colour, so a pixel does not identify its
 * element.
 *
 * The idea: the recording is replayed to the frame's tick, and the scene is composed again. The digest in the PNG
 * proves that this is the scene of the frame. The renderer draws the scene once more and reports every element that
 * covers a sample of the pixel. Elements are drawn from back to front, so the last reported element is on top. If no
 * element covers the pixel, the whole picture is drawn with element numbers in place of colours, and the nearest pixel
 * with a number is chosen. That needs four bytes for each sample of the picture, so it is done only in this case. Cost:
 * one replay to the tick and one or two drawings. */
#include "pick.h"
#include "frame_file.h"
#include "foreign_nodes.h"
#include "layer.h"
#include "json_write.h"
#include "octree/octree.h"
#include "replay.h"
#include "png_read.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The frame and its recording ---------------------------------------------------------------------------- */

/* Read the frame and check that the pixel lies inside it. */
static bool read_frame_and_check_pixel(pick *p, image *frame, octreel_error *error)
{
    if (!image_read_png(p->path, frame, error))
        return false;
    p->width = frame->width;
    p->height = frame->height;
    return (p->asked[0] >= 0 && p->asked[1] >= 0 && p->asked[0] < p->width && p->asked[1] < p->height) ||
           error_set(error, "%s: pixel (%d, %d) is outside the picture, which has %d x %d pixels", p->path, p->asked[0],
                     p->asked[1], p->width, p->height);
}

static bool check_recording_beside(const pick *p, const char *folder, octreel_error *error)
{
    static const char *const needed[] = {"recording.json", "session.json"};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (!folder_contains(folder, needed[i]))
            return error_set(error,
                             "%s: not a frame of a recording: its folder has no %s; give the frame in the folder that "
                             "octreel record wrote",
                             p->path, needed[i]);
    return true;
}

/* Replay to the frame's tick and compose the scene of this tick. Check that the digest of the scene equals the scene
 * digest in the frame. */
static bool compose_scene_again(pick *p, replay *r, octreel_error *error)
{
    r->playback.history.changes.tracked = true;
    if (p->tick >= r->ticks)
        return error_set(error, "%s: shows tick %" PRIu64 ", but the session in its folder ends with tick %" PRIu64,
                         p->path, p->tick, r->ticks - 1);
    if (!replay_play_up_to(r, p->tick, error) || !playback_compose_scene(&r->playback, error))
        return false;
    frame_origin origin = {.tick = p->tick, .session = r->session_digest, .scene = scene_digest(&r->playback.scene)};
    return frame_check_file(p->path, &origin, error);
}

/* ---- The pixel ---------------------------------------------------------------------------------------------- */

/* True if an element covers one of the samples of the pixel (x, y). `numbers` has the element number of each sample of
 * the picture; 0: no element. A pixel has `samples` x `samples` samples. */
static bool is_pixel_drawn(const uint32_t *numbers, size_t samples, size_t width, int x, int y)
{
    bool drawn = false;
    for (size_t i = 0; i < samples * samples; i++)
        drawn |=
            numbers[((size_t)y * samples + i / samples) * width * samples + (size_t)x * samples + i % samples] != 0;
    return drawn;
}

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* Find the drawn pixel that is nearest to the requested pixel. If several pixels are at the same distance, the first
 * one in row order is taken. */
static void find_nearest_drawn_pixel(pick *p, const uint32_t *numbers, size_t samples)
{
    const int left = clamp(p->asked[0] - p->radius, 0, p->width), top = clamp(p->asked[1] - p->radius, 0, p->height);
    const int right = clamp(p->asked[0] + p->radius + 1, 0, p->width);
    const int bottom = clamp(p->asked[1] + p->radius + 1, 0, p->height);
    int64_t best = (int64_t)p->radius * p->radius + 1;
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            const int64_t dx = x - p->asked[0], dy = y - p->asked[1], square = dx * dx + dy * dy;
            if (square >= best || !is_pixel_drawn(numbers, samples, (size_t)p->width, x, y))
                continue;
            best = square;
            p->pixel[0] = x;
            p->pixel[1] = y;
        }
    }
}

static bool move_to_nearest_drawn_pixel(pick *p, renderer *r, const scene *s, octreel_error *error)
{
    const size_t samples = (size_t)s->view.aa;
    uint32_t *numbers = malloc((size_t)p->width * (size_t)p->height * samples * samples * sizeof *numbers);
    bool ok = numbers || error_no_memory(error);
    ok = ok && renderer_find_element_numbers(r, s, numbers, error);
    if (ok)
        find_nearest_drawn_pixel(p, numbers, samples);
    free(numbers);
    return ok;
}

static void copy_foreign_node(pick_element *e)
{
    if (!e->subject.foreign)
        return;
    e->place = *e->subject.foreign;
    e->node = *e->place.node;
    e->place.node = &e->node;
    e->subject.foreign = &e->place;
}

/* True if an earlier element of the pick, which is drawn above, already explains this node. */
static bool is_node_explained(const pick *p, octree_address node)
{
    for (size_t i = 0; i < p->count; i++)
        if (p->elements[i].explained && p->elements[i].subject.node.address == node)
            return true;
    return false;
}

/* Explain the node that the element shows. Does nothing if the element shows no node, or a node that cannot be
 * explained. */
static bool explain_node(const pick *p, pick_element *e, const playback *from, octreel_error *error)
{
    text_stream s;
    const octree_node *node = &e->subject.node;
    if (!e->subject.has_node || e->subject.gone || !has_node_reason(from->game, node) ||
        is_node_explained(p, node->address))
        return true;
    const bool found = node_reason_find(&e->reason, from->game, &from->history.changes, node);
    if (text_stream_begin(&s)) {
        fputs(e->subject.text, s.stream);
        node_reason_print(s.stream, &e->reason);
    }
    return (text_stream_end(&s, &e->explained) && found) || error_no_memory(error);
}

static bool list_elements_at_pixel(pick *p, renderer *r, const playback *from, octreel_error *error)
{
    const scene *s = &from->scene;
    draw_covers touches = {0};
    bool ok = renderer_list_pixel_covers(r, s, p->pixel[0], p->pixel[1], &touches, error);
    p->elements = ok && touches.count ? calloc(touches.count, sizeof *p->elements) : NULL;
    ok = ok && (p->elements || touches.count == 0 || error_no_memory(error));
    for (size_t i = 0; ok && i < touches.count; i++) {
        const scene_element element = scene_element_at(s, touches.items[i].number);
        p->elements[p->count] = (pick_element){
            .touch = touches.items[i],
            .kind = element.kind,
            .in_closeup = element.in_closeup,
            .layer = layer_rows[scene_element_head(s, element).style.layer].name,
            .subject = describe_element(from->game, &from->history.heat, s, element),
        };
        copy_foreign_node(&p->elements[p->count]);
        ok = explain_node(p, &p->elements[p->count], from, error);
        p->count++;
    }
    draw_covers_release(&touches);
    return ok;
}

bool pick_scene(pick *p, const playback *from, renderer *r, octreel_error *error)
{
    const int samples = from->view.aa;
    p->samples = samples * samples;
    if (!list_elements_at_pixel(p, r, from, error))
        return false;
    if (p->count || p->radius == 0)
        return true;
    return move_to_nearest_drawn_pixel(p, r, &from->scene, error) && list_elements_at_pixel(p, r, from, error);
}

static bool pick_pixel(pick *p, replay *from, const pick_options *options, octreel_error *error)
{
    renderer *r = replay_renderer(from, &options->renderer, error);
    return r && pick_scene(p, &from->playback, r, error);
}

bool pick_frame(const char *path, const pick_options *options, pick *found, octreel_error *error)
{
    *found = (pick){
        .path = path, .asked = {options->x, options->y}, .pixel = {options->x, options->y}, .radius = options->radius};
    replay r = {.ticks = 0};
    image frame = {0};
    char *folder = path_parent_folder(path);
    const bool ok = (folder || error_no_memory(error)) && read_frame_and_check_pixel(found, &frame, error) &&
                    frame_read_tick(path, &found->tick, error) && check_recording_beside(found, folder, error) &&
                    replay_open(&r, folder, options->max_ticks, error) && compose_scene_again(found, &r, error) &&
                    pick_pixel(found, &r, options, error);
    if (ok)
        found->color = image_color_at(&frame, found->pixel[0], found->pixel[1]);
    replay_close(&r);
    image_release(&frame);
    free(folder);
    if (!ok)
        pick_release(found);
    return ok;
}

void pick_release(pick *p)
{
    for (size_t i = 0; i < p->count; i++) {
        node_reason_release(&p->elements[i].reason);
        free(p->elements[i].explained);
    }
    free(p->elements);
    *p = (pick){0};
}

#define COLOR_TEXT 8

static char *format_color(const pick *p, char text[COLOR_TEXT])
{
    snprintf(text, COLOR_TEXT, "#%02x%02x%02x", p->color.r, p->color.g, p->color.b);
    return text;
}

static double distance_from_asked_pixel(const pick *p)
{
    const double dx = p->pixel[0] - p->asked[0], dy = p->pixel[1] - p->asked[1];
    return sqrt(dx * dx + dy * dy);
}

/* True if the pixel lies between two dashes of a dashed line. The renderer reports such a pixel as painted, but without
 * a colour. */
static bool is_in_gap_of_dashed_line(const pick_element *e)
{
    return e->touch.painted > 0 && e->touch.color == 0 && e->kind != SCENE_PANEL;
}

/* ---- Text --------------------------------------------------------------------------------------------------- */

static void print_heading(FILE *out, const pick *p)
{
    char color[COLOR_TEXT];
    write_escaped(out, p->path, escape_nothing);
    fprintf(out, ": tick %" PRIu64 ", pixel (%d, %d)", p->tick, p->asked[0], p->asked[1]);
    if (p->count == 0)
        fprintf(out, ": nothing is drawn there, nor within %d pixel%s\n", p->radius,
                plural_ending((uint64_t)p->radius));
    else if (distance_from_asked_pixel(p) > 0)
        fprintf(out, ": nothing is drawn there; %.1f pixels away, at (%d, %d), %s:\n", distance_from_asked_pixel(p),
                p->pixel[0], p->pixel[1], format_color(p, color));
    else
        fprintf(out, ", %s:\n", format_color(p, color));
}

static const char *element_text(const pick_element *e)
{
    return e->explained ? e->explained : e->subject.text;
}

static const char *closeup_words(const pick_element *e)
{
    return e->in_closeup ? " (in the close-up)" : "";
}

/* Print one element of the pixel: whether it is visible, is covered by another element, or coincides with the element
 * before it, in an edge or in the whole pixel. */
static void print_element(FILE *out, const pick *p, const pick_element *e)
{
    if (e->touch.painted == 0) {
        fprintf(out, "      %s %s%s\n",
                e->kind == SCENE_BOX ? "it shares this edge with" : "on the same pixel:", element_text(e),
                closeup_words(e));
        return;
    }
    fputs(e->touch.shown ? "  " : "    over ", out);
    if (e->touch.shown && p->samples > 1)
        fprintf(out, "%d of %d samples: ", e->touch.shown, p->samples);
    fprintf(out, "%s%s%s\n", element_text(e), is_in_gap_of_dashed_line(e) ? " (in a gap of its dashed line)" : "",
            closeup_words(e));
}

static void print_text(FILE *out, const pick *p)
{
    print_heading(out, p);
    for (size_t i = 0; i < p->count; i++)
        print_element(out, p, &p->elements[i]);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_pair(json_writer *w, const char *key, const int pair[2])
{
    json_begin_array_member(w, key);
    json_write_integer(w, (uint64_t)pair[0]);
    json_write_integer(w, (uint64_t)pair[1]);
    json_write_end_array(w);
}

static void write_node(json_writer *w, const pick_element *e)
{
    char path[OCTREE_ADDRESS_TEXT];
    const element_subject *subject = &e->subject;
    const octree_node *node = &subject->node;
    json_begin_object_member(w, "node");
    json_write_text_member(w, "path", octree_address_format(node->address, path));
    json_write_integer_member(w, "depth", node->depth);
    if (!subject->gone) {
        json_write_bool_member(w, "leaf", node->leaf);
        json_write_integer_member(w, "points", node->count);
    }
    json_write_box_member(w, "box", &node->box);
    if (e->explained)
        node_reason_write(w, &e->reason);
    json_write_end_object(w);
}

/* Write a node of the foreign index as a JSON object. */
static void write_foreign_node(json_writer *w, const octree_foreign_place *place)
{
    const octree_foreign_node *node = place->node;
    json_begin_object_member(w, "foreign_node");
    json_write_integer_member(w, "id", node->id);
    if (node->has_parent)
        json_write_integer_member(w, "parent", node->parent);
    if (node->kind[0])
        json_write_text_member(w, "kind", node->kind);
    json_write_integer_member(w, "depth", place->depth);
    json_write_bool_member(w, "leaf", place->leaf);
    json_write_integer_member(w, "points", place->points);
    json_write_box_member(w, "box", &node->box);
    json_begin_array_member(w, "wrong");
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        if (place->wrong >> kind & 1)
            json_write_string(w, octree_wrong_node_name((octree_wrong_node_kind)kind));
    json_write_end_array(w);
    json_write_end_object(w);
}

static void write_point(json_writer *w, const octree_point *point)
{
    json_begin_object_member(w, "point");
    json_write_integer_member(w, "id", point->id);
    json_write_vector_member(w, "position", point->position);
    json_write_end_object(w);
}

static void write_subject(json_writer *w, const pick_element *e)
{
    if (e->subject.has_node)
        write_node(w, e);
    if (e->subject.foreign)
        write_foreign_node(w, e->subject.foreign);
    if (e->subject.has_point)
        write_point(w, &e->subject.point);
    if (e->subject.query)
        json_write_integer_member(w, "query", e->subject.query);
    json_write_text_member(w, "text", element_text(e));
}

static void write_element(json_writer *w, const pick_element *e)
{
    json_write_begin_object(w);
    json_write_text_member(w, "kind", scene_kind_name(e->kind));
    json_write_text_member(w, "layer", e->layer);
    json_write_integer_member(w, "shown", (uint64_t)e->touch.shown);
    json_write_integer_member(w, "painted", (uint64_t)e->touch.painted);
    if (is_in_gap_of_dashed_line(e))
        json_write_bool_member(w, "gap", true);
    if (e->in_closeup)
        json_write_bool_member(w, "closeup", true);
    write_subject(w, e);
    json_write_end_object(w);
}

void pick_print_json(FILE *out, const pick *p)
{
    json_writer writer = {.out = out}, *w = &writer;
    char color[COLOR_TEXT];
    json_write_begin_object(w);
    json_write_text_member(w, "frame", p->path);
    json_write_integer_member(w, "tick", p->tick);
    write_pair(w, "size", (const int[]){p->width, p->height});
    write_pair(w, "asked", p->asked);
    json_write_integer_member(w, "radius", (uint64_t)p->radius);
    if (p->count) {
        write_pair(w, "pixel", p->pixel);
    } else {
        json_write_key(w, "pixel");
        json_write_null(w);
    }
    json_write_text_member(w, "color", format_color(p, color));
    json_write_integer_member(w, "samples", (uint64_t)p->samples);
    json_begin_array_member(w, "elements");
    for (size_t i = 0; i < p->count; i++)
        write_element(w, &p->elements[i]);
    json_write_end_array(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

void pick_print(FILE *out, const pick *p, bool json)
{
    (json ? pick_print_json : print_text)(out, p);
}

/* ---- An element by its name ---------------------------------------------------------------------------------- */

/* If the name begins with `word` and a blank, returns the text after the blank. Otherwise returns null. */
static const char *skip_word(const char *name, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(name, word, length) == 0 && name[length] == ' ' ? name + length + 1 : NULL;
}

static bool parse_id(const char *text, uint64_t *id)
{
    char *end;
    *id = text ? strtoull(text, &end, 10) : 0;
    return text && *text >= '0' && *text <= '9' && *end == 0;
}

/* Describe the element that has this name. If the tick has no such element, *subject stays empty. */
static void describe_named(element_subject *subject, const char *name, const playback *from)
{
    description d = {from->game, octree_game_tick(from->game), &from->history.heat, subject, 0};
    const char *node = skip_word(name, "node");
    octree_address address;
    octree_point point;
    uint64_t id;
    if (node && octree_address_parse(node, &address))
        describe_node(&d, "", address);
    else if (parse_id(skip_word(name, "foreign"), &id) && id < OCTREE_NODE_ID_LIMIT)
        describe_node(&d, "", foreign_element_id(id));
    else if (parse_id(skip_word(name, "point"), &id) && octree_game_find(from->game, id, &point))
        describe_point(&d, "", id, point.position);
}

/* Write the children of an inner node, or the first ids of a leaf. */
static void write_contents(json_writer *w, const octree_node *node)
{
    char path[OCTREE_ADDRESS_TEXT];
    json_begin_array_member(w, node->leaf ? "holds" : "children");
    for (size_t i = 0; node->leaf && node->points && i < node->count && i < PICK_HELD; i++)
        json_write_integer(w, node->points[i].id);
    for (unsigned octant = 0; !node->leaf && octant < 8; octant++)
        if (node->octants >> octant & 1)
            json_write_string(w, octree_address_format(node->address << 3 | octant, path));
    json_write_end_array(w);
}

/* Write the address of the leaf in which a point lies. Cost: O(depth). */
static void write_leaf_address(json_writer *w, const octree *tree, const double at[3])
{
    const octree_box world = octree_definition(tree).world;
    char path[OCTREE_ADDRESS_TEXT];
    octree_node node = {.leaf = true};
    octree_address address = OCTREE_ROOT;
    while (octree_node_at(tree, address, &node) == OCTREE_OK && !node.leaf) {
        /* the lower corner of the last octant is the centre of the node */
        const octree_box last = octree_cell_box(&world, address << 3 | 7);
        address = address << 3 | (at[0] >= last.min[0] ? 4u : 0u) | (at[1] >= last.min[1] ? 2u : 0u) |
                  (at[2] >= last.min[2] ? 1u : 0u);
    }
    json_write_text_member(w, "leaf", octree_address_format(address, path));
}

static void write_point_values(json_writer *w, const point_value *value)
{
    char color[COLOR_TEXT];
    if (value->has[POINT_COLOR]) {
        snprintf(color, sizeof color, "#%02x%02x%02x", value->color[0], value->color[1], value->color[2]);
        json_write_text_member(w, "color", color);
    }
    if (value->has[POINT_INTENSITY])
        json_write_number_member(w, "intensity", (double)value->intensity);
    if (value->has[POINT_CLASS])
        json_write_integer_member(w, "class", value->class);
}

bool pick_print_named(FILE *out, const char *name, const playback *from, octreel_error *error)
{
    json_writer writer = {.out = out}, *w = &writer;
    pick_element e = {.kind = SCENE_BOX};
    const pick none = {0};
    describe_named(&e.subject, name, from);
    if (!e.subject.has_node && !e.subject.foreign && !e.subject.has_point)
        return error_set(error, "this tick has no %s", name);
    const bool ok = explain_node(&none, &e, from, error);
    if (ok) {
        json_write_begin_object(w);
        write_subject(w, &e);
        if (e.subject.has_node && !e.subject.gone)
            write_contents(w, &e.subject.node);
        if (e.subject.has_point) {
            const point_value value = point_values_get(from->values, e.subject.point.id);
            write_leaf_address(w, octree_game_tree(from->game), e.subject.point.position);
            write_point_values(w, &value);
        }
        json_write_end_object(w);
    }
    node_reason_release(&e.reason);
    free(e.explained);
    return ok;
}
