/* join.c - see join.h. */
#include "join.h"
#include "folder_files.h"
#include "missing.h"
#include "recording.h"
#include "recording_file.h"
#include "page.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A recording while its parts are joined. */
typedef struct joining {
    const film_options *options;
    film_summary *summary;
    chunk_list parts;
    FILE **streams;    /* of the parts that have the tick at hand; of the others null */
    file_writer ticks; /* ticks.jsonl, as it will be */
    char *line;        /* of a part */
    size_t line_size;  /* room for it */
} joining;

static bool fail_to_read(const joining *j, size_t i, octreel_error *error)
{
    return error_set(error, "%s/%s: cannot be read: %s", j->options->folder, j->parts.parts[i].name, strerror(errno));
}

static bool open_part(joining *j, size_t i, octreel_error *error)
{
    char *path = path_join(j->options->folder, j->parts.parts[i].name);
    j->streams[i] = path ? fopen(path, "rb") : NULL;
    free(path);
    return j->streams[i] || fail_to_read(j, i, error);
}

static bool make_room(joining *j, size_t size, octreel_error *error)
{
    if (size <= j->line_size)
        return true;
    char *more = realloc(j->line, size);
    if (!more)
        return error_set(error, "there is no memory for a line");
    j->line = more;
    j->line_size = size;
    return true;
}

/* The next line of a part is this tick's. */
static bool compare_line(joining *j, size_t i, const film_step *step, octreel_error *error)
{
    if (!make_room(j, step->size, error))
        return false;
    const size_t size = fread(j->line, 1, step->size, j->streams[i]);
    if (size < step->size && ferror(j->streams[i]))
        return fail_to_read(j, i, error);
    if (size == step->size && memcmp(j->line, step->line, size) == 0)
        return true;
    return error_set(error,
                     "%s/%s: tick %" PRIu64 " is not what the session makes of it: the part is of another session, "
                     "view or version of octreel",
                     j->options->folder, j->parts.parts[i].name, step->tick);
}

/* Compare the tick with each part that has it; files are open only where their ticks are. */
static bool compare_parts(joining *j, const film_step *step, octreel_error *error)
{
    for (size_t i = 0; i < j->parts.count && j->parts.parts[i].first <= step->tick; i++) {
        const part *p = &j->parts.parts[i];
        if (step->tick >= p->first + p->lines)
            continue;
        if ((step->tick == p->first && !open_part(j, i, error)) || !compare_line(j, i, step, error))
            return false;
        if (step->tick + 1 == p->first + p->lines) {
            fclose(j->streams[i]);
            j->streams[i] = NULL;
        }
    }
    return true;
}

static bool join_tick(void *context, const film_step *step, octreel_error *error)
{
    joining *j = context;
    if (!compare_parts(j, step, error))
        return false;
    fwrite(step->line, 1, step->size, j->ticks.stream); /* file_writer_close tells */
    summary_add(j->summary, step);
    if (j->options->progress)
        j->options->progress(j->summary->ticks, j->summary->total, j->options->context);
    return true;
}

/* Not so where it was stopped. */
static bool is_whole(const joining *j)
{
    return j->summary->ticks == j->summary->total;
}

static bool check_and_write(joining *j, take *t, octreel_error *error)
{
    char *path = path_join(j->options->folder, "ticks.jsonl");
    const film_share all = {.last = j->summary->total};
    bool ok = path ? file_writer_open(&j->ticks, path, error) : error_no_memory(error);
    if (ok) {
        ok = film_ticks(t, &all, join_tick, j, error);
        if (ok && is_whole(j))
            ok = file_writer_close(&j->ticks, error);
        else
            file_writer_abandon(&j->ticks);
    }
    free(path);
    return ok;
}

static void release(joining *j)
{
    for (size_t i = 0; j->streams && i < j->parts.count; i++)
        if (j->streams[i])
            fclose(j->streams[i]);
    free(j->streams);
    free(j->line);
    chunks_release(&j->parts);
}

static bool join_lines(joining *j, const octree_session *session, uint64_t session_digest, octreel_error *error)
{
    take t;
    j->streams = calloc(j->parts.count + 1, sizeof *j->streams);
    if (!j->streams)
        return error_no_memory(error);
    bool ok = take_open(&t, session, j->options, FRAMES_CHECK, error);
    t.session_digest = session_digest;
    ok = ok && check_and_write(j, &t, error);
    take_close(&t);
    return ok;
}

static bool check_renderer_file(const char *folder, octreel_error *error)
{
    return folder_has(folder, "renderer.json") ||
           error_set(error, "%s: renderer.json is missing; octreel record --resume writes it", folder);
}

static bool join_session(joining *j, const octree_session *session, uint64_t digest, octreel_error *error)
{
    const char *folder = j->options->folder;
    j->summary->total = octree_session_length(session) + 1;
    bool ok = chunks_find(folder, j->summary->total, &j->parts, error) &&
              missing_nothing(folder, &j->parts, j->summary->total, j->options->every, error) &&
              check_renderer_file(folder, error) && join_lines(j, session, digest, error);
    if (ok && is_whole(j))
        ok = viewer_write(folder, error) && folder_sweep(folder, error);
    release(j);
    return ok;
}

bool join_parts(film_options *options, film_summary *summary, octreel_error *error)
{
    joining j = {.options = options, .summary = summary};
    session_file file;
    uint64_t digest;
    *summary = (film_summary){0};
    if (!recording_read(options->folder, &options->view, &options->every, error) ||
        !read_session_file(options->folder, &file, &digest, error))
        return false;
    const bool ok = join_session(&j, &file.session, digest, error);
    session_release(&file);
    return ok;
}
