/* film.c - see film.h. */
#include "film.h"
#include "filter.h"
#include "fit.h"
#include "folder_files.h"
#include "picture.h"
#include "tick_scene.h"
#include "ticks_write.h"
#include "viewer.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FRAME_NAME "frame_%06" PRIu64 ".png"
#define FRAME_NAME_SIZE 40

/* A recording while it is made. */
typedef struct filming {
    const film_options *options;
    view view; /* that of the options, fitted to tick 0 */
    octree_game *game;
    picture picture;
    scene scene;
    FILE *ticks;
    long whole_lines; /* bytes of ticks.jsonl up to the end of its last whole line */
    uint64_t session_digest;
    uint64_t tree_version; /* of the tree that `extras` describes */
    bool has_tree;
    tick_extras extras;
} filming;

static bool open_ticks(filming *f, record_error *error)
{
    char *path = folder_path(f->options->folder, "ticks.jsonl");
    f->ticks = path ? fopen(path, "wb") : NULL;
    if (!f->ticks)
        record_fail(error, "%s: cannot be written: %s", path ? path : "ticks.jsonl", strerror(errno));
    free(path);
    return f->ticks != NULL;
}

static bool check_view(const view *v, const octree_def *tree, record_error *error)
{
    char reason[FILTER_TEXT];
    return !filter_refusal(&v->filter, tree, reason) || record_fail(error, "%s", reason);
}

/* Everything that can refuse a session or a view comes before the folder is touched. */
static bool begin(filming *f, const octree_session *session, record_error *error)
{
    const film_options *options = f->options;
    const octree_status status = octree_game_create(session, &f->game);
    if (status != OCTREE_OK)
        return record_fail(error, "the session cannot be played: %s", octree_status_text(status));
    fit_view(&f->view, octree_game_tree(f->game));
    if (!check_view(&f->view, &session->tree, error) ||
        !picture_open(&f->picture, &f->view, &options->renderer, error))
        return false;
    const renderer_info info = renderer_about(f->picture.renderer);
    if (!folder_prepare(options->folder, error))
        return false;
    if (write_recording_file(options->folder, &f->view, options->every, error) &&
        write_session_file(options->folder, session, &f->session_digest, error) &&
        write_renderer_file(options->folder, &info, error) && open_ticks(f, error))
        return true;
    folder_abandon(options->folder);
    return false;
}

/* What traces a frame to the tick that made it. */
static bool write_frame(filming *f, const char *name, record_error *error)
{
    char tick[24], digests[3][DIGEST_TEXT];
    snprintf(tick, sizeof tick, "%" PRIu64, octree_game_tick(f->game)->number);
    const image_text texts[] = {
        {"octreel-tick", tick},
        {"octreel-session", digest_print(f->session_digest, digests[0])},
        {"octreel-scene", digest_print(f->extras.scene_digest, digests[1])},
        {"octreel-pixels", digest_print(image_digest(&f->picture.frame), digests[2])},
    };
    char *path = folder_path(f->options->folder, name);
    const bool ok = path ? picture_write(&f->picture, path, texts, sizeof texts / sizeof texts[0], error)
                         : record_fail(error, "there is no memory");
    free(path);
    return ok;
}

static bool draw_frame(filming *f, const char *name, record_error *error)
{
    if (!tick_scene_build(&f->scene, &f->view, f->game))
        return record_fail(error, "there is no memory for a scene");
    f->extras.scene_digest = scene_digest(&f->scene);
    return picture_draw(&f->picture, &f->scene, error) && write_frame(f, name, error);
}

static void describe_tree(filming *f)
{
    const octree *tree = octree_game_tree(f->game);
    if (f->has_tree && f->tree_version == octree_version(tree))
        return;
    f->has_tree = true;
    f->tree_version = octree_version(tree);
    f->extras.tree_digest = octree_digest(tree);
    octree_statistics(tree, &f->extras.stats);
}

/* Close ticks.jsonl and cut it off behind its last whole line. */
static bool give_up_ticks(filming *f, record_error *error)
{
    const int reason = errno;
    char *path = folder_path(f->options->folder, "ticks.jsonl");
    fclose(f->ticks);
    f->ticks = NULL;
    const bool cut = path && truncate(path, f->whole_lines) == 0;
    free(path);
    return record_fail(error, "%s/ticks.jsonl: cannot be written: %s%s", f->options->folder, strerror(reason),
                       cut ? "" : "; its last line is torn");
}

static bool write_line(filming *f, record_error *error)
{
    tick_write(f->ticks, octree_game_tick(f->game), &f->extras);
    if (ferror(f->ticks) || fflush(f->ticks) != 0)
        return give_up_ticks(f, error);
    f->whole_lines = ftell(f->ticks);
    return true;
}

static void count_frame(film_summary *summary, const renderer *r, const scene_tally *tally)
{
    summary->frames++;
    summary->left_out += renderer_left_out(r);
    summary->over_budget += tally->beyond || tally->thinned;
}

static bool film_tick(filming *f, film_summary *summary, record_error *error)
{
    const octree_tick *tick = octree_game_tick(f->game);
    char name[FRAME_NAME_SIZE];
    snprintf(name, sizeof name, FRAME_NAME, tick->number);
    const bool filmed = tick->number % f->options->every == 0;
    f->extras.frame = filmed ? name : NULL;
    describe_tree(f);
    if ((filmed && !draw_frame(f, name, error)) || !write_line(f, error))
        return false;
    summary->ticks++;
    if (filmed)
        count_frame(summary, f->picture.renderer, &f->scene.tally);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        summary->events[i] += tick->events >> i & 1;
    return true;
}

static bool film_all(filming *f, const octree_session *session, film_summary *summary, record_error *error)
{
    const uint64_t total = octree_session_length(session) + 1;
    for (;;) {
        if (!film_tick(f, summary, error))
            return false;
        if (f->options->progress)
            f->options->progress(summary->ticks, total, f->options->context);
        if (octree_game_over(f->game))
            return true;
        const octree_status status = octree_game_advance(f->game);
        if (status != OCTREE_OK)
            return record_fail(error, "tick %" PRIu64 " cannot be played: %s", summary->ticks,
                               octree_status_text(status));
    }
}

static bool end(filming *f, bool ok, record_error *error)
{
    if (f->ticks && fclose(f->ticks) != 0 && ok)
        ok = record_fail(error, "%s/ticks.jsonl: cannot be written: %s", f->options->folder, strerror(errno));
    octree_game_destroy(f->game);
    picture_close(&f->picture);
    scene_release(&f->scene);
    return ok;
}

bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  record_error *error)
{
    filming f = {.options = options, .view = options->view};
    *summary = (film_summary){0};
    const bool ok = begin(&f, session, error) && film_all(&f, session, summary, error);
    return end(&f, ok, error) && viewer_write(options->folder, error);
}

bool film_tree(const octree *tree, const char *title, const film_options *options, const char *path,
               film_summary *summary,
               record_error *error)
{
    picture p;
    scene s = {0};
    view fitted = options->view, *v = &fitted;
    const octree_def def = octree_definition(tree);
    fit_view(v, tree);
    *summary = (film_summary){0};
    if (!check_view(v, &def, error) || !picture_open(&p, v, &options->renderer, error))
        return false;
    char digests[2][DIGEST_TEXT];
    bool ok = tree_scene_build(&s, v, tree, title) || record_fail(error, "there is no memory for a scene");
    ok = ok && picture_draw(&p, &s, error);
    if (ok) {
        const image_text texts[] = {
            {"octreel-scene", digest_print(scene_digest(&s), digests[0])},
            {"octreel-pixels", digest_print(image_digest(&p.frame), digests[1])},
        };
        ok = picture_write(&p, path, texts, sizeof texts / sizeof texts[0], error);
        count_frame(summary, p.renderer, &s.tally);
    }
    scene_release(&s);
    picture_close(&p);
    return ok;
}
