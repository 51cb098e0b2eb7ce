/* SPDX-License-Identifier: MIT */
#include "audit.h"
#include "array.h"
#include "file_kind.h"
#include "folder_files.h"
#include "number.h"
#include "session_file.h"
#include "text.h"
#include "ticks_write.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Counting ----------------------------------------------------------------------------------------------- */

static bool is_worse(const audit_case *a, const audit_case *b)
{
    return a->ratio != b->ratio ? a->ratio > b->ratio : a->missed + a->extra > b->missed + b->extra;
}

static bool write_answer(const octree_answer *answer, char **text)
{
    text_stream s;
    if (text_stream_begin(&s))
        tick_write_answer(&(json_writer){.out = s.stream}, answer);
    return text_stream_end(&s, text);
}

/* Keep a wrong answer where it is among the worst. False when there is no memory. */
static bool keep_worst(audit_kind *kind, uint64_t tick, size_t place, const octree_answer *answer)
{
    const octree_judgement *made = &answer->judgement;
    audit_case c = {
        tick, place, made->fault, made->fault_id, made->rank, made->ratio, made->missed_count, made->extra_count, NULL};
    size_t at = kind->worst_count;
    while (at > 0 && is_worse(&c, &kind->worst[at - 1]))
        at--;
    if (at == AUDIT_WORST)
        return true;
    if (!write_answer(answer, &c.answer))
        return false;
    if (kind->worst_count == AUDIT_WORST)
        free(kind->worst[--kind->worst_count].answer);
    memmove(&kind->worst[at + 1], &kind->worst[at], (kind->worst_count - at) * sizeof c);
    kind->worst[at] = c;
    kind->worst_count++;
    return true;
}

static bool keep_ratio(audit_kind *kind, double ratio)
{
    double *grown = array_reserve(kind->ratios, kind->ratio_count + 1, &kind->ratio_room, sizeof *grown);
    if (!grown)
        return false;
    kind->ratios = grown;
    grown[kind->ratio_count++] = ratio;
    return true;
}

static bool count_answer(audit_report *report, uint64_t tick, size_t place, const octree_answer *answer)
{
    audit_kind *kind = &report->kinds[answer->kind];
    const octree_judgement *made = &answer->judgement;
    kind->asked++;
    report->asked++;
    kind->expected += made->expected;
    kind->missed += made->missed_count;
    kind->extra += made->extra_count;
    if (octree_query_about(answer->kind)->neighbors && !keep_ratio(kind, made->ratio))
        return false;
    if (!made->fault)
        return true;
    if (kind->wrong++ == 0)
        kind->first_wrong = tick;
    report->wrong++;
    return keep_worst(kind, tick, place, answer);
}

static bool count_tick(audit_report *report, const octree_tick *tick)
{
    report->ticks++;
    for (size_t i = 0; i < tick->answer_count; i++)
        if (tick->answers[i].judgement.judged && !count_answer(report, tick->number, i, &tick->answers[i]))
            return false;
    return true;
}

/* ---- Playing ------------------------------------------------------------------------------------------------ */

static bool play(octree_game *game, audit_progress *progress, void *context, audit_report *report, octreel_error *error)
{
    const uint64_t total = octree_session_length(octree_game_session(game)) + 1;
    for (;;) {
        if (!count_tick(report, octree_game_tick(game)))
            return error_no_memory(error);
        if (progress)
            progress(report->ticks, total, context);
        if (octree_game_over(game))
            return true;
        const octree_status status = octree_game_advance(game);
        if (status != OCTREE_OK)
            return error_set(error, "tick %" PRIu64 " cannot be played: %s", report->ticks, octree_status_text(status));
    }
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool play_session(const char *path, const octree_session *session, audit_progress *progress, void *context,
                         audit_report *report, octreel_error *error)
{
    octree_game *game;
    const octree_status status = octree_game_create(session, &game);
    if (status != OCTREE_OK)
        return error_set(error, "%s: cannot be played: %s", path, octree_status_text(status));
    const bool done = play(game, progress, context, report, error);
    octree_game_destroy(game);
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++)
        if (report->kinds[kind].ratio_count > 1)
            qsort(report->kinds[kind].ratios, report->kinds[kind].ratio_count, sizeof(double), compare_numbers);
    if (done && report->asked == 0)
        return error_set(error, "%s: no query has an \"answer\", so there is nothing to judge", path);
    return done;
}

bool audit_read(const char *path, audit_progress *progress, void *context, audit_report *report, octreel_error *error)
{
    session_file file = {0};
    uint64_t digest;
    *report = (audit_report){0};
    const bool done = (file_kind_of(path) == KIND_RECORDING ? read_session_file(path, &file, &digest, error)
                                                            : session_read(path, &file, error)) &&
                      play_session(path, &file.session, progress, context, report, error);
    session_release(&file);
    return done;
}

void audit_release(audit_report *report)
{
    for (int i = 0; i < OCTREE_QUERY_KINDS; i++) {
        audit_kind *kind = &report->kinds[i];
        free(kind->ratios);
        for (size_t j = 0; j < kind->worst_count; j++)
            free(kind->worst[j].answer);
    }
    *report = (audit_report){0};
}

double audit_ratio(const audit_kind *kind, double share)
{
    const double place = ceil(share * (double)kind->ratio_count);
    return kind->ratio_count == 0 ? 1 : kind->ratios[place < 1 ? 0 : (size_t)place - 1];
}

double audit_recall(const audit_kind *kind)
{
    return kind->expected == 0 ? 1 : (double)(kind->expected - kind->missed) / (double)kind->expected;
}

/* ---- For people --------------------------------------------------------------------------------------------- */

static const char *ratio_words(double ratio, char text[NUMBER_TEXT])
{
    return isinf(ratio) ? "infinite" : number_text(ratio, 6, text);
}

static const char *reason_words(octree_fault fault)
{
    static const char *const words[OCTREE_FAULTS] = {
        [OCTREE_FAULT_NONE] = "right",
        [OCTREE_FAULT_UNKNOWN] = "names an id that no point has",
        [OCTREE_FAULT_DUPLICATE] = "names a point twice",
        [OCTREE_FAULT_SKIPPED] = "names a point that is left out",
        [OCTREE_FAULT_COUNT] = "not as many neighbours as there are",
        [OCTREE_FAULT_FARTHER] = "a neighbour too far away",
        [OCTREE_FAULT_MISSED] = "points are missing",
        [OCTREE_FAULT_EXTRA] = "points that are outside",
    };
    return words[fault];
}

static void print_case(FILE *out, const audit_case *c, bool neighbors)
{
    char text[NUMBER_TEXT];
    fprintf(out, "  tick %" PRIu64 ", answers[%zu]: %s", c->tick, c->place, reason_words(c->fault));
    if (c->fault <= OCTREE_FAULT_SKIPPED)
        fprintf(out, " (%" PRIu64 ")", c->fault_id);
    if (c->rank)
        fprintf(out, "; wrong from rank %zu on", c->rank);
    if (neighbors)
        fprintf(out, "; ratio of distances %s", ratio_words(c->ratio, text));
    fprintf(out, "; %zu missed, %zu extra\n    %s\n", c->missed, c->extra, c->answer);
}

static void print_kind(FILE *out, const audit_kind *kind, const octree_query_traits *about)
{
    char texts[3][NUMBER_TEXT];
    fprintf(out, "%s: %" PRIu64 " asked, %" PRIu64 " wrong, recall %s", about->name, kind->asked, kind->wrong,
            number_text(audit_recall(kind), 6, texts[0]));
    if (about->neighbors)
        fprintf(out, ", ratio of distances %s at worst, 99th percentile %s",
                ratio_words(audit_ratio(kind, 1), texts[1]), ratio_words(audit_ratio(kind, 0.99), texts[2]));
    else
        fprintf(out, ", %" PRIu64 " missed, %" PRIu64 " extra", kind->missed, kind->extra);
    if (kind->wrong)
        fprintf(out, "; first wrong at tick %" PRIu64, kind->first_wrong);
    putc('\n', out);
    for (size_t i = 0; i < kind->worst_count; i++)
        print_case(out, &kind->worst[i], about->neighbors);
}

static void print_people(FILE *out, const char *path, const audit_report *report)
{
    fprintf(out, "%s: %" PRIu64 " answer%s in %" PRIu64 " tick%s, ", path, report->asked, plural(report->asked),
            report->ticks, plural(report->ticks));
    if (report->wrong)
        fprintf(out, "%" PRIu64 " wrong\n", report->wrong);
    else
        fputs("all right\n", out);
    for (int i = 0; i < OCTREE_QUERY_KINDS; i++)
        if (report->kinds[i].asked)
            print_kind(out, &report->kinds[i], octree_query_about((octree_query_kind)i));
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

/* The answer is JSON already. */
static void write_case(json_writer *w, const audit_case *c, bool neighbors)
{
    json_write_begin_object(w);
    json_member_integer(w, "tick", c->tick);
    json_member_integer(w, "place", c->place);
    json_member_text(w, "wrong", octree_fault_name(c->fault));
    if (c->rank)
        json_member_integer(w, "rank", c->rank);
    if (neighbors)
        json_member_number(w, "ratio", c->ratio);
    json_member_integer(w, "missed", c->missed);
    json_member_integer(w, "extra", c->extra);
    json_write_key(w, "answer");
    fputs(c->answer, w->out);
    w->comma = true;
    json_write_end_object(w);
}

static void write_kind(json_writer *w, const audit_kind *kind, const octree_query_traits *about)
{
    json_member_begin_object(w, about->name);
    json_member_integer(w, "asked", kind->asked);
    json_member_integer(w, "wrong", kind->wrong);
    json_member_number(w, "recall", audit_recall(kind));
    json_member_integer(w, "missed", kind->missed);
    json_member_integer(w, "extra", kind->extra);
    if (about->neighbors) {
        json_member_number(w, "worst_ratio", audit_ratio(kind, 1));
        json_member_number(w, "ratio_99", audit_ratio(kind, 0.99));
    }
    if (kind->wrong)
        json_member_integer(w, "first_wrong_tick", kind->first_wrong);
    json_member_begin_array(w, "worst");
    for (size_t i = 0; i < kind->worst_count; i++)
        write_case(w, &kind->worst[i], about->neighbors);
    json_write_end_array(w);
    json_write_end_object(w);
}

static void print_json(FILE *out, const char *path, const audit_report *report)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_member_text(w, "path", path);
    json_member_bool(w, "right", report->wrong == 0);
    json_member_integer(w, "ticks", report->ticks);
    json_member_integer(w, "asked", report->asked);
    json_member_integer(w, "wrong", report->wrong);
    json_member_begin_object(w, "kinds");
    for (int i = 0; i < OCTREE_QUERY_KINDS; i++)
        if (report->kinds[i].asked)
            write_kind(w, &report->kinds[i], octree_query_about((octree_query_kind)i));
    json_write_end_object(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

void audit_print(FILE *out, const char *path, const audit_report *report, bool json)
{
    (json ? print_json : print_people)(out, path, report);
}
