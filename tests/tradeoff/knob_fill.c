/* SPDX-License-Identifier: MIT */
/* knob_fill.c - which rasterizer draws: the integer rasterizer or OSMesa, OpenGL in software. */
#include <math.h>

#include "frames.h"
#include "image_compare.h"
#include "knob.h"
#include "picture.h"
#include "program.h"
#include "recording_file.h"
#include "timing.h"

static const column columns[] = {
    {"setting", "0 integers, 1 GL", NULL},
    {"ms", "processor milliseconds a frame of 1280 x 720: quads and pixels", NULL},
    {"differ", "pixels that differ from those of the integer rasterizer", "0"},
};

static const chart charts[] = {
    {.title = "Time of a frame", .x = "setting", .y = "ms", .y_log = true},
};

static const gain gains[] = {
    {"integers instead of OSMesa", {.variant = "gl", .setting = 1}, {.variant = "integers", .setting = 0}, "ms"},
};

typedef struct drawing {
    const scene *scene;
    picture picture;
} drawing;

static void draw(void *contestant)
{
    drawing *d = contestant;
    octreel_error why;
    if (!picture_draw(&d->picture, d->scene, &why))
        stop_with_error("%s", why.text);
}

/* False without GL, which is then not measured. */
static bool open_both(drawing drawings[2], const view *v, const scene *shown)
{
    const renderer_choice choices[] = {{.fill = DRAW_FILL_INTEGERS}, {.fill = DRAW_FILL_GL}};
    octreel_error why;
    for (int i = 0; i < 2; i++) {
        drawings[i].scene = shown;
        if (picture_open(&drawings[i].picture, v, &choices[i], &why)) {
            draw(&drawings[i]); /* the first frame is slower */
            continue;
        }
        fprintf(stderr, "octree-tradeoff: GL is not measured: %s\n", why.text);
        if (i > 0)
            picture_close(&drawings[0].picture);
        return false;
    }
    return true;
}

static void measure(const run *r, table *t)
{
    static const frame_kind kinds[] = {{"session", 0}, {"clusters-2000", 2000}, {"clusters-50000", 50000}};
    const view v = view_make_default();
    for (size_t i = 0; i < (r->quick ? 1 : sizeof kinds / sizeof kinds[0]); i++) {
        drawing drawings[2] = {{0}};
        double ns[2];
        scene shown = {0};
        subject *s = subject_make(&kinds[i]);
        subject_show(s, &v, &shown);
        if (open_both(drawings, &v, &shown)) {
            time_in_turn(draw, drawings, sizeof drawings[0], 2, r->rounds, ns);
            const double differ =
                (double)image_compare(&drawings[0].picture.frame, &drawings[1].picture.frame).unlike.pixels;
            table_add(t, kinds[i].name, "integers", (double[]){0, ns[0] / 1e6, 0});
            table_add(t, kinds[i].name, "gl", (double[]){1, ns[1] / 1e6, differ});
            if (i == 0)
                attach_picture(r, t, &drawings[0].picture.frame, 192, 108, "part of a frame, the same by both");
            picture_close(&drawings[0].picture);
            picture_close(&drawings[1].picture);
        }
        scene_release(&shown);
        subject_free(s);
    }
}

static void tell(const table *t, FILE *out)
{
    const pick integers = {.variant = "integers", .setting = 0}, gl = {.variant = "gl", .setting = 1};
    if (t->count == 0)
        fputs("GL is not installed, so nothing was compared.", out);
    else
        fprintf(
            out,
            "The integer rasterizer is the default: OSMesa takes %.1f times as long (median of the scenes), and %.0f "
            "pixels differ.",
            table_ratio(t, gl, integers, "ms"), table_sum(t, gl, "differ"));
}

static void defend(const table *t, FILE *out)
{
    (void)t;
    fputs("Integers draw the same pixels on every machine; record and inspect check some frames with GL.", out);
}

const knob knob_fill = {
    .name = "fill",
    .title = "The integer rasterizer, or OSMesa (--fill)",
    .trades = "Time of a frame, and whether OpenGL is needed; not the pixels.",
    .preset = "checked: integers, and some frames again with GL",
    .proven = "No pixel differs.",
    .truth = "The pixels of the other rasterizer.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .gains = gains,
    .gain_count = sizeof gains / sizeof gains[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
