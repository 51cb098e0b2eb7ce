/* take.c - see take.h. */
#include "playback.h"
#include "frame_file.h"
#include "layer.h"
#include "tick_scene.h"

#include <inttypes.h>
#include <stdlib.h>

/* Add the tick that was played last. */
static bool grow_hot(take *t, octreel_error *error)
{
    return !(t->view.layers & VIEW_HEAT_LAYERS) || heat_add_tick(&t->heat, t->game) ||
           error_set(error, "there is no memory for the heat of the nodes");
}

bool take_open(take *t, const octree_session *session, const film_options *options, take_frames frames,
               octreel_error *error)
{
    *t = (take){.options = options, .view = options->view, .frames = frames};
    const octree_status status = octree_game_create(session, &t->game);
    if (status != OCTREE_OK)
        return error_set(error, "the session cannot be played: %s", octree_status_text(status));
    return grow_hot(t, error) && picture_fit(&t->view, octree_game_tree(t->game), error) &&
           (frames == FRAMES_CHECK || frames == FRAMES_CLAIM ||
            picture_open(&t->picture, &t->view, &options->renderer, error));
}

void take_close(take *t)
{
    octree_game_destroy(t->game);
    heat_release(&t->heat);
    picture_close(&t->picture);
    scene_release(&t->scene);
    free(t->line);
    *t = (take){0};
}

static bool draw_frame(take *t, frame_origin *origin, octreel_error *error)
{
    if (!picture_draw(&t->picture, &t->scene, error))
        return false;
    origin->left_out = renderer_left_out(t->picture.renderer);
    return t->frames == FRAMES_SHOW || frame_write(t->options->folder, &t->picture.frame, origin, error);
}

bool take_scene(take *t, octreel_error *error)
{
    return tick_scene_build(&t->scene, &t->view, t->game, &t->heat) ||
           error_set(error, "there is no memory for a scene");
}

static bool make_frame(take *t, frame_origin *origin, octreel_error *error)
{
    const char *folder = t->options->folder;
    octreel_error unlike;
    switch (t->frames) {
    case FRAMES_CHECK:
        return frame_check(folder, origin, error);
    case FRAMES_CLAIM:
        return frame_claim(folder, origin, error);
    case FRAMES_KEEP:
        return frame_check(folder, origin, &unlike) || draw_frame(t, origin, error);
    default:
        return draw_frame(t, origin, error);
    }
}

static bool take_frame(take *t, film_step *step, octreel_error *error)
{
    if (!take_scene(t, error))
        return false;
    t->extras.scene_digest = scene_digest(&t->scene);
    frame_origin origin = {.tick = step->tick, .session = t->session_digest, .scene = t->extras.scene_digest};
    const bool done = make_frame(t, &origin, error);
    step->left_out = origin.left_out;
    step->over_budget = t->scene.tally.beyond || t->scene.tally.thinned;
    return done;
}

/* In memory: a line is written in one piece, and may be sent or compared instead. */
static bool take_line(take *t, film_step *step, octreel_error *error)
{
    free(t->line);
    t->line = NULL;
    FILE *stream = open_memstream(&t->line, &step->size);
    if (stream)
        tick_write(stream, octree_game_tick(t->game), &t->extras);
    const bool whole = stream && !ferror(stream);
    if ((stream && fclose(stream) != 0) || !whole)
        return error_set(error, "there is no memory for the line of tick %" PRIu64, step->tick);
    step->line = t->line;
    return true;
}

bool take_tick(take *t, film_step *step, octreel_error *error)
{
    const octree_tick *tick = octree_game_tick(t->game);
    char name[FRAME_NAME];
    *step = (film_step){.tick = tick->number, .events = tick->events, .filmed = tick->number % t->options->every == 0};
    t->extras.frame = step->filmed ? frame_name(tick->number, name) : NULL;
    return (!step->filmed || take_frame(t, step, error)) && take_line(t, step, error);
}

/* What becomes of a tick that was played, or was not. */
static bool finish_step(take *t, octree_status status, octreel_error *error)
{
    if (status != OCTREE_OK)
        return error_set(error, "tick %" PRIu64 " cannot be played: %s", octree_game_tick(t->game)->number,
                         octree_status_text(status));
    return grow_hot(t, error);
}

bool take_advance(take *t, octreel_error *error)
{
    return finish_step(t, octree_game_advance(t->game), error);
}

bool take_play(take *t, const octree_input *input, octreel_error *error)
{
    return finish_step(t, octree_game_play(t->game, input), error);
}
