/* SPDX-License-Identifier: MIT */
/* film_report.c - the summary printed after filming. */
#include "film_report.h"
#include "hint.h"
#include "json_write.h"
#include "page.h"
#include "point_scale.h"
#include "point_world.h"
#include "scene.h"
#include "text.h"

#include <inttypes.h>
#include <string.h>

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* Print the ways to show the recording. */
static void print_ways_to_show(FILE *out, const film_summary *summary, const char *folder)
{
    if (summary->frames == 0) {
        fputs(page_can_play() ? "its index.html draws it in a browser, and you can play on there\n" : "", out);
        return;
    }
    fprintf(out, "its index.html shows it in a browser; as a film: %s film ", hint_program_name());
    hint_write_shell_word(out, folder);
    fputs(" -o film.png\n", out);
}

/* ---- The summary of film_session() ---------------------------------------------------------------------------- */

static double find_frame_rate(const film_summary *summary, double seconds)
{
    return seconds > 0 ? (double)(summary->frames - summary->kept) / seconds : 0;
}

/* Write the members that the JSON summaries of film_session() and join_chunks() share. */
static void begin_json_summary(json_writer *w, const film_summary *summary, const char *folder)
{
    json_write_begin_object(w);
    json_write_text_member(w, "folder", folder);
    json_write_integer_member(w, "ticks", summary->ticks);
    json_write_integer_member(w, "frames", summary->frames);
    json_write_integer_member(w, "gaps", summary->gaps);
    json_write_integer_member(w, "left_out", summary->left_out);
}

static void report_json(FILE *out, const film_summary *summary, const char *folder, double seconds)
{
    json_writer writer = {.out = out}, *w = &writer;
    begin_json_summary(w, summary, folder);
    json_write_integer_member(w, "checked", summary->checks.count);
    json_write_text_member(w, "checked_by", summary->checks.count ? draw_context_name(summary->checks.by) : NULL);
    json_write_integer_member(w, "over_budget", summary->over_budget);
    json_write_integer_member(w, "below_lod", summary->below_lod);
    json_write_integer_member(w, "refusals", summary->refusals);
    json_write_number_member(w, "seconds", seconds);
    json_write_number_member(w, "frames_per_second", find_frame_rate(summary, seconds));
    json_begin_object_member(w, "events");
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        json_write_integer_member(w, octree_event_name(1u << i), summary->events[i]);
    json_write_end_object(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

static void report_counts(FILE *out, const film_summary *summary, const char *folder)
{
    write_escaped(out, folder, escape_nothing);
    fprintf(out, ": %" PRIu64 " tick%s, ", summary->ticks, plural_ending(summary->ticks));
    if (summary->frames == 0)
        fputs("no frames", out);
    else
        fprintf(out, "%" PRIu64 " frame%s", summary->frames, plural_ending(summary->frames));
    if (summary->kept > 0)
        fprintf(out, ", of which %" PRIu64 " existed already", summary->kept);
}

const char *film_left_out_text(unsigned left_out, char text[FILM_LEFT_OUT])
{
    static const char *const names[] = {"nodes", "points", "velocity arrows"};
    *text = 0;
    for (unsigned i = 0; i < 3; i++) {
        if (!(left_out >> i & 1))
            continue;
        if (*text)
            strcat(text, left_out >> (i + 1) ? ", " : " and ");
        strcat(text, names[i]);
    }
    return text;
}

static void report_left_out(FILE *out, const film_summary *summary)
{
    char text[FILM_LEFT_OUT];
    if (summary->gaps)
        fprintf(out, "%" PRIu64 " %s without data; ticks.jsonl has the reason\n", summary->gaps,
                summary->gaps == 1 ? "tick is a gap" : "ticks are gaps");
    if (summary->left_out)
        fprintf(out, "%" PRIu64 " element%s too far away to be drawn; the frames leave %s out\n", summary->left_out,
                plural_ending(summary->left_out), summary->left_out == 1 ? "it" : "them");
    if (summary->over_budget)
        fprintf(out, "%" PRIu64 " frame%s leave%s out %s beyond --budget\n", summary->over_budget,
                plural_ending(summary->over_budget), verb_ending(summary->over_budget),
                film_left_out_text(summary->beyond, text));
    if (summary->below_lod)
        fprintf(out, "%" PRIu64 " frame%s leave%s out %s smaller than --lod\n", summary->below_lod,
                plural_ending(summary->below_lod), verb_ending(summary->below_lod),
                film_left_out_text(summary->small, text));
}

static void report_chunk(FILE *out, const film_summary *summary, const film_options *options)
{
    fprintf(out, "a chunk, from tick %" PRIu64 " to %" PRIu64 "; when all chunks are complete, run: %s join ",
            options->first, options->first + summary->ticks - 1, hint_program_name());
    hint_write_shell_word(out, options->folder);
    putc('\n', out);
}

void film_report(FILE *out, const film_summary *summary, const film_options *options, double seconds, bool json)
{
    if (json) {
        report_json(out, summary, options->folder, seconds);
        return;
    }
    report_counts(out, summary, options->folder);
    fprintf(out, ", %.1f s", seconds);
    if (summary->frames > summary->kept)
        fprintf(out, ", %.0f frames a second", find_frame_rate(summary, seconds));
    putc('\n', out);
    if (summary->checks.count)
        fprintf(out, "%" PRIu64 " of %" PRIu64 " frame%s checked with %s\n", summary->checks.count,
                summary->frames - summary->kept, plural_ending(summary->frames - summary->kept),
                frame_checks_title(summary->checks.by));
    report_left_out(out, summary);
    fputs("ticks with each event: player", out);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        /* Most sessions cannot have wrong answers or overlapping pairs, so "wrong 0" would mislead. */
        if (!(1u << i & (OCTREE_EVENT_WRONG | OCTREE_EVENT_OVERLAPPED)) || summary->events[i])
            fprintf(out, "%s %s %" PRIu64, i ? "," : "", octree_event_name(1u << i), summary->events[i]);
    putc('\n', out);
    if (summary->refusals)
        fprintf(out,
                "refused points, edits and steps (steps out of the world are not counted): %" PRIu64
                "; ticks.jsonl lists them\n",
                summary->refusals);
    if (options->last != 0)
        report_chunk(out, summary, options);
    else
        print_ways_to_show(out, summary, options->folder);
}

/* Print a world that contains all points, in the form of the member "world" of session.json. */
static void print_world(FILE *out, const octree_session *session)
{
    const octree_game_body *bodies = session->bodies;
    const octree_box world = find_point_world(bodies->position, sizeof *bodies, session->body_count);
    json_write_box_member(&(json_writer){.out = out}, "world", &world);
}

void film_report_refused_points(FILE *out, const film_start *start, const octree_session *session)
{
    if (start->outside > start->points / 2) {
        fprintf(out,
                "octreel: %zu of the session's %zu points lie outside its world and are refused; a world that contains "
                "them: ",
                start->outside, start->points);
        print_world(out, session);
        putc('\n', out);
    } else if (start->full > start->points / 2) {
        fprintf(out,
                "octreel: %zu of the session's %zu points are refused by full leaves; \"tree\": {\"full\": \"grow\"} "
                "keeps them\n",
                start->full, start->points);
    }
}

void film_report_useless_options(FILE *out, const film_summary *summary, const film_options *options)
{
    const view *v = &options->view;
    const char *lacking = point_scale_missing_value(v, options->values);
    if (lacking)
        fprintf(out, "octreel: no point has %s: --color-points %s shows all points alike\n", lacking,
                view_point_color_name(v->point_color));
    if (summary->foreign_nodes > 0)
        return;
    if (v->tree == TREE_FOREIGN)
        fputs("octreel: no tick has nodes of a foreign index, so --tree foreign shows no nodes\n", out);
    else if (v->tree == TREE_BOTH)
        fputs("octreel: no tick has nodes of a foreign index, so --tree both shows only the nodes of Octreel\n", out);
    if (v->coloring == COLORING_KIND)
        fputs("octreel: no tick has nodes of a foreign index, so --color-by kind shows all nodes alike\n", out);
}

void film_report_notes(FILE *out, const film_summary *summary, const film_options *options,
                       const octree_session *session)
{
    film_report_refused_points(out, &summary->start, session);
    film_report_useless_options(out, summary, options);
    if (*summary->checks.reason.text)
        fprintf(out, "octreel: %s frame was checked: %s\n", summary->checks.count ? "not every due" : "no",
                summary->checks.reason.text);
}

void film_report_joined(FILE *out, const film_summary *summary, const film_options *options, bool json)
{
    if (json) {
        json_writer w = {.out = out};
        begin_json_summary(&w, summary, options->folder);
        json_write_end_object(&w);
        json_write_end_line(&w);
        return;
    }
    report_counts(out, summary, options->folder);
    putc('\n', out);
    report_left_out(out, summary);
    print_ways_to_show(out, summary, options->folder);
}

void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options)
{
    if (summary->ticks == 0) {
        fputs("octreel: stopped before the first tick was recorded\n", out);
        return;
    }
    fprintf(out, "octreel: stopped after %" PRIu64 " of %" PRIu64 " tick%s; to continue: %s record --resume",
            summary->ticks, summary->total, plural_ending(summary->total), hint_program_name());
    if (options->last != 0)
        fprintf(out, " --ticks %" PRIu64 ":%" PRIu64, options->first, options->first + summary->total);
    fputs(" -o ", out);
    hint_write_shell_word(out, options->folder);
    putc('\n', out);
}
