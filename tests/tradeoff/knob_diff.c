/* SPDX-License-Identifier: MIT */
/* knob_diff.c - the tolerances of octreel diff: what they forgive and what they still find, on seeded distortions. */
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "flip.h"
#include "frames.h"
#include "image_compare.h"
#include "knob.h"
#include "measuring.h"
#include "picture.h"
#include "program.h"
#include "recording_file.h"

static const column columns[] = {
    {"setting", "--max-delta: the distance of two colours that is forgiven, of 1 for black and white; or --flip", NULL},
    {"found", "pixels that still count as different, of all pixels", NULL},
    {"differ", "pixels that differ at all, of all pixels", NULL},
    {"worst", "the largest distance of two colours of a pixel", NULL},
    {"flip", "mean FLIP of the frame: how visible the distortion is, from 0 to 1", NULL},
    {"ms", "processor milliseconds to compare two frames of 640 x 360", NULL},
};

static const chart charts[] = {
    {.title = "Pixels that are still found",
     .x = "setting",
     .x_label = "--max-delta or --flip",
     .y = "found",
     .y_label = "share of pixels that count as different",
     .y_log = true},
    {.title = "Time", .x = "setting", .x_label = "--max-delta or --flip", .y = "ms", .y_label = "milliseconds"},
};

static const double deltas[] = {0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2};
#define DELTA "max-delta alone"
#define FLIP "--flip"
enum { DELTAS = sizeof deltas / sizeof deltas[0], WIDTH = 640, HEIGHT = 360, TIMES = 5 };

/* ---- Distortions -------------------------------------------------------------------------------------------- */

static unsigned char *pixel(const image *frame, int x, int y)
{
    return frame->pixels + 3 * ((size_t)y * (size_t)frame->width + (size_t)x);
}

static void shift(const image *from, image *to)
{
    for (int y = 0; y < from->height; y++)
        memcpy(pixel(to, 1, y), pixel(from, 0, y), 3 * (size_t)(from->width - 1));
}

static void change_gamma(const image *from, image *to)
{
    const size_t size = 3 * (size_t)from->width * (size_t)from->height;
    for (size_t i = 0; i < size; i++)
        to->pixels[i] = (unsigned char)lround(255 * pow(from->pixels[i] / 255.0, 1.05));
}

static void blur(const image *from, image *to)
{
    for (int y = 1; y < from->height - 1; y++)
        for (int x = 1; x < from->width - 1; x++)
            for (int c = 0; c < 3; c++) {
                int sum = 0;
                for (int i = 0; i < 9; i++)
                    sum += pixel(from, x + i % 3 - 1, y + i / 3 - 1)[c];
                pixel(to, x, y)[c] = (unsigned char)(sum / 9);
            }
}

/* One row of pixels takes the colour of the ground, as if a line were missing. */
static void drop_line(const image *from, image *to)
{
    for (int x = 0; x < from->width; x++)
        memcpy(pixel(to, x, from->height / 2), pixel(from, 0, 0), 3);
}

static void add_noise(const image *from, image *to)
{
    uint64_t random = 7;
    const size_t size = 3 * (size_t)from->width * (size_t)from->height;
    for (size_t i = 0; i < size; i++) {
        const int value = from->pixels[i] + (int)random_below(&random, 5) - 2;
        to->pixels[i] = (unsigned char)(value < 0 ? 0 : value > 255 ? 255 : value);
    }
}

static const struct distortion {
    const char *name;
    void (*apply)(const image *from, image *to); /* `to` is a copy; null: another number of samples a pixel */
} distortions[] = {
    {"shifted by a pixel", shift},    {"gamma 1.05", change_gamma},     {"blur of 3 x 3", blur},
    {"a line is missing", drop_line}, {"noise of 2 levels", add_noise}, {"other antialiasing", NULL},
};
enum { DISTORTIONS = sizeof distortions / sizeof distortions[0] };

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

static image copy_image(const image *from)
{
    image copy;
    if (!image_create(&copy, from->width, from->height, 3))
        stop_with_error("there is no memory for a picture");
    memcpy(copy.pixels, from->pixels, 3 * (size_t)from->width * (size_t)from->height);
    return copy;
}

/* A frame in colours. */
static image draw_frame(const subject *s, int aa)
{
    view v = view_make_default();
    picture p;
    scene shown = {0};
    octreel_error why;
    v.width = WIDTH;
    v.height = HEIGHT;
    v.aa = aa;
    subject_show(s, &v, &shown);
    if (!picture_open(&p, &v, &(renderer_choice){0}, &why) || !picture_draw(&p, &shown, &why))
        stop_with_error("%s", why.text);
    image frame = copy_image(&p.frame);
    picture_close(&p);
    scene_release(&shown);
    return frame;
}

/* Compare as octreel diff does; *time is in milliseconds. */
static image_difference compare(const image *a, const image *b, const image_tolerance *tolerance, double *time)
{
    image_difference found = {0};
    double times[TIMES];
    for (int i = 0; i < TIMES; i++) {
        const double start = processor_time();
        found = image_compare_within(a, b, tolerance);
        found.has_flip = tolerance->flip;
        if (tolerance->flip && !image_measure_flip(a, b, tolerance, NULL, &found.flip))
            stop_with_error("there is no memory for FLIP");
        times[i] = processor_time() - start;
    }
    *time = median(times, TIMES) / 1e6;
    return found;
}

static void compare_within(table *t, const char *scene, const char *variant, const image *a, const image *b,
                           image_tolerance tolerance)
{
    const double pixels = (double)a->width * (double)a->height;
    double time;
    const image_difference found = compare(a, b, &tolerance, &time);
    table_add(t, scene, variant,
              (double[]){tolerance.max_delta, (double)found.counted.pixels / pixels,
                         (double)found.unlike.pixels / pixels, found.unlike.worst_delta, NAN, time});
}

/* --flip forgives a frame as a whole. */
static void compare_flip(table *t, const char *scene, const image *a, const image *b)
{
    const double pixels = (double)a->width * (double)a->height;
    image_tolerance tolerance = {.flip = true, .pixels_per_degree = FLIP_PIXELS_PER_DEGREE};
    double time;
    const image_difference found = compare(a, b, &tolerance, &time);
    for (int i = 0; i < DELTAS; i++) {
        tolerance.max_flip = deltas[i];
        const bool forgiven = image_is_within_tolerance(&found, &tolerance);
        table_add(t, scene, FLIP,
                  (double[]){deltas[i], forgiven ? 0 : (double)found.counted.pixels / pixels,
                             (double)found.unlike.pixels / pixels, found.unlike.worst_delta, found.flip.mean, time});
    }
}

static void measure(const run *r, table *t)
{
    const frame_kind kind = {"clusters-2000", 2000};
    subject *s = subject_make(&kind);
    const image frame = draw_frame(s, 2), other = draw_frame(s, 4);
    for (int i = 0; i < DISTORTIONS; i++) {
        image distorted = copy_image(distortions[i].apply ? &frame : &other);
        if (distortions[i].apply)
            distortions[i].apply(&frame, &distorted);
        for (int j = 0; j < DELTAS; j++)
            for (int edges = 0; edges < 2; edges++)
                compare_within(t, distortions[i].name, edges ? "with --antialias" : DELTA, &frame, &distorted,
                               (image_tolerance){.max_delta = deltas[j], .antialias = edges == 1});
        compare_flip(t, distortions[i].name, &frame, &distorted);
        attach_picture(r, t, &distorted, 64, 36, distortions[i].name);
        image_release(&distorted);
    }
    image_release((image *)&frame);
    image_release((image *)&other);
    subject_free(s);
}

/* The least setting that forgives a distortion, of those measured; infinite if none does. */
static double least_forgiving(const table *t, const char *scene, const char *variant)
{
    double least = INFINITY;
    for (size_t i = 0; i < t->count; i++)
        if (strcmp(t->rows[i].scene, scene) == 0 && strcmp(t->rows[i].variant, variant) == 0 &&
            table_value(t, &t->rows[i], "found") == 0)
            least = fmin(least, t->rows[i].values[0]);
    return least;
}

/* List the distortions that some measured setting forgives, or those that none does. */
static void list_distortions(const table *t, const char *variant, bool forgiven, FILE *out)
{
    const char *separator = " ";
    for (int i = 0; i < DISTORTIONS; i++) {
        const double least = least_forgiving(t, distortions[i].name, variant);
        if (isfinite(least) != forgiven)
            continue;
        fprintf(out, "%s%s", separator, distortions[i].name);
        if (forgiven)
            fprintf(out, " (%g)", least);
        separator = ", ";
    }
    if (*separator == ' ')
        fputs(" none", out);
}

static void tell(const table *t, FILE *out)
{
    fputs("Nothing is forgiven by default. A --max-delta forgives", out);
    list_distortions(t, DELTA, true, out);
    fprintf(out, "; up to %g it still finds", deltas[DELTAS - 1]);
    list_distortions(t, DELTA, false, out);
    fputs(". A --flip forgives", out);
    list_distortions(t, FLIP, true, out);
    fputs("; it still finds", out);
    list_distortions(t, FLIP, false, out);
    fputs(".", out);
}

static void defend(const table *t, FILE *out)
{
    const double noise = least_forgiving(t, "noise of 2 levels", DELTA);
    const pick line = {.scene = "a line is missing", .variant = DELTA, .setting = noise};
    const pick seen = {.scene = line.scene, .variant = FLIP, .setting = 0}, grain = {"noise of 2 levels", FLIP, 0};
    fprintf(
        out,
        "Octreel draws the same pixels everywhere, so its own frames need no tolerance. For frames of other programs: "
        "%g forgives noise of 2 levels, and still finds %.2f %% of all pixels where a line is missing. A mean hides "
        "what is small: the FLIP of the missing line is %.3g, and that of the noise %.3g. --flip is for differences "
        "all "
        "over the frame, such as another driver's antialiasing.",
        noise, 100 * table_sum(t, line, "found"), table_sum(t, seen, "flip"), table_sum(t, grain, "flip"));
}

const knob knob_diff = {
    .name = "diff",
    .title = "Tolerances of octreel diff: --max-delta, --antialias and --flip",
    .trades = "Differences that are forgiven for differences that are missed.",
    .preset = "no tolerance: one pixel that differs by one level is found",
    .proven = "Without a tolerance every pixel that differs counts.",
    .truth =
        "Distortions of known kinds: each changes the frame, and should be found unless it is meant to be forgiven.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
