/* SPDX-License-Identifier: MIT */
/* audit.c - measures how wrong the answers of a foreign index are.
 *
 * The game compares each foreign answer with the exact answer. This file adds up the results. Two numbers describe an
 * approximate index.
 *
 * Recall is the share of the true points that the answers name. It is computed over all answers of a query kind
 * together, so large answers weigh more. Ratio is the distance of a named neighbour divided by the distance of the true
 * neighbour of the same rank. The ratio of every answer is stored, because a percentile (such as the ratio that 99 of
 * 100 answers do not exceed) needs all ratios, sorted; an average would hide a few very bad answers. Benchmarks of
 * approximate nearest-neighbour search use both numbers (Aumueller, Bernhardsson and Faithfull 2018, "ANN-Benchmarks").
 *
 * The limits excuse only approximation. An error that no honest approximation makes, such as an unknown id, always
 * counts as wrong. For each query kind the three worst answers are kept in full, sorted by insertion, so memory does
 * not grow with the number of wrong answers. */
#include "audit.h"
#include "array.h"
#include "file.h"
#include "file_kind.h"
#include "octree/octree.h"
#include "recording_file.h"
#include "judgement.h"
#include "number.h"
#include "session_file.h"
#include "text.h"
#include "ticks_write.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Counting ----------------------------------------------------------------------------------------------- */

const octree_query_traits *audit_kind_about(int kind)
{
    static const octree_query_traits pairs = {.name = "pairs"};
    return kind == AUDIT_PAIRS ? &pairs : octree_query_about((octree_query_kind)kind);
}

/* Format the answer of a tick with the index `place`, or the pairs if `place` is SIZE_MAX. */
static bool format_answer(const octree_tick *tick, size_t place, char **text)
{
    const tick_extras extras = {.frame = NULL};
    text_stream s;
    json_writer w = {.context = &extras};
    if (text_stream_begin(&s)) {
        w.out = s.stream;
        if (place == SIZE_MAX)
            tick_write_foreign_pairs(&w, &tick->foreign_pairs);
        else
            tick_write_answer(&w, &tick->answers[place]);
    }
    return text_stream_end(&s, text);
}

static void copy_points(octree_point to[AUDIT_POINTS], const octree_point *from, size_t count)
{
    if (from)
        memcpy(to, from, (count < AUDIT_POINTS ? count : AUDIT_POINTS) * sizeof *to);
}

/* True if an approximate search could make this error: farther neighbours, fewer neighbours, or fewer points. The
 * limits excuse no other kind of error. */
static bool is_approximation_error(const octree_judgement *made)
{
    return made->wrong == OCTREE_WRONG_FARTHER ||
           (made->wrong == OCTREE_WRONG_COUNT && made->given_count < made->expected) ||
           (made->wrong == OCTREE_WRONG_MISSING && made->extra_count == 0);
}

/* True if the limits allow this wrong answer when it is judged alone. Even so, many allowed answers together may
 * violate the recall limit. */
static bool is_allowed(const octree_judgement *made, const audit_limits *limits)
{
    if (limits->by_ratio && made->ratio > limits->ratio)
        return false;
    return (limits->by_recall && is_approximation_error(made)) ||
           (limits->by_ratio && made->wrong == OCTREE_WRONG_FARTHER);
}

static bool is_worse(const audit_case *c, const audit_case *than)
{
    if (c->allowed != than->allowed)
        return than->allowed;
    if (is_approximation_error(&c->made) != is_approximation_error(&than->made))
        return is_approximation_error(&than->made);
    return judgement_is_worse(&c->made, &than->made);
}

/* Keep a wrong answer if it is among the AUDIT_WORST worst ones. Returns false if memory runs out. */
static bool insert_into_worst_answers(audit_kind *kind, audit_case c, const octree_tick *tick)
{
    size_t at = kind->worst_count;
    while (at > 0 && is_worse(&c, &kind->worst[at - 1]))
        at--;
    if (at == AUDIT_WORST)
        return true;
    if (!format_answer(tick, c.place, &c.answer))
        return false;
    copy_points(c.missing, c.made.missing, c.made.missing_count);
    copy_points(c.extra, c.made.extra, c.made.extra_count);
    c.made.given = NULL;
    c.made.missing = c.made.extra = NULL;
    if (kind->worst_count == AUDIT_WORST)
        free(kind->worst[--kind->worst_count].answer);
    memmove(&kind->worst[at + 1], &kind->worst[at], (kind->worst_count - at) * sizeof c);
    kind->worst[at] = c;
    kind->worst_count++;
    return true;
}

/* Returns the entry of the tick, and appends a new entry if the tick has none. Returns null if memory runs out. */
static audit_tick *find_or_add_tick(audit_kind *kind, uint64_t tick)
{
    if (kind->tick_count && kind->ticks[kind->tick_count - 1].tick == tick)
        return &kind->ticks[kind->tick_count - 1];
    if (!array_grow(&kind->ticks, kind->tick_count + 1, &kind->tick_room, sizeof *kind->ticks))
        return NULL;
    kind->ticks[kind->tick_count] = (audit_tick){.tick = tick, .ratio = 1};
    return &kind->ticks[kind->tick_count++];
}

static bool append_ratio(audit_kind *kind, double ratio)
{
    if (!array_grow(&kind->ratios, kind->ratio_count + 1, &kind->ratio_room, sizeof *kind->ratios))
        return false;
    kind->ratios[kind->ratio_count++] = ratio;
    return true;
}

/* Count one answer in the entry of its tick. Returns false if memory runs out. */
static bool add_answer_to_tick(audit_kind *kind, uint64_t tick, const octree_judgement *made)
{
    audit_tick *row = find_or_add_tick(kind, tick);
    if (!row)
        return false;
    row->asked++;
    row->wrong += made->wrong != OCTREE_WRONG_NONE;
    row->expected += made->expected;
    row->missing += made->missing_count;
    row->ratio = made->ratio > row->ratio ? made->ratio : row->ratio;
    return true;
}

/* True if the answer is wrong only in points on the boundary of the query: with other bounds (open or closed) the
 * answer would be right. */
static bool is_wrong_only_on_boundary(const octree_judgement *made)
{
    return made->on_boundary && made->wrong == made->on_boundary && !(made->missing_count && made->extra_count);
}

/* Count one wrong answer. Returns false if memory runs out. */
static bool add_wrong_answer(audit_kind *kind, audit_case c, const octree_tick *tick)
{
    if (kind->wrong++ == 0)
        kind->first_wrong = c.tick;
    kind->on_boundary += is_wrong_only_on_boundary(&c.made);
    kind->beyond += !c.allowed;
    return insert_into_worst_answers(kind, c, tick);
}

/* Count one answer of a kind. `place` is the index of the answer in the tick, or SIZE_MAX for pairs. */
static bool add_answer(audit_report *report, int of, const octree_tick *tick, size_t place,
                       const octree_judgement *made)
{
    audit_kind *kind = &report->kinds[of];
    kind->asked++;
    report->asked++;
    kind->expected += made->expected;
    kind->missing += made->missing_count;
    kind->extra += made->extra_count;
    kind->wrong_by_kind[made->wrong]++;
    if (!add_answer_to_tick(kind, tick->number, made) ||
        (audit_kind_about(of)->neighbors && !append_ratio(kind, made->ratio)))
        return false;
    if (!made->wrong)
        return true;
    report->wrong++;
    return add_wrong_answer(kind, (audit_case){tick->number, place, is_allowed(made, &report->limits), .made = *made},
                            tick);
}

/* Count the pairs of a tick as an answer. */
static bool add_pairs(audit_report *report, const octree_tick *tick)
{
    const octree_pair_judgement *pairs = &tick->foreign_pairs;
    const octree_judgement made = {.judged = pairs->judged,
                                   .wrong = pairs->wrong,
                                   .given_count = pairs->given_count,
                                   .expected = pairs->expected,
                                   .missing_count = pairs->missing_count,
                                   .extra_count = pairs->extra_count};
    return !made.judged || add_answer(report, AUDIT_PAIRS, tick, SIZE_MAX, &made);
}

static void copy_first_wrong_nodes(audit_nodes *nodes, const octree_tick *tick)
{
    for (size_t i = 0; i < tick->foreign.listed_count; i++) {
        const octree_wrong_node *wrong = &tick->foreign.listed[i];
        if (nodes->first[wrong->kind].known)
            continue;
        nodes->first[wrong->kind].known = true;
        nodes->first[wrong->kind].tick = tick->number;
        nodes->first[wrong->kind].node = *wrong;
    }
}

static void add_wrong_nodes(audit_nodes *nodes, const octree_tick *tick)
{
    nodes->given |= tick->foreign.given;
    if (tick->foreign.wrong_count == 0)
        return;
    if (nodes->ticks++ == 0)
        nodes->first_wrong = tick->number;
    nodes->wrong += tick->foreign.wrong_count;
    for (int i = 0; i < OCTREE_WRONG_NODE_KINDS; i++)
        nodes->wrong_by_kind[i] += tick->foreign.wrong[i];
    copy_first_wrong_nodes(nodes, tick);
}

/* Count all answers of a tick. A gap has no answers. Returns false if memory runs out. */
static bool add_tick(audit_report *report, const octree_tick *tick)
{
    report->ticks++;
    if (tick->gap)
        return true;
    for (size_t i = 0; i < tick->answer_count; i++)
        if (tick->answers[i].judgement.judged &&
            !add_answer(report, (int)tick->answers[i].kind, tick, i, &tick->answers[i].judgement))
            return false;
    add_wrong_nodes(&report->nodes, tick);
    return add_pairs(report, tick);
}

/* ---- Playing ------------------------------------------------------------------------------------------------ */

static bool play_and_count(octree_game *game, const watcher *watch, audit_report *report, octreel_error *error)
{
    const uint64_t total = octree_session_length(octree_game_session(game)) + 1;
    for (;;) {
        if (!add_tick(report, octree_game_tick(game)))
            return error_no_memory(error);
        watcher_report(watch, report->ticks, total);
        if (octree_game_over(game))
            return true;
        const octree_status status = octree_game_advance(game);
        if (status != OCTREE_OK)
            return error_set(error, "tick %" PRIu64 " cannot be played: %s", report->ticks, octree_status_text(status));
    }
}

static bool play_session(const char *path, const octree_session *session, const watcher *watch, audit_report *report,
                         octreel_error *error)
{
    octree_game *game;
    const octree_status status = octree_game_create(session, &game);
    if (status != OCTREE_OK)
        return error_set(error, "%s: cannot be played: %s", file_display_name(path), octree_status_text(status));
    const bool done = play_and_count(game, watch, report, error);
    octree_game_destroy(game);
    for (int kind = 0; kind < AUDIT_KINDS; kind++)
        if (report->kinds[kind].ratio_count > 1)
            qsort(report->kinds[kind].ratios, report->kinds[kind].ratio_count, sizeof(double), compare_float64);
    if (done && report->asked == 0 && !report->nodes.given)
        return error_set(error,
                         "%s: nothing to audit: the played ticks have neither foreign nodes nor \"pairs\" nor a query "
                         "with an \"answer\"",
                         file_display_name(path));
    return done;
}

bool audit_replay(const char *path, const audit_limits *limits, uint64_t max_ticks, const watcher *watch,
                  audit_report *report, octreel_error *error)
{
    session_file file = {0};
    uint64_t digest;
    *report = (audit_report){.limits = *limits};
    const bool done = (file_kind_of(path) == KIND_RECORDING ? read_session_file(path, &file, &digest, error)
                                                            : session_read(path, &file, error)) &&
                      session_check_length(&file.session, max_ticks, error) &&
                      play_session(path, &file.session, watch, report, error);
    session_release(&file);
    return done;
}

void audit_release(audit_report *report)
{
    for (int i = 0; i < AUDIT_KINDS; i++) {
        audit_kind *kind = &report->kinds[i];
        free(kind->ratios);
        free(kind->ticks);
        for (size_t j = 0; j < kind->worst_count; j++)
            free(kind->worst[j].answer);
    }
    *report = (audit_report){0};
}

double audit_ratio_percentile(const audit_kind *kind, double share)
{
    const double place = ceil(share * (double)kind->ratio_count);
    return kind->ratio_count == 0 ? 1 : kind->ratios[place < 1 ? 0 : (size_t)place - 1];
}

double audit_recall(const audit_kind *kind)
{
    return kind->expected == 0 ? 1 : (double)(kind->expected - kind->missing) / (double)kind->expected;
}

double audit_tick_recall(const audit_tick *tick)
{
    return tick->expected == 0 ? 1 : (double)(tick->expected - tick->missing) / (double)tick->expected;
}

/* ---- Limits ------------------------------------------------------------------------------------------------ */

/* Parse "NAME=NUMBER" at *at, and move *at past the text and a comma that follows. Returns false if the name is not
 * `name`, if this limit was already given, or if the number is invalid or not between `least` and `most`. */
static bool parse_limit(const char **at, const char *name, double least, double most, bool *given, double *value)
{
    const size_t length = strlen(name);
    char number[NUMBER_TEXT];
    if (*given || strncmp(*at, name, length) != 0 || (*at)[length] != '=')
        return false;
    const char *from = *at + length + 1;
    const size_t size = strcspn(from, ",");
    if (size >= sizeof number || (from[size] == ',' && from[size + 1] == 0))
        return false;
    memcpy(number, from, size);
    number[size] = 0;
    *given = numbers_parse(number, value, 1) && *value >= least && *value <= most;
    *at = from + size + (from[size] == ',');
    return *given;
}

bool audit_limits_parse(const char *text, audit_limits *limits, octreel_error *error)
{
    const char *at = text;
    *limits = (audit_limits){.by_ratio = false};
    do {
        if (!parse_limit(&at, "ratio", 1, DBL_MAX, &limits->by_ratio, &limits->ratio) &&
            !parse_limit(&at, "recall", 0, 1, &limits->by_recall, &limits->recall))
            return error_set(error,
                             "expected a ratio of at least 1, a recall from 0 to 1, or both, such as "
                             "ratio=1.01,recall=0.99, not \"%.200s\"",
                             text);
    } while (*at);
    return true;
}

bool audit_kind_passes(const audit_kind *kind, const audit_limits *limits)
{
    return kind->beyond == 0 && (!limits->by_ratio || audit_ratio_percentile(kind, 1) <= limits->ratio) &&
           (!limits->by_recall || audit_recall(kind) >= limits->recall);
}

bool audit_passes(const audit_report *report)
{
    bool passes = report->nodes.wrong == 0;
    for (int i = 0; i < AUDIT_KINDS; i++)
        passes = passes && audit_kind_passes(&report->kinds[i], &report->limits);
    return passes;
}
