/* SPDX-License-Identifier: MIT */
/* verify.c - replays the session of a recording, and compares ticks and frames. */
#include "verify.h"
#include "context.h"
#include "film.h"
#include "frame_file.h"
#include "folder_files.h"
#include "replay.h"
#include "text.h"
#include "verify_line.h"
#include "image_compare.h"
#include "image_digest.h"
#include "png_read.h"

#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* The state of a verification. */
typedef struct verifying {
    const char *folder;
    const verify_options *options;
    replay replay;
    film_share share;        /* the ticks to verify, all of them or the share of one process */
    uint64_t filmed_session; /* the session digest in the recording's first frame; without this frame, the digest of
                                session.json */
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

static void check_session_digest(verifying *v)
{
    if (!frame_read_session_digest(v->folder, 0, &v->filmed_session) || v->filmed_session == v->replay.session_digest)
        return;
    add_finding(v, VERIFY_SESSION, 0,
                "session.json is not the recorded session: its digest is %016" PRIx64
                ", and the first frame names %016" PRIx64,
                v->replay.session_digest, v->filmed_session)
        ->has_tick = false;
}

static void check_frame_size(verifying *v, const char *path)
{
    const view *wanted = &v->replay.film.view;
    octreel_error ignored;
    image frame;
    if (!image_read_png(path, &frame, &ignored))
        return;
    if (frame.width != wanted->width || frame.height != wanted->height) {
        add_finding(v, VERIFY_VIEW, 0, "recording.json says %d x %d pixels, but the first frame has %d x %d",
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
        check_session_digest(v);
        check_frame_size(v, path);
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
    const line_state state = line_reader_next(&v->lines, line_size_limit(&expected));
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
                    state == LINE_TORN ? "is incomplete: the file ends in the middle of it"
                                       : "is longer than it should be",
                    state == LINE_TORN ? COMPLETED : "");
    v->stopped = true;
    return true;
}

static void report_pixel_difference(verifying *v, const char *path, uint64_t tick)
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
                r->drawn_by, same ? "the same renderer, so recording.json or octreel has changed" : r->drawn_now);
}

/* Report a wrong frame. `drawn` is true if the pixels of the frame are correct and something else is wrong. */
static void report_wrong_frame(verifying *v, const char *sentence, uint64_t tick, bool drawn)
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
static bool is_pixel_digest_correct(const verifying *v, const frame_origin *origin)
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
        report_wrong_frame(v, unlike.text, step->tick, is_pixel_digest_correct(v, &origin));
    else if (!is_pixel_digest_correct(v, &origin))
        report_pixel_difference(v, path, step->tick);
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
    /* Only the first share reports progress. All shares take about the same time, so its part stands for the whole. */
    if (v->share.first == 0)
        watcher_report(&v->options->watch, (step->tick + 1) * v->replay.ticks / v->share.last, v->replay.ticks);
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
                        make_printable(first), count > 1 ? ", and neither are other files" : "");
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

/* Replay the session, and verify the ticks of v->share. `watch` may be null. */
static bool verify_share(verifying *v, const watcher *watch, octreel_error *error)
{
    if (!line_reader_open(&v->lines, v->folder, error))
        return false;
    line_reader_skip(&v->lines, v->share.first);
    if (!playback_open(&v->replay.playback, &v->replay.session.session, &v->replay.session.values, &v->replay.film.view,
                       error) ||
        !open_renderer(v, error))
        return false;
    if (v->replay.playback.picture.renderer)
        report_renderer(v);
    if (!playback_run(&v->replay.playback, &v->share, check_tick, v, watch, error))
        return v->stopped;
    if (v->share.last == v->replay.ticks)
        check_end_of_lines(v);
    return true;
}

/* ---- Several processes --------------------------------------------------------------------------------------- */

/* The result of the verification of a share. */
typedef struct outcome {
    bool ok, stopped;
    verify_report report;
    octreel_error error;
} outcome;

/* A process that verifies a share. It inherits the session from this process, so pointers into the session and to
 * string constants are the same in both processes. */
typedef struct verifier {
    pid_t pid;
    FILE *outcome; /* the process writes its outcome into this pipe */
} verifier;

/* Returns false if nobody reads the outcome any more, because the process that started this one has ended. */
static bool is_awaited(void *context)
{
    struct pollfd outcome = {.fd = *(const int *)context};
    return poll(&outcome, 1, 0) == 0;
}

static bool start_verifier(verifying *v, verifier *started, octreel_error *error)
{
    int ends[2];
    *started = (verifier){0};
    if (pipe(ends) != 0)
        return error_set(error, "cannot create a pipe: %s", strerror(errno));
    started->pid = fork();
    if (started->pid == 0) {
        outcome made = {.report = *v->report};
        close(ends[0]);
        v->report = &made.report;
        draw_context_set_report(NULL);
        made.ok = verify_share(v, &(watcher){.keep_going = is_awaited, .context = &ends[1]}, &made.error);
        made.stopped = v->stopped;
        _exit(write(ends[1], &made, sizeof made) == sizeof made ? EXIT_SUCCESS : EXIT_FAILURE);
    }
    const int reason = errno;
    close(ends[1]);
    started->outcome = started->pid > 0 ? fdopen(ends[0], "rb") : NULL;
    if (started->outcome)
        return true;
    close(ends[0]);
    return error_set(error, "cannot start a process: %s", strerror(reason));
}

/* Add the outcome of a share to the outcome of all shares before it. */
static bool add_outcome(verifying *v, const verifier *from, octreel_error *error)
{
    outcome made;
    const verify_report before = *v->report;
    if (fread(&made, sizeof made, 1, from->outcome) != 1)
        return error_set(error, "%s: a process that verifies ticks ended early", v->folder);
    *v->report = made.report;
    v->report->ticks += before.ticks;
    v->report->frames += before.frames;
    v->report->gaps += before.gaps;
    if (before.gaps > 0)
        v->report->first_gap = before.first_gap;
    v->stopped = made.stopped;
    *error = made.error;
    return made.ok;
}

/* End a process whose outcome is known or not needed. A verifier writes no files. */
static void end_verifier(const verifier *ended)
{
    if (ended->outcome)
        fclose(ended->outcome);
    if (ended->pid > 0) {
        kill(ended->pid, SIGKILL);
        while (waitpid(ended->pid, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
}

/* Divide the ticks into one share for each process. This process verifies the first share, and then adds the outcomes
 * of the others in order, up to the first tick that differs. */
static bool verify_by_jobs(verifying *v, unsigned jobs, octreel_error *error)
{
    verifier *others = calloc(jobs, sizeof *others);
    bool ok = others || error_no_memory(error);
    /* llvmpipe must draw without threads, because each process uses one core, as in octreel record */
    if (jobs > 1)
        setenv("LP_NUM_THREADS", "0", 0);
    for (unsigned i = jobs; ok && i-- > 0;) {
        v->share = (film_share){.first = v->replay.ticks * i / jobs, .last = v->replay.ticks * (i + 1) / jobs};
        ok = i > 0 ? start_verifier(v, &others[i], error) : verify_share(v, NULL, error);
    }
    for (unsigned i = 1; others && i < jobs; i++) {
        ok = ok && (v->stopped || add_outcome(v, &others[i], error));
        end_verifier(&others[i]);
    }
    free(others);
    return ok;
}

static unsigned choose_jobs(const verifying *v)
{
    const unsigned jobs =
        v->options->jobs ? v->options->jobs : film_default_jobs(&v->replay.session.session, &v->replay.film);
    return jobs < v->replay.ticks ? jobs : (unsigned)v->replay.ticks;
}

static bool verify_all(verifying *v, octreel_error *error)
{
    if (!replay_read(&v->replay, v->folder, v->options->max_ticks, error) ||
        !line_reader_open(&v->lines, v->folder, error))
        return false;
    line_reader_close(&v->lines);
    v->filmed_session = v->replay.session_digest;
    v->report->has_frames = v->replay.film.every > 0;
    errno = 0;
    if (v->report->has_frames)
        describe_recorded_renderer(v->folder, v->report->drawn_by, sizeof v->report->drawn_by);
    return check_system_resources(error) && (!v->report->has_frames || check_first_frame(v, error)) &&
           (v->stopped || verify_by_jobs(v, choose_jobs(v), error)) && check_extra_frames(v, error);
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
