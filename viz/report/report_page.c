/* SPDX-License-Identifier: MIT */
/* report_page.c - writes report.html into the folder of evidence: see report.h.
 *
 * The facts and the pictures are inserted between the two parts of the embedded page. The facts are lines of JSON: one
 * line for the whole comparison and one for each differing group. The pictures follow. Each picture is copied from disk
 * block by block, so that no picture is ever in memory as a whole. */
#include "evidence_page.h"
#include "frame_file.h"
#include "link.h"
#include "report_json.h"
#include "text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A group that the page shows, and whether its pictures are embedded in the page. */
typedef struct page_group {
    size_t group;
    bool embedded;
} page_group;

/* The groups on the page, in the order of the report. */
typedef struct page {
    const diff_report *report;
    FILE *out;
    page_group groups[DIFF_REPORT_PAGE_FRAMES];
    size_t count, left_out;
} page;

/* Return the index of the first pair of the n-th group on the page. */
static size_t first_pair_of_group(const page *p, size_t n)
{
    return p->report->groups->groups[p->groups[n].group].first;
}

/* ---- Contents ------------------------------------------------------------------------------------------------ */

/* Return whether a picture is embedded in the page. A picture that cannot be read is not embedded, because no
 * browser can show it. */
static bool is_embedded(const diff_report *report, size_t i, evidence_picture picture)
{
    return (report->evidence->pictures[i] & 1u << picture) && report->result->pairs[i].finding != FOUND_UNREADABLE;
}

static uint64_t sum_picture_sizes(const diff_report *report, size_t i)
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

static void choose_groups_for_page(page *p)
{
    const frame_groups *g = p->report->groups;
    uint64_t room = DIFF_REPORT_PAGE_BYTES;
    for (size_t group = 0; group < g->count; group++) {
        if (!frame_group_fails(&g->groups[group], p->report->result))
            continue;
        if (p->count == DIFF_REPORT_PAGE_FRAMES) {
            p->left_out++;
            continue;
        }
        const uint64_t size = sum_picture_sizes(p->report, g->groups[group].first);
        p->groups[p->count++] = (page_group){group, size <= room};
        room -= size <= room ? size : 0;
    }
}

/* ---- Facts --------------------------------------------------------------------------------------------------- */

/* Write the number of differing pixels of each pair, and the names of the first and the last pair. Write null if the
 * pixels were not counted, for example because the pictures have different sizes. */
static void write_pixel_counts(json_writer *w, const diff_result *result)
{
    json_begin_array_member(w, "pixels");
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
    json_begin_array_member(w, "ends");
    if (result->count > 0) {
        json_write_string(w, diff_pair_name(&result->pairs[0]));
        json_write_string(w, diff_pair_name(&result->pairs[result->count - 1]));
    }
    json_write_end_array(w);
}

static int compare_group(const void *key, const void *element)
{
    const size_t group = *(const size_t *)key, other = ((const page_group *)element)->group;
    return (group > other) - (group < other);
}

/* Write, for each pair, the position of its group on the page, or null if the page does not show its group. */
static void write_group_positions(json_writer *w, const page *p)
{
    json_begin_array_member(w, "entries");
    for (size_t i = 0; i < p->report->result->count; i++) {
        const page_group *found =
            bsearch(&p->report->groups->of[i], p->groups, p->count, sizeof *p->groups, compare_group);
        if (found)
            json_write_integer(w, (uint64_t)(found - p->groups));
        else
            json_write_null(w);
    }
    json_write_end_array(w);
}

/* Write the relative addresses of the pages of the two recordings, as far as they exist. */
static void write_recordings(json_writer *w, const diff_report *report)
{
    const diff_side *const sides[] = {report->a, report->b};
    json_begin_object_member(w, "recordings");
    for (int i = 0; i < 2; i++) {
        char *folder = sides[i]->kind == DIFF_RECORDING && link_has_page(sides[i]->path)
                           ? link_make_relative_path(report->evidence->folder, sides[i]->path)
                           : NULL;
        if (folder)
            json_write_text_member(w, evidence_picture_name(i ? EVIDENCE_ACTUAL : EVIDENCE_EXPECTED), folder);
        free(folder);
    }
    json_write_end_object(w);
}

/* Write the tick of a pair of frames and, if the facts about this tick name a point, the id of the first such point.
 * Write nothing if the frames are not named after a tick. */
static void write_tick_and_point(json_writer *w, const page *p, size_t pair)
{
    uint64_t tick;
    if (!frame_parse_name(diff_pair_name(&p->report->result->pairs[pair]), &tick))
        return;
    json_write_integer_member(w, "tick", tick);
    const cause_tick *cause = cause_find_tick(&p->report->why->cause, tick);
    for (size_t i = 0; cause && i < cause->facts.count; i++) {
        const cause_group *group = &cause->facts.groups[i];
        if (cause_count_listed(group) && group->listed[0].id != CAUSE_NO_ID) {
            json_write_integer_member(w, "point", group->listed[0].id);
            return;
        }
    }
}

static void write_comparison(json_writer *w, const page *p)
{
    json_write_begin_object(w);
    diff_json_summary(w, p->report);
    json_write_text_member(w, "verdict_words", p->report->groups->verdict);
    json_write_text_member(w, "tolerance_words", p->report->groups->tolerance);
    json_write_integer_member(w, "different", p->count + p->left_out);
    json_write_integer_member(w, "left_out", p->left_out);
    write_recordings(w, p->report);
    write_pixel_counts(w, p->report->result);
    write_group_positions(w, p);
    json_write_end_object(w);
    json_write_end_line(w);
}

/* Write the file names of the pictures that are stored in the same folder as the page. */
static void write_file_names(json_writer *w, const diff_report *report, size_t i)
{
    json_begin_object_member(w, "files");
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *name = NULL;
        if (report->evidence->pictures[i] & 1u << picture)
            name = evidence_file_name(diff_pair_name(&report->result->pairs[i]), (evidence_picture)picture);
        if (name)
            json_write_text_member(w, evidence_picture_name((evidence_picture)picture), name);
        free(name);
    }
    json_write_end_object(w);
}

static void write_group(json_writer *w, const page *p, size_t n)
{
    const size_t group = p->groups[n].group;
    json_write_begin_object(w);
    diff_json_finding(w, p->report, first_pair_of_group(p, n));
    json_write_text_member(w, "words", p->report->groups->groups[group].difference);
    json_write_text_member(w, "frames_words", p->report->groups->groups[group].frames);
    diff_json_group_frames(w, p->report, group);
    write_file_names(w, p->report, first_pair_of_group(p, n));
    write_tick_and_point(w, p, first_pair_of_group(p, n));
    json_write_bool_member(w, "embedded", p->groups[n].embedded);
    json_write_end_object(w);
    json_write_end_line(w);
}

/* Write lines of JSON into the HTML page. The lines are built in memory first, because each "<" is escaped: "</" in
 * a JSON string would end the enclosing HTML element. In JSON, "<" occurs only in strings. */
static bool write_facts(const page *p, octreel_error *error)
{
    text_stream s;
    char *text;
    if (text_stream_begin(&s)) {
        json_writer w = {.out = s.stream};
        write_comparison(&w, p);
        for (size_t n = 0; n < p->count; n++)
            write_group(&w, p, n);
    }
    if (!text_stream_end(&s, &text))
        return error_no_memory(error);
    fputs("<script type=\"application/x-ndjson\" id=\"facts\">", p->out);
    for (const char *at = text; *at; at++)
        if (*at == '<')
            fputs("\\u003c", p->out);
        else
            putc(*at, p->out);
    fputs("</script>\n", p->out);
    free(text);
    return true;
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

static bool write_picture(const page *p, size_t n, evidence_picture picture, octreel_error *error)
{
    char *path = evidence_path(p->report->evidence, p->report->result, first_pair_of_group(p, n), picture);
    FILE *in = path ? fopen(path, "rb") : NULL;
    if (!in) {
        const int reason = path ? errno : ENOMEM;
        error_set(error, "%s: cannot be read: %s", path ? path : p->report->evidence->folder, strerror(reason));
        free(path);
        return false;
    }
    fprintf(p->out, "<img data-frame=\"%zu\" data-picture=\"%s\" src=\"data:image/png;base64,", n,
            evidence_picture_name(picture));
    base64_encode(in, p->out);
    fputs("\">\n", p->out);
    const bool ok = !ferror(in) || error_set(error, "%s: cannot be read: %s", path, strerror(errno));
    fclose(in);
    free(path);
    return ok;
}

/* Write the pictures in template elements, so that the browser decodes a picture only when the page shows it. */
static bool write_pictures(const page *p, octreel_error *error)
{
    bool ok = true;
    fputs("<template id=\"pictures\">\n", p->out);
    for (size_t n = 0; n < p->count; n++)
        for (int picture = 0; ok && p->groups[n].embedded && picture < EVIDENCE_PICTURES; picture++)
            if (is_embedded(p->report, first_pair_of_group(p, n), (evidence_picture)picture))
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
        choose_groups_for_page(&p);
        ok = write_page(&p, error) ? file_writer_close(&file, error) : file_writer_discard(&file);
    }
    free(path);
    return ok;
}
