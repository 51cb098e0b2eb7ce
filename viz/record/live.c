/* SPDX-License-Identifier: MIT */
/* live.c - records a session whose ticks are not known in advance.
 *
 * Other recordings write session.json first, because every frame contains its digest. Here the session grows with each
 * tick, so session.json is written last.
 *
 * Each tick is appended to session.json.live and flushed before it is played. If the process dies, only the current
 * tick is lost, and octreel record --resume completes the recording. Until the end, frames contain the session digest
 * 0.
 *
 * When the recording is closed, session.json is written: a header with the number of ticks, and then the ticks copied
 * from session.json.live. Then the digest is written into every frame in place, and session.json.live is removed. The
 * files have the same bytes as film_session() writes for this session. */
#include "live.h"
#include "array.h"
#include "film.h"
#include "frame_file.h"
#include "octree/digest.h"
#include "recording.h"
#include "session_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <sys/types.h>

struct live_recording {
    film_options options;
    char *folder;
    session_file start;
    playback playback;
    film_summary summary;
    recording recording;
    size_t key_count;  /* length of start.session.keys, which holds the player's key presses */
    uint64_t ticks;    /* number of recorded ticks, without tick 0 */
    FILE *stream;      /* the open session.json.live; null if it does not exist */
    char *path;        /* path of session.json.live */
    off_t head, whole; /* offsets in session.json.live: the start of its ticks, and the end of its last complete tick */
    /* Numbers of the ticks that would have a frame by `every`, but have none because they are gaps. */
    uint64_t *gaps;
    size_t gap_count, gap_room;
    bool begun;  /* true: tick 0 is filmed */
    bool broken; /* true: a tick failed, so no more ticks are recorded */
};

/* ---- session.json.live -------------------------------------------------------------------------------------- */

static bool fail_with_write_error(const live_recording *live, octreel_error *error)
{
    return error_set(error, "%s: cannot be written: %s", live->path, strerror(errno));
}

/* Flush session.json.live. Flushed bytes are kept even if the process is killed. */
static bool flush_live_file(live_recording *live, octreel_error *error)
{
    if (fflush(live->stream) != 0 || ferror(live->stream))
        return fail_with_write_error(live, error);
    live->whole = ftello(live->stream);
    return true;
}

/* Returns the input of tick 0, without the queries and shapes that belong to every tick: the session's header has
 * those. */
static octree_input make_first_input(const octree_session *session)
{
    octree_input input = {
        .queries = session->queries, .shapes = session->shapes, .gap = octree_session_gap(session, 0)};
    if (session->foreign_count && session->foreign->tick == 0)
        input.foreign = session->foreign;
    if (session->foreign_pairs_count && session->foreign_pairs->tick == 0)
        input.foreign_pairs = session->foreign_pairs;
    while (input.query_count < session->query_count && session->queries[input.query_count].tick == 0)
        input.query_count++;
    while (input.shape_count < session->shape_count && session->shapes[input.shape_count].tick == 0)
        input.shape_count++;
    return input;
}

static bool create_live_file(live_recording *live, octreel_error *error)
{
    live->path = path_join(live->folder, "session.json.live");
    if (!live->path)
        return error_no_memory(error);
    unlink(live->path); /* first remove an old file at this path, which may be a pipe or a link */
    live->stream = fopen(live->path, "w+bx");
    return live->stream || fail_with_write_error(live, error);
}

static bool write_header_and_first_tick(live_recording *live, octreel_error *error)
{
    const octree_session header = live->start.session;
    session_write_header(&header, live->options.values, live->stream);
    if (!flush_live_file(live, error))
        return false;
    live->head = live->whole;
    const octree_input input = make_first_input(&header);
    session_write_tick(0, &input, live->options.values, live->stream);
    return flush_live_file(live, error);
}

static bool add_tick_to_live_file(live_recording *live, uint64_t tick, const octree_input *input, octreel_error *error)
{
    if (tick > SESSION_LAST_TICK)
        return error_set(error, "a recording has at most %d ticks", SESSION_LAST_TICK);
    session_write_tick(tick, input, live->options.values, live->stream);
    return flush_live_file(live, error);
}

static void remove_live_file(live_recording *live)
{
    if (!live->stream)
        return;
    fclose(live->stream);
    live->stream = NULL;
    remove(live->path);
}

/* ---- session.json ------------------------------------------------------------------------------------------- */

/* Copy the ticks in session.json.live to the end of session.json. */
static bool copy_ticks(live_recording *live, FILE *out, octreel_error *error)
{
    char buffer[1 << 16];
    off_t left = live->whole - live->head;
    clearerr(live->stream);
    if (fseeko(live->stream, live->head, SEEK_SET) != 0)
        return fail_with_write_error(live, error);
    while (left > 0) {
        const size_t wanted = left < (off_t)sizeof buffer ? (size_t)left : sizeof buffer;
        if (fread(buffer, 1, wanted, live->stream) != wanted)
            return error_set(error, "%s: cannot be read", live->path);
        fwrite(buffer, 1, wanted, out); /* a write error is reported later, by file_writer_close() */
        left -= (off_t)wanted;
    }
    return true;
}

/* Returns the header of the finished session. If fewer ticks were recorded than planned, the session ends with the last
 * recorded tick. The player's key presses after that tick are kept, because frames show them. */
static octree_session make_final_header(live_recording *live, uint64_t ticks)
{
    octree_session header = live->start.session;
    header.ticks = ticks;
    if (octree_session_length(&header) <= live->ticks)
        return header;
    header.ticks = live->ticks;
    header.unplayed = 0;
    header.unplayed = octree_session_length(&header) - live->ticks;
    return header;
}

static bool write_finished_session(live_recording *live, uint64_t ticks, const char *path, octreel_error *error)
{
    file_writer file;
    const octree_session header = make_final_header(live, ticks);
    if (!file_writer_open_replacing(&file, path, error))
        return false;
    session_write_header(&header, live->options.values, file.stream);
    return copy_ticks(live, file.stream, error) ? file_writer_close(&file, error) : file_writer_discard(&file);
}

/* Compute octree_digest_bytes() of a file. The file is read in pieces because a session may be large. */
static bool compute_file_digest(const char *path, uint64_t *digest, octreel_error *error)
{
    unsigned char bytes[1 << 13];
    uint64_t size = 0;
    FILE *in = fopen(path, "rb");
    if (!in)
        return error_set(error, "%s: cannot be opened: %s", path, strerror(errno));
    *digest = OCTREE_DIGEST_START;
    for (size_t got; (got = fread(bytes, 1, sizeof bytes, in)) > 0; size += got)
        *digest = octree_digest_words(*digest, bytes, got);
    *digest = octree_digest_word(*digest, size);
    const bool ok = !ferror(in);
    fclose(in);
    return ok || error_set(error, "%s: cannot be read", path);
}

/* Write the digest of session.json into every frame. The digest is known only now, because session.json has just been
 * completed. */
static bool write_digest_into_frames(const live_recording *live, uint64_t digest, octreel_error *error)
{
    size_t gap = 0;
    for (uint64_t tick = 0; live->options.every && tick < live->summary.ticks; tick += live->options.every)
        if (gap < live->gap_count && live->gaps[gap] == tick)
            gap++;
        else if (!frame_replace_session_digest(live->folder, tick, digest, error))
            return false;
    return true;
}

static bool finish_session(live_recording *live, uint64_t ticks, octreel_error *error)
{
    uint64_t digest;
    char *path = path_join(live->folder, "session.json");
    bool ok = path ? write_finished_session(live, ticks, path, error) : error_no_memory(error);
    ok = ok && compute_file_digest(path, &digest, error);
    if (ok)
        remove_live_file(live);
    ok = ok && write_digest_into_frames(live, digest, error);
    free(path);
    return ok;
}

/* ---- The recording ------------------------------------------------------------------------------------------ */

static void release_live(live_recording *live)
{
    playback_close(&live->playback);
    if (live->stream)
        fclose(live->stream);
    session_release(&live->start);
    free(live->gaps);
    free(live->path);
    free(live->folder);
    free(live);
}

live_recording *live_open(const octree_session *start, const film_options *options, octreel_error *error)
{
    live_recording *live = calloc(1, sizeof *live);
    octreel_error ignored;
    if (!live || !(live->folder = strdup(options->folder)) || !session_copy(start, &live->start, &ignored)) {
        error_no_memory(error);
        if (live)
            release_live(live);
        return NULL;
    }
    live->options = *options;
    live->options.folder = live->folder;
    live->options.first = live->options.last = 0;
    live->options.resume = false;
    live->key_count = start->keys ? strlen(start->keys) : 0;
    live->recording = (recording){.options = &live->options, .summary = &live->summary};
    bool ok = playback_open(&live->playback, &live->start.session, live->options.values, &live->options.view, error);
    if (ok)
        live->summary.start = film_count_start_points(&live->start.session, octree_game_tick(live->playback.game));
    if (ok && recording_open_picture(&live->recording, &live->playback, error))
        return live;
    release_live(live);
    return NULL;
}

static bool add_gap(live_recording *live, uint64_t tick, octreel_error *error)
{
    if (!array_grow(&live->gaps, live->gap_count + 1, &live->gap_room, sizeof *live->gaps))
        return error_no_memory(error);
    live->gaps[live->gap_count++] = tick;
    return true;
}

static bool film_tick(live_recording *live, octreel_error *error)
{
    film_step step;
    return playback_film_tick(&live->playback, &step, error) && recording_add_tick(&live->recording, &step, error) &&
           (!step.gap || !frame_is_due(step.tick, live->options.every) || add_gap(live, step.tick, error));
}

static void abandon_recording(live_recording *live)
{
    octreel_error late;
    tick_log_close(&live->recording.log, false, &late);
    remove_live_file(live);
    folder_remove_recording_files(live->folder);
    replacement_undo(&live->recording.replaced);
}

bool live_begin(live_recording *live, octreel_error *error)
{
    if (!recording_begin(&live->recording, &live->playback, error))
        return false;
    if (create_live_file(live, error))
        return true;
    abandon_recording(live);
    return false;
}

bool live_film_first_tick(live_recording *live, octreel_error *error)
{
    live->begun = write_header_and_first_tick(live, error) && film_tick(live, error);
    if (!live->begun)
        abandon_recording(live);
    return live->begun;
}

const octree_game *live_game(const live_recording *live)
{
    return live->playback.game;
}

static char find_next_key_press(const live_recording *live)
{
    const char *keys = live->start.session.keys;
    return live->ticks < live->key_count ? keys[live->ticks] : '.';
}

bool live_film_tick(live_recording *live, const octree_input *input, octreel_error *error)
{
    octree_input played = *input;
    if (!played.key)
        played.key = find_next_key_press(live);
    live->broken = live->broken || !add_tick_to_live_file(live, live->ticks + 1, input, error);
    live->ticks += !live->broken;
    live->broken = live->broken || !playback_play_input(&live->playback, &played, error) || !film_tick(live, error);
    return !live->broken;
}

bool live_add_unplayed(live_recording *live, uint64_t tick, const octree_input *input, octreel_error *error)
{
    live->broken = live->broken || !add_tick_to_live_file(live, tick, input, error);
    return !live->broken;
}

bool live_close(live_recording *live, uint64_t ticks, film_summary *summary, octreel_error *error)
{
    octreel_error late;
    bool ok = true;
    if (live->begun) {
        const bool same = live->broken || playback_check_last_frame(&live->playback, error);
        const bool whole = finish_session(live, ticks, same ? error : &late) && same;
        live->summary.total = live->summary.ticks;
        live->summary.checks = live->playback.checks;
        ok = (recording_end(&live->recording, whole && !live->broken, whole ? error : &late) || live->broken) && whole;
    }
    if (summary)
        *summary = live->summary;
    release_live(live);
    return ok;
}
