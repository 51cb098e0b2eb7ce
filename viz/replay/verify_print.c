/* SPDX-License-Identifier: MIT */
/* verify_print.c - prints the findings of octreel verify, as text or JSON. */
#include "json_write.h"
#include "text.h"
#include "verify.h"

#include <inttypes.h>
#include <string.h>

static const struct {
    const char *name;  /* the name of the kind in JSON */
    const char *words; /* the text that follows "tick 3 differs" */
} kinds[VERIFY_KINDS] = {
#define VERIFY_ROW(name, word, words) [VERIFY_##name] = {word, words},
    VERIFY_KIND_MAP(VERIFY_ROW)
#undef VERIFY_ROW
};

static void print_identical(FILE *out, const char *folder, const verify_report *report)
{
    write_escaped(out, folder, escape_nothing);
    fprintf(out, ": identical: %" PRIu64 " tick%s, ", report->ticks, plural_ending(report->ticks));
    if (report->has_frames)
        fprintf(out, "%" PRIu64 " frame%s\n", report->frames, plural_ending(report->frames));
    else
        fputs("compared by ticks.jsonl alone, since there are no frames\n", out);
}

static void print_text(FILE *out, const char *folder, const verify_report *report)
{
    const octree_gap *gap = &report->first_gap;
    if (report->count == 0)
        print_identical(out, folder, report);
    if (report->gaps > 0) {
        write_escaped(out, folder, escape_nothing);
        fprintf(out, ": %" PRIu64 " of these ticks %s without data; the first is tick %" PRIu64 ": ", report->gaps,
                report->gaps == 1 ? "is a gap" : "are gaps", gap->tick);
        write_escaped(out, gap->why, escape_nothing);
        fputc('\n', out);
    }
    for (size_t i = 0; i < report->count; i++) {
        const verify_finding *finding = &report->findings[i];
        write_escaped(out, folder, escape_nothing);
        fputs(": ", out);
        if (finding->has_tick)
            fprintf(out, "tick %" PRIu64 " differs%s: ", finding->tick, kinds[finding->kind].words);
        write_escaped(out, finding->text, escape_nothing);
        fputc('\n', out);
    }
}

static void write_string(json_writer *w, const char *key, const char *text)
{
    json_write_key(w, key);
    if (*text)
        json_write_string(w, text);
    else
        json_write_null(w);
}

static void write_finding(json_writer *w, const verify_report *report, const verify_finding *finding)
{
    json_write_begin_object(w);
    write_string(w, "in", kinds[finding->kind].name);
    if (finding->has_tick)
        json_write_integer_member(w, "tick", finding->tick);
    if (*finding->fact)
        write_string(w, "fact", finding->fact);
    if (finding->kind == VERIFY_PIXELS)
        json_write_integer_member(w, "pixels", report->pixels);
    write_string(w, "text", finding->text);
    json_write_end_object(w);
}

static void print_json(FILE *out, const char *folder, const verify_report *report)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    write_string(w, "folder", folder);
    json_write_bool_member(w, "identical", report->count == 0);
    json_write_integer_member(w, "ticks", report->ticks);
    json_write_integer_member(w, "frames", report->frames);
    json_write_integer_member(w, "gaps", report->gaps);
    json_begin_array_member(w, "findings");
    for (size_t i = 0; i < report->count; i++)
        write_finding(w, report, &report->findings[i]);
    json_write_end_array(w);
    write_string(w, "drawn_by", report->drawn_by);
    write_string(w, "drawn_now", report->drawn_now);
    write_string(w, "fill", report->fill);
    json_write_end_object(w);
    json_write_end_line(w);
}

void verify_print(FILE *out, const char *folder, const verify_report *report, bool json)
{
    (json ? print_json : print_text)(out, folder, report);
}
