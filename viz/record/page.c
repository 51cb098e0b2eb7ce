/* viewer.c - see viewer.h. */
#include "page.h"
#include "json_thin.h"
#include "page_html.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

/* A file of the recording while it is read. */
typedef struct source {
    char *path;
    FILE *stream;
    off_t end;      /* of its last whole line */
    uintmax_t line; /* counted from 1 */
} source;

/* A line that was torn when a recording broke off is not a tick. */
static off_t end_of_lines(FILE *stream)
{
    char block[16384];
    off_t at = 0, end = 0;
    for (size_t size; (size = fread(block, 1, sizeof block, stream)) > 0; at += (off_t)size)
        for (size_t i = size; i > 0; i--)
            if (block[i - 1] == '\n') {
                end = at + (off_t)i;
                break;
            }
    return end;
}

static bool fail_to_read(const source *s, octreel_error *error)
{
    return error_set(error, "%s: cannot be read: %s", s->path, strerror(errno));
}

static bool open_source(source *s, const char *folder, const char *name, octreel_error *error)
{
    *s = (source){.path = path_join(folder, name), .line = 1};
    if (!s->path)
        return error_no_memory(error);
    s->stream = fopen(s->path, "rb");
    if (!s->stream)
        return fail_to_read(s, error);
    s->end = end_of_lines(s->stream);
    return (!ferror(s->stream) && fseeko(s->stream, 0, SEEK_SET) == 0) || fail_to_read(s, error);
}

static void close_source(source *s)
{
    if (s->stream)
        fclose(s->stream);
    free(s->path);
}

static bool ends_line(FILE *stream)
{
    int c;
    do
        c = getc(stream);
    while (c == ' ' || c == '\t' || c == '\r');
    return c == '\n';
}

/* An object and the end of its line, as one line of the page. */
static bool copy_object(source *s, FILE *page, octreel_error *error)
{
    const bool opens = ungetc(getc(s->stream), s->stream) == '{';
    if (opens && json_thin(s->stream, page, VIEWER_LIST) && ends_line(s->stream)) {
        putc('\n', page);
        s->line++;
        return true;
    }
    if (ferror(s->stream))
        return fail_to_read(s, error);
    return error_set(error, "%s:%ju: is no JSON object, so index.html cannot be written", s->path, s->line);
}

static bool copy_recording(const char *folder, FILE *page, octreel_error *error)
{
    source s;
    const bool ok = open_source(&s, folder, "recording.json", error) && copy_object(&s, page, error);
    close_source(&s);
    return ok;
}

static bool copy_ticks(const char *folder, FILE *page, octreel_error *error)
{
    source s;
    bool ok = open_source(&s, folder, "ticks.jsonl", error);
    while (ok && ftello(s.stream) < s.end)
        ok = copy_object(&s, page, error);
    close_source(&s);
    return ok;
}

static bool write_page(const char *folder, FILE *page, octreel_error *error)
{
    fwrite(page_html_head, 1, page_html_head_size, page);
    const bool ok = copy_recording(folder, page, error) && copy_ticks(folder, page, error);
    fwrite(page_html_tail, 1, page_html_tail_size, page);
    return ok;
}

bool viewer_write(const char *folder, octreel_error *error)
{
    char *path = path_join(folder, "index.html");
    file_writer file;
    bool ok = path ? file_writer_open(&file, path, error) : error_no_memory(error);
    if (ok)
        ok = write_page(folder, file.stream, error) ? file_writer_close(&file, error) : file_writer_abandon(&file);
    free(path);
    return ok;
}
