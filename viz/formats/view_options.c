/* SPDX-License-Identifier: MIT */
#include "view_options.h"
#include "file_kind.h"
#include "hint.h"
#include "layer.h"
#include "number.h"
#include "recording_file.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define MOST_TURN 360 /* degrees */
#define MOST_ZOOM 1e6

/* ---- Names to choose from ----------------------------------------------------------------------------------- */

/* camera_at() and camera_words_at() of view_camera, and so on: the n-th name, and what it is. */
#define NAMES(choice)                                                                                                  \
    static const char *choice##_at(int n)                                                                              \
    {                                                                                                                  \
        return view_##choice##_name((view_##choice)n);                                                                 \
    }                                                                                                                  \
    static const char *choice##_words_at(int n)                                                                        \
    {                                                                                                                  \
        return view_##choice##_words((view_##choice)n);                                                                \
    }
NAMES(camera)
NAMES(coloring)
NAMES(tree)
NAMES(diagram)
NAMES(point_color)
NAMES(shade)

const char *view_layer_at(int n)
{
    return n < LAYER_COUNT ? layer_rows[n].name : NULL;
}

static const char *layer_words_at(int n)
{
    return n < LAYER_COUNT ? layer_rows[n].help : NULL;
}

/* Those of view_fit that a command line can ask for. */
static const char *fit_at(int n)
{
    static const char *const names[] = {[FIT_WORLD] = "world", [FIT_POINTS] = "points"};
    return (size_t)n < sizeof names / sizeof names[0] ? names[n] : NULL;
}

static const char *fit_words_at(int n)
{
    static const char *const words[] = {[FIT_WORLD] = "all of the world, which is the default of record",
                                        [FIT_POINTS] = "the points shown at tick 0, which is the default of inspect"};
    return (size_t)n < sizeof words / sizeof words[0] ? words[n] : NULL;
}

/* "there is no camera "x"; there are iso, top ...", or "... "iss", did you mean iso? ..." */
static bool no_such(const char *what, const char *text, int length, json_name *names, octreel_error *error)
{
    char known[320], meant[HINT_TEXT];
    hint h = hint_for(text, (size_t)length);
    for (int i = 0; names(i); i++)
        hint_offer(&h, names(i));
    return error_set(error, "there is no %s \"%.*s\"%sthere are %s", what, length < 100 ? length : 100, text,
                     hint_text(&h, "", meant), json_list_names(names, known, sizeof known));
}

/* ---- Values of each type ------------------------------------------------------------------------------------ */

static bool refuse_value(const view_option *option, const char *text, octreel_error *error)
{
    return error_set(error, "--%s takes %s, not \"%.200s\"", option->name, option->takes, text);
}

static void *value_of(const view_option *option, const view *v)
{
    return (char *)v + option->member.offset;
}

static bool parse_choice(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const int found = json_find_name(option->member.names, text);
    if (found < 0)
        return no_such(option->takes, text, (int)strlen(text), option->member.names, error);
    *(int *)value_of(option, v) = found;
    return true;
}

static bool parse_switch(const view_option *option, const char *text, view *v, octreel_error *error)
{
    (void)text, (void)error;
    return *(bool *)value_of(option, v) = true;
}

static bool parse_off(const view_option *option, const char *text, view *v, octreel_error *error)
{
    (void)text, (void)error;
    *(bool *)value_of(option, v) = false;
    return true;
}

static bool parse_whole(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    uint64_t value;
    if (!whole_parse(&at, (uint64_t)option->member.max, &value) || *at != 0 || (double)value < option->member.min)
        return refuse_value(option, text, error);
    if (option->member.codec == &json_int)
        *(int *)value_of(option, v) = (int)value;
    else
        *(uint64_t *)value_of(option, v) = value;
    return true;
}

static bool parse_number(const view_option *option, const char *text, view *v, octreel_error *error)
{
    double value;
    if (!numbers_parse(text, &value, 1) || !(value >= option->member.min && value <= option->member.max))
        return refuse_value(option, text, error);
    *(double *)value_of(option, v) = value;
    if (option->member.given)
        *(bool *)((char *)v + option->member.given) = true;
    return true;
}

/* ---- Size --------------------------------------------------------------------------------------------------- */

static bool parse_size(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    uint64_t width, height;
    if (!whole_parse(&at, INT32_MAX, &width) || *at++ != 'x' || !whole_parse(&at, INT32_MAX, &height) || *at != 0)
        return refuse_value(option, text, error);
    v->width = (int)width;
    v->height = (int)height;
    return true;
}

/* ---- Camera ------------------------------------------------------------------------------------------------- */

static bool parse_camera_from(const view_option *option, const char *text, view *v, octreel_error *error)
{
    uint64_t every;
    const file_kind kind = file_kind_of(text);
    if (kind == KIND_MISSING)
        return error_set(error, "%s: there is no such file or folder", text);
    if (file_kind_rows[kind].words && kind != KIND_RECORDING)
        return error_set(error, "%s is %s, and --%s takes the folder of a recording", text, file_kind_rows[kind].words,
                         option->name);
    return recording_read(text, v, &every, error);
}

static bool parse_fit(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const int found = json_find_name(option->member.names, text);
    if (found < 0)
        return no_such(option->takes, text, (int)strlen(text), option->member.names, error);
    v->fit = (view_fit)found;
    return true;
}

static bool read_fit(json_reader *r, json_t *value, const json_place *at, void *into)
{
    view *v = into;
    v->fit = FIT_BOX;
    if (!json_read_box(r, value, at, &v->focus))
        return false;
    for (int i = 0; i < 3; i++)
        if (v->focus.min[i] < v->focus.max[i])
            return true;
    return json_fail(r, at, "the box has no extent");
}

static void write_fit(json_writer *w, const void *from)
{
    json_write_box(w, &((const view *)from)->focus);
}

static bool fits_box(const void *from)
{
    return ((const view *)from)->fit == FIT_BOX;
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Other colours have another scale than those of --camera-from. */
static bool parse_point_color(const view_option *option, const char *text, view *v, octreel_error *error)
{
    v->point_scale.given = false;
    return parse_choice(option, text, v, error);
}

#define SCALE_NUMBERS (sizeof(point_scale) / sizeof(double))

static bool read_scale(json_reader *r, json_t *value, const json_place *at, void *into)
{
    double n[SCALE_NUMBERS];
    if (json_array_size(value) != SCALE_NUMBERS)
        return json_expected(
            r, value, at,
            "eleven numbers: the lowest and the highest place, the ends of ids and of intensities, and a spacing");
    if (!json_read_numbers(r, value, at, 0, SCALE_NUMBERS, n))
        return false;
    const point_scale s = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7]}, {n[8], n[9]}, n[10]};
    for (int i = 0; i < 3; i++)
        if (s.low[i] > s.high[i])
            return json_fail(r, at, "the lowest place is above the highest");
    if (s.spacing < 0)
        return json_fail(r, at, "the spacing is below 0");
    memcpy(into, &s, sizeof s);
    return true;
}

static void write_scale(json_writer *w, const void *from)
{
    const point_scale *s = from;
    const double n[SCALE_NUMBERS] = {s->low[0], s->low[1], s->low[2],         s->high[0],        s->high[1], s->high[2],
                                     s->ids[0], s->ids[1], s->intensities[0], s->intensities[1], s->spacing};
    json_write_numbers(w, n, SCALE_NUMBERS);
}

/* ---- Layers ------------------------------------------------------------------------------------------------- */

static bool parse_layers(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *bad;
    return view_layers_parse(text, &v->layers, &bad) ||
           no_such(option->takes, bad, (int)strcspn(bad, ","), view_layer_at, error);
}

static bool read_layer(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const int layer = json_find_name(view_layer_at, json_string_value(value));
    if (layer >= 0)
        *(unsigned *)into |= 1u << layer;
    return layer >= 0 || json_expected(r, value, at, "the name of a layer");
}

static bool read_layers(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return json_read_elements(r, value, at, "a list of layers", read_layer, into);
}

static void write_layers(json_writer *w, const void *from)
{
    json_write_begin_array(w);
    for (int i = 0; view_layer_at(i); i++)
        if (*(const unsigned *)from >> i & 1)
            json_write_string(w, view_layer_at(i));
    json_write_end_array(w);
}

static bool parse_look(const view_option *option, const char *text, view *v, octreel_error *error)
{
    double look[2];
    if (!numbers_parse(text, look, 2) || !(fabs(look[0]) <= MOST_TURN && fabs(look[1]) <= 90))
        return refuse_value(option, text, error);
    v->look.given = true;
    v->look.azimuth = look[0];
    v->look.elevation = look[1];
    return true;
}

static bool read_look(json_reader *r, json_t *value, const json_place *at, void *into)
{
    double look[2];
    if (json_array_size(value) != 2)
        return json_expected(r, value, at, "an azimuth and an elevation in degrees as in [30, 22]");
    if (!json_read_numbers(r, value, at, 0, 2, look))
        return false;
    if (!(fabs(look[0]) <= MOST_TURN && fabs(look[1]) <= 90))
        return json_fail(r, at, "must be an azimuth from -360 to 360 and an elevation from -90 to 90");
    memcpy(into, look, sizeof look);
    return true;
}

static void write_look(json_writer *w, const void *from)
{
    json_write_numbers(w, from, 2);
}

static bool parse_center(const view_option *option, const char *text, view *v, octreel_error *error)
{
    v->center.given = numbers_parse(text, v->center.place, 3);
    return v->center.given || refuse_value(option, text, error);
}

/* ---- What of the tree is shown ------------------------------------------------------------------------------ */

static bool parse_slice(const view_option *option, const char *text, view *v, octreel_error *error)
{
    if (text[0] < 'x' || text[0] > 'z' || text[1] != '=' || !numbers_parse(text + 2, &v->filter.slice_at, 1))
        return refuse_value(option, text, error);
    v->filter.slice = text[0];
    return true;
}

static bool read_slice(json_reader *r, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    const char *axis = json_object_size(value) == 1 ? json_object_iter_key(json_object_iter(value)) : "";
    if (strlen(axis) != 1 || !strchr("xyz", *axis))
        return json_expected(r, value, at, "an axis and a place as in {\"z\": 100}");
    f->slice = *axis;
    return json_read_number(r, json_object_get(value, axis), &(json_place){at, axis, 0}, &f->slice_at);
}

static void write_slice(json_writer *w, const void *from)
{
    const view_filter *f = from;
    json_write_begin_object(w);
    json_member_number(w, (const char[]){f->slice, 0}, f->slice_at);
    json_write_end_object(w);
}

static bool has_slice(const void *from)
{
    return ((const view_filter *)from)->slice != 0;
}

/* "2:5", "2:", ":5" or "3" */
static bool parse_depths(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    uint64_t from = 0, to = OCTREE_MAX_DEPTH;
    const bool begins = whole_parse(&at, OCTREE_MAX_DEPTH, &from), open = *at == ':';
    at += open;
    const bool ends = open && whole_parse(&at, OCTREE_MAX_DEPTH, &to);
    to = open ? to : from;
    if (*at != 0 || from > to || !(begins || ends))
        return refuse_value(option, text, error);
    v->filter.by_depth = true;
    v->filter.min_depth = (unsigned)from;
    v->filter.max_depth = (unsigned)to;
    return true;
}

static bool read_depths(json_reader *r, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    uint64_t depths[2];
    if (json_array_size(value) != 2)
        return json_expected(r, value, at, "two depths as in [2, 5]");
    for (size_t i = 0; i < 2; i++)
        if (!json_read_whole(r, json_array_get(value, i), &(json_place){at, NULL, i}, i ? (double)depths[0] : 0,
                             OCTREE_MAX_DEPTH, &depths[i]))
            return false;
    f->min_depth = (unsigned)depths[0];
    f->max_depth = (unsigned)depths[1];
    return true;
}

static void write_depths(json_writer *w, const void *from)
{
    const view_filter *f = from;
    json_write_numbers(w, (double[]){f->min_depth, f->max_depth}, 2);
}

static bool parse_region(const view_option *option, const char *text, view *v, octreel_error *error)
{
    double corners[6];
    if (!numbers_parse(text, corners, 6))
        return refuse_value(option, text, error);
    for (int i = 0; i < 3; i++)
        if (corners[i] > corners[i + 3])
            return error_set(error, "--region: min must be below max on every axis, not so in \"%.200s\"", text);
    v->filter.by_region = true;
    memcpy(&v->filter.region, corners, sizeof corners);
    return true;
}

/* ---- Anti-aliasing ------------------------------------------------------------------------------------------ */

static bool parse_aa(const view_option *option, const char *text, view *v, octreel_error *error)
{
    if (text[0] == 0 || text[1] != 0 || !strchr("124", text[0]))
        return refuse_value(option, text, error);
    v->aa = text[0] - '0';
    return true;
}

static bool read_aa(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return json_read_int(r, value, at, into) && (*(int *)into != 3 || json_expected(r, value, at, "1, 2 or 4"));
}

/* 0 samples are 1. */
static void write_aa(json_writer *w, const void *from)
{
    json_write_integer(w, *(const int *)from > 1 ? (uint64_t) * (const int *)from : 1);
}

/* ---- The rows ------------------------------------------------------------------------------------------------- */

#define MOST_PIXELS NUMBER_DIGITS(VIEW_MAX_SIDE)
#define SIZE NUMBER_DIGITS(VIEW_DEFAULT_WIDTH) "x" NUMBER_DIGITS(VIEW_DEFAULT_HEIGHT)
#define LOD NUMBER_DIGITS(VIEW_DEFAULT_LOD)
#define BUDGET NUMBER_DIGITS(VIEW_DEFAULT_BUDGET)

/* A value of recording.json: its name and codec, and where it is in the view. */
#define MEMBER(text, how, field) .member.name = text, .member.codec = how, .member.offset = offsetof(view, field)

static const view_option rows[] = {
    {"camera-from", "DIR", NULL, "the whole view of a recording; other options here change it",
     .parse = parse_camera_from},
    {"size", "WxH", "pixels as in 1280x720", "picture in pixels (default " SIZE "; a side is 1 to " MOST_PIXELS ")",
     .parse = parse_size},
    {MEMBER("width", &json_int, width), .member.required = true, .member.min = 1, .member.max = VIEW_MAX_SIDE},
    {MEMBER("height", &json_int, height), .member.required = true, .member.min = 1, .member.max = VIEW_MAX_SIDE},
    {"camera", "NAME", "camera", "from where it is seen (default iso): one of", parse_choice,
     MEMBER("camera", &json_choice, camera), .member.required = true, .member.names = camera_at,
     .words = camera_words_at},
    {"fit", "WHAT", "fit", "what the camera frames: one of", parse_fit, .member.name = "fit",
     .member.codec = JSON_CODEC(read_fit, write_fit, fits_box), .member.names = fit_at, .words = fit_words_at},
    {"look", "AZ,EL", "an azimuth from -360 to 360 and an elevation from -90 to 90 as in 30,22",
     "where the eye is: degrees from -y towards +x, and above the ground (iso: 30,22)", parse_look,
     MEMBER("look", JSON_CODEC(read_look, write_look, NULL), look.azimuth), .member.given = offsetof(view, look.given),
     .noun = "direction of view"},
    {"center", "X,Y,Z", "three numbers as in 100,0,0", "what the camera looks at, in place of the middle or the player",
     parse_center, MEMBER("center", &json_vector, center.place), .member.given = offsetof(view, center.given),
     .noun = "center of view"},
    {"zoom", "TIMES", "a number from 0.001 to 1000000",
     "how much larger all appears than the camera makes it (default 1)", parse_number,
     MEMBER("zoom", &json_interval, zoom.times), .member.min = 0.001, .member.max = MOST_ZOOM,
     .member.given = offsetof(view, zoom.given)},
    {"layers", "LIST", "layer",
     "what is drawn (default: all about the tick itself; -text leaves one out, default,visit-heat adds one): of",
     parse_layers, MEMBER("layers", JSON_CODEC(read_layers, write_layers, NULL), layers), .member.required = true,
     .member.names = view_layer_at, .words = layer_words_at, .noun = "layer"},
    {"color-by", "MODE", "colour mode", "what the colour of a node tells (default depth): one of", parse_choice,
     MEMBER("color_by", &json_choice, coloring), .member.names = coloring_at, .words = coloring_words_at,
     .noun = "colouring"},
    {"color-points", "MODE", "point colour",
     "what the colour of a point tells (default plain; inspect: file where the cloud has colours, leaf where it has "
     "more points than the picture pixels, else height): one of",
     parse_point_color, MEMBER("color_points", &json_later_choice, point_color), .member.names = point_color_at,
     .words = point_color_words_at, .noun = "colouring of points"},
    {"shade", "MODE", "shade",
     "what tells how far off points are (default bands; inspect: edl where points are as near to each other as on a "
     "surface): one of",
     parse_choice, MEMBER("shade", &json_later_choice, shade), .member.names = shade_at, .words = shade_words_at},
    {MEMBER("point_scale", JSON_CODEC(read_scale, write_scale, NULL), point_scale.of),
     .member.given = offsetof(view, point_scale.given), .noun = "scale of points"},
    {"tree", "WHOSE", "tree", "whose nodes are shown, where a session has those of a program (default auto): one of",
     parse_choice, MEMBER("tree", &json_later_choice, tree), .member.names = tree_at, .words = tree_words_at},
    {"diagram", "WHERE", "diagram", "draw the tree as a tree, its root at the top (default none): one of", parse_choice,
     MEMBER("diagram", &json_later_choice, diagram), .member.names = diagram_at, .words = diagram_words_at},
    {"no-closeup", NULL, NULL,
     "do not show larger, in a part of the picture, what appears small in it: what is around the player; else what is "
     "asked; else what a tick changes",
     parse_off, MEMBER("closeup", &json_bool, closeup), .noun = "close-up"},
    {"slice", "AXIS=AT", "an axis and a place as in z=100",
     "only nodes that cut a plane, as in z=100, and the points of such leaves", parse_slice,
     MEMBER("slice", JSON_CODEC(read_slice, write_slice, has_slice), filter)},
    {"depths", "A:B", "levels from 0 to " NUMBER_DIGITS(OCTREE_MAX_DEPTH) " as in 2:5, 2:, :5 or 3",
     "only nodes of depth A to B; A:, :B and A alone will do; the root is 0", parse_depths,
     MEMBER("depths", JSON_CODEC(read_depths, write_depths, NULL), filter),
     .member.given = offsetof(view, filter.by_depth), .noun = "range of depths"},
    {"leaves", NULL, NULL, "only leaves; with --depths, and their points", parse_switch,
     MEMBER("leaves", &json_bool, filter.leaves), .noun = "rule for leaves alone"},
    {"region", "BOX", "six numbers as in -10,-10,-10,10,10,10",
     "only nodes that meet x0,y0,z0,x1,y1,z1, and the points in it", parse_region,
     MEMBER("region", &json_box, filter.region), .member.given = offsetof(view, filter.by_region)},
    {"labels", NULL, NULL, "write paths such as 0/3/7 on nodes, where there is room", parse_switch,
     MEMBER("labels", &json_bool, labels), .noun = "rule for labels"},
    {"lod", "PX", "pixels from 0 to " MOST_PIXELS,
     "leave out boxes below PX pixels whose ancestor is drawn (default " LOD "; 0: none)", parse_number,
     MEMBER("lod", &json_interval, lod), .member.max = VIEW_MAX_SIDE, .noun = "level of detail"},
    {"budget", "N", "a whole number below 2^53",
     "at most N boxes, N points, N/1000 arrows a frame; it says what it lacks (default " BUDGET "; 0: all)",
     parse_whole, MEMBER("budget", &json_uint64, budget), .member.max = JSON_LARGEST_WHOLE},
    {"aa", "N", "1, 2 or 4 samples on each side of a pixel",
     "anti-aliasing: 1 (off, the default), 2 or 4 samples on each side of a pixel", parse_aa,
     MEMBER("aa", JSON_CODEC(read_aa, write_aa, NULL), aa), .member.min = 1, .member.max = 4, .noun = "anti-aliasing"},
};

const view_option *view_option_at(size_t n)
{
    return n < sizeof rows / sizeof rows[0] ? &rows[n] : NULL;
}

const view_option *view_option_named(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].name && strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}
