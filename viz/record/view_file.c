/* view_file.c - see view_file.h. */
#include "view_file.h"

static void write_key(json_writer *w, const char *key)
{
    json_write_newline(w);
    json_write_key(w, key);
}

static void write_whole(json_writer *w, const char *key, uint64_t value)
{
    write_key(w, key);
    json_write_integer(w, value);
}

static void write_name(json_writer *w, const char *key, const char *name)
{
    write_key(w, key);
    json_write_string(w, name);
}

static void write_layers(json_writer *w, const view *v)
{
    write_key(w, "layers");
    json_write_begin_array(w);
    for (int i = 0; i < LAYER_COUNT; i++)
        if (view_shows(v, (view_layer)i))
            json_write_string(w, view_layer_name((view_layer)i));
    json_write_end_array(w);
}

static void write_box(json_writer *w, const char *key, const octree_box *box)
{
    write_key(w, key);
    json_write_begin_object(w);
    json_write_key(w, "min");
    json_write_numbers(w, box->min, 3);
    json_write_key(w, "max");
    json_write_numbers(w, box->max, 3);
    json_write_end_object(w);
}

static void write_slice(json_writer *w, const view_filter *f)
{
    const char axis[2] = {f->slice, 0};
    write_key(w, "slice");
    json_write_begin_object(w);
    json_write_key(w, axis);
    json_write_number(w, f->slice_at);
    json_write_end_object(w);
}

static void write_filter(json_writer *w, const view_filter *f)
{
    if (f->slice)
        write_slice(w, f);
    if (f->by_depth) {
        write_key(w, "depths");
        json_write_numbers(w, (double[]){f->min_depth, f->max_depth}, 2);
    }
    if (f->leaves) {
        write_key(w, "leaves");
        json_write_bool(w, true);
    }
    if (f->by_region)
        write_box(w, "region", &f->region);
}

void view_write(json_writer *w, const view *v)
{
    write_whole(w, "width", (uint64_t)v->width);
    write_whole(w, "height", (uint64_t)v->height);
    write_name(w, "camera", view_camera_name(v->camera));
    write_layers(w, v);
    write_name(w, "color_by", view_coloring_name(v->coloring));
    write_filter(w, &v->filter);
}
