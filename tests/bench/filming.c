/* SPDX-License-Identifier: MIT */
/* filming.c - see filming.h. */
#include "filming.h"
#include "cloud_page.h"
#include "file.h"
#include "film.h"
#include "frame_file.h"
#include "naive.h"
#include "page.h"
#include "page_timing.h"
#include "playback.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double read_clock(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double now(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

/* The processor time of this process, which has one thread, independent of the load of the machine. */
static double worked(void)
{
    return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* The state of a recording in its own process. */
typedef struct work {
    const filming_order *order;
    filming *result;
    double started; /* time before the process was started */
    double begun;   /* time when the first counted frame began */
    uint64_t apart; /* number of start-up frames, one per process */
    octree_session *session;
} work;

static bool fail(work *w, const char *why)
{
    snprintf(w->result->trouble, sizeof w->result->trouble, "%s", why);
    return false;
}

/* After each frame. */
static void note_frame(uint64_t done, uint64_t total, void *context)
{
    work *w = context;
    (void)total;
    if (done == 1)
        w->result->first_ms = now() - w->started;
    if (done == w->apart)
        w->begun = now();
}

static void note_end(work *w)
{
    w->result->frame_ms = (now() - w->begun) / (double)(w->order->frames - w->apart);
}

/* ---- Octreel ------------------------------------------------------------------------------------------------ */

static bool film_octreel(work *w)
{
    film_summary summary;
    octreel_error error;
    const film_options options = {.folder = w->order->folder,
                                  .view = filmed_view(w->order->scene),
                                  .every = 1,
                                  .jobs = w->order->jobs,
                                  .watch = {note_frame, NULL, w}};
    w->apart = w->order->jobs;
    if (!film_session(w->session, &options, &summary, &error))
        return fail(w, error.text);
    note_end(w);
    return true;
}

/* Record one frame and time its parts. The second encoding is of pixels that are in the cache. */
static bool film_part(work *w, playback *p, const char *again, double spent[3])
{
    film_step step;
    octreel_error error;
    octreel_error unwritten;
    const double start = worked();
    if (!playback_film_tick(p, &step, &error))
        return fail(w, error.text);
    const double drawn = worked();
    if (!frame_write(w->order->folder, &p->picture.frame, &(frame_origin){.tick = step.tick}, &error))
        return fail(w, error.text);
    const double written = worked();
    if (!image_write_png(&p->picture.frame, again, NULL, 0, &unwritten))
        return fail(w, unwritten.text);
    spent[0] += drawn - start;
    spent[1] += written - drawn;
    spent[2] += worked() - written;
    return true;
}

static bool film_in_parts(work *w, playback *p)
{
    double spent[3] = {0};
    octreel_error error;
    char *again = path_join(w->order->folder, "again.png");
    bool ok = again || fail(w, "there is no memory");
    for (uint64_t i = 0; ok && i < w->order->frames; i++) {
        const double start = worked();
        if (i > 0 && !playback_advance(p, &error))
            ok = fail(w, error.text);
        spent[0] += worked() - start;
        ok = ok && film_part(w, p, again, spent);
        if (i == 0) {
            w->result->first_ms = spent[0] + spent[1];
            memset(spent, 0, sizeof spent); /* start-up */
        }
    }
    const double start = worked();
    ok = ok && (playback_check_last_frame(p, &error) || fail(w, error.text));
    spent[0] += worked() - start;
    const double frames = (double)(w->order->frames - 1);
    w->result->draw_ms = spent[0] / frames;
    w->result->encode_ms = spent[1] / frames;
    w->result->floor_ms = spent[2] / frames;
    w->result->frame_ms = w->result->draw_ms + w->result->encode_ms;
    free(again);
    return ok;
}

static bool film_parts(work *w)
{
    playback p;
    octreel_error error;
    const view v = filmed_view(w->order->scene);
    const draw_fill fill = w->order->who == FILM_CHECKED ? DRAW_FILL_CHECKED : DRAW_FILL_INTEGERS;
    const playback_target target = {
        .frames = FRAMES_SHOW, .folder = w->order->folder, .every = 1, .renderer.fill = fill};
    setenv("LP_NUM_THREADS", "0", 0); /* as in the processes of FILM_OCTREEL */
    const bool open = folder_create(w->order->folder, &error) && playback_open(&p, w->session, NULL, &v, &error) &&
                      playback_open_picture(&p, &target, &error);
    const bool ok = open ? film_in_parts(w, &p) : fail(w, error.text);
    if (open)
        playback_close(&p);
    return ok;
}

/* ---- The naive way ------------------------------------------------------------------------------------------ */

static bool film_naive_tick(work *w, naive *n, octree_game *game, scene *s)
{
    const double start = worked();
    const view v = filmed_whole_view(w->order->scene);
    const uint64_t tick = octree_game_tick(game)->number;
    char name[FRAME_NAME];
    if (!tick_scene_build(s, &v, game, NULL, NULL) || !naive_draw(n, s))
        return fail(w, "the naive way cannot draw");
    const double drawn = worked();
    char *path = path_join(w->order->folder, frame_print_name(tick, name));
    const bool written = path && naive_write(n, path);
    free(path);
    if (!written)
        return fail(w, "the naive way cannot write");
    w->result->draw_ms += drawn - start;
    w->result->encode_ms += worked() - drawn;
    note_frame(tick + 1, 0, w);
    if (tick == 0)
        w->result->draw_ms = w->result->encode_ms = 0; /* start-up */
    return true;
}

static bool film_naive(work *w)
{
    const view v = filmed_whole_view(w->order->scene);
    const char *why;
    scene s = {0};
    octree_game *game = NULL;
    octreel_error error;
    setenv("LP_NUM_THREADS", "0", 1);
    w->apart = 1;
    naive *n = naive_open(v.width, v.height, &why);
    bool ok = n ? folder_create(w->order->folder, &error) || fail(w, error.text) : fail(w, why);
    ok = ok && (octree_game_create(w->session, &game) == OCTREE_OK || fail(w, "the session cannot be played"));
    for (uint64_t i = 0; ok && i < w->order->frames; i++) {
        ok = i == 0 || octree_game_advance(game) == OCTREE_OK || fail(w, "the session cannot be played");
        ok = ok && film_naive_tick(w, n, game, &s);
    }
    note_end(w);
    w->result->draw_ms /= (double)(w->order->frames - 1);
    w->result->encode_ms /= (double)(w->order->frames - 1);
    octree_game_destroy(game);
    scene_release(&s);
    naive_close(n);
    return ok;
}

/* ---- The page ----------------------------------------------------------------------------------------------- */

static bool film_session_page(work *w)
{
    film_summary summary;
    octreel_error error;
    const film_options options = {.folder = w->order->folder, .view = filmed_view(w->order->scene), .every = 0};
    return film_session(w->session, &options, &summary, &error) || fail(w, error.text);
}

/* Make a cloud of the points of the session. The color of a point shows its position. */
static bool make_cloud(const octree_session *session, cloud *c)
{
    *c = (cloud){.count = session->body_count, .color_full = 255};
    c->positions = malloc(c->count * sizeof *c->positions);
    for (size_t i = 0; c->positions && i < c->count; i++) {
        point_value value = {.has[POINT_COLOR] = true};
        memcpy(c->positions[i], session->bodies[i].position, sizeof c->positions[i]);
        for (int axis = 0; axis < 3; axis++)
            value.color[axis] = (unsigned char)((c->positions[i][axis] + 1000) / 8);
        if (!point_values_append_row(&c->values, &value))
            return false;
    }
    return c->positions;
}

static bool write_cloud_page(work *w, const inspection *made)
{
    const view v = filmed_view(w->order->scene);
    const cloud_page page = {.title = w->order->scene->name, .made = made, .view = &v};
    octreel_error error;
    file_writer file;
    char *path = folder_create(w->order->folder, &error) ? path_join(w->order->folder, "index.html") : NULL;
    const bool open = path && file_writer_open(&file, path, &error);
    const bool ok = open && (cloud_page_write(&page, file.stream, &error) ? file_writer_close(&file, &error)
                                                                          : file_writer_discard(&file));
    free(path);
    return ok || fail(w, error.text);
}

static bool film_cloud_page(work *w)
{
    octree_def def = w->session->tree;
    inspection made;
    octreel_error error;
    cloud c;
    def.leaf_capacity = 64;
    const bool built = make_cloud(w->session, &c) && inspect_build(&c, &def, NULL, &made, &error);
    const bool ok = built ? write_cloud_page(w, &made) : fail(w, "the cloud has no tree");
    if (built)
        inspect_release(&made);
    cloud_release(&c);
    return ok;
}

static bool film_page(work *w)
{
    page_times t;
    if (!page_can_play())
        return fail(w, "octreel was built without WebAssembly");
    if (!(w->order->scene->cloud ? film_cloud_page : film_session_page)(w))
        return false;
    if (!page_time(w->order->browser, w->order->folder, w->order->frames, &t, w->result->trouble,
                   sizeof w->result->trouble))
        return false;
    w->result->first_ms = t.first_ms;
    w->result->frame_ms = t.frame_ms;
    w->result->draw_ms = t.draw_ms;
    w->result->scrub_ms = t.scrub_ms;
    memcpy(w->result->turning, t.turning, sizeof t.turning);
    w->result->mib = t.mib;
    w->result->page_kb = t.kb;
    return true;
}

/* ---- A process of its own ----------------------------------------------------------------------------------- */

/* Linux counts both in kilobytes. */
static double peak_mib(void)
{
    struct rusage own, children;
    if (getrusage(RUSAGE_SELF, &own) != 0 || getrusage(RUSAGE_CHILDREN, &children) != 0)
        return 0;
    return (double)(own.ru_maxrss > children.ru_maxrss ? own.ru_maxrss : children.ru_maxrss) / 1024;
}

static uint64_t count_ticks(const filming_order *order)
{
    const uint64_t page_ticks = order->who == FILM_PAGE ? order->scene->page_ticks : 0;
    return page_ticks ? page_ticks : order->frames;
}

static void do_work(const filming_order *order, double started, int result_end)
{
    static bool (*const films[FILM_KINDS])(work *) = {
        [FILM_NAIVE] = film_naive,   [FILM_OCTREEL] = film_octreel, [FILM_PARTS] = film_parts,
        [FILM_CHECKED] = film_parts, [FILM_ASKED] = film_parts,     [FILM_ANSWERED] = film_parts,
        [FILM_PAGE] = film_page};
    filming result = {0};
    filmed_session made;
    work w = {.order = order, .result = &result, .started = started, .apart = 1};
    const bool answered = order->who == FILM_ANSWERED;
    const size_t asked = answered || order->who == FILM_ASKED ? order->scene->asked : 0;
    bool ok = filmed_session_make(&made, order->scene, count_ticks(order), asked, answered) ||
              fail(&w, "there is no memory for the session");
    w.session = &made.session;
    ok = ok && films[order->who](&w);
    if (order->who != FILM_PAGE)
        result.mib = peak_mib();
    _exit(ok + (write(result_end, &result, sizeof result) == sizeof result) == 2 ? EXIT_SUCCESS : EXIT_FAILURE);
}

static void remove_folder(const char *folder)
{
    const pid_t pid = fork();
    if (pid == 0) {
        execlp("rm", "rm", "-rf", "--", folder, (char *)NULL);
        _exit(EXIT_FAILURE);
    }
    while (pid > 0 && waitpid(pid, NULL, 0) < 0 && errno == EINTR)
        continue;
}

bool film_scene(const filming_order *order, filming *result)
{
    int ends[2], status = -1;
    *result = (filming){.trouble = "the process that filmed has died"};
    if (pipe(ends) != 0)
        return false;
    const double started = now();
    const pid_t pid = fork();
    if (pid == 0)
        do_work(order, started, ends[1]);
    close(ends[1]);
    const bool told = read(ends[0], result, sizeof *result) == sizeof *result;
    close(ends[0]);
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    remove_folder(order->folder);
    return told && status == 0;
}
