/* SPDX-License-Identifier: MIT */
/* played_page.c - writes a page that plays a session in a browser. */
#include "played_page.h"
#include "film.h"
#include "folder_files.h"
#include "packed_points.h"
#include "page.h"
#include "playback.h"
#include "recording_file.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* The state of writing a page. */
typedef struct playing {
    const film_options *options;
    film_summary *summary;
    page_writer page;
} playing;

static bool add_tick_to_page(void *context, const film_step *step, octreel_error *error)
{
    playing *p = context;
    if (!page_add_tick(&p->page, "the session's ticks", step->line, step->size, error))
        return false;
    p->summary->ticks++;
    watcher_report(&p->options->watch, p->summary->ticks, p->summary->total);
    return true;
}

/* Begin the page with the text of recording.json that a recording without frames would have. */
static bool begin_page(playing *p, const view *v, octreel_error *error)
{
    text_stream s;
    char *text;
    if (text_stream_begin(&s))
        recording_write(s.stream, v, 0);
    if (!text_stream_end(&s, &text))
        return error_no_memory(error);
    const bool ok = page_begin(&p->page, "recording.json", text, s.size, error);
    free(text);
    return ok;
}

static bool play_and_write_ticks(playing *p, const octree_session *session, octreel_error *error)
{
    const film_share all = {.last = p->summary->total};
    playback played;
    bool ok = playback_open(&played, session, p->options->values, &p->options->view, error);
    if (ok)
        p->summary->start = film_count_start_points(session, octree_game_tick(played.game));
    ok = ok && begin_page(p, &played.view, error) &&
         playback_run(&played, &all, add_tick_to_page, p, &p->options->watch, error);
    playback_close(&played);
    return ok;
}

static bool check_session_size(size_t size, octreel_error *error)
{
    return size <= PAGE_MOST_SESSION ||
           error_set(
               error,
               "the session is larger than %zu MB, the most that a page holds; record it with --no-frames, then drop "
               "session.json on the recording's page",
               PAGE_MOST_SESSION / 1000000);
}

/* Returns a lower bound of the size of session.json in bytes, so that a session that is far too large is refused before
 * its text is made. */
static size_t find_least_session_size(const octree_session *session)
{
    return (session->keys ? strlen(session->keys) : 0) + session->body_count * strlen("[0,0,0],");
}

bool write_played_page(const octree_session *session, const film_options *options, FILE *page, film_summary *summary,
                       octreel_error *error)
{
    session_bytes written;
    *summary = (film_summary){.total = octree_session_length(session) + 1};
    if (!page_can_play())
        return error_set(error,
                         "this octreel was built without WebAssembly, so its pages cannot play; use octreel record, "
                         "or build it with clang, lld and wasi-libc");
    if (!check_session_size(find_least_session_size(session), error) ||
        !session_check_length(session, options->max_ticks, error) ||
        !make_session_bytes(session, options->values, &written, error))
        return false;
    playing p = {.options = options, .summary = summary};
    bool ok = check_session_size(written.size, error) && play_and_write_ticks(&p, session, error);
    if (ok && are_points_packed(session, options->values))
        ok = page_end_with_packed_session(&p.page, page, session, options->values, error);
    else if (ok)
        ok = page_end(&p.page, page, written.bytes, written.size, error);
    page_release(&p.page);
    free(written.bytes);
    return ok;
}
