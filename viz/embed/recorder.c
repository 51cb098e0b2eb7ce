/* recorder.c - see octreel/recorder.h: ticks are compared with those before them, checked, and handed on. */
#include "octreel/recorder.h"
#include "live.h"
#include "ring.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct octreel_recorder {
    settings settings;
    char *folder; /* of a recorder without a ring */
    bool never_wait, closed;
    points now, next, spare; /* at the last tick that was taken, and while one is being read */
    bool had_tree;
    ring ring; /* most is 0 where ticks are filmed as they come */
    live live;
    octreel_error error;
};

const char *octreel_status_text(octreel_status status)
{
#define OCTREEL_STATUS_TEXT(name, text) text,
    static const char *const texts[OCTREEL_STATUS_COUNT] = {OCTREEL_STATUS_MAP(OCTREEL_STATUS_TEXT)};
#undef OCTREEL_STATUS_TEXT
    return (unsigned)status < OCTREEL_STATUS_COUNT ? texts[status] : "there is no such status";
}

const char *octreel_recorder_error(const octreel_recorder *recorder)
{
    return recorder ? recorder->error.text : "";
}

octreel_recorder_def octreel_recorder_def_default(void)
{
    const view v = view_default();
    return (octreel_recorder_def){.tree = octree_def_default(),
                                  .player = {.kind = OCTREE_PLAYER_NONE},
                                  .width = v.width,
                                  .height = v.height,
                                  .camera = view_camera_name(v.camera),
                                  .layers = "default",
                                  .color_by = view_coloring_name(v.coloring),
                                  .diagram = view_diagram_name(v.diagram),
                                  .lod = v.lod,
                                  .budget = v.budget,
                                  .aa = view_samples(&v),
                                  .every = 1,
                                  .context = draw_context_name(DRAW_AUTO),
                                  .queue_ticks = 16,
                                  .queue_bytes = (size_t)64 << 20};
}

/* ---- Opening ------------------------------------------------------------------------------------------------ */

static octreel_status open_folder(octreel_recorder *r, const octreel_recorder_def *def)
{
    r->ring.most = def->ring;
    if (def->ring > 0)
        return OCTREEL_OK;
    if (!def->folder) {
        error_set(&r->error, "folder: there is none, and no ring");
        return OCTREEL_NULL_ARGUMENT;
    }
    r->folder = strdup(def->folder);
    if (!r->folder)
        return OCTREEL_NO_MEMORY;
    return folder_prepare(r->folder, &r->error) ? OCTREEL_OK : OCTREEL_BAD_FOLDER;
}

static octreel_status start(octreel_recorder *r, const octreel_recorder_def *def)
{
    octreel_status status = settings_make(&r->settings, def, &r->error);
    if (status == OCTREEL_OK)
        status = open_folder(r, def);
    if (status == OCTREEL_OK && r->ring.most == 0)
        status = live_start(&r->live, &r->settings, r->folder, def);
    if (status == OCTREEL_NO_MEMORY)
        error_set(&r->error, "%s", octreel_status_text(status));
    return status;
}

static void release(octreel_recorder *r)
{
    points_release(&r->now);
    points_release(&r->next);
    points_release(&r->spare);
    ring_release(&r->ring);
    free(r->folder);
    free(r);
}

/* Say why there is no recorder. */
static octreel_status explain(octreel_status status, const char *sentence, octreel_error *error)
{
    if (error)
        snprintf(error->text, sizeof error->text, "%s", *sentence ? sentence : octreel_status_text(status));
    return status;
}

octreel_status octreel_recorder_open(const octreel_recorder_def *def, octreel_recorder **recorder, octreel_error *error)
{
    if (recorder)
        *recorder = NULL;
    if (!def || !recorder)
        return explain(OCTREEL_NULL_ARGUMENT, "", error);
    octreel_recorder *r = calloc(1, sizeof *r);
    if (!r)
        return explain(OCTREEL_NO_MEMORY, "", error);
    r->never_wait = def->never_wait;
    const octreel_status status = start(r, def);
    if (status == OCTREEL_OK) {
        *recorder = r;
        return status;
    }
    explain(status, r->error.text, error);
    release(r);
    return status;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* Write the sentence of a status, and return it. */
static octreel_status fail(octreel_recorder *r, octreel_status status)
{
    error_set(&r->error, "%s", octreel_status_text(status));
    return status;
}

/* JSON has no infinities, which a box may have in a tree. */
static bool is_finite(const octree_query *query)
{
    for (int i = 0; i < 3; i++)
        if (query->kind == OCTREE_QUERY_RANGE && (!isfinite(query->box.min[i]) || !isfinite(query->box.max[i])))
            return false;
    return true;
}

static octreel_status check_queries(octreel_recorder *r, const octreel_tick_info *about)
{
    for (size_t i = 0; i < about->query_count; i++) {
        const octree_input one = {.queries = &about->queries[i], .query_count = 1};
        const octree_status status = is_finite(&about->queries[i]) ? octree_input_check(&one) : OCTREE_NOT_FINITE;
        if (status == OCTREE_OK)
            continue;
        error_set(&r->error, "queries[%zu]: %s", i, octree_status_text(status));
        return OCTREEL_BAD_QUERY;
    }
    return OCTREEL_OK;
}

static octreel_status check_shapes(octreel_recorder *r, const octreel_tick_info *about)
{
    for (size_t i = 0; i < about->shape_count; i++) {
        const octree_input one = {.shapes = &about->shapes[i], .shape_count = 1};
        const octree_status status = octree_input_check(&one);
        if (status == OCTREE_OK)
            continue;
        error_set(&r->error, "shapes[%zu]: %s", i, octree_status_text(status));
        return OCTREEL_BAD_SHAPE;
    }
    return OCTREEL_OK;
}

static octreel_status check_about(octreel_recorder *r, const octreel_tick_info *about)
{
    if (!about)
        return OCTREEL_OK;
    if ((!about->queries && about->query_count) || (!about->shapes && about->shape_count))
        return fail(r, OCTREEL_NULL_ARGUMENT);
    const octreel_status status = check_queries(r, about);
    return status == OCTREEL_OK ? check_shapes(r, about) : status;
}

static octreel_status read_tree(octreel_recorder *r, const octree *tree)
{
    uint64_t clash = 0;
    if (!tree && r->had_tree)
        return fail(r, OCTREEL_NULL_ARGUMENT);
    if (!settings_fit(&r->settings, tree))
        return fail(r, OCTREEL_OTHER_TREE);
    const octreel_status status = points_read(&r->next, &r->spare, tree, &clash);
    if (status == OCTREEL_BAD_ID || status == OCTREEL_DUPLICATE_ID)
        error_set(&r->error, "%s: %" PRIu64, octreel_status_text(status), clash);
    else if (status != OCTREEL_OK)
        fail(r, status);
    return status;
}

static octreel_status hand_on(octreel_recorder *r, batch *b)
{
    if (r->ring.most > 0) {
        if (ring_put(&r->ring, b))
            return OCTREEL_OK;
        batch_release(b);
        return fail(r, OCTREEL_NO_MEMORY);
    }
    const octreel_status status = live_put(&r->live, b, !r->never_wait);
    if (status == OCTREEL_BUSY)
        return fail(r, status);
    if (status != OCTREEL_OK)
        r->error = r->live.error;
    return status;
}

/* Ticks are compared with the last one that was taken. */
static void keep(octreel_recorder *r, const octree *tree)
{
    const points old = r->now;
    r->now = r->next;
    r->next = old;
    r->had_tree |= tree != NULL;
}

octreel_status octreel_recorder_tick(octreel_recorder *recorder, const octree *tree, const octreel_tick_info *about)
{
    octreel_recorder *r = recorder;
    if (!r)
        return OCTREEL_OK;
    if (r->closed)
        return fail(r, OCTREEL_CLOSED);
    octreel_status status = check_about(r, about);
    if (status == OCTREEL_OK)
        status = read_tree(r, tree);
    if (status != OCTREEL_OK)
        return status;
    batch *b = batch_make(&r->now, &r->next, about);
    if (!b)
        return fail(r, OCTREEL_NO_MEMORY);
    status = hand_on(r, b);
    if (status == OCTREEL_OK)
        keep(r, tree);
    return status;
}

/* ---- The end ------------------------------------------------------------------------------------------------ */

octreel_status octreel_recorder_write(octreel_recorder *recorder, const char *folder, uint64_t *first)
{
    octreel_recorder *r = recorder;
    if (!r)
        return OCTREEL_OK;
    if (!folder)
        return fail(r, OCTREEL_NULL_ARGUMENT);
    if (r->closed)
        return fail(r, OCTREEL_CLOSED);
    if (r->ring.most == 0)
        return fail(r, OCTREEL_NO_RING);
    if (r->ring.count == 0)
        return fail(r, OCTREEL_NOTHING);
    if (!folder_prepare(folder, &r->error))
        return OCTREEL_BAD_FOLDER;
    if (first)
        *first = r->ring.dropped;
    return ring_write(&r->ring, &r->settings, folder, &r->error);
}

octreel_status octreel_recorder_close(octreel_recorder *recorder)
{
    octreel_recorder *r = recorder;
    if (!r)
        return OCTREEL_OK;
    if (r->closed)
        return fail(r, OCTREEL_CLOSED);
    r->closed = true;
    if (r->ring.most > 0)
        return OCTREEL_OK;
    const octreel_status status = live_end(&r->live);
    if (status != OCTREEL_OK)
        r->error = r->live.error;
    return status == OCTREEL_OK && r->live.ticks == 0 ? fail(r, OCTREEL_NOTHING) : status;
}

void octreel_recorder_destroy(octreel_recorder *recorder)
{
    if (!recorder)
        return;
    if (!recorder->closed)
        octreel_recorder_close(recorder);
    release(recorder);
}
