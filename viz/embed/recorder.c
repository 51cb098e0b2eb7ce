/* SPDX-License-Identifier: MIT */
/* recorder.c - the public recorder. The recorder checks each tick of a program, finds the point changes, and passes the
 * tick to the recording thread's queue or to the ring. */
#include "octreel/recorder.h"
#include "about.h"
#include "contents.h"
#include "error.h"
#include "folder.h"
#include "json_table.h"
#include "number.h"
#include "octree/octree.h"
#include "replacement.h"
#include "ring.h"
#include "session_file.h"
#include "status.h"
#include "recording_file.h"
#include "view_options.h"

#include <errno.h>
#include <fenv.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct octreel_recorder {
    filmer_settings settings;
    bool never_wait, closed;
    bool broken; /* true: recording failed, and no more ticks are accepted */
    contents contents;
    octree_foreign_tree kept; /* foreign nodes of a refused tick; the next accepted tick gets them */
    bool has_kept;
    /* the ring buffer of the last ticks; ring.most is 0 if there is no ring, and then the members below are used: */
    ring ring;
    char *folder;
    queue queue;
    session_filmer filmer;
    uint64_t put;   /* number of ticks that were added to the queue */
    uint64_t ticks; /* number of all accepted and refused ticks */
    losses lost;    /* summary of the refused ticks */
    gap_list gaps;  /* ticks that were refused since the last accepted tick */
    octreel_error error;
};

/* ---- Errors ---------------------------------------------------------------------------------------------- */

const char *octreel_recorder_error(const octreel_recorder *recorder)
{
    return recorder ? recorder->error.text : "";
}

/* Returns the status of a finished recording: GAPS with an error text if ticks were refused. */
static octreel_status find_final_status(octreel_recorder *r, const losses *lost, uint64_t ticks)
{
    if (lost->ticks == 0)
        return OCTREEL_OK;
    return status_refuse(&r->error, OCTREEL_GAPS,
                         "%" PRIu64 " of %" PRIu64 " ticks %s refused and %s in the recording; the first is "
                         "tick %" PRIu64 ": %s",
                         lost->ticks, ticks, lost->ticks == 1 ? "was" : "were",
                         lost->ticks == 1 ? "is a gap" : "are gaps", lost->first, lost->why);
}

/* ---- The definition ----------------------------------------------------------------------------------------- */

octreel_recorder_def octreel_recorder_def_default(void)
{
    const view v = view_make_default();
    return (octreel_recorder_def){.tree = octree_def_default(),
                                  .player = {.kind = OCTREE_PLAYER_NONE},
                                  .width = v.width,
                                  .height = v.height,
                                  .camera = view_camera_name(v.camera),
                                  .layers = "default",
                                  .color_by = view_coloring_name(v.coloring),
                                  .show_tree = view_tree_name(v.tree),
                                  .color_points = view_point_color_name(v.point_color),
                                  .shade = view_shade_name(v.shade),
                                  .diagram = view_diagram_name(v.diagram),
                                  .lod = v.lod,
                                  .budget = v.budget,
                                  .aa = v.aa,
                                  .every = 1,
                                  .fill = draw_fill_name(DRAW_FILL_INTEGERS),
                                  .context = draw_context_name(DRAW_AUTO),
                                  .queue_ticks = 16,
                                  .queue_bytes = (size_t)64 << 20};
}

static octreel_status set_tree(octreel_recorder *r, const octree_def *def)
{
    octree *tree;
    r->settings.tree = *def;
    r->settings.tree.allocator = (octree_allocator){0}; /* the recording thread must not use the program's allocator */
    if (def->leaf_capacity == OCTREE_AUTO)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION,
                             "tree: leaf_capacity is OCTREE_AUTO; use the capacity of octree_definition(tree)");
    const octree_status status = octree_create(&r->settings.tree, &tree);
    if (status != OCTREE_OK)
        return status_refuse(&r->error, status == OCTREE_NO_MEMORY ? OCTREEL_NO_MEMORY : OCTREEL_BAD_OPTION, "tree: %s",
                             octree_status_text(status));
    r->settings.tree = octree_definition(tree);
    octree_destroy(tree);
    return OCTREEL_OK;
}

static octreel_status set_player(octreel_recorder *r, const octree_player *player)
{
    r->settings.player = (octree_player){.kind = player->kind};
    if (player->kind == OCTREE_PLAYER_NONE)
        return OCTREEL_OK;
    if (player->kind != OCTREE_PLAYER_BODY)
        return status_refuse(
            &r->error, OCTREEL_BAD_OPTION,
            "player: kind must be OCTREE_PLAYER_NONE or OCTREE_PLAYER_BODY; a recorder has no key presses");
    if (!(player->box_size >= 0) || isinf(player->box_size))
        return status_refuse(&r->error, OCTREEL_BAD_OPTION, "player: box_size must be finite and not negative");
    if (player->id >= SESSION_ID_LIMIT)
        return status_refuse(&r->error, OCTREEL_BAD_ID, "player: %s: %" PRIu64, octreel_status_text(OCTREEL_BAD_ID),
                             player->id);
    r->settings.player.id = player->id;
    r->settings.player.box_size = player->box_size;
    r->settings.player.sweep = player->sweep;
    return OCTREEL_OK;
}

/* Set the view from the names and numbers in the definition. The table of view options parses these values in the same
 * way as the options of the command line. */
static octreel_status set_view(octreel_recorder *r, const octreel_recorder_def *def)
{
    view *v = &r->settings.film.view;
    char lod[NUMBER_TEXT] = "no number", budget[NUMBER_TEXT], aa[NUMBER_TEXT];
    if (isfinite(def->lod))
        number_print(def->lod, lod);
    snprintf(budget, sizeof budget, "%" PRIu64, def->budget);
    snprintf(aa, sizeof aa, "%d", def->aa);
    const char *const options[][2] = {{"camera", def->camera},
                                      {"layers", def->layers},
                                      {"color-by", def->color_by},
                                      {"tree", def->show_tree},
                                      {"color-points", def->color_points},
                                      {"shade", def->shade},
                                      {"diagram", def->diagram},
                                      {"lod", lod},
                                      {"budget", budget},
                                      {"aa", aa}};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        const view_option *option = view_find_option(options[i][0]);
        if (!option->parse(option, options[i][1], v, &r->error))
            return OCTREEL_BAD_OPTION;
    }
    const int longest = VIEW_MAX_SIDE / v->aa;
    v->width = def->width;
    v->height = def->height;
    v->labels = def->labels;
    if (v->width < 1 || v->height < 1 || v->width > longest || v->height > longest)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION,
                             "a frame of %d x %d pixels cannot be drawn: a side must be 1 to %d", v->width, v->height,
                             longest);
    return OCTREEL_OK;
}

static octreel_status set_film_options(octreel_recorder *r, const octreel_recorder_def *def)
{
    film_options *film = &r->settings.film;
    film->every = def->every;
    film->replace = def->replace;
    const int fill = json_find_name(draw_fill_name, def->fill),
              context = json_find_name(draw_context_name, def->context);
    if (fill < 0)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION,
                             "fill: unknown rasterizer \"%s\"; octreel record --help lists the rasterizers", def->fill);
    if (context < 0)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION,
                             "context: unknown name \"%s\"; octreel record --help lists the names", def->context);
    film->renderer = (renderer_choice){(draw_context)context, (draw_fill)fill, def->any_renderer};
    if (film->renderer.any_renderer && film->renderer.context != DRAW_EGL)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION, "any_renderer: works only with the context \"egl\"");
    if (def->every > SESSION_LAST_TICK)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION, "every: must be from 0 (no frames) to %d",
                             SESSION_LAST_TICK);
    if (def->queue_ticks < 1)
        return status_refuse(&r->error, OCTREEL_BAD_OPTION, "queue_ticks: the queue must hold at least one tick");
    return OCTREEL_OK;
}

static octreel_status set_options(octreel_recorder *r, const octreel_recorder_def *def)
{
    r->settings.film.view = view_make_default();
    r->never_wait = def->never_wait;
    r->ring.most = def->ring;
    if (!def->camera || !def->layers || !def->color_by || !def->show_tree || !def->color_points || !def->shade ||
        !def->diagram || !def->fill || !def->context)
        return status_refuse(&r->error, OCTREEL_NULL_ARGUMENT,
                             "a name in the definition is null; start from octreel_recorder_def_default()");
    octreel_status status = set_tree(r, &def->tree);
    if (status == OCTREEL_OK)
        status = set_player(r, &def->player);
    if (status == OCTREEL_OK)
        status = set_view(r, def);
    return status == OCTREEL_OK ? set_film_options(r, def) : status;
}

/* ---- Opening ------------------------------------------------------------------------------------------------ */

/* Check that a recording can be written to the folder. With `replace` an existing recording stays until tick 0 of the
 * new recording is filmed. */
static octreel_status check_folder(octreel_recorder *r, const char *folder)
{
    errno = 0;
    const bool usable = r->settings.film.replace
                            ? folder_create(folder, &r->error) && replacement_check(folder, &r->error)
                            : folder_create_for_recording(folder, &r->error);
    return usable ? OCTREEL_OK : errno == ENOMEM ? OCTREEL_NO_MEMORY : OCTREEL_BAD_FOLDER;
}

static octreel_status start_filming(octreel_recorder *r, const octreel_recorder_def *def)
{
    if (!def->folder)
        return status_refuse(&r->error, OCTREEL_NULL_ARGUMENT, "folder: may be null only if `ring` is not 0");
    r->folder = strdup(def->folder);
    if (!r->folder)
        return status_fail(&r->error, OCTREEL_NO_MEMORY);
    const octreel_status status = check_folder(r, r->folder);
    if (status != OCTREEL_OK)
        return status;
    if (!queue_init(&r->queue, def->queue_ticks, def->queue_bytes))
        return status_fail(&r->error, OCTREEL_NO_MEMORY);
    r->filmer = (session_filmer){.settings = &r->settings, .folder = r->folder, .queue = &r->queue};
    if (session_filmer_start(&r->filmer) == OCTREEL_OK)
        return OCTREEL_OK;
    queue_release(&r->queue);
    return status_fail(&r->error, OCTREEL_NO_MEMORY);
}

static void release_recorder(octreel_recorder *r)
{
    contents_release(&r->contents);
    foreign_tree_release(&r->kept);
    ring_release(&r->ring);
    free(r->folder);
    free(r);
}

static octreel_status open_recorder(const octreel_recorder_def *def, octreel_recorder **recorder, octreel_error *error)
{
    octreel_recorder *r = NULL, none = {.closed = false};
    octreel_status status = OCTREEL_OK;
    if (recorder)
        *recorder = NULL;
    if (!def || !recorder)
        status = status_fail(&none.error, OCTREEL_NULL_ARGUMENT);
    else if (!(r = calloc(1, sizeof *r)))
        status = status_fail(&none.error, OCTREEL_NO_MEMORY);
    else
        status = set_options(r, def);
    if (status == OCTREEL_OK && r->ring.most == 0)
        status = start_filming(r, def);
    if (status == OCTREEL_OK) {
        *recorder = r;
        return status;
    }
    if (error)
        *error = r ? r->error : none.error;
    if (r)
        release_recorder(r);
    return status;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* If the program passes points without a tree, let full leaves grow. If full leaves refused points, a tree of the
 * program's points might be impossible. Returns OTHER_TREE if leaves do not grow yet and earlier ticks are already in
 * the recording. */
static octreel_status let_full_leaves_grow(octreel_recorder *r)
{
    const bool listed = r->contents.read_source != FROM_TREE && r->contents.read_source != FROM_NOTHING;
    if (!listed || r->settings.tree.full_leaf == OCTREE_GROW)
        return OCTREEL_OK;
    if (r->put > 0)
        return status_refuse(
            &r->error, OCTREEL_OTHER_TREE,
            "a list of points cannot be passed now, because earlier ticks had none; to allow it, set tree.full_leaf "
            "to OCTREE_GROW when you open the recorder");
    r->settings.tree.full_leaf = OCTREE_GROW;
    return OCTREEL_OK;
}

/* Keep the foreign nodes of a refused tick for the next accepted tick. Returns false if memory runs out. */
static bool store_nodes_for_next_tick(octreel_recorder *r, const octree_foreign_tree *tree)
{
    octree_foreign_tree copy;
    if (!foreign_tree_duplicate(tree, &copy))
        return false;
    foreign_tree_release(&r->kept);
    r->kept = copy;
    r->has_kept = true;
    return true;
}

/* Read and check a tick. The points are read before the queries and shapes are checked, so that no point change is lost
 * if a query or shape is invalid. */
static octreel_status read_tick(octreel_recorder *r, const octree *tree, const octreel_tick_info *about)
{
    octreel_error why;
    const octreel_status read = contents_read(&r->contents, &r->settings.tree, tree, about, &why);
    const octreel_status status = tick_info_check(about, r->settings.player.kind, &r->error);
    if (status != OCTREEL_OK)
        return status;
    if (read != OCTREEL_OK)
        r->error = why;
    return read == OCTREEL_OK ? let_full_leaves_grow(r) : read;
}

/* Add a batch to the queue. *taken becomes false if the batch was not added and the caller still owns it. */
static octreel_status queue_batch(octreel_recorder *r, batch *b, bool *taken)
{
    const octreel_status status = queue_put(&r->queue, b, !r->never_wait);
    *taken = status == OCTREEL_OK;
    if (status == OCTREEL_BUSY)
        return status_fail(&r->error, status);
    r->put += *taken;
    if (*taken)
        return status;
    r->broken = true;
    r->error = r->filmer.error;
    return r->filmer.status;
}

static octreel_status put_batch_into_queue_or_ring(octreel_recorder *r, batch *b)
{
    octreel_status status = OCTREEL_OK;
    bool taken = true;
    if (r->ring.most == 0)
        status = queue_batch(r, b, &taken);
    else if (!(taken = ring_put(&r->ring, b)))
        status = status_fail(&r->error, OCTREEL_NO_MEMORY);
    if (!taken) {
        contents_move_changes_from_batch(&r->contents, b);
        batch_release(b);
    }
    return status;
}

static octreel_status record_tick(octreel_recorder *r, const octreel_tick_info *about)
{
    const octree_foreign_tree *said = about ? about->foreign : NULL;
    batch *b = batch_make(&r->gaps, about, said ? said : r->has_kept ? &r->kept : NULL);
    if (!b)
        return status_fail(&r->error, OCTREEL_NO_MEMORY);
    contents_move_changes_to_batch(&r->contents, b);
    return put_batch_into_queue_or_ring(r, b);
}

static octreel_status read_and_record_tick(octreel_recorder *r, const octree *tree, const octreel_tick_info *about)
{
    octreel_error why;
    const octreel_status nodes = tick_info_check_nodes(about, &why);
    octreel_status status = read_tick(r, tree, about);
    if (status == OCTREEL_OK && nodes != OCTREEL_OK) {
        status = nodes;
        r->error = why;
    }
    if (status == OCTREEL_OK)
        status = record_tick(r, about);
    if (status != OCTREEL_OK && nodes == OCTREEL_OK && about && about->foreign &&
        !store_nodes_for_next_tick(r, about->foreign))
        status = status_fail(&r->error, OCTREEL_NO_MEMORY);
    if (status != OCTREEL_OK) {
        contents_refuse_tick(&r->contents, status);
        return status;
    }
    contents_accept_tick(&r->contents);
    foreign_tree_release(&r->kept);
    r->has_kept = false;
    r->gaps.count = 0;
    return OCTREEL_OK;
}

/* Count a refused tick. The refused tick keeps its number and becomes a gap in the recording. */
static void add_gap(octreel_recorder *r)
{
    gap_list_add(&r->gaps, r->error.text);
    if (r->lost.ticks++ > 0)
        return;
    r->lost.first = r->ticks;
    memcpy(r->lost.why, r->gaps.runs[0].why, sizeof r->lost.why);
}

static octreel_status record_or_add_gap(octreel_recorder *r, const octree *tree, const octreel_tick_info *about)
{
    if (r->closed)
        return status_fail(&r->error, OCTREEL_CLOSED);
    const octreel_status status = read_and_record_tick(r, tree, about);
    if (status != OCTREEL_OK && !r->broken)
        add_gap(r);
    r->ticks += !r->broken;
    return status;
}

/* ---- The end ------------------------------------------------------------------------------------------------ */

/* Record the ring into a folder. The ticks that were refused after the ring's last tick are added to the ring as a
 * batch of gaps, and removed again afterwards. */
static octreel_status record_ring(octreel_recorder *r, const char *folder)
{
    ring *all = &r->ring;
    const batch_list before = all->list;
    batch *tail = batch_make_gaps(&r->gaps);
    if (!tail)
        return status_fail(&r->error, OCTREEL_NO_MEMORY);
    batch_list_add(&all->list, tail);
    uint64_t ticks;
    const losses lost = ring_sum_losses(all, &ticks);
    const octreel_status status = ring_film(all, &r->settings, folder, &r->error);
    all->list = before;
    all->list.last->next = NULL;
    batch_release(tail);
    return status == OCTREEL_OK ? find_final_status(r, &lost, ticks) : status;
}

static octreel_status write_ring_to_folder(octreel_recorder *r, const char *folder, uint64_t *first)
{
    if (!folder)
        return status_fail(&r->error, OCTREEL_NULL_ARGUMENT);
    if (r->closed)
        return status_fail(&r->error, OCTREEL_CLOSED);
    if (r->ring.most == 0)
        return status_fail(&r->error, OCTREEL_NO_RING);
    if (r->ring.list.count == 0)
        return status_fail(&r->error, OCTREEL_NOTHING);
    const octreel_status status = check_folder(r, folder);
    if (status != OCTREEL_OK)
        return status;
    if (first)
        *first = r->ring.dropped;
    return record_ring(r, folder);
}

/* Add the ticks that were refused after the last accepted tick to the queue. */
static void queue_last_gaps(octreel_recorder *r)
{
    batch *b = r->gaps.count > 0 ? batch_make_gaps(&r->gaps) : NULL;
    if (b && queue_put(&r->queue, b, true) != OCTREEL_OK)
        batch_release(b); /* no error is reported here: the recording has already failed with a more specific error */
}

static octreel_status close_recorder(octreel_recorder *r)
{
    if (r->closed)
        return status_fail(&r->error, OCTREEL_CLOSED);
    r->closed = true;
    if (r->ring.most > 0)
        return find_final_status(r, &r->lost, r->ticks);
    if (r->put > 0)
        queue_last_gaps(r);
    queue_end(&r->queue);
    const octreel_status status = session_filmer_join(&r->filmer);
    queue_release(&r->queue);
    if (status != OCTREEL_OK)
        r->error = r->filmer.error;
    if (status != OCTREEL_OK || r->put > 0)
        return status == OCTREEL_OK ? find_final_status(r, &r->lost, r->ticks) : status;
    return r->lost.ticks == 0
               ? status_fail(&r->error, OCTREEL_NOTHING)
               : status_refuse(&r->error, OCTREEL_NOTHING, "%s: all ticks were refused; the first error is: %s",
                               octreel_status_text(OCTREEL_NOTHING), r->lost.why);
}

/* ---- The public functions ------------------------------------------------------------------------------------
 *
 * The program may use any floating-point mode, so each public function sets the default mode and restores the program's
 * mode at the end. The compiler must not move arithmetic across these changes. The compiler cannot do so: the inner
 * functions take and return only pointers and integers, and the compiler must assume that the calls which change the
 * mode read and write the doubles behind the pointers. */

static fenv_t enter_default_mode(void)
{
    fenv_t program;
    fegetenv(&program);
    fesetenv(FE_DFL_ENV);
    return program;
}

octreel_status octreel_recorder_open(const octreel_recorder_def *def, octreel_recorder **recorder, octreel_error *error)
{
    const fenv_t program = enter_default_mode();
    const octreel_status status = open_recorder(def, recorder, error);
    fesetenv(&program);
    return status;
}

octreel_status octreel_recorder_tick(octreel_recorder *recorder, const octree *tree, const octreel_tick_info *about)
{
    const fenv_t program = enter_default_mode();
    const octreel_status status = recorder ? record_or_add_gap(recorder, tree, about) : OCTREEL_OK;
    fesetenv(&program);
    return status;
}

octreel_status octreel_recorder_write(octreel_recorder *recorder, const char *folder, uint64_t *first)
{
    const fenv_t program = enter_default_mode();
    const octreel_status status = recorder ? write_ring_to_folder(recorder, folder, first) : OCTREEL_OK;
    fesetenv(&program);
    return status;
}

octreel_status octreel_recorder_close(octreel_recorder *recorder)
{
    const fenv_t program = enter_default_mode();
    const octreel_status status = recorder ? close_recorder(recorder) : OCTREEL_OK;
    fesetenv(&program);
    return status;
}

void octreel_recorder_destroy(octreel_recorder *recorder)
{
    if (!recorder)
        return;
    if (!recorder->closed)
        octreel_recorder_close(recorder);
    release_recorder(recorder);
}
