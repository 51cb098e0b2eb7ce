/* sentence.c - the cause of one pair, from what is known of both recordings or of the two frames alone. */
#include "sentence.h"
#include "cause_words.h"
#include "frame_file.h"
#include "text.h"
#include "image_digest.h"
#include "png_read.h"

#include <inttypes.h>
#include <string.h>

/* What both frames say of themselves. */
typedef struct origins {
    frame_origin of[2];
    bool told; /* by both */
} origins;

static origins read_origins(const diff_pair *pair)
{
    origins o = {0};
    o.told = pair->a && pair->b && pair->a->path && pair->b->path && frame_read_origin(pair->a->path, &o.of[0]) &&
             frame_read_origin(pair->b->path, &o.of[1]);
    return o;
}

/* Whether a frame has the pixels that it says were drawn. */
static bool is_as_drawn(const diff_frame *frame, const frame_origin *origin)
{
    octreel_error ignored;
    image about;
    uint64_t pixels;
    return image_digest_png(frame->path, IMAGE_WHITE, &about, &pixels, &ignored) && pixels == origin->pixels;
}

/* Two frames that say the same of their pixels, and differ in them: name what somebody changed. */
static bool print_changed(FILE *out, const diff_pair *pair, const origins *o)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    bool changed = false;
    for (int i = 0; i < 2 && o->of[0].pixels == o->of[1].pixels; i++)
        if (!is_as_drawn(frames[i], &o->of[i])) {
            fprintf(out, "%s%s was changed after it was drawn: its pixels are not those that it says",
                    changed ? "; " : "", frames[i]->path);
            changed = true;
        }
    return changed;
}

void sentence_print_rendering(FILE *out, const explanation *e)
{
    fputs("rendering differs: the scene digests are equal", out);
    if (e->recordings && strcmp(e->sides[0].drawn_by, e->sides[1].drawn_by) == 0)
        fprintf(out, "; both drawn by %s", e->sides[0].drawn_by);
    else if (e->recordings)
        fprintf(out, "; reference drawn by %s, frame by %s", e->sides[0].drawn_by, e->sides[1].drawn_by);
}

/* Why a recording has no frame of a tick. */
static void print_missing(FILE *out, const recorded *r, uint64_t tick)
{
    const uint64_t last = octree_session_length(&r->replay.session.session);
    if (tick > last)
        fprintf(out, "the session of %s ends at tick %" PRIu64, r->side->path, last);
    else if (tick % r->view.every)
        fprintf(out, "%s has a frame every %" PRIu64 " ticks", r->side->path, r->view.every);
    else
        fprintf(out, "%s lacks it: that recording is damaged, or not done", r->side->path);
}

static void print_tick(FILE *out, const explanation *e, uint64_t tick)
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
    if ((e->cause.session.count > 0)) {
        fputs("the same happened in it; ", out);
        cause_print_facts(out, &e->cause.session, true);
    } else {
        fputs(
            "another scene of the same session and view: drawn by another version of octreel, or the files beside the "
            "frames were changed",
            out);
    }
}

/* Frames without recordings: only their text chunks tell something. */
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
    const trace *t = tracer_at(&e->tracer, tick);
    if (t && t->count) {
        fputs("; ", out);
        trace_print(out, t);
    }
}

static void print_cause(FILE *out, const explanation *e, const diff_pair *pair, pair_cause *cause)
{
    const origins o = read_origins(pair);
    const bool same_scene = o.told && o.of[0].scene == o.of[1].scene, both = pair->a && pair->b;
    const bool changed = same_scene && print_changed(out, pair, &o);
    uint64_t tick = 0;
    frame_parse_name(diff_pair_name(pair), &tick);
    cause->only_drawn = same_scene && !changed;
    if (cause->only_drawn)
        sentence_print_rendering(out, e);
    else if (e->recordings && both && !changed)
        print_tick(out, e, tick);
    else if (e->recordings && !both)
        print_missing(out, &e->sides[pair->a ? 1 : 0], tick);
    else if (o.told && !changed)
        print_origins(out, &o);
    if (e->recordings)
        print_trace(out, e, tick);
}

bool sentence_of(const explanation *e, const diff_pair *pair, pair_cause *cause, octreel_error *error)
{
    text_stream s;
    const bool begun = text_stream_begin(&s);
    if (begun)
        print_cause(s.stream, e, pair, cause);
    return (text_stream_end(&s, &cause->text) && begun) || error_set(error, "there is no memory for a cause");
}
