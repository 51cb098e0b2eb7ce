/* SPDX-License-Identifier: MIT */
/* pair_look.c - finds why two frames differ. It compares the text chunks of the PNG files and, if the frames belong
 * to recordings, these recordings. */
#include "pair_look.h"
#include "cause_words.h"
#include "image_digest.h"
#include "png_read.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void read_origins(const diff_pair *pair, pair_look *l)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    for (int i = 0; i < 2; i++)
        l->has_texts[i] = frames[i] && frames[i]->path && frame_read_origin(frames[i]->path, &l->origins[i]);
}

static bool have_both_texts(const pair_look *l)
{
    return l->has_texts[0] && l->has_texts[1];
}

/* Return whether the pixels of a frame have the digest that its text chunk states. */
static bool has_stated_pixel_digest(const diff_frame *frame, const frame_origin *origin)
{
    octreel_error ignored;
    image about;
    uint64_t pixels;
    errno = 0;
    if (!image_digest_png(origin->kind, frame->path, IMAGE_WHITE, &about, &pixels, &ignored))
        return !check_system_resources(&ignored); /* if resources are lacking, the frame counts as correct */
    return pixels == origin->pixels;
}

static frame_fault find_origin_fault(const recorded *r, const frame_origin *origin, uint64_t tick)
{
    if (origin->session != r->frames_session && origin->session != r->replay.session_digest)
        return FAULT_SESSION;
    if (origin->tick != tick)
        return FAULT_TICK;
    const uint64_t scene = recorded_scene_digest(r, tick);
    return scene == 0 || origin->scene == scene ? FAULT_NONE : FAULT_SCENE;
}

pair_look pair_examine(const explanation *e, const diff_pair *pair)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    pair_look l = {.has_texts = {false}};
    read_origins(pair, &l);
    for (int i = 0; i < 2; i++) {
        if (frames[i] && !l.has_texts[i] && e->recordings)
            l.faults[i] = FAULT_TEXTS;
        if (l.has_texts[i] && e->recordings)
            l.faults[i] = find_origin_fault(&e->sides[i], &l.origins[i], diff_pair_tick(pair));
        if (l.has_texts[i] && l.faults[i] == FAULT_NONE && !has_stated_pixel_digest(frames[i], &l.origins[i]))
            l.faults[i] = FAULT_PIXELS;
    }
    l.same_scene = have_both_texts(&l) && l.origins[0].scene == l.origins[1].scene;
    return l;
}

static bool has_frame_fault(const pair_look *l)
{
    return l->faults[0] != FAULT_NONE || l->faults[1] != FAULT_NONE;
}

static bool is_only_rendering_different(const explanation *e, const pair_look *l)
{
    return l->same_scene && !has_frame_fault(l) && !cause_has_facts_of_tick(&e->cause.view, 0);
}

/* Print how a frame contradicts its own text chunks or the recording that contains it. */
static void print_fault(FILE *out, frame_fault fault, const frame_origin *origin)
{
    static const char *const words[] = {
        [FAULT_SESSION] = "is a frame of another session",
        [FAULT_SCENE] = "shows a scene that differs from the one in ticks.jsonl",
        [FAULT_TEXTS] = "has no text chunks of octreel; another program may have saved it",
        [FAULT_PIXELS] = "was changed after it was drawn: its pixels do not match the digest in its text chunk",
    };
    if (fault == FAULT_TICK)
        fprintf(out, "is the frame of tick %" PRIu64, origin->tick);
    else
        fputs(words[fault], out);
}

static void print_faults(FILE *out, const diff_pair *pair, const pair_look *l)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    const char *separator = "";
    for (int i = 0; i < 2; i++) {
        if (l->faults[i] == FAULT_NONE)
            continue;
        fprintf(out, "%s%s ", separator, frames[i]->path);
        print_fault(out, l->faults[i], &l->origins[i]);
        separator = "; ";
    }
}

static bool have_same_renderer(const explanation *e)
{
    return strcmp(e->sides[0].drawn_by, e->sides[1].drawn_by) == 0;
}

static void print_renderers(FILE *out, const explanation *e)
{
    fprintf(out, "; reference drawn by %s, frame by %s", e->sides[0].drawn_by, e->sides[1].drawn_by);
}

void pair_print_rendering(FILE *out, const explanation *e)
{
    fputs("rendering differs: the scene digests are equal", out);
    if (e->recordings && have_same_renderer(e))
        fprintf(out, "; both drawn by %s", e->sides[0].drawn_by);
    else if (e->recordings)
        print_renderers(out, e);
}

/* Print why a recording has no frame of a tick. */
static void print_why_frame_is_missing(FILE *out, const recorded *r, uint64_t tick)
{
    const uint64_t last = octree_session_length(&r->replay.session.session);
    if (tick > last)
        fprintf(out, "the session of %s ends at tick %" PRIu64, r->side->path, last);
    else if (octree_session_gap(&r->replay.session.session, tick))
        fprintf(out, "%s has a gap at this tick: %s", r->side->path,
                octree_session_gap(&r->replay.session.session, tick)->why);
    else if (!frame_is_due(tick, r->view.every))
        fprintf(out, "%s has a frame only every %" PRIu64 " ticks", r->side->path, r->view.every);
    else
        fprintf(out, "%s has no such frame: the recording is damaged or incomplete", r->side->path);
}

/* Return whether any known difference is visible in the frame of a tick. */
static bool has_visible_difference(const explanation *e, const cause_tick *details, uint64_t tick)
{
    return (details && details->facts.count > 0) || cause_has_facts_of_tick(&e->cause.view, tick) ||
           cause_has_facts_of_tick(&e->cause.session, tick);
}

/* Print the cause for two frames whose tick is equal in both sessions: the differences between the sessions. If some
 * of these differences are visible in the frames, print only these. */
static void print_same_tick(FILE *out, const explanation *e, const cause_facts *shown, bool other_view)
{
    const cause_facts *session = shown->count || other_view ? shown : &e->cause.session;
    if (!other_view)
        fputs(session->count
                  ? "nothing differs in the tick itself; "
                  : "the scene differs although session and view are equal: another version of octreel drew it, or "
                    "a file beside the frames was changed",
              out);
    else if (session->count)
        fputs("; ", out);
    cause_print_facts(out, session, true);
}

static void print_tick_cause(FILE *out, const explanation *e, const cause_tick *details, uint64_t tick)
{
    const bool facts = details && details->facts.count > 0;
    cause_facts view = cause_select_facts_of_tick(&e->cause.view, tick),
                session = cause_select_facts_of_tick(&e->cause.session, tick);
    fprintf(out, "tick %" PRIu64 ": ", tick);
    if (facts)
        cause_print_facts(out, &details->facts, false);
    fputs(facts && view.count ? "; " : "", out);
    cause_print_facts(out, &view, false);
    if (!facts)
        print_same_tick(out, e, &session, view.count > 0);
    free(view.groups);
    free(session.groups);
}

/* Print how the text chunks of two frames differ, for frames that are not from recordings. */
static void print_origins(FILE *out, const pair_look *l)
{
    const frame_origin *a = &l->origins[0], *b = &l->origins[1];
    if (a->tick != b->tick)
        fprintf(out, "the reference shows tick %" PRIu64 ", the frame tick %" PRIu64, a->tick, b->tick);
    else if (a->session != b->session)
        fprintf(out, "tick %" PRIu64 " of two different sessions", a->tick);
    else
        fprintf(out,
                "tick %" PRIu64
                " of one session, drawn as two different scenes: another view or another version of octreel",
                a->tick);
}

/* Return whether no frame has a fault other than missing text chunks. A frame without text chunks may show the right
 * picture, so the difference between the ticks is printed, too. */
static bool can_show_right_picture(const pair_look *l)
{
    return (l->faults[0] == FAULT_NONE || l->faults[0] == FAULT_TEXTS) &&
           (l->faults[1] == FAULT_NONE || l->faults[1] == FAULT_TEXTS);
}

static void print_cause(FILE *out, const explanation *e, const diff_pair *pair, const pair_look *l)
{
    const bool both = pair->a && pair->b, faulty = has_frame_fault(l), drawn = is_only_rendering_different(e, l);
    const uint64_t tick = diff_pair_tick(pair);
    const cause_tick *details = cause_find_tick(&e->cause, tick); /* null if the frames are not from recordings */
    const bool prints_tick = e->recordings && both && !drawn &&
                             (!faulty || (can_show_right_picture(l) && has_visible_difference(e, details, tick)));
    const bool prints_missing = e->recordings && !both;
    if (pair->flaky)
        fputs(pair->flaky, out);
    fputs(pair->flaky && faulty ? "; " : "", out);
    print_faults(out, pair, l);
    fputs(faulty && (prints_tick || prints_missing) ? "; " : "", out);
    if (drawn)
        pair_print_rendering(out, e);
    else if (prints_tick)
        print_tick_cause(out, e, details, tick);
    else if (prints_missing)
        print_why_frame_is_missing(out, &e->sides[pair->a ? 1 : 0], tick);
    else if (have_both_texts(l) && !faulty)
        print_origins(out, l);
    if (e->recordings && l->same_scene && !faulty && !drawn && !have_same_renderer(e))
        print_renderers(out, e);
    if (details && details->trace.count) {
        fputs("; ", out);
        trace_print(out, &details->trace);
    }
}

bool pair_find_cause(const explanation *e, const diff_pair *pair, const pair_look *l, pair_cause *cause,
                     octreel_error *error)
{
    text_stream s;
    const bool begun = text_stream_begin(&s);
    cause->only_drawn = is_only_rendering_different(e, l);
    if (begun)
        print_cause(s.stream, e, pair, l);
    return (text_stream_end(&s, &cause->text) && begun) || error_no_memory(error);
}

/* ---- The text that identifies a cause -------------------------------------------------------------------------- */

/* Print a key for a pair whose cause is unknown. Pairs in which the same pixels differ by the same amount get the
 * same key. */
static void print_tally_key(FILE *out, const diff_pair *pair)
{
    const image_tally *t = &pair->difference.unlike;
    fprintf(out, "%" PRIu64 " %a %d %d %d %d %d %d %d", t->pixels, t->worst_delta, t->worst_x, t->worst_y,
            t->largest_channel, t->min_x, t->min_y, t->max_x, t->max_y);
}

/* Print a key made from the text chunks of two PNG files, for frames that are not from recordings. */
static void print_origins_key(FILE *out, const pair_look *l)
{
    const frame_origin *a = &l->origins[0], *b = &l->origins[1];
    fprintf(out, "%s session, %" PRIu64 " ticks on", a->session == b->session ? "the same" : "another",
            b->tick - a->tick);
}

/* Print the key of a pair. Return false if the pair has no key. A pair has no key if it cannot be compared with
 * other pairs: for example, only digests are known, or a frame is missing. */
static bool print_key(FILE *out, const explanation *e, const diff_pair *pair, const pair_look *l)
{
    const bool known = e->cause.session.count > 0 || e->cause.view.count > 0, both = pair->a && pair->b;
    fprintf(out, "%s, ", diff_finding_name(pair->finding));
    if (pair->effect != RULE_UNUSED)
        fprintf(out, "rule %zu %d, ", pair->rule->line, (int)pair->effect);
    if (pair->finding == FOUND_SIZE)
        fprintf(out, "%dx%d %dx%d, ", pair->about[0].width, pair->about[0].height, pair->about[1].width,
                pair->about[1].height);
    if (pair->flaky)
        fprintf(out, "%s, ", pair->flaky);
    if (has_frame_fault(l))
        fprintf(out, "faults %d %d, ", (int)l->faults[0], (int)l->faults[1]);
    if (is_only_rendering_different(e, l))
        fputs("drawn", out);
    else if (e->recordings && !both)
        print_why_frame_is_missing(out, &e->sides[pair->a ? 1 : 0], diff_pair_tick(pair));
    else if (e->recordings && known && !has_frame_fault(l))
        fprintf(out, "recordings, %s", cause_origins_find_causes(&e->cause.session.origins, diff_pair_tick(pair)));
    else if (have_both_texts(l) && !has_frame_fault(l))
        print_origins_key(out, l);
    else if (pair->finding == FOUND_PIXELS || pair->finding == FOUND_WITHIN)
        print_tally_key(out, pair);
    else
        return pair->finding == FOUND_SIZE || pair->flaky;
    return true;
}

char *pair_find_key(const explanation *e, const diff_pair *pair, const pair_look *l)
{
    text_stream s;
    char *key;
    const bool has_key = text_stream_begin(&s) && print_key(s.stream, e, pair, l);
    if (text_stream_end(&s, &key) && has_key)
        return key;
    free(key);
    return NULL;
}
