/* verify_report.c - what verifying found; see verify.h. */
#include "json_write.h"
#include "plural.h"
#include "verify.h"

#include <inttypes.h>

#define VERIFY_WORD(name, word) [VERIFY_##name] = word,
static const char *const words[VERIFY_KINDS] = {VERIFY_KIND_MAP(VERIFY_WORD)};
#undef VERIFY_WORD

/* What a sentence about a tick begins with. */
static const char *const beginnings[VERIFY_KINDS] = {
    [VERIFY_SESSION] = "",
    [VERIFY_VIEW] = " in its size",
    [VERIFY_LINES] = "",
    [VERIFY_FACTS] = " in what happened",
    [VERIFY_SCENE] = " in what is drawn",
    [VERIFY_FRAME] = " in its frame",
    [VERIFY_PIXELS] = ", only in its pixels",
};

static void print_people(FILE *out, const char *folder, const verify_report *report)
{
    if (report->count == 0)
        fprintf(out, "%s: identical: %" PRIu64 " tick%s, %" PRIu64 " frame%s\n", folder, report->ticks,
                plural(report->ticks), report->frames, plural(report->frames));
    for (size_t i = 0; i < report->count; i++) {
        const verify_finding *finding = &report->findings[i];
        fprintf(out, "%s: ", folder);
        if (finding->has_tick)
            fprintf(out, "tick %" PRIu64 " differs%s: ", finding->tick, beginnings[finding->kind]);
        fprintf(out, "%s\n", finding->text);
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
    write_string(w, "in", words[finding->kind]);
    if (finding->has_tick)
        json_member_integer(w, "tick", finding->tick);
    if (*finding->fact)
        write_string(w, "fact", finding->fact);
    if (finding->kind == VERIFY_PIXELS)
        json_member_integer(w, "pixels", report->pixels);
    write_string(w, "text", finding->text);
    json_write_end_object(w);
}

static void print_json(FILE *out, const char *folder, const verify_report *report)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    write_string(w, "folder", folder);
    json_write_key(w, "identical");
    json_write_bool(w, report->count == 0);
    json_member_integer(w, "ticks", report->ticks);
    json_member_integer(w, "frames", report->frames);
    json_write_key(w, "findings");
    json_write_begin_array(w);
    for (size_t i = 0; i < report->count; i++)
        write_finding(w, report, &report->findings[i]);
    json_write_end_array(w);
    write_string(w, "drawn_by", report->drawn_by);
    write_string(w, "drawn_now", report->drawn_now);
    json_write_end_object(w);
    json_write_end_line(w);
}

void verify_print(FILE *out, const char *folder, const verify_report *report, bool json)
{
    (json ? print_json : print_people)(out, folder, report);
}
