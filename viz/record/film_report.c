/* film_report.c - see film_report.h. */
#include "film_report.h"
#include "film_commands.h"
#include "json_write.h"
#include "text.h"

#include <inttypes.h>
#include <string.h>

static double rate_of(const film_summary *summary, double seconds)
{
    return seconds > 0 ? (double)summary->frames / seconds : 0;
}

static void report_json(FILE *out, const film_summary *summary, const char *folder, double seconds)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_key(w, "folder");
    json_write_string(w, folder);
    json_write_key(w, "ticks");
    json_write_integer(w, summary->ticks);
    json_write_key(w, "frames");
    json_write_integer(w, summary->frames);
    json_write_key(w, "left_out");
    json_write_integer(w, summary->left_out);
    json_write_key(w, "over_budget");
    json_write_integer(w, summary->over_budget);
    json_write_key(w, "seconds");
    json_write_number(w, seconds);
    json_write_key(w, "frames_per_second");
    json_write_number(w, rate_of(summary, seconds));
    json_write_key(w, "events");
    json_write_begin_object(w);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++) {
        json_write_key(w, octree_event_name(1u << i));
        json_write_integer(w, summary->events[i]);
    }
    json_write_end_object(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

/* A word as a shell reads it. */
static void put_word(FILE *out, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+:,";
    if (*text && strspn(text, plain) == strlen(text)) {
        fputs(text, out);
        return;
    }
    fputs(*text == '-' ? "'./" : "'", out);
    for (; *text; text++)
        fputs(*text == '\'' ? "'\\''" : (char[]){*text, 0}, out);
    putc('\'', out);
}

void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options)
{
    if (summary->ticks == 0) {
        fputs("octreel: stopped before a tick was filmed\n", out);
        return;
    }
    fprintf(out, "octreel: stopped after %" PRIu64 " of %" PRIu64 " ticks; to go on: octreel record --resume",
            summary->ticks, summary->total);
    if (options->last != 0)
        fprintf(out, " --ticks %" PRIu64 ":%" PRIu64, options->first, options->first + summary->total);
    fputs(" -o ", out);
    put_word(out, options->folder);
    putc('\n', out);
}

static void report_part(FILE *out, const film_summary *summary, const film_options *options)
{
    fprintf(out, "a part, from tick %" PRIu64 " to %" PRIu64 "; when all parts are there: octreel join ",
            options->first, options->first + summary->ticks - 1);
    put_word(out, options->folder);
    putc('\n', out);
}

void film_report(FILE *out, const film_summary *summary, const film_options *options, double seconds, bool json)
{
    const char *folder = options->folder;
    if (json) {
        report_json(out, summary, folder, seconds);
        return;
    }
    fprintf(out, "%s: %" PRIu64 " tick%s, %" PRIu64 " frame%s, %.1f s, %.0f frames a second\n", folder, summary->ticks,
            plural(summary->ticks), summary->frames, plural(summary->frames), seconds, rate_of(summary, seconds));
    if (summary->left_out)
        fprintf(out, "%" PRIu64 " elements are not in their frames: they are too far off to be drawn\n",
                summary->left_out);
    if (summary->over_budget)
        fprintf(out, "%" PRIu64 " frames leave out what is beyond --budget\n", summary->over_budget);
    fputs("ticks that", out);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        fprintf(out, "%s %s %" PRIu64, i ? "," : "", octree_event_name(1u << i), summary->events[i]);
    if (options->last != 0) {
        putc('\n', out);
        report_part(out, summary, options);
        return;
    }
    fputs("\n\nIts index.html shows it in a browser. ffmpeg, where it is installed, makes of it\n", out);
    film_commands(out, options, summary->frames);
}
