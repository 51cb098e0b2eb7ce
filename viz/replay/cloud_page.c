/* SPDX-License-Identifier: MIT */
/* cloud_page.c - writes the page of a point cloud.
 *
 * The page is an ordinary page, of a session that has one tick and no player. So the viewer and the module are the same
 * as in every page. The page's session.json has the tree's options and the queries, but no points: the points are a
 * compressed block (point_block.h) in a separate script element. */
#include "cloud_page.h"
#include "octree/octree.h"
#include "packed_points.h"
#include "page.h"
#include "picture.h"
#include "recording_file.h"
#include "text.h"
#include "ticks_write.h"

#include <stdlib.h>
#include <string.h>

/* ---- Points ----------------------------------------------------------------------------------------------------- */

typedef struct collector {
    octree_game_body *rows; /* rows[id]: the point with this id */
    unsigned char *stored;  /* stored[id]: the tree has a point with this id */
} collector;

static octree_walk_order collect_leaf(const octree_node *node, void *context)
{
    collector *c = context;
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        const octree_point *point = &node->points[i];
        c->rows[point->id].id = point->id;
        memcpy(c->rows[point->id].position, point->position, sizeof point->position);
        c->stored[point->id] = 1;
    }
    return OCTREE_WALK_ON;
}

/* Collect the points of the tree in ascending order of their ids, which are row numbers of the file. */
static bool collect_points(const inspection *made, point_block *b)
{
    const size_t rows = made->points + made->skipped;
    collector c = {calloc(rows, sizeof *c.rows), calloc(rows, 1)};
    b->bodies = c.rows;
    if (c.rows && c.stored)
        octree_walk(made->tree, collect_leaf, &c);
    for (size_t i = 0; c.rows && c.stored && i < rows; i++)
        if (c.stored[i])
            c.rows[b->count++] = c.rows[i];
    const bool ok = c.rows && c.stored;
    free(c.stored);
    return ok;
}

static unsigned char *make_packed_points(const cloud_page *c, size_t *packed)
{
    point_block b = {.node = c->node, .values = c->made->values};
    snprintf(b.title, sizeof b.title, "%s", c->title);
    unsigned char *result = collect_points(c->made, &b) ? pack_points(&b, packed) : NULL;
    free(b.bodies);
    return result;
}

/* ---- The page --------------------------------------------------------------------------------------------------- */

/* Begin the page with the text of recording.json that a recording with this view would have. */
static bool begin_page(const cloud_page *c, page_writer *w, octreel_error *error)
{
    text_stream s;
    char *text;
    view v = *c->view;
    if (!picture_fit_view(&v, c->made->tree, &c->made->values, error))
        return false;
    if (text_stream_begin(&s))
        recording_write(s.stream, &v, 0);
    const bool ok =
        text_stream_end(&s, &text) ? page_begin(w, "recording.json", text, s.size, error) : error_no_memory(error);
    free(text);
    return ok;
}

/* Add tick 0 with the tree's statistics, without answers. The page's module adds the answers. */
static bool add_tick(const cloud_page *c, page_writer *w, octreel_error *error)
{
    octree_tick tick = {.tree_digest = octree_digest(c->made->tree)};
    text_stream s;
    char *text;
    octree_statistics(c->made->tree, &tick.stats);
    if (text_stream_begin(&s))
        tick_write(s.stream, &tick, &(tick_extras){0});
    const bool ok =
        text_stream_end(&s, &text) ? page_add_tick(w, "the tick", text, s.size, error) : error_no_memory(error);
    free(text);
    return ok;
}

static bool end_page(const cloud_page *c, page_writer *w, FILE *page, octreel_error *error)
{
    const octree_session session = {.tree = octree_definition(c->made->tree),
                                    .player.kind = OCTREE_PLAYER_NONE,
                                    .queries = c->queries,
                                    .query_count = c->query_count};
    text_stream s;
    char *text = NULL;
    size_t size = 0;
    if (text_stream_begin(&s))
        session_write(&session, NULL, s.stream);
    const bool written = text_stream_end(&s, &text);
    unsigned char *points = written ? make_packed_points(c, &size) : NULL;
    const bool ok =
        points ? page_end_with_points(w, page, text, s.size, points, size, true, error) : error_no_memory(error);
    free(text);
    free(points);
    return ok;
}

bool cloud_page_write(const cloud_page *c, FILE *page, octreel_error *error)
{
    page_writer w = {0};
    if (!page_can_play())
        return error_set(error, "this octreel was built without WebAssembly, so it cannot make pages of clouds; name a "
                                "PNG file, or build octreel with clang, lld and wasi-libc");
    if (octree_count(c->made->tree) > POINT_BLOCK_MOST)
        return error_set(
            error, "the cloud has %zu points, but a page holds at most %d; use --world to show a part of the cloud",
            octree_count(c->made->tree), POINT_BLOCK_MOST);
    const bool ok = begin_page(c, &w, error) && add_tick(c, &w, error) && end_page(c, &w, page, error);
    page_release(&w);
    return ok;
}
