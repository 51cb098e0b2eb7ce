/* SPDX-License-Identifier: MIT */
/* verify.c - replays the session of a recording, compares ticks and frames, and prints the findings. */
#include "verify.h"
#include "frame_file.h"
#include "json_write.h"
#include "folder_files.h"
#include "replay.h"
#include "text.h"
#include "verify_line.h"
#include "image_compare.h"
#include "image_digest.h"
#include "png_read.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The state of a verification. */
typedef struct verifying {
    const char *folder;
    const verify_options *options;
    replay replay;
    uint64_t filmed_session; /* the digest of the session that the recording's first frame contains */
    line_reader lines;
    bool stopped; /* true: verification has stopped at the first tick that differs */
    verify_report *report;
} verifying;

/* Append a finding about a tick to the report. */
static verify_finding *add_finding(verifying *v, verify_kind kind, uint64_t tick, const char *format, ...)
{
    verify_finding *finding = &v->report->findings[v->report->count++];
    va_list arguments;
    *finding = (verify_finding){.kind = kind, .has_tick = true, .tick = tick};
    va_start(arguments, format);
    vsnprintf(finding->text, sizeof finding->text, format, arguments);
    va_end(arguments);
    return finding;
}

/* ---- Before the first tick ---------------------------------------------------------------------------------- */

static void check_session(verifying *v)
{
    if (!frame_read_session_digest(v->folder, 0, &v->filmed_session) || v->filmed_session == v->replay.session_digest)
        return;
    add_finding(v, VERIFY_SESSION, 0,
                "session.json is not the recorded session: its digest is %016" PRIx64
                ", and the first frame names %016" PRIx64,
                v->replay.session_digest, v->filmed_session)
        ->has_tick = false;
}

static void check_size(verifying *v, const char *path)
{
    const view *wanted = &v->replay.film.view;
    octreel_error ignored;
    image frame;
    if (!image_read_png(path, &frame, &ignored))
        return;
    if (frame.width != wanted->width || frame.height != wanted->height) {
        add_finding(v, VERIFY_VIEW, 0, "recording.json says %d x %d pixels, and the first frame has %d x %d",
                    wanted->width, wanted->height, frame.width, frame.height);
        v->stopped = true;
    }
    image_release(&frame);
}

static bool is_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* Check the session digest and the size of the first frame before the renderer is opened, because the renderer is
 * opened with the size in recording.json. Everything else in this frame is checked later, together with its tick. */
static bool check_first_frame(verifying *v, octreel_error *error)
{
    char name[FRAME_NAME], *path = path_join(v->folder, frame_print_name(0, name));
    if (!path)
        return error_no_memory(error);
    errno = 0;
    if (is_file(path)) {
        check_session(v);
        check_size(v, path);
    }
    free(path);
    return check_system_resources(error);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* Appended to a finding if ticks or frames at the end of the recording are missing: recording was then interrupted. */
#define COMPLETED "; octreel record --resume completes an interrupted recording"

static bool check_line(verifying *v, const film_step *step, octreel_error *error)
{
    const playback *p = &v->replay.playback;
    char name[FRAME_NAME];
    const tick_extras extras = {.frame = step->filmed ? frame_print_name(step->tick, name) : NULL,
                                .scene_digest = p->extras.scene_digest};
    const expected_line expected = {step->line, step->size, octree_game_tick(p->game), &extras};
    const line_state state = line_reader_next(&v->lines, line_limit(&expected));
    verify_finding differs = {.kind = VERIFY_LINES, .has_tick = true, .tick = step->tick};
    if (state == LINE_TROUBLE)
        return error_set(error, "%s/ticks.jsonl: cannot be read: %s", v->folder, strerror(errno));
    if (state == LINE_WHOLE && line_matches(&v->lines, &expected, &differs))
        return true;
    if (state == LINE_WHOLE)
        v->report->findings[v->report->count++] = differs;
    else if (state == LINE_NONE)
        add_finding(v, VERIFY_LINES, step->tick,
                    "ticks.jsonl ends before this tick: %" PRIu64 " of its %" PRIu64 " line%s are missing%s",
                    v->replay.ticks - step->tick, v->replay.ticks, plural_ending(v->replay.ticks), COMPLETED);
    else
        add_finding(v, VERIFY_LINES, step->tick, "its line in ticks.jsonl %s%s",
                    state == LINE_TORN ? "is torn: the file ends within it" : "does not end where it should",
                    state == LINE_TORN ? COMPLETED : "");
    v->stopped = true;
    return true;
}

static void report_pixels(verifying *v, const char *path, uint64_t tick)
{
    image_tally unlike = {0};
    octreel_error ignored;
    image frame;
    if (image_read_png(path, &frame, &ignored)) {
        unlike = image_compare(&frame, &v->replay.playback.picture.frame).unlike;
        image_release(&frame);
    }
    v->report->pixels = unlike.pixels;
    const verify_report *r = v->report;
    const bool same = strcmp(r->drawn_by, r->drawn_now) == 0;
    add_finding(v, VERIFY_PIXELS, tick, "%" PRIu64 " pixel%s from (%d, %d) to (%d, %d); filmed by %s; now drawn by %s",
                unlike.pixels, plural_ending(unlike.pixels), unlike.min_x, unlike.min_y, unlike.max_x, unlike.max_y,
                r->drawn_by, same ? "the same: was recording.json changed, or octreel?" : r->drawn_now);
}

/* Report a wrong frame. `drawn` is true if the pixels of the frame are correct and something else is wrong. */
static void report_frame(verifying *v, const char *sentence, uint64_t tick, bool drawn)
{
    const size_t length = strlen(v->folder);
    const bool inside = strncmp(sentence, v->folder, length) == 0 && sentence[length] == '/';
    add_finding(v, VERIFY_FRAME, tick, "%s%s", inside ? sentence + length + 1 : sentence,
                drawn ? "; its pixels are correct" : "");
}

/* Check that an existing file can be read. Returns false with an error if permissions or the disk prevent this: such an
 * error is not a difference of the recording. */
static bool check_readable(const char *path, octreel_error *error)
{
    char reason[FILE_REASON];
    FILE *file = file_open(path, NULL, reason);
    if (!file)
        return error_set(error, "%s: %s", path, reason);
    fclose(file);
    return true;
}

/* Returns true if the pixel digest that a frame contains is the digest of the pixels that were drawn now. */
static bool is_drawn(const verifying *v, const frame_origin *origin)
{
    return origin->pixels == image_digest_with(origin->kind, &v->replay.playback.picture.frame);
}

static bool check_frame(verifying *v, const film_step *step, octreel_error *error)
{
    char name[FRAME_NAME], *path = path_join(v->folder, frame_print_name(step->tick, name));
    frame_origin origin = {
        .tick = step->tick, .session = v->filmed_session, .scene = v->replay.playback.extras.scene_digest};
    octreel_error unlike;
    if (!path)
        return error_no_memory(error);
    bool ok = true;
    v->stopped = true;
    if (access(path, F_OK) != 0)
        add_finding(v, VERIFY_FRAME, step->tick, "%s is missing", name);
    else if (!is_file(path))
        add_finding(v, VERIFY_FRAME, step->tick, "%s is not a regular file", name);
    else if (!check_readable(path, error))
        v->stopped = ok = false;
    else if (!frame_check_tick(v->folder, &origin, &unlike))
        report_frame(v, unlike.text, step->tick, is_drawn(v, &origin));
    else if (!is_drawn(v, &origin))
        report_pixels(v, path, step->tick);
    else
        v->stopped = false;
    free(path);
    return ok;
}

/* Check one tick; a film_sink. Returns false on an error, and also to stop at the first tick that differs. */
static bool check_tick(void *context, const film_step *step, octreel_error *error)
{
    verifying *v = context;
    errno = 0;
    bool ok = check_line(v, step, error);
    if (ok && !v->stopped && step->filmed)
        ok = check_frame(v, step, error);
    if (ok && v->stopped && !check_system_resources(error))
        v->stopped = ok = false;
    if (!ok || v->stopped)
        return false;
    v->report->ticks++;
    v->report->frames += step->filmed;
    if (step->gap && v->report->gaps++ == 0)
        v->report->first_gap = *octree_session_gap(&v->replay.session.session, step->tick);
    watcher_report(&v->options->watch, step->tick + 1, v->replay.ticks);
    return true;
}

/* ---- After the last tick ------------------------------------------------------------------------------------ */

static void check_end_of_lines(verifying *v)
{
    if (line_reader_next(&v->lines, 0) == LINE_NONE)
        return;
    add_finding(v, VERIFY_LINES, v->replay.ticks,
                "ticks.jsonl has lines beyond the session, which has %" PRIu64 " tick%s", v->replay.ticks,
                plural_ending(v->replay.ticks));
}

/* Returns true if a file is named like a frame, but the recording has no frame with this name. */
static bool is_extra_frame(const verifying *v, const char *name)
{
    uint64_t tick;
    return strncmp(name, "frame_", 6) == 0 &&
           (!frame_is_name_of_recording(name, v->replay.ticks, v->replay.film.every) ||
            (frame_parse_name(name, &tick) && octree_session_gap(&v->replay.session.session, tick)));
}

/* Report extra frames: files in the folder that are named like a frame, but are not frames of the recording. Only the
 * first by name is reported. */
static bool check_extra_frames(verifying *v, octreel_error *error)
{
    char **names = folder_names(v->folder, error), *first = NULL;
    const bool ok = names;
    uint64_t count = 0, tick;
    for (size_t i = 0; ok && names[i]; i++)
        if (is_extra_frame(v, names[i]) && count++ == 0)
            first = names[i];
    if (count > 0) {
        const bool has_tick = frame_parse_name(first, &tick);
        verify_finding *finding =
            add_finding(v, VERIFY_FRAME, has_tick ? tick : 0, "%s is not a frame of this recording%s",
                        make_printable(first), count > 1 ? ", and neither are others" : "");
        finding->has_tick = has_tick;
    }
    free(names);
    return ok;
}

/* ---- The recording ------------------------------------------------------------------------------------------ */

static void report_renderer(verifying *v)
{
    const renderer_info info = renderer_describe(v->replay.playback.picture.renderer);
    describe_renderer(&info, v->report->drawn_now, sizeof v->report->drawn_now);
    v->report->fill = info.fill;
}

/* Open the renderer for the comparison. GL draws, because GL defines which pixels are correct. If no GL can be loaded
 * and the user did not name a GL context, the integer rasterizer draws. */
static bool open_renderer(verifying *v, octreel_error *error)
{
    playback *p = &v->replay.playback;
    playback_target target = {FRAMES_SHOW, v->folder, v->replay.film.every, v->options->renderer};
    target.renderer.fill = DRAW_FILL_GL;
    if (playback_open_picture(p, &target, error))
        return true;
    if (v->options->renderer.context != DRAW_AUTO)
        return false;
    v->report->no_gl = *error;
    target.renderer.fill = DRAW_FILL_INTEGERS;
    return playback_open_picture(p, &target, error);
}

static bool replay_ticks(verifying *v, octreel_error *error)
{
    const film_share all = {.last = v->replay.ticks};
    if (!playback_open(&v->replay.playback, &v->replay.session.session, &v->replay.session.values, &v->replay.film.view,
                       error) ||
        !open_renderer(v, error))
        return false;
    if (v->replay.playback.picture.renderer)
        report_renderer(v);
    if (!playback_run(&v->replay.playback, &all, check_tick, v, NULL, error))
        return v->stopped;
    check_end_of_lines(v);
    return true;
}

static bool verify_all(verifying *v, octreel_error *error)
{
    if (!replay_read(&v->replay, v->folder, v->options->max_ticks, error) ||
        !line_reader_open(&v->lines, v->folder, error))
        return false;
    v->filmed_session = v->replay.session_digest;
    v->report->has_frames = v->replay.film.every > 0;
    errno = 0;
    if (v->report->has_frames)
        describe_recorded_renderer(v->folder, v->report->drawn_by, sizeof v->report->drawn_by);
    return check_system_resources(error) && (!v->report->has_frames || check_first_frame(v, error)) &&
           (v->stopped || replay_ticks(v, error)) && check_extra_frames(v, error);
}

bool verify_recording(const char *folder, const verify_options *options, verify_report *report, octreel_error *error)
{
    verifying v = {.folder = folder, .options = options, .report = report};
    *report = (verify_report){.fill = ""};
    const bool ok = verify_all(&v, error);
    replay_close(&v.replay);
    line_reader_close(&v.lines);
    return ok;
}

/* ---- Printing ----------------------------------------------------------------------------------------------- */

static const struct {
    const char *name; /* the name of the kind in JSON */
    const char *words;
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
