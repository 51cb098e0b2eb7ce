/* settings.c - see settings.h. */
#include "settings.h"
#include "layer.h"
#include "session_file.h"

#include <inttypes.h>
#include <math.h>

static octreel_status refuse(octreel_error *error, const char *option, const char *name)
{
    error_set(error, "%s: there is no \"%s\"; octreel record --help lists what there is", option, name);
    return OCTREEL_BAD_OPTION;
}

/* ---- The tree ----------------------------------------------------------------------------------------------- */

static octreel_status settle_tree(settings *s, const octree_def *def, octreel_error *error)
{
    octree *tree;
    s->tree = *def;
    s->tree.allocator = (octree_allocator){0}; /* the program's may not be used from the worker */
    if (def->leaf_capacity == OCTREE_AUTO) {
        error_set(error, "tree: give the capacity in force, which is that of octree_definition(tree)");
        return OCTREEL_BAD_OPTION;
    }
    const octree_status status = octree_create(&s->tree, &tree);
    if (status != OCTREE_OK) {
        error_set(error, "tree: %s", octree_status_text(status));
        return status == OCTREE_NO_MEMORY ? OCTREEL_NO_MEMORY : OCTREEL_BAD_OPTION;
    }
    s->tree = octree_definition(tree);
    octree_destroy(tree);
    return OCTREEL_OK;
}

bool settings_fit(const settings *s, const octree *tree)
{
    if (!tree)
        return true;
    const octree_def def = octree_definition(tree);
    for (int i = 0; i < 3; i++)
        if (def.world.min[i] != s->tree.world.min[i] || def.world.max[i] != s->tree.world.max[i])
            return false;
    return def.leaf_capacity == s->tree.leaf_capacity && def.max_depth == s->tree.max_depth &&
           def.full_leaf == s->tree.full_leaf;
}

/* ---- The player --------------------------------------------------------------------------------------------- */

static octreel_status settle_player(settings *s, const octree_player *player, octreel_error *error)
{
    s->player = (octree_player){.kind = OCTREE_PLAYER_NONE};
    if (player->kind == OCTREE_PLAYER_NONE)
        return OCTREEL_OK;
    if (player->kind != OCTREE_PLAYER_BODY) {
        error_set(error, "player: it is OCTREE_PLAYER_NONE or OCTREE_PLAYER_BODY; keys are the program's own matter");
        return OCTREEL_BAD_OPTION;
    }
    if (!(player->box_size >= 0) || isinf(player->box_size)) {
        error_set(error, "player: box_size must be finite and not negative");
        return OCTREEL_BAD_OPTION;
    }
    if (player->id >= SESSION_ID_LIMIT) {
        error_set(error, "player: %s: %" PRIu64, octreel_status_text(OCTREEL_BAD_ID), player->id);
        return OCTREEL_BAD_ID;
    }
    s->player = (octree_player){
        .kind = OCTREE_PLAYER_BODY, .id = player->id, .box_size = player->box_size, .sweep = player->sweep};
    return OCTREEL_OK;
}

/* ---- The view ----------------------------------------------------------------------------------------------- */

static octreel_status settle_names(view *v, const octreel_recorder_def *def, octreel_error *error)
{
    const char *bad;
    if (!view_camera_parse(def->camera, &v->camera))
        return refuse(error, "camera", def->camera);
    if (!view_layers_parse(def->layers, &v->layers, &bad))
        return refuse(error, "layers", bad);
    if (!view_coloring_parse(def->color_by, &v->coloring))
        return refuse(error, "color_by", def->color_by);
    if (!view_diagram_parse(def->diagram, &v->diagram))
        return refuse(error, "diagram", def->diagram);
    return OCTREEL_OK;
}

static octreel_status settle_numbers(view *v, const octreel_recorder_def *def, octreel_error *error)
{
    const int aa = def->aa;
    v->width = def->width;
    v->height = def->height;
    v->labels = def->labels;
    v->lod = def->lod;
    v->budget = def->budget;
    v->aa = aa;
    const bool sized = aa >= 1 && def->width >= 1 && def->height >= 1 && def->width <= VIEW_MAX_SIDE / aa &&
                       def->height <= VIEW_MAX_SIDE / aa;
    if (aa != 1 && aa != 2 && aa != 4)
        error_set(error, "aa: there is no anti-aliasing by %d; there are 1, 2 and 4", aa);
    else if (!sized)
        error_set(error, "a frame of %d x %d pixels cannot be drawn: a side must be 1 to %d", def->width, def->height,
                  VIEW_MAX_SIDE / aa);
    else if (!(def->lod >= 0 && def->lod <= VIEW_MAX_SIDE))
        error_set(error, "lod: it must be 0 to %d pixels", VIEW_MAX_SIDE);
    else if (def->budget >= SESSION_ID_LIMIT)
        error_set(error, "budget: it must be below 2^53; 0 is none");
    else
        return OCTREEL_OK;
    return OCTREEL_BAD_OPTION;
}

static octreel_status settle_film(settings *s, const octreel_recorder_def *def, octreel_error *error)
{
    renderer_choice *choice = &s->film.renderer;
    s->film.every = def->every;
    choice->any_renderer = def->any_renderer;
    if (!draw_context_parse(def->context, &choice->context))
        return refuse(error, "context", def->context);
    if (choice->any_renderer && choice->context != DRAW_EGL)
        error_set(error, "any_renderer: it goes with the context \"egl\" alone");
    else if (def->every < 1 || def->every > SESSION_LAST_TICK)
        error_set(error, "every: it must be 1 to %d", SESSION_LAST_TICK);
    else if (def->queue_ticks < 1)
        error_set(error, "queue_ticks: the queue must hold at least one tick");
    else
        return OCTREEL_OK;
    return OCTREEL_BAD_OPTION;
}

octreel_status settings_make(settings *s, const octreel_recorder_def *def, octreel_error *error)
{
    *s = (settings){.film.view = view_default()};
    if (!def->camera || !def->layers || !def->color_by || !def->diagram || !def->context) {
        error_set(error, "a name in the definition is null; start from octreel_recorder_def_default()");
        return OCTREEL_NULL_ARGUMENT;
    }
    octreel_status status = settle_tree(s, &def->tree, error);
    if (status == OCTREEL_OK)
        status = settle_player(s, &def->player, error);
    if (status == OCTREEL_OK)
        status = settle_names(&s->film.view, def, error);
    if (status == OCTREEL_OK)
        status = settle_numbers(&s->film.view, def, error);
    if (status == OCTREEL_OK)
        status = settle_film(s, def, error);
    return status;
}
