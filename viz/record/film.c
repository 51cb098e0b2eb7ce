/* film.c - see film.h. */
#include "film.h"
#include "jobs.h"

#include <inttypes.h>
#include <stdlib.h>
#include <unistd.h>

/* A process takes as long to start as some ten small frames take to be filmed. */
#define FRAMES_WORTH_A_JOB 16

static bool is_stopped(const film_options *options)
{
    return options->keep_going && !options->keep_going(options->context);
}

static bool has_tick(const film_share *share, uint64_t tick, uint64_t every)
{
    return tick >= share->first && (share->count == 0 || tick / every % share->count == share->index);
}

bool film_ticks(take *t, const film_share *share, film_sink *sink, void *context, octreel_error *error)
{
    for (;;) {
        const uint64_t tick = octree_game_tick(t->game)->number;
        film_step step;
        if (has_tick(share, tick, t->options->every) && !(take_tick(t, &step, error) && sink(context, &step, error)))
            return false;
        if (tick + 1 >= share->last || is_stopped(t->options))
            return true;
        if (!take_advance(t, error))
            return false;
    }
}

static bool find_share(const octree_session *session, const film_options *options, film_share *share,
                       octreel_error *error)
{
    const uint64_t total = octree_session_length(session) + 1;
    const bool open = options->last == 0 || options->last > total;
    *share = (film_share){.first = options->first, .last = open ? total : options->last};
    return share->first < share->last ||
           error_set(error, "there is no part from tick %" PRIu64 " on: the session's last tick is %" PRIu64,
                     share->first, total - 1);
}

/* Those that a share is cut into: one that began before it counts too, for the sake of the ticks behind it. */
static uint64_t count_frames(const film_share *share, uint64_t every)
{
    return (share->last - 1) / every - share->first / every + 1;
}

unsigned film_default_jobs(const octree_session *session, const film_options *options)
{
    film_share share;
    octreel_error ignored;
    if (!find_share(session, options, &share, &ignored))
        return 1;
    const uint64_t worth = count_frames(&share, options->every) / FRAMES_WORTH_A_JOB;
#ifdef _SC_NPROCESSORS_ONLN
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
#else
    const long cores = 1;
#endif
    const uint64_t jobs = cores > 0 && (uint64_t)cores < worth ? (uint64_t)cores : worth;
    return jobs < 1 ? 1 : jobs > FILM_MOST_JOBS ? FILM_MOST_JOBS : (unsigned)jobs;
}

static bool begin(take *t, recording *r, octreel_error *error)
{
    if (!take_open(t, r->session, r->options, r->options->resume ? FRAMES_KEEP : FRAMES_DRAW, error) ||
        !recording_prepare(r, error))
        return false;
    const renderer_info info = renderer_about(t->picture.renderer);
    t->session_digest = r->written.digest;
    return recording_begin(r, &t->view, &info, error);
}

static bool film_alone(recording *r, octreel_error *error)
{
    take t;
    bool ok = begin(&t, r, error);
    if (ok)
        ok = recording_end(r, film_ticks(&t, &r->share, recording_add, r, error), error);
    take_close(&t);
    return ok;
}

bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error)
{
    recording r = {.options = options, .summary = summary, .session = session};
    *summary = (film_summary){0};
    if (!find_share(session, options, &r.share, error))
        return false;
    summary->total = r.share.last - r.share.first;
    const uint64_t frames = count_frames(&r.share, options->every);
    const unsigned jobs = options->jobs < frames ? options->jobs : (unsigned)frames;
    const bool ok = jobs > 1 ? film_by_jobs(&r, jobs, error) : film_alone(&r, error);
    free(r.written.bytes);
    return ok;
}
