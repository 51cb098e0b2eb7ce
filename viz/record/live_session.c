/* live_session.c - see live_session.h. */
#include "live_session.h"
#include "folder_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool live_session_init(live_session *s, const octree_session *start)
{
    octreel_error ignored;
    *s = (live_session){0};
    return session_copy(start, &s->start, &ignored);
}

void live_session_release(live_session *s)
{
    if (s->stream)
        fclose(s->stream);
    free(s->path);
    session_release(&s->start);
    *s = (live_session){0};
}

const octree_session *live_session_start(const live_session *s)
{
    return &s->start.session;
}

static bool fail_to_write(const live_session *s, octreel_error *error)
{
    return error_set(error, "%s: cannot be written: %s", s->path, strerror(errno));
}

/* What was written is there for good, even where the process dies. */
static bool keep(live_session *s, octreel_error *error)
{
    if (fflush(s->stream) != 0 || ferror(s->stream))
        return fail_to_write(s, error);
    s->whole = ftello(s->stream);
    return true;
}

/* What tick 0 asks and shows; what is so at every tick stands in the header. */
static octree_input first_tick(const octree_session *session)
{
    octree_input input = {.queries = session->queries, .shapes = session->shapes};
    while (input.query_count < session->query_count && session->queries[input.query_count].tick == 0)
        input.query_count++;
    while (input.shape_count < session->shape_count && session->shapes[input.shape_count].tick == 0)
        input.shape_count++;
    return input;
}

bool live_session_begin(live_session *s, const char *folder, octreel_error *error)
{
    octree_session header = s->start.session;
    header.ticks = SESSION_ENDLESS;
    s->path = path_join(folder, "session.json.live");
    if (!s->path)
        return error_no_memory(error);
    s->stream = fopen(s->path, "w+b");
    if (!s->stream)
        return fail_to_write(s, error);
    session_write_header(&header, s->stream);
    if (!keep(s, error))
        return false;
    s->head = s->whole;
    const octree_input input = first_tick(&header);
    session_write_tick(0, &input, s->stream);
    return keep(s, error);
}

bool live_session_add(live_session *s, const octree_input *input, octreel_error *error)
{
    if (s->ticks == SESSION_LAST_TICK)
        return error_set(error, "a recording has at most %d ticks", SESSION_LAST_TICK);
    session_write_tick(s->ticks + 1, input, s->stream);
    if (!keep(s, error))
        return false;
    s->ticks++;
    return true;
}

void live_session_abandon(live_session *s)
{
    if (!s->stream)
        return;
    fclose(s->stream);
    s->stream = NULL;
    remove(s->path);
}

/* Copy the ticks behind a header that knows how many there are. */
static bool copy_ticks(live_session *s, FILE *out, octreel_error *error)
{
    char buffer[1 << 16];
    off_t left = s->whole - s->head;
    clearerr(s->stream);
    if (fseeko(s->stream, s->head, SEEK_SET) != 0)
        return fail_to_write(s, error);
    while (left > 0) {
        const size_t wanted = left < (off_t)sizeof buffer ? (size_t)left : sizeof buffer;
        if (fread(buffer, 1, wanted, s->stream) != wanted)
            return error_set(error, "%s: cannot be read", s->path);
        fwrite(buffer, 1, wanted, out); /* file_writer_close tells */
        left -= (off_t)wanted;
    }
    return true;
}

static bool write_session(live_session *s, const char *path, octreel_error *error)
{
    file_writer file;
    octree_session header = s->start.session;
    header.ticks = s->ticks;
    if (!file_writer_open(&file, path, error))
        return false;
    session_write_header(&header, file.stream);
    return copy_ticks(s, file.stream, error) ? file_writer_close(&file, error) : file_writer_abandon(&file);
}

bool live_session_end(live_session *s, const char *folder, uint64_t *digest, octreel_error *error)
{
    char *path = path_join(folder, "session.json");
    bool ok = path ? write_session(s, path, error) : error_no_memory(error);
    ok = ok && digest_session_file(path, digest, error);
    if (ok)
        live_session_abandon(s);
    free(path);
    return ok;
}
