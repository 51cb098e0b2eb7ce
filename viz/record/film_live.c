/* film_live.c - see film_live.h. */
#include "film_live.h"
#include "frame_file.h"
#include "live_session.h"
#include "recording.h"

#include <stdlib.h>
#include <string.h>

struct film_live {
    film_options options;
    char *folder;
    live_session session;
    take take;
    film_summary summary;
    recording recording;
    bool begun;  /* the folder is a recording's */
    bool broken; /* a tick failed */
};

static void release(film_live *film)
{
    take_close(&film->take);
    live_session_release(&film->session);
    free(film->folder);
    free(film);
}

static bool film_tick(film_live *film, octreel_error *error)
{
    film_step step;
    return take_tick(&film->take, &step, error) && recording_add(&film->recording, &step, error);
}

static bool begin(film_live *film, bool *drawn, octreel_error *error)
{
    take *t = &film->take;
    if (!take_open(t, live_session_start(&film->session), &film->options, FRAMES_DRAW, error))
        return false;
    *drawn = true;
    const renderer_info info = renderer_about(t->picture.renderer);
    film->begun = recording_begin(&film->recording, &t->view, &info, error);
    return film->begun && live_session_begin(&film->session, film->folder, error) && film_tick(film, error);
}

/* Leave no files of a recording that did not come to its first frame. */
static void abandon(film_live *film)
{
    octreel_error late;
    tick_log_close(&film->recording.log, false, &late);
    live_session_abandon(&film->session);
    if (film->begun)
        folder_abandon(film->folder);
}

film_live *film_live_open(const octree_session *start, const film_options *options, bool *drawn, octreel_error *error)
{
    film_live *film = calloc(1, sizeof *film);
    *drawn = true;
    if (!film || !(film->folder = strdup(options->folder)) || !live_session_init(&film->session, start)) {
        error_no_memory(error);
        if (film)
            release(film);
        return NULL;
    }
    film->options = *options;
    film->options.folder = film->folder;
    film->options.first = film->options.last = 0;
    film->options.resume = false;
    film->recording = (recording){.options = &film->options, .summary = &film->summary};
    *drawn = false;
    if (begin(film, drawn, error))
        return film;
    abandon(film);
    release(film);
    return NULL;
}

bool film_live_tick(film_live *film, const octree_input *input, octreel_error *error)
{
    film->broken = film->broken || !live_session_add(&film->session, input, error) ||
                   !take_play(&film->take, input, error) || !film_tick(film, error);
    return !film->broken;
}

/* The frames are of the session that came out. */
static bool sign_frames(const film_live *film, uint64_t digest, octreel_error *error)
{
    for (uint64_t tick = 0; tick < film->summary.ticks; tick += film->options.every)
        if (!frame_set_session(film->folder, tick, digest, error))
            return false;
    return true;
}

bool film_live_close(film_live *film, octreel_error *error)
{
    uint64_t digest;
    octreel_error late;
    const bool ok = live_session_end(&film->session, film->folder, &digest, error) && sign_frames(film, digest, error);
    film->summary.total = film->summary.ticks;
    const bool ended = recording_end(&film->recording, ok && !film->broken, ok ? error : &late) || film->broken;
    release(film);
    return ok && ended;
}
