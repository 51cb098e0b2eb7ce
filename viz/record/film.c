/* SPDX-License-Identifier: MIT */
/* film.c - records a session, or draws one tree into a file. */
#include "film.h"
#include "cores.h"
#include "file.h"
#include "frame_file.h"
#include "image_digest.h"
#include "jobs.h"
#include "parallel.h"
#include "png_write.h"
#include "recording.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* One more process is started only if it films at least this many frames, because starting a process costs about as
 * much as filming ten small frames. */
#define FRAMES_WORTH_A_JOB 16

/* ---- A session ---------------------------------------------------------------------------------------------- */

static bool choose_ticks_of_chunk(const octree_session *session, const film_options *options, film_share *share,
                                  octreel_error *error)
{
    const uint64_t total = octree_session_length(session) + 1;
    const bool open = options->last == 0 || options->last > total;
    *share = (film_share){.first = options->first, .last = open ? total : options->last};
    return share->first < share->last ||
           error_set(error, "no chunk can begin at tick %" PRIu64 ": the session's last tick is %" PRIu64, share->first,
                     total - 1);
}

unsigned film_default_jobs(const octree_session *session, const film_options *options)
{
    film_share share;
    octreel_error ignored;
    if (!choose_ticks_of_chunk(session, options, &share, &ignored))
        return 1;
    const uint64_t worth = share_count_frames(&share, options->every) / FRAMES_WORTH_A_JOB, cores = count_cores();
    const uint64_t jobs = cores < worth ? cores : worth;
    return jobs < 1 ? 1 : jobs > FILM_MOST_JOBS ? FILM_MOST_JOBS : (unsigned)jobs;
}

static bool film_in_this_process(recording *r, playback *p, octreel_error *error)
{
    if (!recording_open_picture(r, p, error) || !recording_begin(r, p, error))
        return false;
    const bool filmed = playback_run(p, &r->share, recording_add_tick, r, &r->options->watch, error);
    r->summary->checks = p->checks;
    return recording_end(r, filmed, error);
}

film_start film_count_start_points(const octree_session *session, const octree_tick *tick)
{
    film_start start = {.points = session->body_count};
    for (size_t i = 0; i < tick->refusal_count; i++) {
        start.outside += tick->refusals[i].why == OCTREE_OUTSIDE;
        start.full += tick->refusals[i].why == OCTREE_FULL;
    }
    return start;
}

/* The two preparations of a recording: playing tick 0, and making the bytes of session.json. Both run in parallel,
 * because for a large session they take about the same time. */
enum { OPEN_PLAYBACK, MAKE_BYTES, PREPARATIONS };

typedef struct preparation {
    recording *recording;
    playback *playback;
    bool done[PREPARATIONS];
    octreel_error errors[PREPARATIONS];
} preparation;

static void run_preparation(size_t part, void *context)
{
    preparation *to = context;
    recording *r = to->recording;
    const film_options *o = r->options;
    to->done[part] = part == OPEN_PLAYBACK
                         ? playback_open(to->playback, r->session, o->values, &o->view, &to->errors[part])
                         : make_session_bytes(r->session, o->values, &r->bytes, &to->errors[part]);
}

static bool play_first_tick_and_make_session(recording *r, playback *p, octreel_error *error)
{
    preparation to = {.recording = r, .playback = p};
    parallel_for(PREPARATIONS, run_preparation, &to);
    for (int part = 0; part < PREPARATIONS; part++)
        if (!to.done[part]) {
            *error = to.errors[part];
            return false;
        }
    return true;
}

bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error)
{
    playback p;
    recording r = {.options = options, .summary = summary, .session = session};
    *summary = (film_summary){0};
    if (!session_check_length(session, options->max_ticks, error) ||
        !choose_ticks_of_chunk(session, options, &r.share, error))
        return false;
    summary->total = r.share.last - r.share.first;
    const uint64_t frames = share_count_frames(&r.share, options->every);
    const unsigned jobs = options->jobs < frames ? options->jobs : (unsigned)frames;
    bool ok = play_first_tick_and_make_session(&r, &p, error);
    if (ok)
        summary->start = film_count_start_points(session, octree_game_tick(p.game));
    ok = ok && (jobs > 1 ? film_by_jobs(&r, &p, jobs, error) : film_in_this_process(&r, &p, error));
    playback_close(&p);
    free(r.bytes.bytes);
    return ok;
}

/* ---- One tree ----------------------------------------------------------------------------------------------- */

/* Check the picture before it is written to `path`. If pixels differ, the pictures of both rasterizers are kept as PNG
 * files beside `path`, or in the current folder if the picture goes to standard output. */
static bool check_picture(picture *p, const scene *s, const char *path, frame_checks *checks, octreel_error *error)
{
    const char *title = file_output_display_name(path);
    const size_t length = strlen(path), suffix = sizeof ".png" - 1;
    const bool is_png = length > suffix && strcmp(path + length - suffix, ".png") == 0;
    char *prefix = file_is_standard_stream(path) ? strdup("different_picture") : strdup(path);
    if (!prefix)
        return error_no_memory(error);
    if (is_png)
        prefix[length - suffix] = 0;
    const bool same = frame_checks_compare(checks, p, s, title, prefix, error);
    free(prefix);
    return same;
}

static bool write_picture(const picture *p, const scene *s, const char *path, octreel_error *error)
{
    char scene[DIGEST_TEXT], pixels[IMAGE_DIGEST_TEXT];
    const image_text texts[] = {
        {FRAME_SCENE_KEYWORD, digest_print(scene_digest(s), scene)},
        {FRAME_PIXELS_KEYWORD, image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&p->frame), pixels)},
    };
    return image_write_png(&p->frame, path, texts, sizeof texts / sizeof texts[0], error);
}

bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error)
{
    picture p;
    scene s = {0};
    view v = options->view;
    *summary = (film_summary){0};
    if (!picture_fit_view(&v, tree, options->values, error) || !picture_open(&p, &v, &options->renderer, error))
        return false;
    tree_subject shown = *about;
    shown.values = options->values;
    bool ok = tree_scene_build(&s, &v, tree, &shown) || error_no_memory(error);
    frame_checks checks = {0};
    ok = ok && picture_draw(&p, &s, error) &&
         (options->renderer.fill != DRAW_FILL_CHECKED || check_picture(&p, &s, path, &checks, error)) &&
         write_picture(&p, &s, path, error);
    if (ok)
        *summary = (film_summary){.frames = 1,
                                  .checks = checks,
                                  .left_out = renderer_left_out_count(p.renderer),
                                  .over_budget = scene_kinds_beyond_budget(&s.tally) != 0,
                                  .below_lod = scene_kinds_below_lod(&s.tally) != 0,
                                  .beyond = scene_kinds_beyond_budget(&s.tally),
                                  .small = scene_kinds_below_lod(&s.tally)};
    scene_release(&s);
    picture_close(&p);
    return ok;
}
