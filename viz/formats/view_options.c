/* SPDX-License-Identifier: MIT */
/* view_options.c - the table of view options; see view_options.h. The rows of the table are at the end of the file.
 * Each section of the file before the table holds the functions of a few rows. */
#include "view_options.h"
#include "file_kind.h"
#include "hint.h"
#include "layer.h"
#include "number.h"
#include "recording_file.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- Names to choose from ----------------------------------------------------------------------------------- */

const char *view_layer_name(int n)
{
    return n < LAYER_COUNT ? layer_rows[n].name : NULL;
}

static const char *layer_description(int n)
{
    return n < LAYER_COUNT ? layer_rows[n].help : NULL;
}

/* The values of view_fit that a user can choose. A user cannot choose FIT_BOX: camera_fit_points() sets it. */
static const char *const fits[][2] = {
    [FIT_WORLD] = {"world", "the whole world, the default of record"},
    [FIT_POINTS] = {"points", "the points shown at tick 0; this is the default of inspect"},
};

static const char *fit_name(int n)
{
    return (size_t)n < sizeof fits / sizeof fits[0] ? fits[n][0] : NULL;
}

static const char *fit_description(int n)
{
    return (size_t)n < sizeof fits / sizeof fits[0] ? fits[n][1] : NULL;
}

/* Sets the error for an unknown name, for example: unknown camera "iss", did you mean iso? choose from iso, top, ...
 * Returns false. */
static bool fail_with_unknown_name(const view_option *option, const char *text, size_t length, octreel_error *error)
{
    char known[320], meant[HINT_TEXT];
    json_name *names = option->member.names;
    hint h = hint_create(text, length);
    for (int i = 0; names(i); i++)
        hint_add_candidate(&h, names(i));
    return error_set(error, "unknown %s \"%.*s\"%schoose from %s", option->takes, length < 100 ? (int)length : 100,
                     text, hint_format(&h, "", meant), json_list_names(names, known, sizeof known));
}

/* ---- Values of each type ------------------------------------------------------------------------------------ */

static bool fail_with_wrong_value(const view_option *option, const char *text, octreel_error *error)
{
    return error_set(error, "--%s takes %s, not \"%.200s\"", option->name, option->takes, text);
}

static void *option_address(const view_option *option, view *v)
{
    return (char *)v + option->member.offset;
}

static bool parse_choice(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const int found = json_find_name(option->member.names, text);
    if (found < 0)
        return fail_with_unknown_name(option, text, strlen(text), error);
    *(int *)option_address(option, v) = found;
    return true;
}

/* Sets a switch: an option without a value. On the command line `text` is empty, and the switch gets the opposite of
 * its default. Otherwise `text` is "on" or "off". */
static bool parse_switch(const view_option *option, const char *text, view *v, octreel_error *error)
{
    (void)error;
    *(bool *)option_address(option, v) = *text ? strcmp(text, "on") == 0 : strcmp(option->standard, "off") == 0;
    return true;
}

static bool parse_whole(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    if (!whole_number_parse(&at, (uint64_t)option->member.max, option_address(option, v)) || *at != 0)
        return fail_with_wrong_value(option, text, error);
    return true;
}

/* Parses numbers that are separated by commas. The limits member.min and member.max are checked only for an option
 * with a single number. */
static bool parse_numbers(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const json_member *m = &option->member;
    const size_t count = m->size ? m->size : 1;
    double numbers[3];
    if (!numbers_parse(text, numbers, count) || (m->min < m->max && !(*numbers >= m->min && *numbers <= m->max)))
        return fail_with_wrong_value(option, text, error);
    memcpy(option_address(option, v), numbers, count * sizeof *numbers);
    if (m->given)
        *(bool *)((char *)v + m->given) = true;
    return true;
}

/* ---- Size --------------------------------------------------------------------------------------------------- */

static bool parse_size(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    uint64_t width, height;
    if (!whole_number_parse(&at, INT32_MAX, &width) || *at++ != 'x' || !whole_number_parse(&at, INT32_MAX, &height) ||
        *at != 0)
        return fail_with_wrong_value(option, text, error);
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
        return error_set(error, "%s: no such file or folder", text);
    if (file_kind_rows[kind].name && kind != KIND_RECORDING)
        return error_set(error, "%s is %s, and --%s takes the folder of a recording", text, file_kind_rows[kind].name,
                         option->name);
    return recording_read(text, v, &every, error);
}

static void write_fit(json_writer *w, const void *from)
{
    json_write_string(w, fit_name(*(const view_fit *)from == FIT_WORLD ? FIT_WORLD : FIT_POINTS));
}

#define MOST_TURN 360 /* the largest angle, in degrees */

static bool is_valid_look(double azimuth, double elevation)
{
    return fabs(azimuth) <= MOST_TURN && fabs(elevation) <= 90;
}

static bool parse_look(const view_option *option, const char *text, view *v, octreel_error *error)
{
    return parse_numbers(option, text, v, error) &&
           (is_valid_look(v->look.azimuth, v->look.elevation) || fail_with_wrong_value(option, text, error));
}

static bool check_look(json_reader *r, const json_place *at, void *structure)
{
    const view *v = structure;
    return is_valid_look(v->look.azimuth, v->look.elevation) ||
           json_fail(r, at, "must be an azimuth from -360 to 360 and an elevation from -90 to 90");
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Sets the coloring of points. If --camera-from has read the scale of another coloring, the scale is discarded. */
static bool parse_point_color(const view_option *option, const char *text, view *v, octreel_error *error)
{
    v->point_scale.given = false;
    return parse_choice(option, text, v, error);
}

/* ---- Layers ------------------------------------------------------------------------------------------------- */

static bool parse_layers(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *bad;
    return view_layers_parse(text, &v->layers, &bad) || fail_with_unknown_name(option, bad, strcspn(bad, ","), error);
}

/* ---- Parts of the tree -------------------------------------------------------------------------------------- */

static bool parse_slice(const view_option *option, const char *text, view *v, octreel_error *error)
{
    if (text[0] < 'x' || text[0] > 'z' || text[1] != '=' || !numbers_parse(text + 2, &v->filter.slice_at, 1))
        return fail_with_wrong_value(option, text, error);
    v->filter.slice = text[0];
    return true;
}

static bool read_slice(json_reader *r, json_t *value, const json_place *at, void *into)
{
    view_filter *f = into;
    const char *axis = json_object_size(value) == 1 ? json_object_iter_key(json_object_iter(value)) : "";
    if (strlen(axis) != 1 || !strchr("xyz", *axis))
        return json_fail_expected(r, value, at, "an axis and a place as in {\"z\": 100}");
    f->slice = *axis;
    return json_number.read(r, json_object_get(value, axis), &(json_place){at, axis, 0}, &f->slice_at);
}

static void write_slice(json_writer *w, const void *from)
{
    const view_filter *f = from;
    json_write_begin_object(w);
    json_write_number_member(w, (const char[]){f->slice, 0}, f->slice_at);
    json_write_end_object(w);
}

/* Parses a range of depths: "2:5", "2:", ":5" or "3". */
static bool parse_depths(const view_option *option, const char *text, view *v, octreel_error *error)
{
    const char *at = text;
    uint64_t from = 0, to = OCTREE_MAX_DEPTH;
    const bool begins = whole_number_parse(&at, OCTREE_MAX_DEPTH, &from), open = *at == ':';
    at += open;
    const bool ends = open && whole_number_parse(&at, OCTREE_MAX_DEPTH, &to);
    to = open ? to : from;
    if (*at != 0 || from > to || !(begins || ends))
        return fail_with_wrong_value(option, text, error);
    v->filter.by_depth = true;
    v->filter.min_depth = (unsigned)from;
    v->filter.max_depth = (unsigned)to;
    return true;
}

static bool check_depths(json_reader *r, const json_place *at, void *structure)
{
    const view_filter *f = &((const view *)structure)->filter;
    return f->min_depth <= f->max_depth || json_fail(r, at, "the first depth must not be greater than the second");
}

static bool parse_region(const view_option *option, const char *text, view *v, octreel_error *error)
{
    double corners[6];
    if (!numbers_parse(text, corners, 6))
        return fail_with_wrong_value(option, text, error);
    for (int i = 0; i < 3; i++)
        if (corners[i] > corners[i + 3])
            return error_set(error, "--region: min must not be above max on any axis, but %c is in \"%.200s\"",
                             "xyz"[i], text);
    v->filter.by_region = true;
    memcpy(&v->filter.region, corners, sizeof corners);
    return true;
}

/* ---- Anti-aliasing ------------------------------------------------------------------------------------------ */

static bool parse_antialiasing(const view_option *option, const char *text, view *v, octreel_error *error)
{
    if (text[0] == 0 || text[1] != 0 || !strchr("124", text[0]))
        return fail_with_wrong_value(option, text, error);
    v->aa = text[0] - '0';
    return true;
}

static bool check_antialiasing(json_reader *r, const json_place *at, void *structure)
{
    return ((const view *)structure)->aa != 3 || json_fail(r, at, "expected 1, 2 or 4, found 3");
}

/* ---- Derived values ----------------------------------------------------------------------------------------- */

static bool check_focus(json_reader *r, const json_place *at, void *structure)
{
    view *v = structure;
    if (v->fit == FIT_WORLD)
        return json_fail(r, at, "needs \"fit\": \"points\"");
    v->fit = FIT_BOX;
    for (int i = 0; i < 3; i++)
        if (v->focus.min[i] < v->focus.max[i])
            return true;
    return json_fail(r, at, "the box has no extent");
}

static bool has_focus(const void *structure)
{
    return ((const view *)structure)->fit == FIT_BOX;
}

static bool check_point_scale(json_reader *r, const json_place *at, void *structure)
{
    const point_scale *s = &((const view *)structure)->point_scale.of;
    for (int i = 0; i < 3; i++)
        if (s->low[i] > s->high[i])
            return json_fail(r, at, "the lowest corner is above the highest");
    return s->spacing >= 0 || json_fail(r, at, "the spacing is below 0");
}

/* The members of "derived". A point_scale is written as eleven doubles. */
_Static_assert(offsetof(view, height) == offsetof(view, width) + sizeof(int) &&
                   offsetof(view_filter, max_depth) == offsetof(view_filter, min_depth) + sizeof(unsigned) &&
                   offsetof(view, look.elevation) == offsetof(view, look.azimuth) + sizeof(double),
               "a row reads the two members as an array, so the second must follow the first");

const json_member view_derived_members[] = {
    {"focus", &json_box, offsetof(view, focus), .is_set = has_focus, .check = check_focus},
    {"point_scale", &json_numbers, offsetof(view, point_scale.of), .given = offsetof(view, point_scale.given),
     .size = sizeof(point_scale) / sizeof(double), .check = check_point_scale,
     .about = "eleven numbers: the lowest and the highest corner, the ranges of ids and of intensities, and a spacing"},
    {0},
};

/* ---- The rows ------------------------------------------------------------------------------------------------- */

#define MOST_PIXELS NUMBER_DIGITS(VIEW_MAX_SIDE)

/* Sets the fields of an option's member in recording.json: its name, its codec, and the offset of its value in
 * `view`. */
#define MEMBER(text, how, field) .member.name = text, .member.codec = how, .member.offset = offsetof(view, field)

/* Makes an option's member in recording.json nullable. The member is null until the user sets the option. `flag` is
 * the bool of `view` that says whether the option was set. */
#define UNSET_UNTIL(flag) .member.nullable = true, .member.given = offsetof(view, flag)

static const view_option rows[] = {
    {"camera-from", "DIR", NULL, "use the view options of the recording in DIR, except for options that you give here",
     .parse = parse_camera_from},
    {"size", "WxH", "pixels as in 1280x720", "picture in pixels (default 1280x720; a side is 1 to " MOST_PIXELS ")",
     parse_size, MEMBER("size", &json_ints, width), .member.size = 2, .standard = "1280x720", .member.min = 1,
     .member.max = VIEW_MAX_SIDE, .member.about = "a width and a height in pixels as in [1280, 720]"},
    {"camera", "NAME", "camera", "the camera (default iso): one of", parse_choice,
     MEMBER("camera", &json_choice, camera), .standard = "iso", .member.names = view_camera_name,
     .words = view_camera_words},
    {"fit", "WHAT", "fit", "what the camera frames: one of", parse_choice,
     MEMBER("fit", JSON_CODEC(json_read_choice, write_fit), fit), .standard = "world", .member.names = fit_name,
     .words = fit_description},
    {"look", "AZ,EL", "an azimuth from -360 to 360 and an elevation from -90 to 90 as in 30,22",
     "direction from the centre to the eye, in degrees: azimuth from -y towards +x, elevation (iso: 30,22)", parse_look,
     MEMBER("look", &json_numbers, look.azimuth), .member.size = 2, UNSET_UNTIL(look.given), .member.check = check_look,
     .member.about = "an azimuth and an elevation in degrees as in [30, 22]", .noun = "direction of view"},
    {"center", "X,Y,Z", "three numbers as in 100,0,0",
     "world position at the centre of the picture, instead of the middle of the world or the player", parse_numbers,
     MEMBER("center", &json_numbers, center.place), .member.size = 3, .member.about = "three numbers [x, y, z]",
     UNSET_UNTIL(center.given), .noun = "center of view"},
    {"zoom", "TIMES", "a number from 0.001 to 1000000", "magnification (default 1)", parse_numbers,
     MEMBER("zoom", &json_number, zoom), .standard = "1", .member.min = 0.001, .member.max = 1e6},
    {"layers", "LIST", "layer",
     "layers to draw (default: all but the heat layers; -text removes a layer from them, default,visit-heat adds one): "
     "of",
     parse_layers, MEMBER("layers", &json_set, layers), .standard = "default", .member.about = "a list of layers",
     .member.advice = "the name of a layer", .member.names = view_layer_name, .words = layer_description,
     .noun = "layer", .by_element = true},
    {"color-by", "MODE", "colour mode", "meaning of a node's colour (default depth): one of", parse_choice,
     MEMBER("color_by", &json_choice, coloring), .standard = "depth", .member.names = view_coloring_name,
     .words = view_coloring_words, .noun = "colouring"},
    {"color-points", "MODE", "point colour",
     "meaning of a point's colour (default plain; inspect: file if the cloud has colours, leaf if it has more points "
     "than the picture has pixels, else height): one of",
     parse_point_color, MEMBER("color_points", &json_choice, point_color), .standard = "plain",
     .member.names = view_point_color_name, .words = view_point_color_words, .noun = "colouring of points"},
    {"shade", "MODE", "shade",
     "how points show their distance from the eye (default bands; inspect: edl if the points are dense enough to form "
     "surfaces): one of",
     parse_choice, MEMBER("shade", &json_choice, shade), .standard = "bands", .member.names = view_shade_name,
     .words = view_shade_words},
    {"tree", "WHOSE", "tree", "the tree whose nodes are drawn if the session has foreign nodes (default auto): one of",
     parse_choice, MEMBER("tree", &json_choice, tree), .standard = "auto", .member.names = view_tree_name,
     .words = view_tree_words},
    {"diagram", "WHERE", "diagram",
     "draw the tree as a diagram with its root at the top (default none, and beside for the example session): one of",
     parse_choice, MEMBER("diagram", &json_choice, diagram), .standard = "none", .member.names = view_diagram_name,
     .words = view_diagram_words},
    {"no-closeup", NULL, NULL,
     "draw no close-up. A close-up is a part of the picture that enlarges small elements: the surroundings of the "
     "player, otherwise the queries, otherwise the changes of the tick",
     parse_switch, MEMBER("closeup", &json_bool, closeup), .standard = "on", .noun = "close-up"},
    {"slice", "AXIS=AT", "an axis and a place as in z=100",
     "show only the nodes that a plane such as z=100 cuts, and the points in the leaves among these nodes", parse_slice,
     MEMBER("slice", JSON_CODEC(read_slice, write_slice), filter), .member.nullable = true,
     .member.nonzero = offsetof(view, filter.slice), .member.nonzero_size = 1},
    {"depths", "A:B", "levels from 0 to " NUMBER_DIGITS(OCTREE_MAX_DEPTH) " as in 2:5, 2:, :5 or 3",
     "show only nodes of depth A to B; A:, :B and A alone are allowed; the root has depth 0", parse_depths,
     MEMBER("depths", &json_ints, filter.min_depth), .member.size = 2, UNSET_UNTIL(filter.by_depth),
     .member.max = OCTREE_MAX_DEPTH, .member.check = check_depths, .member.about = "two depths as in [2, 5]",
     .noun = "range of depths"},
    {"leaves", NULL, NULL,
     "draw boxes for leaves only; with --depths, also show only the points in leaves of these depths", parse_switch,
     MEMBER("leaves", &json_bool, filter.leaves), .standard = "off", .noun = "rule for leaves only"},
    {"region", "BOX", "six numbers as in -10,-10,-10,10,10,10",
     "show only the nodes that meet the box x0,y0,z0,x1,y1,z1, and the points in the box", parse_region,
     MEMBER("region", &json_box, filter.region), UNSET_UNTIL(filter.by_region)},
    {"labels", NULL, NULL, "write the address of each node, such as 0/3/7, on the node if there is room", parse_switch,
     MEMBER("labels", &json_bool, labels), .standard = "off", .noun = "rule for labels"},
    /* Up to --lod 4, frames of 100,000 points look the same as without --lod, because the boxes that are left out
     * are only specks. */
    {"lod", "PX", "pixels from 0 to " MOST_PIXELS,
     "leave out boxes smaller than PX pixels if an ancestor's box is drawn (default 2; 0: draw all)", parse_numbers,
     MEMBER("lod", &json_number, lod), .standard = "2", .member.max = VIEW_MAX_SIDE, .noun = "level of detail"},
    /* With the default budget, a frame needs at worst about 300 MB and a few seconds. */
    {"budget", "N", "a whole number below 2^53",
     "draw at most N boxes, N points and N/1000 arrows in a frame; the frame states what it leaves out (default "
     "250000; 0: no "
     "limit)",
     parse_whole, MEMBER("budget", &json_uint64, budget), .standard = "250000", .member.max = JSON_LARGEST_WHOLE},
    {"aa", "N", "1, 2 or 4 samples on each side of a pixel",
     "anti-aliasing: 1 (off, the default), 2 or 4 samples on each side of a pixel", parse_antialiasing,
     MEMBER("aa", &json_int, aa), .standard = "1", .member.min = 1, .member.max = 4, .member.check = check_antialiasing,
     .noun = "anti-aliasing"},
};

const view_option *view_option_at(size_t n)
{
    return n < sizeof rows / sizeof rows[0] ? &rows[n] : NULL;
}

const view_option *view_find_option(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}

view view_make_default(void)
{
    view v = {0};
    octreel_error ignored;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].standard)
            rows[i].parse(&rows[i], rows[i].standard, &v, &ignored);
    return v;
}
