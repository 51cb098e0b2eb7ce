/* SPDX-License-Identifier: MIT */
/* report_page.c - writes report.html into the folder of evidence: see report.h.
 *
 * Between the page's two halves go the facts, a line of JSON for the whole and one for each group that differs, and
 * then the pictures. They stay on the disk until they are copied, a block at a time.
 */
#include "diff_words.h"
#include "evidence_page.h"
#include "report_json.h"
#include "text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The first pairs of the groups on the page, in the order of the groups. */
typedef struct page {
    const diff_report *report;
    FILE *out;
    size_t pairs[DIFF_REPORT_PAGE_FRAMES];
    bool embedded[DIFF_REPORT_PAGE_FRAMES];
    size_t count, left_out;
} page;

/* ---- Contents ------------------------------------------------------------------------------------------------ */

/* Unreadable pictures are left out: a browser cannot show them. */
static bool is_embedded(const diff_report *report, size_t i, evidence_picture picture)
{
    return (report->evidence->pictures[i] & 1u << picture) && report->result->pairs[i].finding != FOUND_UNREADABLE;
}

static uint64_t pictures_size(const diff_report *report, size_t i)
{
    uint64_t sum = 0;
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        struct stat status;
        char *path = is_embedded(report, i, (evidence_picture)picture)
                         ? evidence_path(report->evidence, report->result, i, (evidence_picture)picture)
                         : NULL;
        if (path && stat(path, &status) == 0)
            sum += (uint64_t)status.st_size;
        free(path);
    }
    return sum;
}

static void choose_pairs(page *p)
{
    const diff_result *result = p->report->result;
    uint64_t room = DIFF_REPORT_PAGE_BYTES;
    for (size_t group = 0; group < p->report->groups->count; group++) {
        const size_t i = p->report->groups->groups[group].first;
        if (diff_finding_verdict(result->pairs[i].finding) == DIFF_SAME)
            continue;
        if (p->count == DIFF_REPORT_PAGE_FRAMES) {
            p->left_out++;
            continue;
        }
        const uint64_t size = pictures_size(p->report, i);
        p->embedded[p->count] = size <= room;
        room -= size <= room ? size : 0;
        p->pairs[p->count++] = i;
    }
}

/* ---- Facts --------------------------------------------------------------------------------------------------- */

/* A line of JSON. It is built in memory because "</" in it would end the HTML element and must be escaped. */
typedef struct fact_line {
    text_stream made;
    json_writer writer;
} fact_line;

static bool line_begin(fact_line *line)
{
    *line = (fact_line){.writer = {.out = NULL}};
    if (!text_stream_begin(&line->made))
        return false;
    line->writer.out = line->made.stream;
    json_write_begin_object(&line->writer);
    return true;
}

/* Escape "<", which occurs only in strings of JSON. */
static bool line_end(fact_line *line, FILE *out)
{
    char *text;
    json_write_end_object(&line->writer);
    json_write_end_line(&line->writer);
    const bool ok = text_stream_end(&line->made, &text);
    for (const char *at = ok ? text : ""; *at; at++)
        if (*at == '<')
            fputs("\\u003c", out);
        else
            putc(*at, out);
    free(text);
    return ok;
}

/* Write a member whose text was printed into a stream. */
static bool write_words(json_writer *w, const char *key, text_stream *s)
{
    char *text;
    if (!text_stream_end(s, &text))
        return false;
    json_member_text(w, key, text ? text : "");
    free(text);
    return true;
}

typedef void printer(FILE *out, const diff_report *report);

static bool write_line(json_writer *w, const char *key, printer *print, const diff_report *report)
{
    text_stream s;
    if (text_stream_begin(&s))
        print(s.stream, report);
    return write_words(w, key, &s);
}

/* Write the number of differing pixels of each pair; null if they were not counted, as for pictures of different sizes.
 */
static void write_curve(json_writer *w, const diff_result *result)
{
    json_member_begin_array(w, "pixels");
    for (size_t i = 0; i < result->count; i++) {
        const diff_pair *pair = &result->pairs[i];
        if (diff_finding_verdict(pair->finding) == DIFF_SAME)
            json_write_integer(w, 0);
        else if (pair->finding == FOUND_PIXELS)
            json_write_integer(w, pair->difference.counted.pixels);
        else
            json_write_null(w);
    }
    json_write_end_array(w);
    json_member_begin_array(w, "ends");
    if (result->count > 0) {
        json_write_string(w, diff_pair_name(&result->pairs[0]));
        json_write_string(w, diff_pair_name(&result->pairs[result->count - 1]));
    }
    json_write_end_array(w);
}

/* Write for each pair the number of its group on the page, or null. */
static void write_entries(json_writer *w, const page *p)
{
    const frame_groups *g = p->report->groups;
    json_member_begin_array(w, "entries");
    for (size_t i = 0; i < p->report->result->count; i++) {
        size_t n = 0;
        while (g->of[i] != GROUP_NONE && n < p->count && p->pairs[n] != g->groups[g->of[i]].first)
            n++;
        if (g->of[i] != GROUP_NONE && n < p->count)
            json_write_integer(w, n);
        else
            json_write_null(w);
    }
    json_write_end_array(w);
}

static bool write_whole(const page *p)
{
    fact_line line;
    if (!line_begin(&line))
        return false;
    diff_json_summary(&line.writer, p->report);
    const bool ok = write_line(&line.writer, "verdict_words", diff_print_summary, p->report) &&
                    write_line(&line.writer, "tolerance_words", diff_print_tolerance, p->report);
    json_member_integer(&line.writer, "different", p->count + p->left_out);
    json_member_integer(&line.writer, "left_out", p->left_out);
    write_curve(&line.writer, p->report->result);
    write_entries(&line.writer, p);
    return line_end(&line, p->out) && ok;
}

/* Write the names of the files beside the page. */
static void write_files(json_writer *w, const diff_report *report, size_t i)
{
    json_member_begin_object(w, "files");
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *name = NULL;
        if (report->evidence->pictures[i] & 1u << picture)
            name = evidence_name(diff_pair_name(&report->result->pairs[i]), (evidence_picture)picture);
        if (name)
            json_member_text(w, evidence_word((evidence_picture)picture), name);
        free(name);
    }
    json_write_end_object(w);
}

static bool write_pair(const page *p, size_t n)
{
    const size_t i = p->pairs[n];
    const diff_pair *pair = &p->report->result->pairs[i];
    fact_line line;
    if (!line_begin(&line))
        return false;
    diff_json_finding(&line.writer, p->report, i);
    text_stream words;
    if (text_stream_begin(&words))
        diff_print_difference(words.stream, pair);
    bool ok = write_words(&line.writer, "words", &words);
    if (text_stream_begin(&words))
        frame_group_print(words.stream, p->report->groups, p->report->result, p->report->groups->of[i], false);
    ok = write_words(&line.writer, "frames_words", &words) && ok;
    diff_json_group(&line.writer, p->report, p->report->groups->of[i]);
    write_files(&line.writer, p->report, i);
    json_member_bool(&line.writer, "embedded", p->embedded[n]);
    return line_end(&line, p->out) && ok;
}

static bool write_facts(const page *p, octreel_error *error)
{
    fputs("<script type=\"application/x-ndjson\" id=\"facts\">", p->out);
    bool ok = write_whole(p);
    for (size_t n = 0; ok && n < p->count; n++)
        ok = write_pair(p, n);
    fputs("</script>\n", p->out);
    return ok || error_no_memory(error);
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

static bool write_picture(const page *p, size_t n, evidence_picture picture, octreel_error *error)
{
    char *path = evidence_path(p->report->evidence, p->report->result, p->pairs[n], picture);
    FILE *in = path ? fopen(path, "rb") : NULL;
    if (!in) {
        const int reason = path ? errno : ENOMEM;
        error_set(error, "%s: cannot be read: %s", path ? path : p->report->evidence->folder, strerror(reason));
        free(path);
        return false;
    }
    fprintf(p->out, "<img data-frame=\"%zu\" data-picture=\"%s\" src=\"data:image/png;base64,", n,
            evidence_word(picture));
    base64_copy(in, p->out);
    fputs("\">\n", p->out);
    const bool ok = !ferror(in) || error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    fclose(in);
    free(path);
    return ok;
}

/* Pictures are in template elements, so that the browser decodes them only when the page shows them. */
static bool write_pictures(const page *p, octreel_error *error)
{
    bool ok = true;
    fputs("<template id=\"pictures\">\n", p->out);
    for (size_t n = 0; n < p->count; n++)
        for (int picture = 0; ok && p->embedded[n] && picture < EVIDENCE_PICTURES; picture++)
            if (is_embedded(p->report, p->pairs[n], (evidence_picture)picture))
                ok = write_picture(p, n, (evidence_picture)picture, error);
    fputs("</template>\n", p->out);
    return ok;
}

static bool write_page(const page *p, octreel_error *error)
{
    fwrite(evidence_page_head, 1, evidence_page_head_size, p->out);
    const bool ok = write_facts(p, error) && write_pictures(p, error);
    fwrite(evidence_page_tail, 1, evidence_page_tail_size, p->out);
    return ok;
}

bool diff_report_page(const diff_report *report, octreel_error *error)
{
    char *path = path_join(report->evidence->folder, EVIDENCE_PAGE);
    file_writer file;
    bool ok = path ? file_writer_open_replacing(&file, path, error) : error_no_memory(error);
    if (ok) {
        page p = {.report = report, .out = file.stream};
        choose_pairs(&p);
        ok = write_page(&p, error) ? file_writer_close(&file, error) : file_writer_abandon(&file);
    }
    free(path);
    return ok;
}
