/* report_markdown.c - a comparison for the page of a CI job: see report.h. */
#include "report.h"
#include "escaped.h"

#include <inttypes.h>
#include <stdlib.h>

static void write_text(FILE *out, const char *text)
{
    write_escaped(out, text, escape_markdown);
}

/* A name: as HTML, for between backticks nothing can be escaped. */
static void write_name(FILE *out, const char *name)
{
    fputs("<code>", out);
    write_text(out, name);
    fputs("</code>", out);
}

/* What another function prints, escaped. */
typedef struct words {
    FILE *stream;
    char *text;
    size_t size;
} words;

static bool words_begin(words *w)
{
    *w = (words){.stream = NULL};
    w->stream = open_memstream(&w->text, &w->size);
    return w->stream != NULL;
}

static void words_end(words *w, FILE *out)
{
    fclose(w->stream);
    write_text(out, w->text ? w->text : "");
    free(w->text);
}

static bool has_causes(const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (result->pairs[i].cause)
            return true;
    return false;
}

static void write_pixels(FILE *out, const diff_pair *pair)
{
    const image_difference *d = &pair->difference;
    const uint64_t all = (uint64_t)pair->about[0].width * (uint64_t)pair->about[0].height;
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixels", d->counted.pixels, all);
    if (d->unlike.pixels > d->counted.pixels)
        fprintf(out, ", %" PRIu64 " more forgiven", d->unlike.pixels - d->counted.pixels);
    fprintf(out, " | %.4f " IMAGE_DELTA_UNIT " at (%d,%d)", diff_shown_delta(d->counted.worst_delta),
            d->counted.worst_x, d->counted.worst_y);
}

static void write_row(FILE *out, const diff_pair *pair, bool causes)
{
    words w;
    fputs("| ", out);
    write_name(out, diff_pair_name(pair));
    fputs(" | ", out);
    if (pair->finding == FOUND_PIXELS) {
        write_pixels(out, pair);
    } else if (words_begin(&w)) {
        diff_print_difference(w.stream, pair);
        words_end(&w, out);
        fputs(" |", out);
    }
    fputs(" |", out);
    if (causes) {
        putc(' ', out);
        write_text(out, pair->cause ? pair->cause : "");
        fputs(" |", out);
    }
    putc('\n', out);
}

static void write_table(FILE *out, const diff_result *result)
{
    const bool causes = has_causes(result);
    size_t rows = 0;
    fprintf(out, "\n| frame | difference | worst |%s\n|---|---|---|%s\n", causes ? " cause |" : "",
            causes ? "---|" : "");
    for (size_t i = 0; i < result->count; i++)
        if (diff_finding_verdict(result->pairs[i].finding) != DIFF_SAME && rows++ < DIFF_REPORT_ROWS)
            write_row(out, &result->pairs[i], causes);
    if (rows > DIFF_REPORT_ROWS)
        fprintf(out, "\nand %zu more\n", rows - DIFF_REPORT_ROWS);
}

static void write_verdict(FILE *out, const diff_report *report)
{
    words w;
    fputs("### octreel diff: ", out);
    if (words_begin(&w)) {
        diff_print_verdict(w.stream, report->result);
        words_end(&w, out);
    }
    fputs("\n\n", out);
    if (report->result->headline) {
        fputs("**", out);
        write_text(out, report->result->headline);
        fputs("**\n\n", out);
    }
    write_name(out, report->b->path);
    fputs(" against ", out);
    write_name(out, report->a->path);
    fputs(", ", out);
    if (words_begin(&w)) {
        diff_print_tolerance(w.stream, report);
        words_end(&w, out);
    }
    fputs(".\n", out);
}

void diff_report_markdown(FILE *out, const diff_report *report)
{
    write_verdict(out, report);
    if (report->result->verdict != DIFF_SAME)
        write_table(out, report->result);
    if (report->evidence) {
        char *page = folder_path(report->evidence->folder, EVIDENCE_PAGE);
        fputs("\nEvidence: ", out);
        write_name(out, page ? page : report->evidence->folder);
        putc('\n', out);
        free(page);
    }
}
