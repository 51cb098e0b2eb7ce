/* SPDX-License-Identifier: MIT */
/* replay.c - opens a recording and replays it to a tick. */
#include "replay.h"
#include "file.h"
#include "recording_file.h"

#include <inttypes.h>

bool replay_read(replay *r, const char *folder, uint64_t max_ticks, octreel_error *error)
{
    *r = (replay){.film.folder = folder};
    if (folder_contains(folder, "session.json.live") && !folder_contains(folder, "session.json"))
        return error_set(error,
                         "%s: the program that records it is still running or was interrupted: octreel record --resume "
                         "completes the "
                         "recording",
                         folder);
    if (!recording_read(folder, &r->film.view, &r->film.every, error) ||
        !read_session_file(folder, &r->session, &r->session_digest, error) ||
        !session_check_length(&r->session.session, max_ticks, error))
        return false;
    r->ticks = octree_session_length(&r->session.session) + 1;
    return true;
}

/* Start the playback without a renderer, because many callers need no pixels. */
static bool start_playback(replay *r, octreel_error *error)
{
    return playback_open(&r->playback, &r->session.session, &r->session.values, &r->film.view, error);
}

bool replay_open(replay *r, const char *folder, uint64_t max_ticks, octreel_error *error)
{
    return replay_read(r, folder, max_ticks, error) && start_playback(r, error);
}

void replay_close(replay *r)
{
    playback_close(&r->playback);
    session_release(&r->session);
}

static uint64_t current_tick(const replay *r)
{
    return octree_game_tick(r->playback.game)->number;
}

static bool restart_playback(replay *r, octreel_error *error)
{
    /* Keep the renderer when the playback restarts, because the view does not change. */
    picture drawing = r->playback.picture;
    r->playback.picture = (picture){0};
    playback_close(&r->playback);
    const bool ok = start_playback(r, error);
    r->playback.picture = drawing;
    return ok;
}

bool replay_play_up_to(replay *r, uint64_t tick, octreel_error *error)
{
    if (tick >= r->ticks)
        return error_set(error, "%s: no tick %" PRIu64 ": the last tick of the session is %" PRIu64, r->film.folder,
                         tick, r->ticks - 1);
    if (tick < current_tick(r) && !restart_playback(r, error))
        return false;
    while (current_tick(r) < tick)
        if (!playback_advance(&r->playback, error))
            return false;
    return true;
}

renderer *replay_renderer(replay *r, const renderer_choice *choice, octreel_error *error)
{
    picture *drawing = &r->playback.picture;
    return drawing->renderer || picture_open(drawing, &r->playback.view, choice, error) ? drawing->renderer : NULL;
}
