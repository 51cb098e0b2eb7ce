/* SPDX-License-Identifier: MIT */
/* join.c - completes a recording that was made in chunks (octreel record --ticks A:B), perhaps on several machines.
 *
 * Each chunk left frames and one file of lines, ticks_A_B.jsonl. The chunks are sorted by their first tick and their
 * lines are copied into ticks.jsonl. A tick that two chunks contain is copied once. Each line must belong to the next
 * tick. The frame of this tick must be whole and must contain the digests of the tick's scene and of the folder's
 * session. These checks find chunks of another session, view or version, and gaps between chunks.
 *
 * ticks.jsonl is written under a temporary name and renamed after the last check, so a failure changes no file. Then
 * index.html is written and the chunk files are removed. The folder now has the same bytes as a recording by one
 * process. Nothing is played or drawn here; octreel verify checks that lines and pixels follow from the session. */
#include "join.h"
#include "hint.h"
#include "folder_files.h"
#include "frame_file.h"
#include "page.h"
#include "recording_file.h"
#include "ticks_write.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* The file of a chunk, ticks_A_B.jsonl. The file has a line for each tick from `first` to `last` - 1. Lines at the end
 * of the file may be missing. */
typedef struct chunk {
    uint64_t first, last;
    char name[CHUNK_NAME];
} chunk;

/* The state of a join. */
typedef struct joining {
    const film_options *options;
    const octree_session *session;
    film_summary *summary;   /* summary->ticks is the number of ticks joined so far */
    uint64_t session_digest; /* digest of session.json */
    chunk *chunks;           /* the chunks, sorted by their first tick */
    size_t count;
    file_writer ticks; /* writes the new file ticks.jsonl */
    char *line;        /* the current line of a chunk */
    size_t line_room;
} joining;

/* ---- Chunks ------------------------------------------------------------------------------------------------- */

static bool add_chunk(joining *j, chunk c, octreel_error *error)
{
    if (c.last > j->summary->total)
        return error_set(error, "%s/%s: not a chunk of this session, whose last tick is %" PRIu64, j->options->folder,
                         c.name, j->summary->total - 1);
    chunk *more = realloc(j->chunks, (j->count + 1) * sizeof *more);
    if (!more)
        return error_no_memory(error);
    j->chunks = more;
    j->chunks[j->count++] = c;
    return true;
}

/* If a file of the folder is the file of a chunk, add it to the list of chunks. An existing ticks.jsonl counts as a
 * chunk of all ticks. A frame that this recording does not have is an error. */
static bool add_chunk_file(joining *j, const char *name, octreel_error *error)
{
    uint64_t tick;
    chunk c = {.last = j->summary->total};
    if (frame_parse_name(name, &tick) && !frame_is_name_of_recording(name, j->summary->total, j->options->every))
        return error_set(error, "%s/%s: not a frame of this recording", j->options->folder, name);
    if (!chunk_parse_name(name, &c.first, &c.last) && strcmp(name, "ticks.jsonl") != 0)
        return true;
    snprintf(c.name, sizeof c.name, "%.*s", CHUNK_NAME - 1, name);
    return add_chunk(j, c, error);
}

static int compare_chunks(const void *a, const void *b)
{
    const chunk *p = a, *q = b;
    return p->first < q->first ? -1 : p->first > q->first;
}

static bool find_chunks(joining *j, octreel_error *error)
{
    char **names = folder_names(j->options->folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        ok = add_chunk_file(j, names[i], error);
    free(names);
    if (ok && j->count > 1)
        qsort(j->chunks, j->count, sizeof *j->chunks, compare_chunks);
    return ok;
}

/* ---- Ticks -------------------------------------------------------------------------------------------------- */

static bool check_frame(joining *j, uint64_t scene, octreel_error *error)
{
    frame_origin origin = {.tick = j->summary->ticks, .session = j->session_digest, .scene = scene};
    char name[FRAME_NAME];
    if (!folder_contains(j->options->folder, frame_print_name(origin.tick, name)))
        return error_set(error, "%s: %s is missing; complete the recording with %s record --resume", j->options->folder,
                         name, hint_program_name());
    if (!frame_check_tick(j->options->folder, &origin, error))
        return false;
    j->summary->frames++;
    j->summary->left_out += origin.left_out;
    return true;
}

/* Check that j->line is the line of the next tick, and copy it to the new ticks.jsonl. */
static bool join_line(joining *j, const chunk *c, size_t size, octreel_error *error)
{
    char begin[48];
    uint64_t scene;
    const uint64_t tick = j->summary->ticks;
    const bool gap = octree_session_gap(j->session, tick), filmed = !gap && frame_is_due(tick, j->options->every);
    const int length = snprintf(begin, sizeof begin, "{\"tick\": %" PRIu64 ", ", tick);
    if (strncmp(j->line, begin, (size_t)length) != 0 || tick_read_scene_digest(j->line, size, tick, &scene) != filmed)
        return error_set(error, "%s/%s: expected the line of tick %" PRIu64, j->options->folder, c->name, tick);
    if (filmed && !check_frame(j, scene, error))
        return false;
    fwrite(j->line, 1, size, j->ticks.stream); /* a write error is reported later, by file_writer_close() */
    j->summary->ticks++;
    j->summary->gaps += gap;
    watcher_report(&j->options->watch, j->summary->ticks, j->summary->total);
    return true;
}

/* Join the lines of a chunk. Ticks that earlier chunks contain are skipped. A last line without a newline is
 * ignored. */
static bool join_lines(joining *j, const chunk *c, FILE *stream, bool *stopped, octreel_error *error)
{
    ssize_t size;
    for (uint64_t tick = c->first; !*stopped && (size = getline(&j->line, &j->line_room, stream)) > 0; tick++) {
        if (j->line[size - 1] != '\n')
            break;
        if (tick >= c->last)
            return error_set(error, "%s/%s: has more lines than ticks", j->options->folder, c->name);
        if (tick < j->summary->ticks)
            continue;
        if (!join_line(j, c, (size_t)size, error))
            return false;
        *stopped = j->summary->ticks < j->summary->total && !watcher_continues(&j->options->watch);
    }
    return !ferror(stream) ||
           error_set(error, "%s/%s: cannot be read: %s", j->options->folder, c->name, strerror(errno));
}

static bool join_chunk(joining *j, const chunk *c, bool *stopped, octreel_error *error)
{
    char *path = path_join(j->options->folder, c->name);
    char reason[FILE_REASON] = "cannot be read: out of memory";
    FILE *stream = path ? file_open(path, NULL, reason) : NULL;
    free(path);
    if (!stream)
        return error_set(error, "%s/%s: %s", j->options->folder, c->name, reason);
    const bool ok = join_lines(j, c, stream, stopped, error);
    fclose(stream);
    return ok;
}

/* Join the chunks in order, up to the first gap between two chunks. */
static bool join_chunks_in_order(joining *j, bool *stopped, octreel_error *error)
{
    for (size_t i = 0; i < j->count && !*stopped && j->chunks[i].first <= j->summary->ticks; i++)
        if (!join_chunk(j, &j->chunks[i], stopped, error))
            return false;
    return *stopped || j->summary->ticks == j->summary->total ||
           error_set(error, "%s: no chunk has tick %" PRIu64 "; complete the recording with %s record --resume",
                     j->options->folder, j->summary->ticks, hint_program_name());
}

/* ---- The recording ------------------------------------------------------------------------------------------ */

static bool write_joined_ticks(joining *j, octreel_error *error)
{
    char *path = path_join(j->options->folder, "ticks.jsonl");
    bool stopped = false, ok = path ? file_writer_open_replacing(&j->ticks, path, error) : error_no_memory(error);
    if (ok) {
        ok = join_chunks_in_order(j, &stopped, error);
        if (ok && !stopped)
            ok = file_writer_close(&j->ticks, error);
        else
            file_writer_discard(&j->ticks);
    }
    free(path);
    return ok;
}

static bool check_renderer_file(const char *folder, octreel_error *error)
{
    return folder_contains(folder, "renderer.json") ||
           error_set(error, "%s: renderer.json is missing; %s record --resume writes it", folder, hint_program_name());
}

bool join_chunks(film_options *options, film_summary *summary, octreel_error *error)
{
    joining j = {.options = options, .summary = summary};
    session_file file;
    *summary = (film_summary){0};
    if (!recording_read(options->folder, &options->view, &options->every, error) ||
        !read_session_file(options->folder, &file, &j.session_digest, error))
        return false;
    j.session = &file.session;
    summary->total = octree_session_length(j.session) + 1;
    bool ok = (options->every == 0 || check_renderer_file(options->folder, error)) && find_chunks(&j, error) &&
              write_joined_ticks(&j, error);
    if (ok && summary->ticks == summary->total)
        ok = page_write(NULL, options->folder, &file.session, &file.values, error) &&
             folder_remove_leftovers(options->folder, error);
    session_release(&file);
    free(j.chunks);
    free(j.line);
    return ok;
}
