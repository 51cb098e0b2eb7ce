/* options.c - the values of options, and the sentences for those that do not fit. */
#include "options.h"
#include "layer.h"
#include "number.h"
#include "session_file.h"
#include "view_file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* One line, whatever the names of files in it hold. */
static void say(const char *format, va_list arguments)
{
    char sentence[1 << 14];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    for (char *at = sentence; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 127)
            *at = '?';
    fprintf(stderr, "octreel: %s\n", sentence);
}

int trouble(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    return EXIT_TROUBLE;
}

bool refuse(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    return false;
}

bool check_name(const char *option, const char *name)
{
    return *name || refuse("%s takes a name, and the one that it is given is empty", option);
}

bool check_names(const char *command, char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (!check_name(command, names[i]))
            return false;
    return true;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

/* A decimal whole number at *text, which is moved behind it. False on a sign, no digits, or more than `max`. */
static bool take_number(const char **text, uint64_t max, uint64_t *value)
{
    char *end;
    if (**text < '0' || **text > '9')
        return false;
    errno = 0;
    const unsigned long long number = strtoull(*text, &end, 10);
    if (errno || number > max)
        return false;
    *value = number;
    *text = end;
    return true;
}

bool read_count(const char *option, const char *text, uint64_t min, uint64_t max, uint64_t *value)
{
    const char *at = text;
    if (take_number(&at, max, value) && *at == 0 && *value >= min)
        return true;
    return refuse("%s takes a whole number from %" PRIu64 " to %" PRIu64 ", not \"%s\"", option, min, max, text);
}

bool read_ticks(const char *text, uint64_t *first, uint64_t *last)
{
    const char *at = text;
    *first = 0;
    *last = UINT64_MAX;
    const bool begins = take_number(&at, UINT64_MAX - 1, first), open = *at == ':';
    at += open;
    const bool ends = open && take_number(&at, UINT64_MAX, last);
    if (open && (begins || ends) && *at == 0 && *first < *last)
        return true;
    return refuse("--ticks takes ticks as in 100:200 (from 100 to 199), 100: or :200, not \"%s\"", text);
}

bool read_box(const char *option, const char *text, octree_box *box)
{
    const char *at = text, *limit = text + strlen(text);
    double values[6];
    for (int i = 0; i < 6; i++, at++)
        if (!number_parse(at, limit, &at, &values[i]) || *at != (i < 5 ? ',' : 0))
            return refuse("%s takes six numbers as in -10,-10,-10,10,10,10, not \"%s\"", option, text);
    for (int i = 0; i < 3; i++) {
        box->min[i] = values[i];
        box->max[i] = values[i + 3];
        if (box->min[i] > box->max[i])
            return refuse("%s: min must be below max on every axis, not so in \"%s\"", option, text);
    }
    return true;
}

bool read_rectangle(const char *option, const char *text, image_rectangle *rectangle)
{
    const char *at = text;
    uint64_t values[4] = {0};
    bool ok = true;
    for (int i = 0; ok && i < 4; i++, at++)
        ok = take_number(&at, INT32_MAX, &values[i]) && *at == (i < 3 ? ',' : 0);
    if (!ok || values[2] == 0 || values[3] == 0)
        return refuse(
            "%s takes left, top, width and height in pixels, as in 10,20,300,40, each at most %d and the last "
            "two at least 1, not \"%s\"",
            option, INT32_MAX, text);
    *rectangle = (image_rectangle){(int)values[0], (int)values[1], (int)values[2], (int)values[3]};
    return true;
}

bool read_color(const char *option, const char *text, image_color *color)
{
    const char *digits = text[0] == '#' ? text + 1 : text;
    if (strlen(digits) != 6 || strspn(digits, "0123456789abcdefABCDEF") != 6)
        return refuse("%s takes a colour as in ff8000, not \"%s\"", option, text);
    const unsigned long value = strtoul(digits, NULL, 16);
    *color = (image_color){(uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value};
    return true;
}

bool read_part(const char *option, const char *text, double *value)
{
    const char *limit = text + strlen(text), *end = text;
    if (number_parse(text, limit, &end, value) && end == limit && *value >= 0 && *value <= 1)
        return true;
    return refuse("%s takes a number from 0 to 1, not \"%s\"", option, text);
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

/* Names, by their place; null beyond the last. */
typedef const char *name_at(int i);

static const char *camera_at(int i)
{
    return view_camera_name((view_camera)i);
}

static const char *layer_at(int i)
{
    return view_layer_name((view_layer)i);
}

static const char *coloring_at(int i)
{
    return view_coloring_name((view_coloring)i);
}

static const char *diagram_at(int i)
{
    return view_diagram_name((view_diagram)i);
}

static const char *fit_at(int i)
{
    static const char *const names[] = {[FIT_WORLD] = "world", [FIT_POINTS] = "points"};
    return i < (int)(sizeof names / sizeof names[0]) ? names[i] : NULL;
}

static const char *context_at(int i)
{
    return draw_context_name((draw_context)i);
}

static void print_names(FILE *out, name_at *name)
{
    for (int i = 0; name(i); i++)
        fprintf(out, "%s%s", i ? ", " : "", name(i));
}

/* "octreel: there is no camera "x"; there are iso, top ..." */
static bool no_such(const char *kind, const char *text, int length, name_at *name)
{
    fprintf(stderr, "octreel: there is no %s \"%.*s\"; there are ", kind, length, text);
    print_names(stderr, name);
    fputc('\n', stderr);
    return false;
}

/* ---- Options of a view -------------------------------------------------------------------------------------- */

static bool read_size(const char *text, view *v)
{
    const char *at = text;
    uint64_t width, height;
    if (!take_number(&at, INT32_MAX, &width) || *at++ != 'x' || !take_number(&at, INT32_MAX, &height) || *at != 0)
        return refuse("--size takes pixels as in 1280x720, not \"%s\"", text);
    v->width = (int)width;
    v->height = (int)height;
    return true;
}

static bool read_camera_from(const char *text, view *v)
{
    octreel_error error;
    return view_read(text, v, &error) || refuse("%s", error.text);
}

static bool read_camera(const char *text, view *v)
{
    return view_camera_parse(text, &v->camera) || no_such("camera", text, (int)strlen(text), camera_at);
}

static bool read_fit(const char *text, view *v)
{
    for (int i = 0; fit_at(i); i++) {
        if (strcmp(text, fit_at(i)) == 0) {
            v->fit = (view_fit)i;
            return true;
        }
    }
    return no_such("fit", text, (int)strlen(text), fit_at);
}

static bool read_layers(const char *text, view *v)
{
    const char *bad;
    return view_layers_parse(text, &v->layers, &bad) || no_such("layer", bad, (int)strcspn(bad, ","), layer_at);
}

static bool read_coloring(const char *text, view *v)
{
    return view_coloring_parse(text, &v->coloring) || no_such("colour mode", text, (int)strlen(text), coloring_at);
}

static bool read_diagram(const char *text, view *v)
{
    return view_diagram_parse(text, &v->diagram) || no_such("diagram", text, (int)strlen(text), diagram_at);
}

static bool read_slice(const char *text, view *v)
{
    const char *limit = text + strlen(text), *end = text;
    if (text[0] < 'x' || text[0] > 'z' || text[1] != '=' || !number_parse(text + 2, limit, &end, &v->filter.slice_at) ||
        end != limit)
        return refuse("--slice takes an axis and a place as in z=100, not \"%s\"", text);
    v->filter.slice = text[0];
    return true;
}

/* "2:5", "2:", ":5" or "3". */
static bool read_depths(const char *text, view *v)
{
    const char *at = text;
    uint64_t from = 0, to = OCTREE_MAX_DEPTH;
    const bool begins = take_number(&at, OCTREE_MAX_DEPTH, &from), open = *at == ':';
    at += open;
    const bool ends = open && take_number(&at, OCTREE_MAX_DEPTH, &to);
    to = open ? to : from;
    if (*at != 0 || from > to || !(begins || ends))
        return refuse("--depths takes levels from 0 to %d as in 2:5, 2:, :5 or 3, not \"%s\"", OCTREE_MAX_DEPTH, text);
    v->filter.by_depth = true;
    v->filter.min_depth = (unsigned)from;
    v->filter.max_depth = (unsigned)to;
    return true;
}

static bool read_leaves(const char *text, view *v)
{
    (void)text;
    return v->filter.leaves = true;
}

static bool read_labels(const char *text, view *v)
{
    (void)text;
    return v->labels = true;
}

static bool read_region(const char *text, view *v)
{
    return v->filter.by_region = read_box("--region", text, &v->filter.region);
}

static bool read_lod(const char *text, view *v)
{
    const char *limit = text + strlen(text), *end = text;
    if (number_parse(text, limit, &end, &v->lod) && end == limit && v->lod >= 0 && v->lod <= VIEW_MAX_SIDE)
        return true;
    return refuse("--lod takes pixels from 0 to %d, not \"%s\"", VIEW_MAX_SIDE, text);
}

static bool read_budget(const char *text, view *v)
{
    return read_count("--budget", text, 0, SESSION_ID_LIMIT - 1, &v->budget);
}

static bool read_aa(const char *text, view *v)
{
    if (text[0] == 0 || text[1] != 0 || !strchr("124", text[0]))
        return refuse("--aa takes 1, 2 or 4 samples on each side of a pixel, not \"%s\"", text);
    v->aa = text[0] - '0';
    return true;
}

#define SIZE NUMBER_DIGITS(VIEW_DEFAULT_WIDTH) "x" NUMBER_DIGITS(VIEW_DEFAULT_HEIGHT)
#define MOST NUMBER_DIGITS(VIEW_MAX_SIDE)
#define LOD NUMBER_DIGITS(VIEW_DEFAULT_LOD)
#define BUDGET NUMBER_DIGITS(VIEW_DEFAULT_BUDGET)

/* Each option, in the order in which they are read: its name, what stands for its value in the help (null: it takes
 * none), what reads it, and what it does; where there are names to choose from, these are listed behind that. */
static const struct {
    const char *name, *value;
    bool (*read)(const char *text, view *v);
    const char *help;
    name_at *names;
} rows[] = {
    {"camera-from", "DIR", read_camera_from, "the whole view of a recording; other options here change it", NULL},
    {"size", "WxH", read_size, "picture in pixels (default " SIZE "; a side is 1 to " MOST ")", NULL},
    {"camera", "NAME", read_camera, "(default iso) one of", camera_at},
    {"fit", "WHAT", read_fit, "what the camera frames (points: those shown at tick 0); record: world, inspect: points",
     NULL},
    {"layers", "LIST", read_layers, "(default all but heat; -text leaves one out, default,visit-heat adds one) of",
     layer_at},
    {"color-by", "MODE", read_coloring, "what the colour of a node tells (default depth): one of", coloring_at},
    {"diagram", "WHERE", read_diagram, "draw the tree as a tree, its root at the top (default none): one of",
     diagram_at},
    {"slice", "AXIS=AT", read_slice, "only nodes that cut a plane, as in z=100, and the points of such leaves", NULL},
    {"depths", "A:B", read_depths, "only nodes of depth A to B; A:, :B and A alone will do; the root is 0", NULL},
    {"leaves", NULL, read_leaves, "only leaves", NULL},
    {"region", "BOX", read_region, "only nodes that meet x0,y0,z0,x1,y1,z1, and the points in it", NULL},
    {"labels", NULL, read_labels, "write paths such as 0/3/7 on nodes, where there is room", NULL},
    {"aa", "N", read_aa, "anti-aliasing: 1 (off, the default), 2 or 4 samples on each side of a pixel", NULL},
    {"lod", "PX", read_lod, "leave out boxes below PX pixels whose ancestor is drawn (default " LOD "; 0: none)", NULL},
    {"budget", "N", read_budget,
     "at most N boxes and N points a frame, which says what it leaves out (default " BUDGET "; 0: all)", NULL},
};

#define ROWS (sizeof rows / sizeof rows[0])
_Static_assert(ROWS <= VIEW_OPTIONS, "there is room for every option of a view");

size_t list_view_options(struct option *options)
{
    for (size_t i = 0; i < ROWS; i++)
        options[i] =
            (struct option){rows[i].name, rows[i].value ? required_argument : no_argument, NULL, VIEW_OPTION + (int)i};
    return ROWS;
}

bool take_view_option(view_options *given, int option)
{
    if (option < VIEW_OPTION || option >= VIEW_OPTION + (int)ROWS)
        return false;
    given->values[option - VIEW_OPTION] = optarg ? optarg : "";
    return true;
}

const char *first_view_option(const view_options *given)
{
    for (size_t i = 0; i < ROWS; i++)
        if (given->values[i])
            return rows[i].name;
    return NULL;
}

bool read_view(const view_options *given, view *v)
{
    for (size_t i = 0; i < ROWS; i++)
        if (given->values[i] && !rows[i].read(given->values[i], v))
            return false;
    return true;
}

/* In lines of their own, below what an option does. */
static void list_names(FILE *out, name_at *name)
{
    int room = 0;
    for (int i = 0; name(i); i++) {
        const int length = (int)strlen(name(i)) + 2;
        const bool fits = length <= room;
        fprintf(out, "%s%s%s", i ? "," : "", fits ? " " : "\n                        ", name(i));
        room = (fits ? room : 90) - length;
    }
}

void print_view_options(FILE *out)
{
    for (size_t i = 0; i < ROWS; i++) {
        char name[32];
        snprintf(name, sizeof name, "--%s%s%s", rows[i].name, rows[i].value ? " " : "",
                 rows[i].value ? rows[i].value : "");
        fprintf(out, "      %-17s %s", name, rows[i].help);
        if (rows[i].names)
            list_names(out, rows[i].names);
        fputc('\n', out);
    }
}

/* ---- Options of who draws ----------------------------------------------------------------------------------- */

bool read_context(const char *text, renderer_choice *choice)
{
    return draw_context_parse(text, &choice->context) || no_such("context", text, (int)strlen(text), context_at);
}

bool check_renderer(const renderer_choice *choice)
{
    if (!choice->any_renderer || choice->context == DRAW_EGL)
        return true;
    return refuse("--any-renderer goes with --context egl alone: no other context has another renderer");
}

void print_renderer_options(FILE *out)
{
    fputs("      --context NAME    what draws off-screen: ", out);
    print_names(out, context_at);
    fputs(" (default auto: the first of these that there is)\n"
          "      --any-renderer    with --context egl: draw with a graphics card too. Frames are then the same for\n"
          "                        the same card and driver; those of llvmpipe are the same everywhere\n",
          out);
}
