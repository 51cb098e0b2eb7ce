/* world_layer.c - see world_layer.h. */
#include "world_layer.h"
#include "axes.h"
#include "element_ids.h"
#include "layer.h"
#include "layout.h"

void begin_scene(scene *s, const view *v, const octree_box *world, const double player[3], uint64_t tick)
{
    scene_clear(s);
    s->view = *v;
    s->unit = view_unit(v);
    if (v->diagram == DIAGRAM_ONLY)
        s->view.layers &= 1u << LAYER_TEXT;
    s->camera = camera_make(v, layout_space(v), world, player, tick);
}

/* Where the slice and the region are. */
static void add_filter(scene *s, const octree_box *world)
{
    const view_filter *f = &s->view.filter;
    const scene_style style = {.layer = LAYER_WORLD, .role = ROLE_FAINT, .stroke = STROKE_DASHED, .width = 1};
    octree_box plane = *world;
    if (f->slice) {
        plane.min[f->slice - 'x'] = plane.max[f->slice - 'x'] = f->slice_at;
        scene_add_box(s, (scene_box){.id = SLICE_ID, .box = plane, .style = style});
    }
    if (f->by_region)
        scene_add_box(s, (scene_box){.id = REGION_ID, .box = f->region, .style = style});
}

void add_world(scene *s, const octree_box *world)
{
    const scene_style style = layer_style(LAYER_WORLD, STROKE_SOLID, 1);
    scene_add_box(s, (scene_box){.id = WORLD_ID, .box = *world, .style = style});
    add_filter(s, world);
    add_axes(s, world);
}
