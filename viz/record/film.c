/* film.c - see film.h. */
#include "film.h"
#include "recording.h"

bool film_ticks(take *t, const film_share *share, film_sink *sink, void *context, record_error *error)
{
    for (;;) {
        const uint64_t tick = octree_game_tick(t->game)->number;
        film_step step;
        if (tick >= share->first && !(take_tick(t, &step, error) && sink(context, &step, error)))
            return false;
        if (tick + 1 >= share->last)
            return true;
        if (!take_advance(t, error))
            return false;
    }
}

bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  record_error *error)
{
    const film_share all = {.last = octree_session_length(session) + 1};
    take t;
    recording r = {.options = options, .summary = summary, .ticks = all.last};
    *summary = (film_summary){0};
    bool ok = take_open(&t, session, options, FRAMES_DRAW, error);
    if (ok) {
        const renderer_info info = renderer_about(t.picture.renderer);
        ok = recording_begin(&r, session, &t.view, &info, &t.session_digest, error);
    }
    if (ok)
        ok = recording_end(&r, film_ticks(&t, &all, recording_add, &r, error), error);
    take_close(&t);
    return ok;
}
