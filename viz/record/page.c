/* SPDX-License-Identifier: MIT */
/* page.c - writes the page of a recording or session. */
#include "page.h"
#include "file.h"
#include "folder_files.h"
#include "frame_file.h"
#include "json_read.h"
#include "packed_points.h"
#include "page_html.h"
#include "text.h"
#include "ticks_write.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

/* ---- Long lists --------------------------------------------------------------------------------------------- */

#define DEPTH 64 /* maximum nesting depth of lists and objects */

/* The state of copying JSON text while entries of long lists are dropped. */
typedef struct cutter {
    FILE *out;
    unsigned depth;
    unsigned cut;         /* depth of the list whose surplus entries are being dropped; 0: no list */
    bool lists[DEPTH];    /* lists[d]: true if the open value at depth d is a list, false if it is an object */
    size_t commas[DEPTH]; /* commas[d]: number of commas so far in the open value at depth d */
    bool quoted, escaped;
} cutter;

/* Update c->quoted and c->escaped by the next character of the text. Returns whether the character belongs to a string,
 * quotes included. */
static bool update_string_state(cutter *c, char at)
{
    const bool was = c->quoted;
    if (!c->escaped && at == '"')
        c->quoted = !c->quoted;
    c->escaped = was && !c->escaped && at == '\\';
    return was || c->quoted;
}

/* Update the depth and the commas by the next character of the text, which is outside strings. Sets c->cut when the
 * open list is full, and clears c->cut at the end of this list. Returns false if brackets do not match or are nested
 * too deeply. */
static bool update_list_state(cutter *c, char at)
{
    if (at == '[' || at == '{') {
        if (++c->depth == DEPTH)
            return false;
        c->lists[c->depth] = at == '[';
        c->commas[c->depth] = 0;
    } else if (at == ']' || at == '}') {
        if (c->depth == 0)
            return false;
        if (c->cut == c->depth) {
            fprintf(c->out, ",{\"more\":%zu}", c->commas[c->depth] - PAGE_LIST + 1);
            c->cut = 0;
        }
        c->depth--;
    } else if (at == ',' && ++c->commas[c->depth] == PAGE_LIST && c->lists[c->depth] && !c->cut) {
        c->cut = c->depth;
    }
    return true;
}

/* Copy JSON text, but keep only the first PAGE_LIST entries of each list. A tick may list a million refused points, so
 * lists are shortened before the text is parsed. The caller frees the copy. If brackets do not match or are nested too
 * deeply, the copy is not JSON. Returns null if memory runs out. */
static char *shorten_lists(const char *text, size_t size, size_t *left)
{
    char *copy;
    text_stream s;
    bool ok = text_stream_begin(&s);
    cutter c = {.out = s.stream};
    size_t from = 0; /* offset of the first character that is neither copied nor dropped yet */
    for (size_t i = 0; ok && i < size; i++) {
        const bool cut = c.cut;
        ok = update_string_state(&c, text[i]) || update_list_state(&c, text[i]);
        if (!cut && c.cut)
            fwrite(text + from, 1, i - from, c.out);
        from = cut && !c.cut ? i : from;
    }
    if (ok && !c.cut)
        fwrite(text + from, 1, size - from, c.out);
    if (s.stream)
        putc(ok ? '\n' : ']', s.stream);
    const bool whole = text_stream_end(&s, &copy);
    *left = s.size;
    return whole ? copy : NULL;
}

/* ---- Ticks -------------------------------------------------------------------------------------------------- */

/* Write JSON text with each '<' escaped, because "</script>" would end the script element of the page. In JSON, '<'
 * occurs only inside strings. */
static void write_escaped_json(FILE *page, const char *text, size_t size)
{
    const char *end = text + size, *found;
    for (; (found = memchr(text, '<', (size_t)(end - text))); text = found + 1) {
        fwrite(text, 1, (size_t)(found - text), page);
        fputs("\\u003c", page);
    }
    fwrite(text, 1, (size_t)(end - text), page);
}

/* Add text to the facts of the page. If the page plays, it has a script that unpacks them. */
static void add_facts(page_writer *w, const char *text, size_t size)
{
    if (page_html_plays)
        packer_add(&w->facts, text, size);
    else if (w->plain.stream)
        write_escaped_json(w->plain.stream, text, size);
}

/* Add a JSON object as one line of ASCII text. Returns false if memory runs out. */
static bool add_object(page_writer *w, const json_t *object)
{
    char *text = json_dumps(object, JSON_COMPACT | JSON_ENSURE_ASCII);
    if (text)
        add_facts(w, text, strlen(text));
    add_facts(w, "\n", 1);
    free(text);
    return text != NULL;
}

/* Add a JSON object to the page. `path` and `line` are the source of the text in error messages. */
static bool add_json_text(page_writer *w, const char *text, size_t size, const char *path, uintmax_t line,
                          octreel_error *error)
{
    size_t left;
    char *cut = shorten_lists(text, size, &left);
    json_error_t why = {0};
    json_t *object = cut ? json_parse(cut, left, 0, &why) : NULL;
    const bool short_of_memory = !cut || (!object && why.line < 0);
    bool ok = false;
    if (short_of_memory || (json_is_object(object) && !(ok = add_object(w, object))))
        error_no_memory(error);
    else if (!ok)
        error_set(error, "%s:%ju: not a JSON object; index.html cannot be written", path, line);
    json_decref(object);
    free(cut);
    return ok;
}

/* ---- Ticks in which nothing happens -------------------------------------------------------------------------- */

/* Most ticks of a long session are like the tick before them. Such a tick is not written as a whole line: if it has a
 * frame, its scene digest is written, otherwise the tick is only counted. The page restores the members that differ:
 * the tick number, the frame and the scene digest. */

/* The part of a tick's line that a repetition shares: the line without "tick", "frame" and "scene". */
typedef struct tick_rest {
    const char *text;
    size_t size;
    bool has_frame;
    uint64_t scene; /* the scene digest; valid if `has_frame` is true */
} tick_rest;

/* Find the part of a line of ticks.jsonl that is the same in a tick and its repetitions: all members except "tick",
 * "frame" and "scene". Returns false if tick_write() did not write the line; such a line is never treated as a
 * repetition. */
static bool find_repeatable_part(const char *line, size_t size, uint64_t tick, tick_rest *rest)
{
    char begin[40], name[FRAME_NAME];
    const size_t begins = (size_t)snprintf(begin, sizeof begin, "{\"tick\": %" PRIu64 ", ", tick);
    rest->has_frame = tick_read_scene_digest(line, size, tick, &rest->scene);
    const size_t ends = rest->has_frame ? strlen(", \"frame\": \"\", \"scene\": \"0123456789abcdef\"}\n") +
                                              strlen(frame_print_name(tick, name))
                                        : strlen("}\n");
    if (size < begins + ends || memcmp(line, begin, begins) != 0 || memcmp(line + size - 2, "}\n", 2) != 0)
        return false;
    rest->text = line + begins;
    rest->size = size - begins - ends;
    return true;
}

static void add_repetition_count(page_writer *w)
{
    char text[24];
    if (w->repeated > 0)
        add_facts(w, text, (size_t)snprintf(text, sizeof text, "%" PRIu64 "\n", w->repeated));
    w->repeated = 0;
}

/* If a tick repeats the last tick, add it as a repetition and return true. */
static bool add_tick_as_repetition(page_writer *w, const tick_rest *rest)
{
    char digest[DIGEST_TEXT], text[DIGEST_TEXT + 4];
    if (!w->rest || rest->size != w->rest_size || memcmp(rest->text, w->rest, rest->size) != 0)
        return false;
    w->repeated += !rest->has_frame;
    if (!rest->has_frame)
        return true;
    add_repetition_count(w);
    add_facts(w, text, (size_t)snprintf(text, sizeof text, "\"%s\"\n", digest_print(rest->scene, digest)));
    return true;
}

/* Store the part of a tick's line that later ticks may repeat. `rest` is null if no tick can repeat this tick. Returns
 * false if memory runs out. */
static bool store_repeatable_part(page_writer *w, const tick_rest *rest)
{
    free(w->rest);
    w->rest_size = rest ? rest->size : 0;
    w->rest = rest ? malloc(rest->size + 1) : NULL;
    if (w->rest)
        memcpy(w->rest, rest->text, rest->size);
    return w->rest || !rest;
}

static bool add_tick(page_writer *w, const char *path, const char *line, size_t size, const tick_rest *rest,
                     octreel_error *error)
{
    add_repetition_count(w);
    return add_json_text(w, line, size, path, w->ticks + 1, error) &&
           (store_repeatable_part(w, rest) || error_no_memory(error));
}

/* ---- A page ------------------------------------------------------------------------------------------------- */

bool page_can_play(void)
{
    return page_html_plays;
}

bool page_begin(page_writer *w, const char *path, const char *recording, size_t size, octreel_error *error)
{
    *w = (page_writer){.ticks = 0};
    if (page_html_plays)
        packer_begin(&w->facts);
    else if (!text_stream_begin(&w->plain))
        return error_no_memory(error);
    return add_json_text(w, recording, size, path, 1, error);
}

bool page_add_tick(page_writer *w, const char *path, const char *line, size_t size, octreel_error *error)
{
    tick_rest rest;
    const bool repeatable = find_repeatable_part(line, size, w->ticks, &rest);
    const bool ok = (repeatable && add_tick_as_repetition(w, &rest)) ||
                    add_tick(w, path, line, size, repeatable ? &rest : NULL, error);
    w->ticks++;
    return ok;
}

static bool write_packed_facts(page_writer *w, FILE *page)
{
    size_t size;
    unsigned char *facts = packer_end(&w->facts, &size);
    if (facts)
        write_letters(page, facts, size);
    free(facts);
    return facts != NULL;
}

static bool write_plain_facts(page_writer *w, FILE *page)
{
    char *facts;
    const bool ok = text_stream_end(&w->plain, &facts);
    if (facts)
        fwrite(facts, 1, w->plain.size, page);
    free(facts);
    w->plain = (text_stream){0};
    return ok;
}

/* Write the page up to the text of the session. */
static bool begin_session_element(page_writer *w, FILE *page, octreel_error *error)
{
    add_repetition_count(w);
    fwrite(page_html_head, 1, page_html_head_size, page);
    if (!(page_html_plays ? write_packed_facts : write_plain_facts)(w, page))
        return error_no_memory(error);
    fputs("</script>\n<script type=\"application/json\" id=\"session\">", page);
    return true;
}

static void write_page_tail(FILE *page)
{
    fwrite(page_html_tail, 1, page_html_tail_size, page);
}

bool page_end(page_writer *w, FILE *page, const char *session, size_t size, octreel_error *error)
{
    if (!begin_session_element(w, page, error))
        return false;
    if (size <= PAGE_MOST_SESSION)
        write_escaped_json(page, session, size);
    write_page_tail(page);
    return true;
}

bool page_end_with_points(page_writer *w, FILE *page, const char *session, size_t size, const unsigned char *points,
                          size_t points_size, bool cloud, octreel_error *error)
{
    if (!begin_session_element(w, page, error))
        return false;
    write_escaped_json(page, session, size);
    fprintf(page, "</script>\n<script type=\"application/gzip;z85\" id=\"points\"%s>", cloud ? " data-cloud" : "");
    write_letters(page, points, points_size);
    write_page_tail(page);
    return true;
}

bool page_end_with_packed_session(page_writer *w, FILE *page, const octree_session *session, const point_values *values,
                                  octreel_error *error)
{
    octree_session rest = *session;
    session_bytes text = {0};
    size_t size = 0;
    rest.bodies = NULL;
    rest.body_count = 0;
    unsigned char *points = pack_points_of_session(session, values, &size);
    const bool ok = points ? make_session_bytes(&rest, NULL, &text, error) &&
                                 page_end_with_points(w, page, text.bytes, text.size, points, size, false, error)
                           : error_no_memory(error);
    free(text.bytes);
    free(points);
    return ok;
}

void page_release(page_writer *w)
{
    packer_release(&w->facts);
    if (w->plain.stream)
        fclose(w->plain.stream);
    free(w->plain.text);
    free(w->rest);
    *w = (page_writer){0};
}

/* ---- The page of a folder ----------------------------------------------------------------------------------- */

bool page_begin_folder(page_writer *w, const char *folder, octreel_error *error)
{
    char *path = path_join(folder, "recording.json"), *text = NULL;
    size_t size;
    bool ok = path || error_no_memory(error);
    *w = (page_writer){.ticks = 0};
    if (ok)
        ok = file_read_whole(path, &text, &size, error) && page_begin(w, path, text, size, error);
    free(text);
    free(path);
    return ok;
}

/* Add each line of ticks.jsonl to the page. A last line without a newline is ignored, because its writer was
 * interrupted. */
static bool add_ticks_of_file(page_writer *w, const char *path, octreel_error *error)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t size;
    char reason[FILE_REASON];
    FILE *ticks = file_open(path, NULL, reason);
    if (!ticks)
        return error_set(error, "%s: %s", path, reason);
    bool ok = true;
    while (ok && (size = getline(&line, &room, ticks)) > 0 && line[size - 1] == '\n')
        ok = page_add_tick(w, path, line, (size_t)size, error);
    if (ferror(ticks))
        ok = error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    fclose(ticks);
    free(line);
    return ok;
}

/* Copy session.json in pieces, because the session of a long recording is large. */
static bool copy_session(FILE *page, const char *path, octreel_error *error)
{
    char piece[1 << 14];
    char reason[FILE_REASON];
    FILE *in = file_open(path, NULL, reason);
    if (!in)
        return error_set(error, "%s: %s", path, reason);
    for (size_t size; (size = fread(piece, 1, sizeof piece, in)) > 0;)
        write_escaped_json(page, piece, size);
    const bool ok = !ferror(in) || error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    fclose(in);
    return ok;
}

static bool end_page_with_file(page_writer *w, FILE *page, const char *path, octreel_error *error)
{
    struct stat status;
    if (!begin_session_element(w, page, error))
        return false;
    const bool has = stat(path, &status) == 0 && (uintmax_t)status.st_size <= PAGE_MOST_SESSION;
    const bool ok = !has || copy_session(page, path, error);
    write_page_tail(page);
    return ok;
}

static bool read_folder(page_writer *w, const char *folder, octreel_error *error)
{
    char *ticks = path_join(folder, "ticks.jsonl");
    const bool ok =
        ticks ? page_begin_folder(w, folder, error) && add_ticks_of_file(w, ticks, error) : error_no_memory(error);
    free(ticks);
    return ok;
}

static bool end_page_of_folder(page_writer *w, FILE *page, const char *folder, const octree_session *session,
                               const point_values *values, octreel_error *error)
{
    if (session && are_points_packed(session, values))
        return page_end_with_packed_session(w, page, session, values, error);
    char *path = path_join(folder, "session.json");
    const bool ok = path ? end_page_with_file(w, page, path, error) : error_no_memory(error);
    free(path);
    return ok;
}

bool page_write(page_writer *made, const char *folder, const octree_session *session, const point_values *values,
                octreel_error *error)
{
    page_writer read = {0}, *w = made ? made : &read;
    file_writer file;
    char *path = path_join(folder, "index.html");
    bool ok = path ? file_writer_open_replacing(&file, path, error) : error_no_memory(error);
    if (ok)
        ok = (made || read_folder(w, folder, error)) &&
                     end_page_of_folder(w, file.stream, folder, session, values, error)
                 ? file_writer_close(&file, error)
                 : file_writer_discard(&file);
    page_release(&read);
    free(path);
    return ok;
}
