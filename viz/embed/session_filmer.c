/* reel.c - see reel.h. */
#include "session_filmer.h"

#include <stdlib.h>
#include <string.h>

/* The ticks that the program has given are its own matter. */
static void number_tick(batch *b, uint64_t tick)
{
    for (size_t i = 0; i < b->query_count; i++)
        b->queries[i].tick = tick;
    for (size_t i = 0; i < b->shape_count; i++)
        b->shapes[i].tick = tick;
}

static octree_body *make_bodies(const points *start)
{
    octree_body *bodies = calloc(start->count ? start->count : 1, sizeof *bodies);
    for (size_t i = 0; bodies && i < start->count; i++) {
        bodies[i].id = start->items[i].id;
        memcpy(bodies[i].position, start->items[i].position, sizeof bodies[i].position);
    }
    return bodies;
}

static octreel_status fail_memory(octreel_error *error, octreel_status status)
{
    error_no_memory(error);
    return status;
}

octreel_status reel_begin(reel *r, const settings *s, const char *folder, const points *start, batch *first,
                          octreel_error *error)
{
    bool drawn = true;
    film_options film = s->film;
    octree_body *bodies = make_bodies(start);
    *r = (reel){0};
    if (!bodies || !edit_order_init(&r->order, &s->tree, start)) {
        free(bodies);
        edit_order_release(&r->order);
        return fail_memory(error, OCTREEL_NO_MEMORY);
    }
    number_tick(first, 0);
    const octree_session session = {.tree = s->tree,
                                    .player = s->player,
                                    .bodies = bodies,
                                    .body_count = start->count,
                                    .queries = first->queries,
                                    .query_count = first->query_count,
                                    .shapes = first->shapes,
                                    .shape_count = first->shape_count};
    film.folder = folder;
    r->film = film_live_open(&session, &film, &drawn, error);
    free(bodies);
    if (r->film)
        return OCTREEL_OK;
    edit_order_release(&r->order);
    return drawn ? OCTREEL_BAD_FOLDER : OCTREEL_CANNOT_DRAW;
}

octreel_status reel_tick(reel *r, batch *b, octreel_error *error)
{
    number_tick(b, ++r->tick);
    if (!edit_order_make(&r->order, b, r->tick))
        return fail_memory(error, OCTREEL_BROKEN);
    const octree_input input = {.key = '.',
                                .edits = r->order.edits,
                                .edit_count = r->order.count,
                                .queries = b->queries,
                                .query_count = b->query_count,
                                .shapes = b->shapes,
                                .shape_count = b->shape_count};
    return film_live_tick(r->film, &input, error) ? OCTREEL_OK : OCTREEL_BROKEN;
}

octreel_status reel_end(reel *r, octreel_error *error)
{
    edit_order_release(&r->order);
    const bool ok = film_live_close(r->film, error);
    r->film = NULL;
    return ok ? OCTREEL_OK : OCTREEL_BROKEN;
}
