/* text_layer.c - see text_layer.h. */
#include "text_layer.h"
#include "draw.h"
#include "frame_file.h"
#include "session_file.h"
#include "tick_scene.h"
#include "view_file.h"

#include <stdlib.h>

/* A recording while its session is played. */
typedef struct playing {
    const diff_side *side;
    session_file session;
    view view;
    octree_game *game;
    heat heat; /* where the view shows it: the legend tells whether there is any */
    scene scene;
} playing;

/* Where a pair's rectangles go. */
typedef struct rectangles {
    diff_pair *pair;
    bool out_of_memory;
} rectangles;

static bool add_heat(playing *p, record_error *error)
{
    return !(p->view.layers & VIEW_HEAT_LAYERS) || heat_add_tick(&p->heat, p->game) ||
           record_fail(error, "there is no memory for the heat of the nodes");
}

static bool open_session(playing *p, record_error *error)
{
    session_error unread;
    char *path = folder_path(p->side->path, "session.json");
    bool ok = path || record_fail(error, "there is no memory");
    ok = ok && (session_read(path, &p->session, &unread) || record_fail(error, "%s", unread.text));
    free(path);
    if (!ok)
        return false;
    const octree_status status = octree_game_create(&p->session.session, &p->game);
    if (status != OCTREE_OK)
        return record_fail(error, "%s/session.json: the session cannot be played: %s", p->side->path,
                           octree_status_text(status));
    return add_heat(p, error);
}

static void close_session(playing *p)
{
    octree_game_destroy(p->game);
    heat_release(&p->heat);
    session_release(&p->session);
    scene_release(&p->scene);
}

static bool play_to(playing *p, const diff_frame *frame, uint64_t tick, record_error *error)
{
    while (octree_game_tick(p->game)->number < tick) {
        if (octree_game_over(p->game) || octree_game_advance(p->game) != OCTREE_OK)
            return record_fail(error, "%s/%s: the recording's session has no such tick", p->side->path, frame->name);
        if (!add_heat(p, error))
            return false;
    }
    return true;
}

static void add_rectangle(const draw_box *box, void *context)
{
    rectangles *to = context;
    diff_pair *pair = to->pair;
    image_rectangle *grown = realloc(pair->ignored, (pair->ignored_count + 1) * sizeof *grown);
    if (!grown) {
        to->out_of_memory = true;
        return;
    }
    pair->ignored = grown;
    pair->ignored[pair->ignored_count++] = (image_rectangle){box->x, box->y, box->width, box->height};
}

/* A recording's frames are named for their ticks. */
static uint64_t tick_of(const diff_frame *frame)
{
    uint64_t tick = 0;
    frame_parse_name(frame->name, &tick);
    return tick;
}

static bool ignore_in(playing *p, diff_pair *pair, const diff_frame *frame, record_error *error)
{
    rectangles to = {.pair = pair};
    if (!play_to(p, frame, tick_of(frame), error))
        return false;
    if (!tick_scene_build(&p->scene, &p->view, p->game, &p->heat))
        return record_fail(error, "there is no memory for a scene");
    draw_text_boxes(&p->scene, add_rectangle, &to);
    return !to.out_of_memory || record_fail(error, "there is no memory for what is ignored");
}

static int by_tick(const void *a, const void *b)
{
    const uint64_t x = tick_of((*(diff_pair *const *)a)->a), y = tick_of((*(diff_pair *const *)b)->a);
    return (x > y) - (x < y);
}

/* Names are alike on both sides, so that one order by ticks serves both; beyond six digits it is not that of names. */
static bool ignore_of(const diff_side *side, bool is_a, diff_pair **pairs, size_t count, record_error *error)
{
    playing p = {.side = side};
    bool ok = view_read(side->path, &p.view, error) && open_session(&p, error);
    qsort(pairs, count, sizeof *pairs, by_tick);
    for (size_t i = 0; ok && i < count; i++)
        ok = ignore_in(&p, pairs[i], is_a ? pairs[i]->a : pairs[i]->b, error);
    close_session(&p);
    return ok;
}

bool text_layer_ignore(const diff_side *a, const diff_side *b, diff_pair **pairs, size_t count, record_error *error)
{
    if (a->kind != DIFF_RECORDING && b->kind != DIFF_RECORDING)
        return record_fail(error, "where text is can be told of recordings alone: neither %s nor %s is one", a->path,
                           b->path);
    return count == 0 || ((a->kind != DIFF_RECORDING || ignore_of(a, true, pairs, count, error)) &&
                          (b->kind != DIFF_RECORDING || ignore_of(b, false, pairs, count, error)));
}
