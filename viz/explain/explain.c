/* SPDX-License-Identifier: MIT */
/* explain.c - two sides are explained pair by pair; recordings are played for it. */
#include "explain.h"
#include "cause_words.h"
#include "file.h"
#include "frame_file.h"
#include "image_digest.h"
#include "png_read.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool explain_is_unlike(const diff_pair *pair)
{
    return pair->finding != FOUND_SAME_BYTES && pair->finding != FOUND_SAME_PIXELS && pair->finding != FOUND_UNREADABLE;
}

void explanation_release(explanation *e)
{
    for (size_t i = 0; i < e->count; i++)
        free(e->pairs[i].text);
    free(e->pairs);
    free(e->headline);
    free(e->trouble);
    recorded_close(&e->sides[0]);
    recorded_close(&e->sides[1]);
    cause_release(&e->cause);
    tracer_close(&e->tracer);
    *e = (explanation){0};
}

const char *explanation_cause(const explanation *e, size_t i)
{
    return e->pairs ? e->pairs[i].text : NULL;
}

diff_verdict explanation_verdict(const explanation *e, const diff_result *result)
{
    return e->trouble ? DIFF_TROUBLE : result->verdict;
}

/* ---- Playing both -------------------------------------------------------------------------------------------- */

/* A pair that is explained, and the tick of its frames. */
typedef struct wanted_pair {
    uint64_t tick;
    const diff_pair *pair;
} wanted_pair;

/* State while both recordings are played. */
typedef struct watching {
    explanation *e;
    const diff_options *options;
    wanted_pair *pairs; /* in ascending order of their ticks */
    size_t count, next;
} watching;

/* Called with ascending ticks. */
static bool is_wanted(void *context, uint64_t tick)
{
    watching *w = context;
    while (w->next < w->count && w->pairs[w->next].tick < tick)
        w->next++;
    return w->next < w->count && w->pairs[w->next].tick == tick;
}

static bool watch(void *context, const octree_game *const games[2], bool differs, octreel_error *error)
{
    watching *w = context;
    const uint64_t tick = octree_game_tick(games[0])->number;
    if (!recorded_check_tick(w->e->sides, games, differs, error) ||
        !tracer_add_tick(&w->e->tracer, w->e->sides, games, error))
        return false;
    if (!is_wanted(w, tick))
        return true;
    const diff_pair *pair = w->pairs[w->next].pair;
    cause_tick *told = &w->e->cause.ticks[w->e->cause.count - 1]; /* of this tick, which was wanted */
    return !pair->difference.unlike.pixels ||
           tracer_trace(&w->e->tracer, w->e->sides, games, pair, w->options, &told->trace, error);
}

static int by_number(const void *a, const void *b)
{
    const uint64_t x = ((const wanted_pair *)a)->tick, y = ((const wanted_pair *)b)->tick;
    return (x > y) - (x < y);
}

/* The first tick whose frames differ; names beyond six digits are not in the order of ticks. */
static uint64_t first_drawn(const diff_result *result)
{
    uint64_t first = CAUSE_NO_TICK, tick;
    for (size_t i = 0; i < result->count; i++) {
        const diff_pair *pair = &result->pairs[i];
        if (pair->a && pair->b && explain_is_unlike(pair) && frame_parse_name(diff_pair_name(pair), &tick) &&
            tick < first)
            first = tick;
    }
    return first;
}

/* The first pairs that differ. */
static bool list_pairs(watching *w, const diff_result *result, uint64_t most)
{
    w->pairs = malloc((result->count + 1) * sizeof *w->pairs);
    if (!w->pairs)
        return false;
    for (size_t i = 0; i < result->count && w->count < most; i++) {
        const diff_pair *pair = &result->pairs[i];
        w->pairs[w->count].pair = pair;
        if (explain_is_unlike(pair) && frame_parse_name(diff_pair_name(pair), &w->pairs[w->count].tick))
            w->count++;
    }
    qsort(w->pairs, w->count, sizeof *w->pairs, by_number);
    return true;
}

static bool play_both(explanation *e, const diff_result *result, uint64_t most, octreel_error *error)
{
    const cause_view views[2] = {e->sides[0].view, e->sides[1].view};
    watching w = {.e = e, .options = &result->options};
    const cause_watcher watcher = {most < SIZE_MAX ? (size_t)most : SIZE_MAX, is_wanted, watch, &w};
    const bool ok = list_pairs(&w, result, most) ? cause_find(&e->sides[0].replay.session, &e->sides[1].replay.session,
                                                              views, &watcher, &e->cause, error)
                                                 : error_no_memory(error);
    e->cause.drawn = first_drawn(result);
    free(w.pairs);
    return ok;
}

/* ---- One pair ------------------------------------------------------------------------------------------------ */

/* What both frames say of themselves in their text chunks. */
typedef struct origins {
    frame_origin of[2];
    bool told[2]; /* the frame says it */
} origins;

static origins read_origins(const diff_pair *pair)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    origins o = {0};
    for (int i = 0; i < 2; i++)
        o.told[i] = frames[i] && frames[i]->path && frame_read_origin(frames[i]->path, &o.of[i]);
    return o;
}

static bool both_told(const origins *o)
{
    return o->told[0] && o->told[1];
}

/* Whether a frame has the pixels of the digest in its text chunk. */
static bool is_as_drawn(const diff_frame *frame, const frame_origin *origin)
{
    octreel_error ignored;
    image about;
    uint64_t pixels;
    errno = 0;
    if (!image_digest_png(frame->path, IMAGE_WHITE, &about, &pixels, &ignored))
        return !system_served(&ignored); /* nothing is said of what is not known */
    return pixels == origin->pixels;
}

/* What a frame is that is not the one which its recording made for this tick; "" where it is. */
static const char *tell_foreign(const recorded *r, const frame_origin *origin, uint64_t tick, char text[64])
{
    if (origin->session != r->filmed && origin->session != r->replay.session_digest)
        return "is a frame of another session";
    if (origin->tick == tick)
        return "";
    snprintf(text, 64, "is the frame of tick %" PRIu64, origin->tick);
    return text;
}

/* Name the frames that were exchanged, or changed after they were drawn. */
static bool print_tampered(FILE *out, const explanation *e, const diff_pair *pair, const origins *o, uint64_t tick)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    bool any = false;
    for (int i = 0; i < 2; i++) {
        char text[64];
        const char *what = o->told[i] && e->recordings ? tell_foreign(&e->sides[i], &o->of[i], tick, text) : "";
        if (o->told[i] && !*what && !is_as_drawn(frames[i], &o->of[i]))
            what = "was changed after it was drawn: its pixels are not those that it says";
        if (*what)
            fprintf(out, "%s%s %s", any ? "; " : "", frames[i]->path, what);
        any = any || *what;
    }
    return any;
}

static bool same_renderer(const explanation *e)
{
    return strcmp(e->sides[0].drawn_by, e->sides[1].drawn_by) == 0;
}

static void print_renderers(FILE *out, const explanation *e)
{
    fprintf(out, "; reference drawn by %s, frame by %s", e->sides[0].drawn_by, e->sides[1].drawn_by);
}

/* The sentence for frames of the same scene: who drew them, where that is known. */
static void print_rendering(FILE *out, const explanation *e)
{
    fputs("rendering differs: the scene digests are equal", out);
    if (e->recordings && same_renderer(e))
        fprintf(out, "; both drawn by %s", e->sides[0].drawn_by);
    else if (e->recordings)
        print_renderers(out, e);
}

/* Why a recording has no frame of a tick. */
static void print_missing(FILE *out, const recorded *r, uint64_t tick)
{
    const uint64_t last = octree_session_length(&r->replay.session.session);
    if (tick > last)
        fprintf(out, "the session of %s ends at tick %" PRIu64, r->side->path, last);
    else if (octree_session_gap(&r->replay.session.session, tick))
        fprintf(out, "%s has a gap there: %s", r->side->path,
                octree_session_gap(&r->replay.session.session, tick)->why);
    else if (!frame_is_due(tick, r->view.every))
        fprintf(out, "%s has a frame every %" PRIu64 " ticks", r->side->path, r->view.every);
    else
        fprintf(out, "%s lacks it: that recording is damaged, or not done", r->side->path);
}

/* Nothing differs that the files beside the frames tell. */
static void print_unknown(FILE *out, const diff_pair *pair, const origins *o)
{
    if (both_told(o))
        fputs("another scene of the same session and view: drawn by another version of octreel, or the files beside "
              "the frames were changed",
              out);
    for (int i = 0; i < 2; i++)
        if (!o->told[i])
            fprintf(out, "%s%s has none of octreel's texts, as after another program has saved it",
                    i && !o->told[0] ? "; " : "", (i ? pair->b : pair->a)->path);
}

static void print_tick(FILE *out, const explanation *e, const diff_pair *pair, const origins *o, uint64_t tick)
{
    const cause_tick *told = cause_at(&e->cause, tick);
    const bool facts = told && told->facts.count > 0, view = e->cause.view.count > 0;
    fprintf(out, "tick %" PRIu64 ": ", tick);
    if (facts)
        cause_print_facts(out, &told->facts, false);
    if (view) {
        fputs(facts ? "; " : "", out);
        cause_print_facts(out, &e->cause.view, false);
    }
    if (facts || view)
        return;
    if (e->cause.session.count > 0) {
        fputs("the same happened in it; ", out);
        cause_print_facts(out, &e->cause.session, true);
    } else {
        print_unknown(out, pair, o);
    }
}

/* Frames without recordings: only their text chunks are known. */
static void print_origins(FILE *out, const origins *o)
{
    const frame_origin *a = &o->of[0], *b = &o->of[1];
    if (a->tick != b->tick)
        fprintf(out, "the reference shows tick %" PRIu64 ", the frame tick %" PRIu64, a->tick, b->tick);
    else if (a->session != b->session)
        fprintf(out, "tick %" PRIu64 " of unlike sessions", a->tick);
    else
        fprintf(out, "tick %" PRIu64 " of one session in unlike scenes: another view, or another version of octreel",
                a->tick);
}

/* What is drawn where they differ. */
static void print_trace(FILE *out, const explanation *e, uint64_t tick)
{
    const cause_tick *told = cause_at(&e->cause, tick);
    if (told && told->trace.count) {
        fputs("; ", out);
        trace_print(out, &told->trace);
    }
}

static void print_cause(FILE *out, const explanation *e, const diff_pair *pair, pair_cause *cause)
{
    const origins o = read_origins(pair);
    const bool same_scene = both_told(&o) && o.of[0].scene == o.of[1].scene, both = pair->a && pair->b;
    uint64_t tick = 0;
    frame_parse_name(diff_pair_name(pair), &tick);
    const bool tampered = print_tampered(out, e, pair, &o, tick);
    cause->only_drawn = same_scene && !tampered && e->cause.view.count == 0;
    if (cause->only_drawn)
        print_rendering(out, e);
    else if (e->recordings && both && !tampered)
        print_tick(out, e, pair, &o, tick);
    else if (e->recordings && !both)
        print_missing(out, &e->sides[pair->a ? 1 : 0], tick);
    else if (both_told(&o) && !tampered)
        print_origins(out, &o);
    if (e->recordings && same_scene && !tampered && !cause->only_drawn && !same_renderer(e))
        print_renderers(out, e);
    if (e->recordings)
        print_trace(out, e, tick);
}

/* Find the cause of a pair that differs. Its text is null where neither recordings nor text chunks in the frames tell
 * one. */
static bool find_cause(const explanation *e, const diff_pair *pair, pair_cause *cause, octreel_error *error)
{
    text_stream s;
    const bool begun = text_stream_begin(&s);
    if (begun)
        print_cause(s.stream, e, pair, cause);
    return (text_stream_end(&s, &cause->text) && begun) || error_no_memory(error);
}

/* ---- The headline -------------------------------------------------------------------------------------------- */

/* Whether all explained pairs show the same scenes, drawn differently. */
static bool only_drawn(const explanation *e)
{
    bool any = false;
    for (size_t i = 0; i < e->count; i++) {
        if (e->pairs[i].text && !e->pairs[i].only_drawn)
            return false;
        any = any || e->pairs[i].text;
    }
    return any;
}

/* The first pair that has a cause; e->count where there is none. */
static size_t first_explained(const explanation *e)
{
    size_t i = 0;
    while (i < e->count && !e->pairs[i].text)
        i++;
    return i;
}

/* Whether there were any. */
static bool print_warnings(FILE *out, const explanation *e)
{
    bool any = false;
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < e->sides[side].warning_count; i++) {
            fprintf(out, "%s%s", any ? "; " : "", e->sides[side].warnings[i]);
            any = true;
        }
    return any;
}

/* Warnings about files come first; without a difference of sessions and views, rendering is the cause. */
static void print_headline(FILE *out, const explanation *e, const diff_result *result)
{
    const bool known = e->cause.session.count > 0 || e->cause.view.count > 0;
    const size_t first = first_explained(e);
    if (print_warnings(out, e) && (known || first < e->count))
        fputs("; ", out);
    if (known)
        cause_print_headline(out, &e->cause);
    else if (only_drawn(e))
        print_rendering(out, e);
    else if (first < e->count && e->recordings)
        fprintf(out, "%s: %s", diff_pair_name(&result->pairs[first]), e->pairs[first].text);
}

static bool say(explanation *e, const diff_result *result, octreel_error *error)
{
    text_stream s;
    if (text_stream_begin(&s))
        print_headline(s.stream, e, result);
    const bool ok = text_stream_end(&s, &e->headline);
    return ok || error_no_memory(error);
}

/* ---- Both kinds of sides ------------------------------------------------------------------------------------- */

/* Whether only one side has the file, or both have it with other bytes. */
static bool file_differs(const diff_side *a, const diff_side *b, const char *name)
{
    char *paths[2] = {path_join(a->path, name), path_join(b->path, name)};
    const bool there = paths[0] && paths[1] && (access(paths[0], F_OK) == 0 || access(paths[1], F_OK) == 0);
    const bool differs = there && !same_bytes(paths[0], paths[1]);
    free(paths[0]);
    free(paths[1]);
    return differs;
}

static bool any_to_explain(const diff_side *a, const diff_side *b, const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (explain_is_unlike(&result->pairs[i]))
            return true;
    return a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING &&
           (file_differs(a, b, "session.json") || file_differs(a, b, "recording.json") ||
            file_differs(a, b, "ticks.jsonl"));
}

static bool explain_pairs(explanation *e, const diff_result *result, uint64_t most, octreel_error *error)
{
    bool ok = true;
    e->pairs = calloc(result->count + 1, sizeof *e->pairs);
    if (!e->pairs)
        return error_no_memory(error);
    e->count = result->count;
    for (size_t i = 0; ok && i < result->count && most > 0; i++) {
        if (!explain_is_unlike(&result->pairs[i]))
            continue;
        ok = find_cause(e, &result->pairs[i], &e->pairs[i], error);
        most--;
    }
    return ok;
}

static bool explain_all(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most,
                        explanation *e, octreel_error *error)
{
    e->recordings = a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING;
    if (e->recordings && !(recorded_open(&e->sides[0], a, error) && recorded_open(&e->sides[1], b, error) &&
                           play_both(e, result, most, error)))
        return false;
    return explain_pairs(e, result, most, error) && say(e, result, error);
}

bool explain(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most, explanation *e,
             octreel_error *error)
{
    octreel_error why;
    *e = (explanation){0};
    if (most == 0 || !any_to_explain(a, b, result) || explain_all(a, b, result, most, e, &why))
        return true;
    explanation_release(e);
    e->trouble = strdup(why.text);
    return e->trouble || error_set(error, "%s", why.text);
}
