/* view_file.c - see view_file.h. */
#include "view_file.h"
#include "layer.h"
#include "number.h"
#include "session_reader.h"
#include "theme.h"
#include "file.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Writing ------------------------------------------------------------------------------------------------ */

static void write_key(json_writer *w, const char *key)
{
    json_write_newline(w);
    json_write_key(w, key);
}

static void write_whole(json_writer *w, const char *key, uint64_t value)
{
    json_write_newline(w);
    json_member_integer(w, key, value);
}

static void write_name(json_writer *w, const char *key, const char *name)
{
    json_write_newline(w);
    json_member_text(w, key, name);
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
    json_write_newline(w);
    json_member_box(w, key, box);
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
    if (v->fit == FIT_BOX)
        write_box(w, "fit", &v->focus);
    write_layers(w, v);
    write_name(w, "color_by", view_coloring_name(v->coloring));
    if (v->diagram != DIAGRAM_NONE)
        write_name(w, "diagram", view_diagram_name(v->diagram));
    write_filter(w, &v->filter);
    if (v->labels) {
        write_key(w, "labels");
        json_write_bool(w, true);
    }
    write_key(w, "lod");
    json_write_number(w, v->lod);
    write_whole(w, "budget", v->budget);
    write_whole(w, "aa", (uint64_t)view_samples(v));
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static bool read_kind(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *kind = json_string_value(value);
    (void)into;
    return (kind && strcmp(kind, "recording") == 0) || session_expected(reader, value, at, "\"recording\"");
}

/* Digests of scenes in ticks.jsonl and in frames are those of the version. */
static bool read_version(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t version;
    (void)into;
    if (!session_read_whole(reader, value, at, 1, RECORDING_VERSION, &version))
        return false;
    return version == RECORDING_VERSION ||
           session_fail(reader, at,
                        "the recording was made by an older octreel, of format version %" PRIu64
                        ": film its session.json again, or use that octreel",
                        version);
}

static bool read_theme(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    char what[80];
    (void)into;
    snprintf(what, sizeof what, "the theme that there is, \"%s\"", theme_name());
    return (name && strcmp(name, theme_name()) == 0) || session_expected(reader, value, at, what);
}

/* What is read: the view comes first, so that places in it are places in this. */
typedef struct recorded {
    view view;
    uint64_t every; /* what belongs to the recording and not to its view */
} recorded;

static bool read_every(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    return session_read_whole(reader, value, at, 1, SESSION_LAST_TICK, into);
}

static bool read_side(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t side;
    if (!session_read_whole(reader, value, at, 1, VIEW_MAX_SIDE, &side))
        return false;
    *(int *)into = (int)side;
    return true;
}

static bool read_camera(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    return (name && view_camera_parse(name, into)) || session_expected(reader, value, at, "the name of a camera");
}

static bool read_coloring(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    return (name && view_coloring_parse(name, into)) ||
           session_expected(reader, value, at, "the name of a colour mode");
}

static bool read_diagram(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    return (name && view_diagram_parse(name, into)) ||
           session_expected(reader, value, at, "the name of a place for the diagram");
}

static bool read_layer(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    for (int i = 0; name && i < LAYER_COUNT; i++) {
        if (strcmp(name, view_layer_name((view_layer)i)) == 0) {
            *(unsigned *)into |= 1u << i;
            return true;
        }
    }
    return session_expected(reader, value, at, "the name of a layer");
}

static bool read_layers(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    return session_read_elements(reader, value, at, "a list of layers", read_layer, into);
}

static bool read_box(session_reader *reader, json_t *value, const json_place *at, octree_box *box)
{
    if (!session_read_box(reader, value, at, box))
        return false;
    for (int i = 0; i < 3; i++)
        if (box->min[i] > box->max[i])
            return session_fail(reader, at, "min is above max on %c", "xyz"[i]);
    return true;
}

static bool read_fit(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    view *v = into;
    v->fit = FIT_BOX;
    if (!read_box(reader, value, at, &v->focus))
        return false;
    for (int i = 0; i < 3; i++)
        if (v->focus.min[i] < v->focus.max[i])
            return true;
    return session_fail(reader, at, "the box has no extent");
}

static bool read_region(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    f->by_region = true;
    return read_box(reader, value, at, &f->region);
}

static bool read_slice(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    const char *axis = json_object_size(value) == 1 ? json_object_iter_key(json_object_iter(value)) : "";
    if (strlen(axis) != 1 || !strchr("xyz", *axis))
        return session_expected(reader, value, at, "an axis and a place as in {\"z\": 100}");
    f->slice = *axis;
    return session_read_number(reader, json_object_get(value, axis), &(json_place){at, axis, 0}, &f->slice_at);
}

static bool read_depths(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    uint64_t depths[2];
    if (!json_is_array(value) || json_array_size(value) != 2)
        return session_expected(reader, value, at, "two depths as in [2, 5]");
    for (size_t i = 0; i < 2; i++)
        if (!session_read_whole(reader, json_array_get(value, i), &(json_place){at, NULL, i}, i ? depths[0] : 0,
                                OCTREE_MAX_DEPTH, &depths[i]))
            return false;
    f->by_depth = true;
    f->min_depth = (unsigned)depths[0];
    f->max_depth = (unsigned)depths[1];
    return true;
}

static bool read_lod(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const double pixels = json_real_value(value);
    if (!json_is_real(value) || !(pixels >= 0 && pixels <= VIEW_MAX_SIDE))
        return session_expected(reader, value, at, "pixels from 0 to " NUMBER_DIGITS(VIEW_MAX_SIDE));
    *(double *)into = pixels;
    return true;
}

static bool read_aa(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t samples;
    if (!session_read_whole(reader, value, at, 1, 4, &samples))
        return false;
    *(int *)into = (int)samples;
    return samples != 3 || session_expected(reader, value, at, "1, 2 or 4");
}

static bool read_truth(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    *(bool *)into = json_is_true(value);
    return json_is_boolean(value) || session_expected(reader, value, at, "true or false");
}

static const session_member members[] = {
    {"octreel", read_kind, 0, true},
    {"version", read_version, 0, true},
    {"width", read_side, offsetof(view, width), true},
    {"height", read_side, offsetof(view, height), true},
    {"camera", read_camera, offsetof(view, camera), true},
    {"fit", read_fit, 0, false},
    {"layers", read_layers, offsetof(view, layers), true},
    {"color_by", read_coloring, offsetof(view, coloring), false},
    {"diagram", read_diagram, offsetof(view, diagram), false},
    {"slice", read_slice, offsetof(view, filter), false},
    {"depths", read_depths, offsetof(view, filter), false},
    {"leaves", read_truth, offsetof(view, filter.leaves), false},
    {"region", read_region, offsetof(view, filter), false},
    {"labels", read_truth, offsetof(view, labels), false},
    {"lod", read_lod, offsetof(view, lod), false},
    {"budget", session_read_id, offsetof(view, budget), false},
    {"aa", read_aa, offsetof(view, aa), false},
    {"theme", read_theme, 0, false},
    {"every", read_every, offsetof(recorded, every), false},
    {0},
};

static bool parse(session_reader *reader, recorded *into)
{
    const size_t flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
    json_error_t parsed;
    json_t *object = json_loadb(reader->object, (size_t)(reader->limit - reader->object), flags, &parsed);
    if (!object)
        return session_fail_parsed(reader, &parsed);
    const bool done = session_read_members(reader, object, NULL, members, into);
    json_decref(object);
    return done;
}

static bool read_file(const char *folder, recorded *into, octreel_error *error)
{
    char reason[FILE_REASON], *text, *path = path_join(folder, "recording.json");
    octreel_error unread;
    size_t size;
    *into = (recorded){.every = 1};
    if (!path)
        return error_no_memory(error);
    bool done = file_read_whole(path, &text, &size, reason) || error_set(error, "%s: %s", path, reason);
    if (done) {
        session_reader reader = {.name = path, .object = text, .limit = text + size, .line = 1, .error = &unread};
        done = parse(&reader, into) || error_set(error, "%s", unread.text);
        free(text);
    }
    free(path);
    return done;
}

bool view_read_recording(const char *folder, view *v, uint64_t *every, octreel_error *error)
{
    recorded found;
    const bool done = read_file(folder, &found, error);
    *v = found.view;
    *every = found.every;
    return done;
}

bool view_read(const char *folder, view *v, octreel_error *error)
{
    uint64_t every;
    return view_read_recording(folder, v, &every, error);
}
