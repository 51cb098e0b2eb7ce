/* SPDX-License-Identifier: MIT */
/* playback.c - plays a session and makes a scene, a frame and a line of ticks.jsonl from each tick.
 *
 * A tick goes through five steps. The game plays the tick. tick_scene_build() makes a draw list from the game and the
 * history of earlier ticks. picture_draw() turns the draw list into pixels. frame_write() writes the pixels as a PNG
 * file, with the digests of the session and the scene. Last, the line of ticks.jsonl is made in memory; it contains the
 * name of the frame and the digest of the scene.
 *
 * All ticks are played and enter the history, even ticks without a frame, because trails, heat and events depend on
 * earlier ticks. So a chunk, a job or a resumed recording, which films only some ticks, makes the same frames as a
 * recording of all ticks. */
#include "playback.h"
#include "frame_file.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Playing ------------------------------------------------------------------------------------------------ */

static bool add_tick_to_history(playback *p, octreel_error *error)
{
    return tick_history_add(&p->history, &p->view, p->game) || error_no_memory(error);
}

bool playback_open(playback *p, const octree_session *session, const point_values *values, const view *v,
                   octreel_error *error)
{
    *p = (playback){.view = *v, .values = values};
    const octree_status status = octree_game_create(session, &p->game);
    if (status != OCTREE_OK)
        return error_set(error, "the session cannot be played: %s", octree_status_text(status));
    return picture_fit_view(&p->view, octree_game_tree(p->game), values, error) && add_tick_to_history(p, error);
}

void playback_close(playback *p)
{
    octree_game_destroy(p->game);
    tick_history_release(&p->history);
    picture_close(&p->picture);
    scene_release(&p->scene);
    free(p->line);
    *p = (playback){0};
}

static bool finish_tick(playback *p, octree_status status, octreel_error *error)
{
    if (status != OCTREE_OK)
        return error_set(error, "tick %" PRIu64 " cannot be played: %s", octree_game_tick(p->game)->number,
                         octree_status_text(status));
    return add_tick_to_history(p, error);
}

static bool begin_tick(playback *p, const octree_input *input, octreel_error *error)
{
    return node_changes_begin_tick(&p->history.changes, p->game, input) || error_no_memory(error);
}

bool playback_advance(playback *p, octreel_error *error)
{
    return begin_tick(p, NULL, error) && finish_tick(p, octree_game_advance(p->game), error);
}

bool playback_play_input(playback *p, const octree_input *input, octreel_error *error)
{
    return begin_tick(p, input, error) && finish_tick(p, octree_game_play(p->game, input), error);
}

/* ---- Filming ------------------------------------------------------------------------------------------------ */

bool playback_open_picture(playback *p, const playback_target *target, octreel_error *error)
{
    p->target = *target;
    return target->every == 0 || picture_open(&p->picture, &p->view, &target->renderer, error);
}

static bool build_cloud_scene(playback *p)
{
    const octree_tick *tick = octree_game_tick(p->game);
    const tree_subject subject = {.title = p->cloud->title,
                                  .node = p->cloud->node,
                                  .answers = tick->answers,
                                  .answer_count = tick->answer_count,
                                  .values = p->values,
                                  .history = &p->history};
    return tree_scene_build(&p->scene, &p->view, octree_game_tree(p->game), &subject);
}

bool playback_compose_scene(playback *p, octreel_error *error)
{
    return (p->cloud ? build_cloud_scene(p) : tick_scene_build(&p->scene, &p->view, p->game, &p->history, p->values)) ||
           error_no_memory(error);
}

static uint64_t find_session_digest(playback *p)
{
    if (p->learn_session)
        p->learn_session(&p->session_digest, p->learn_context);
    p->learn_session = NULL;
    return p->session_digest;
}

/* Returns whether a frame is to be checked: the first and the last frame of a share, and every CHECK_EVERY-th frame.
 * `frame` is the number of the frame, which is its tick divided by `every`. */
static bool must_check_frame(const film_share *share, uint64_t frame, uint64_t every)
{
    return frame % CHECK_EVERY == 0 || frame == (share->first + every - 1) / every ||
           (share->last && frame == (share->last - 1) / every);
}

uint64_t share_count_frames(const film_share *share, uint64_t every)
{
    return every == 0 ? 0 : (share->last - 1) / every - share->first / every + 1;
}

/* Claim a frame for this job. Returns whether this job films the frame. Job 0 films all frames that are checked, so
 * that only one process loads GL. Every other frame is filmed by the first job that reaches it: a job that is faster,
 * or has less to check, films more frames. */
static bool claim_frame(playback *p, uint64_t frame)
{
    const film_share *share = &p->share;
    const uint64_t every = p->target.every;
    if (p->claimed == frame + 1)
        return p->owns_claimed;
    p->claimed = frame + 1;
    p->owns_claimed = must_check_frame(share, frame, every)
                          ? share->index == 0
                          : atomic_exchange(&share->claims[frame - share->first / every], 1) == 0;
    return p->owns_claimed;
}

bool playback_check_last_frame(playback *p, octreel_error *error)
{
    char prefix[sizeof "different_" + FRAME_NAME];
    if (!*p->unchecked)
        return true;
    const int length = (int)strcspn(p->unchecked, ".");
    snprintf(prefix, sizeof prefix, "different_%.*s", length, p->unchecked);
    char *path = path_join(p->target.folder, prefix);
    const bool same = path ? frame_checks_compare(&p->checks, &p->picture, &p->scene, p->unchecked, path, error)
                           : error_no_memory(error);
    *p->unchecked = 0;
    free(path);
    return same;
}

/* Check the last drawn frame if must_check_frame() selects this frame. The first frame that a process draws is always
 * checked. */
static bool check_frame(playback *p, uint64_t tick, octreel_error *error)
{
    const film_share *share = &p->share;
    const renderer_choice *renderer = &p->target.renderer;
    if (renderer->fill != DRAW_FILL_CHECKED || renderer->any_renderer || share->index != 0 || *p->checks.reason.text)
        return true;
    frame_print_name(tick, p->unchecked);
    return (p->checks.count > 0 && !must_check_frame(share, tick / p->target.every, p->target.every)) ||
           playback_check_last_frame(p, error);
}

static bool draw_frame(playback *p, frame_origin *origin, bool *kept, octreel_error *error)
{
    octreel_error unlike;
    const playback_target *target = &p->target;
    origin->session = target->frames == FRAMES_KEEP ? find_session_digest(p) : 0;
    *kept = target->frames == FRAMES_KEEP && frame_check_tick(target->folder, origin, &unlike);
    if (*kept)
        return true;
    if (!picture_draw(&p->picture, &p->scene, error))
        return false;
    if (!check_frame(p, origin->tick, error))
        return false;
    origin->left_out = renderer_left_out_count(p->picture.renderer);
    origin->session = find_session_digest(p);
    return target->frames == FRAMES_SHOW || frame_write(target->folder, &p->picture.frame, origin, error);
}

static bool film_frame(playback *p, film_step *step, octreel_error *error)
{
    if (!playback_compose_scene(p, error))
        return false;
    p->extras.scene_digest = scene_digest(&p->scene);
    frame_origin origin = {.tick = step->tick, .scene = p->extras.scene_digest};
    const bool done = draw_frame(p, &origin, &step->kept, error);
    step->left_out = origin.left_out;
    step->over_budget = scene_kinds_beyond_budget(&p->scene.tally);
    step->below_lod = scene_kinds_below_lod(&p->scene.tally);
    return done;
}

/* Make the line of ticks.jsonl in memory. Callers then write it in one piece, send it to another process, or compare
 * it. */
static bool make_tick_line(playback *p, film_step *step, octreel_error *error)
{
    text_stream s;
    free(p->line);
    if (text_stream_begin(&s))
        tick_write(s.stream, octree_game_tick(p->game), &p->extras);
    if (!text_stream_end(&s, &p->line))
        return error_no_memory(error);
    step->line = p->line;
    step->size = s.size;
    return true;
}

bool playback_film_tick(playback *p, film_step *step, octreel_error *error)
{
    const octree_tick *tick = octree_game_tick(p->game);
    char name[FRAME_NAME];
    *step = (film_step){.tick = tick->number,
                        .events = tick->events,
                        .refusals = tick->refusal_count,
                        .gap = tick->gap,
                        .foreign_nodes = tick->foreign.given,
                        .filmed = !tick->gap && frame_is_due(tick->number, p->target.every)};
    p->extras.frame = step->filmed ? frame_print_name(tick->number, name) : NULL;
    return (!step->filmed || film_frame(p, step, error)) && make_tick_line(p, step, error);
}

bool playback_run(playback *p, const film_share *share, film_sink *sink, void *context, const watcher *watch,
                  octreel_error *error)
{
    p->share = *share;
    for (;;) {
        const uint64_t tick = octree_game_tick(p->game)->number;
        film_step step;
        if (tick >= share->first && (!share->claims || claim_frame(p, tick / p->target.every)) &&
            !(playback_film_tick(p, &step, error) && sink(context, &step, error)))
            return false;
        if (tick + 1 >= share->last || !watcher_continues(watch))
            return playback_check_last_frame(p, error);
        if (!playback_advance(p, error))
            return false;
    }
}
