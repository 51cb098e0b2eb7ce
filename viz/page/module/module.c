/* SPDX-License-Identifier: MIT */
/* module.c - the functions that a page calls in WebAssembly. They play one session at a time and draw its ticks.
 *
 * The page runs octreel's own code, so it needs no recorded frames and can show any view of any tick. This file is the
 * border between C and viewer/engine.js.
 *
 * Input: JavaScript calls web_reserve_buffer() to get a buffer, writes texts or numbers into the buffer, and passes
 * their sizes to the next call. Output: a function that returns bool stores its text, or its error if it returns false,
 * in web_text() until the next call. Numbers are returned as double, because 64-bit integers are inconvenient in
 * JavaScript. web_draw() returns the address of the pixels. Every function named web_* is exported.
 *
 * The pixels are the same as those of the PNG frames, because the same code makes them. Scenes use double arithmetic in
 * a fixed order without FMA, which WebAssembly defines bit for bit, and the integer rasterizer fills them without a
 * GPU. All state is in linear memory. A copy of its first web_used() bytes is therefore a state of the game; the page
 * returns to this state by copying the bytes back. */
#include "choices.h"
#include "describe.h"
#include "layer.h"
#include "octree/octree.h"
#include "pick.h"
#include "playback.h"
#include "point_block.h"
#include "recording_file.h"
#include "renderer.h"
#include "rgba.h"
#include "session_file.h"
#include "text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct web {
    session_file session;
    point_block points; /* the title and the marked node of a cloud; the session owns the points and the values */
    tree_subject cloud;
    playback playback;
    bool open, drawn;       /* true: the playback is open; true: the current tick is drawn */
    bool has_fitted_scale;  /* true: the point scale was fitted to the points, not given in the view */
    int size[2];            /* width and height of the view, which are those of its recording, in pixels */
    unsigned summed_layers; /* the heat layers whose sums over all ticks are collected, as bits of view_layer */
    char *room, *text;      /* the input buffer; the output text, null if the output is the error */
    size_t room_size, text_size;
    uint32_t *rgba; /* the picture, 4 bytes per pixel: R, G, B, A */
    octreel_error error;
} web;

static web page;

/* ---- Texts -------------------------------------------------------------------------------------------------- */

/* Returns the input buffer for the next call, with room for at least `size` + 1 bytes. Returns null if memory runs out.
 */
char *web_reserve_buffer(size_t size)
{
    if (size + 1 > page.room_size) {
        free(page.room);
        page.room = malloc(size + 1);
        page.room_size = page.room ? size + 1 : 0;
    }
    return page.room;
}

const char *web_text(void)
{
    return page.text ? page.text : page.error.text;
}

size_t web_text_size(void)
{
    return page.text ? page.text_size : strlen(page.error.text);
}

static void clear_text(void)
{
    free(page.text);
    page.text = NULL;
}

/* Make the current error the text that web_text() returns. Returns false. */
static bool report_error_text(void)
{
    clear_text();
    return false;
}

/* Make the output of `write` the text that web_text() returns. Returns false if `write` fails or memory runs out;
 * web_text() then returns the error. */
static bool set_text(bool (*write)(FILE *out))
{
    text_stream s;
    clear_text();
    const bool written = text_stream_begin(&s) && write(s.stream);
    if (text_stream_end(&s, &page.text) && written) {
        page.text_size = s.size;
        return true;
    }
    if (written)
        error_no_memory(&page.error);
    return report_error_text();
}

/* ---- The session -------------------------------------------------------------------------------------------- */

static void close_picture(void)
{
    picture_close(&page.playback.picture);
    free(page.rgba);
    page.rgba = NULL;
}

static void close_game_and_picture(void)
{
    close_picture();
    if (page.open)
        playback_close(&page.playback);
    session_release(&page.session);
    page.open = page.drawn = page.has_fitted_scale = false;
}

/* Replace the points and values of the session with those of a block. */
static bool set_session_points(const char *block, size_t size)
{
    session_file *s = &page.session;
    if (!point_block_read(block, size, &page.points, &page.error))
        return false;
    free((octree_game_body *)s->session.bodies);
    point_values_release(&s->values);
    s->session.bodies = page.points.bodies;
    s->session.body_count = page.points.count;
    s->values = page.points.values;
    page.cloud = (tree_subject){.title = page.points.title, .node = page.points.node};
    return true;
}

/* Open a session and play its tick 0. The input buffer holds `session` bytes of a session.json, followed by `recording`
 * bytes of a recording.json and `points` bytes of a block of points (point_block.h), 0 if session.json has the points.
 * `cloud` is true if the session shows a point cloud. A session that is already open is closed first. */
bool web_open(size_t session, size_t recording, size_t points, bool cloud)
{
    view v;
    uint64_t every;
    close_game_and_picture();
    if (!recording_parse("the view", page.room + session, recording, &v, &every, &page.error) ||
        !session_parse("the session", "", page.room, session, &page.session, &page.error) ||
        (points > 0 && !set_session_points(page.room + session + recording, points)))
        return report_error_text();
    free(page.room);
    page.room = NULL;
    page.room_size = 0;
    page.size[0] = v.width;
    page.size[1] = v.height;
    page.summed_layers = v.layers & VIEW_HEAT_LAYERS ? VIEW_HEAT_LAYERS : 0;
    page.open = playback_open(&page.playback, &page.session.session, &page.session.values, &v, &page.error);
    page.playback.history.changes.tracked = page.open;
    page.playback.cloud = cloud ? &page.cloud : NULL;
    if (!page.open)
        close_game_and_picture();
    return page.open || report_error_text();
}

/* Give a view the size of the recording, and put the column of text into the picture. */
static void set_recorded_size(view *v)
{
    v->width = page.size[0];
    v->height = page.size[1];
    v->suited_height = 0;
    v->text_apart = false;
}

/* Play the next tick. `key` is the player's key press. If `key` is 0, the tick has the key press, edits and queries
 * that the session has for it. */
bool web_step(int key)
{
    const octree_input input = {.key = (char)key};
    playback *p = &page.playback;
    const view drawn = p->view;
    page.drawn = false;
    /* A tick's history depends on the view: play every tick with the view of the recording. */
    set_recorded_size(&p->view);
    p->view.layers |= page.summed_layers;
    const bool done = key ? playback_play_input(p, &input, &page.error) : playback_advance(p, &page.error);
    p->view = drawn;
    return done || report_error_text();
}

double web_tick(void)
{
    return (double)octree_game_tick(page.playback.game)->number;
}

/* Returns the number of the session's ticks, without tick 0. */
double web_length(void)
{
    return (double)octree_session_length(&page.session.session);
}

/* Returns the world of the session as six doubles: the minimum corner, then the maximum corner. */
const double *web_world(void)
{
    return page.session.session.tree.world.min;
}

static bool write_facts(FILE *out)
{
    tick_write(out, octree_game_tick(page.playback.game), &(tick_extras){0});
    return true;
}

/* Make web_text() return the line of ticks.jsonl for the current tick, without the members about a frame. */
bool web_facts(void)
{
    return set_text(write_facts);
}

/* ---- The picture -------------------------------------------------------------------------------------------- */

/* Fit a view to the points of tick 0, as opening the session does. */
static bool fit_to_start(view *v)
{
    octree_game *start;
    const octree_status status = octree_game_create(&page.session.session, &start);
    if (status != OCTREE_OK)
        return error_set(&page.error, "%s", octree_status_text(status));
    const bool fitted = picture_fit_view(v, octree_game_tree(start), &page.session.values, &page.error);
    octree_game_destroy(start);
    return fitted;
}

/* Fit a view. Fitting a point scale is slow, and dragging changes the view at every frame. The fitted scale is
 * therefore kept as long as the filter and the colouring of points stay the same. */
static bool fit_view(view *v)
{
    const view *now = &page.playback.view;
    const bool scales = view_paints_points(v) && !v->point_scale.given;
    if (scales && page.has_fitted_scale && v->point_color == now->point_color &&
        memcmp(&v->filter, &now->filter, sizeof v->filter) == 0)
        v->point_scale = now->point_scale;
    page.has_fitted_scale = scales;
    if (scales && !v->point_scale.given && web_tick() > 0)
        return fit_to_start(v);
    return picture_fit_view(v, octree_game_tree(page.playback.game), &page.session.values, &page.error);
}

/* Set the view. The input buffer holds `recording` bytes of a recording.json with the view. The picture keeps its size
 * until the next drawing. */
bool web_view(size_t recording)
{
    view v, *now = &page.playback.view;
    uint64_t every;
    if (!recording_parse("the view", page.room, recording, &v, &every, &page.error) || !fit_view(&v))
        return report_error_text();
    page.size[0] = v.width;
    page.size[1] = v.height;
    v.width = now->width;
    v.height = now->height;
    v.suited_height = now->suited_height;
    v.text_apart = now->text_apart;
    if (v.aa != now->aa || view_is_rgb(&v) != view_is_rgb(now))
        close_picture();
    *now = v;
    page.drawn = false;
    return true;
}

/* Returns true if the view shows a heat layer whose sums have not been collected from tick 0 on. The page must then
 * open the session again with this view. */
bool web_must_replay_for_heat(void)
{
    return page.playback.view.layers & VIEW_HEAT_LAYERS & ~page.summed_layers;
}

static bool open_picture(void)
{
    playback *p = &page.playback;
    const size_t pixels = (size_t)p->view.width * (size_t)p->view.height;
    if (!p->picture.renderer && !picture_open(&p->picture, &p->view, &(renderer_choice){0}, &page.error))
        return false;
    page.rgba = page.rgba ? page.rgba : malloc(4 * pixels);
    return page.rgba || error_no_memory(&page.error);
}

/* Compose the scene of the current tick, and write the rows of its text column if the view has its text apart. */
static bool compose_and_write_rows(FILE *out)
{
    playback *p = &page.playback;
    json_writer writer = {.out = out};
    json_write_begin_array(&writer);
    p->scene.rows = &writer;
    const bool composed = playback_compose_scene(p, &page.error);
    p->scene.rows = NULL;
    json_write_end_array(&writer);
    return composed;
}

/* Draw the current tick with the present size of the picture. Returns the pixels, or null on failure. */
static const uint32_t *draw_picture(void)
{
    playback *p = &page.playback;
    if (!open_picture() || !set_text(compose_and_write_rows) || !picture_draw(&p->picture, &p->scene, &page.error)) {
        report_error_text();
        return NULL;
    }
    rgba_convert(&p->picture.frame, page.rgba);
    page.drawn = true;
    return page.rgba;
}

static const uint32_t *draw_view(const view *v)
{
    view *now = &page.playback.view;
    if (v->width != now->width || v->height != now->height)
        close_picture();
    *now = *v;
    return draw_picture();
}

/* Draw the current tick as recorded. Returns the pixels row by row from the top, 4 bytes each: R, G, B, A. Returns null
 * on failure; web_text() then returns the error. */
const uint32_t *web_draw(void)
{
    view v = page.playback.view;
    set_recorded_size(&v);
    return draw_view(&v);
}

/* Draw the current tick with another size and without the column of text. Lines, markers and characters have the size
 * that suits a picture of height `suited_height`. web_text() then returns the rows of the column as a JSON array
 * (pen.h). */
const uint32_t *web_draw_at(int width, int height, int suited_height)
{
    view v = page.playback.view;
    v.width = width;
    v.height = height;
    v.suited_height = suited_height;
    v.text_apart = true;
    return draw_view(&v);
}

int web_width(void)
{
    return page.playback.view.width;
}

int web_height(void)
{
    return page.playback.view.height;
}

static bool write_digest(FILE *out)
{
    char text[DIGEST_TEXT];
    fputs(digest_print(scene_digest(&page.playback.scene), text), out);
    return true;
}

/* Make web_text() return the digest of the drawn scene. */
bool web_digest(void)
{
    return set_text(write_digest);
}

/* Write the center of a camera, the pixel at which this center is drawn, and the length of a pixel at the center in
 * world units. */
static void write_center(json_writer *w, const camera *c, const int origin[2])
{
    json_write_vector_member(w, "center", c->center);
    json_write_key(w, "middle");
    json_write_numbers(w, (double[]){c->middle[0] + origin[0], c->middle[1] + origin[1]}, 2);
    json_write_number_member(w, "pixel", camera_world_length_of_pixel(c));
}

static void write_closeup(json_writer *w, const scene *closeup)
{
    const view *v = &closeup->view;
    json_begin_object_member(w, "closeup");
    json_write_key(w, "window");
    json_write_numbers(w, (double[]){closeup->place[0], closeup->place[1], v->width, v->height}, 4);
    write_center(w, &closeup->camera, closeup->place);
    json_write_end_object(w);
}

static bool write_camera(FILE *out)
{
    const scene *s = &page.playback.scene;
    const camera *c = &s->camera;
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_vector_member(w, "right", c->right);
    json_write_vector_member(w, "up", c->up);
    json_write_vector_member(w, "forward", c->forward);
    write_center(w, c, s->place);
    if (s->has_closeup)
        write_closeup(w, s->closeup);
    json_write_end_object(w);
    return true;
}

/* Make web_text() return the camera of the drawn picture as JSON: its axes, its center, the pixel at which the center
 * is drawn, and the length of a pixel at the center in world units. If there is a close-up, its camera has the same
 * members, and its window in the picture. */
bool web_camera(void)
{
    return set_text(write_camera);
}

/* Project positions in the world onto the drawn picture. The input buffer holds three doubles for each position. The
 * function overwrites them with two doubles for each position: its pixel, or NaN twice if the position is behind the
 * camera. */
void web_project(size_t count)
{
    double *numbers = (double *)(void *)page.room;
    for (size_t i = 0; i < count; i++) {
        double place[3], pixel[2] = {NAN, NAN};
        memcpy(place, numbers + 3 * i, sizeof place);
        camera_find_pixel(&page.playback.scene.camera, place, pixel);
        memcpy(numbers + 2 * i, pixel, sizeof pixel);
    }
}

/* Returns the ray through a pixel of the drawn picture as six doubles: its origin, and its direction with length 1. */
const double *web_ray(double x, double y)
{
    static double ray[6];
    const scene *s = &page.playback.scene;
    if (s->has_closeup) {
        const scene *closeup = s->closeup;
        const double left = x - closeup->place[0], top = y - closeup->place[1];
        if (left >= 0 && top >= 0 && left < closeup->view.width && top < closeup->view.height)
            s = closeup;
    }
    const double pixel[2] = {x - s->place[0], y - s->place[1]};
    camera_find_ray(&s->camera, pixel, &page.session.session.tree.world, ray, ray + 3);
    return ray;
}

/* ---- Questions ---------------------------------------------------------------------------------------------- */

/* The parameters of web_pick(), for write_pick(). */
static struct {
    int x, y, radius;
} picked;

static bool write_pick(FILE *out)
{
    playback *p = &page.playback;
    pick found = {.path = "",
                  .asked = {picked.x, picked.y},
                  .pixel = {picked.x, picked.y},
                  .radius = picked.radius,
                  .tick = octree_game_tick(p->game)->number,
                  .width = p->view.width,
                  .height = p->view.height};
    const bool ok = pick_scene(&found, p, p->picture.renderer, &page.error);
    found.color = image_color_at(&p->picture.frame, found.pixel[0], found.pixel[1]);
    if (ok)
        pick_print_json(out, &found);
    pick_release(&found);
    return ok;
}

/* Make web_text() return the elements at a pixel of the drawn picture as JSON (see pick.h). */
bool web_pick(int x, int y, int radius)
{
    picked.x = x;
    picked.y = y;
    picked.radius = radius;
    if ((!page.drawn && !draw_picture()) || x < 0 || y < 0 || x >= web_width() || y >= web_height())
        return report_error_text();
    return set_text(write_pick);
}

/* Answer queries at the current tick. The input buffer holds `size` bytes of a session.json whose header has the
 * queries. Until the next tick, web_facts() includes the answers. */
bool web_ask(size_t size)
{
    session_file asked;
    if (!session_parse("the query", "", page.room, size, &asked, &page.error))
        return report_error_text();
    const octree_status status = octree_game_ask(page.playback.game, asked.session.queries, asked.session.query_count);
    session_release(&asked);
    page.drawn = false;
    if (status == OCTREE_OK)
        return true;
    error_set(&page.error, "%s", octree_status_text(status));
    return report_error_text();
}

/* Returns the position of the point with this id as three doubles, or null if there is no such point. */
const double *web_point(double id)
{
    static octree_point found;
    return octree_game_find(page.playback.game, (uint64_t)id, &found) ? found.position : NULL;
}

static bool write_named_element(FILE *out)
{
    return pick_print_named(out, page.room, &page.playback, &page.error);
}

/* Make web_text() return a node or a point of the current tick as JSON. The input buffer holds the `size` bytes of the
 * element's name (see pick_print_named() in pick.h). */
bool web_describe(size_t size)
{
    page.room[size] = 0;
    return set_text(write_named_element);
}

/* ---- The player's key presses ---------------------------------------------------------------------------------- */

/* Remove all items whose tick is greater than `last`. Items that belong to every tick stay. */
#define CUT_AFTER(items, count, last)                                                                                  \
    do {                                                                                                               \
        size_t kept = 0;                                                                                               \
        for (size_t i = 0; i < (count); i++)                                                                           \
            if ((items)[i].tick <= (last) || (items)[i].tick == OCTREE_EVERY_TICK)                                     \
                (items)[kept++] = (items)[i];                                                                          \
        (count) = kept;                                                                                                \
    } while (0)

/* Remove all ticks after tick `last` from the session, and append `count` key presses from the input buffer. Tick
 * `last` must have been played. web_step() plays the new ticks. */
bool web_keys(double last, size_t count)
{
    octree_session *s = &page.session.session;
    const size_t known = s->keys ? strlen(s->keys) : 0, before = (size_t)last;
    char *keys = malloc(before + count + 1);
    if (!keys) {
        error_no_memory(&page.error);
        return report_error_text();
    }
    memset(keys, '.', before);
    if (known > 0)
        memcpy(keys, s->keys, known < before ? known : before);
    memcpy(keys + before, page.room, count);
    keys[before + count] = 0;
    free((char *)s->keys);
    s->keys = keys;
    s->ticks = before + count;
    s->unplayed = 0;
    CUT_AFTER((octree_edit *)s->edits, s->edit_count, before);
    for (size_t i = 0; i < s->query_count; i++)
        if (s->queries[i].tick > before && s->queries[i].tick != OCTREE_EVERY_TICK)
            query_release_ids((octree_query *)&s->queries[i]);
    CUT_AFTER((octree_query *)s->queries, s->query_count, before);
    CUT_AFTER((octree_shape *)s->shapes, s->shape_count, before);
    CUT_AFTER((octree_gap *)s->gaps, s->gap_count, before);
    for (size_t i = 0; i < s->foreign_count; i++)
        if (s->foreign[i].tick > before)
            foreign_tree_release((octree_foreign_tree *)&s->foreign[i]);
    CUT_AFTER((octree_foreign_tree *)s->foreign, s->foreign_count, before);
    page.drawn = false;
    return true;
}

static bool write_session(FILE *out)
{
    return session_write(&page.session.session, &page.session.values, out);
}

/* Make web_text() return the session as session.json. */
bool web_session(void)
{
    return set_text(write_session);
}

/* Make web_text() return the values of each view option, the layers, and the query kinds with their members, as JSON.
 */
bool web_choices(void)
{
    return set_text(choices_write);
}
