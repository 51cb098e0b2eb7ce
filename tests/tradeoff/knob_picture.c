/* SPDX-License-Identifier: MIT */
/* knob_picture.c - samples a pixel, and boxes too small to show: time for nearness to the picture that has all. */
#include <math.h>
#include <string.h>

#include "frames.h"
#include "knob.h"
#include "layer.h"
#include "paint.h"
#include "picture.h"
#include "timing.h"
#include "must.h"
#include "recording_file.h"

static const column columns[] = {
    {"setting", "--lod: boxes that appear smaller, in pixels, are left out under a drawn one", NULL},
    {"psnr", "decibels, against 16 x 16 samples a pixel with nothing left out", NULL},
    {"psnr_lod", "decibels, against the same samples with nothing left out; inf: the same picture", NULL},
    {"largest_left_out", "the largest box left out, or one without a drawn ancestor, in pixels", "bound_left_out"},
    {"bound_left_out", "proven: lod", NULL},
    {"left_out", "boxes left out", NULL},
    {"ms", "processor milliseconds a frame: scene, quads, pixels, mean of samples", NULL},
    {"quads", "primitives drawn", NULL},
    {"samples", "of a frame", NULL},
};

static const chart charts[] = {
    {.title = "Quality against time", .x = "ms", .y = "psnr", .x_log = true},
    {.title = "The largest box that is left out", .x = "setting", .y = "largest_left_out", .bound = "bound_left_out"},
};

static const gain gains[] = {
    {"one sample a pixel instead of --aa 2", {.variant = "aa2", .setting = 2}, {.variant = "aa1", .setting = 2}, "ms"},
    {"--lod instead of 0", {.variant = "aa1", .setting = 0}, {.variant = "aa1", .setting = NAN}, "ms"},
};

static const double lods[] = {0, 1, 2, 4, 8};
static const int samples[] = {1, 2, 4};
static const char *const names[] = {"aa1", "aa2", "aa4"};
enum { LODS = sizeof lods / sizeof lods[0], SAMPLES = sizeof samples / sizeof samples[0] };

/* Text is left out: it says how much is left out. */
static view view_with(int aa, double lod)
{
    view v = view_make_default();
    v.width = 640;
    v.height = 360;
    v.layers &= ~(1u << LAYER_TEXT);
    v.budget = 0;
    v.aa = aa;
    v.lod = lod;
    return v;
}

/* ---- What is left out, by another way than the scene's ------------------------------------------------------- */

typedef struct leaving_out {
    const scene *picture;
    octree_address *shown; /* sorted */
    size_t count, out;
    double largest;
} leaving_out;

static int by_address(const void *a, const void *b)
{
    const octree_address p = *(const octree_address *)a, q = *(const octree_address *)b;
    return (p > q) - (p < q);
}

static bool is_shown(const leaving_out *l, octree_address address)
{
    return bsearch(&address, l->shown, l->count, sizeof address, by_address) != NULL;
}

/* The longer side of the rectangle around a box's corners. */
static double pixels_of(const camera *c, const octree_box *box)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (unsigned corner = 0; corner < 8; corner++) {
        double at[3], seen[3], pixel[2];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = corner >> axis & 1 ? box->max[axis] : box->min[axis];
        camera_transform(c, at, seen);
        camera_project(c, seen, pixel);
        for (int i = 0; i < 2; i++) {
            low[i] = fmin(low[i], pixel[i]);
            high[i] = fmax(high[i], pixel[i]);
        }
    }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

static octree_walk_order look_at(const octree_node *node, void *context)
{
    leaving_out *l = context;
    if (is_shown(l, node->address))
        return OCTREE_WALK_ON;
    bool under_shown = false;
    for (octree_address up = node->address >> 3; up >= OCTREE_ROOT; up >>= 3)
        under_shown = under_shown || is_shown(l, up);
    l->out++;
    l->largest = fmax(l->largest, under_shown ? pixels_of(&l->picture->camera, &node->box) : INFINITY);
    return OCTREE_WALK_ON;
}

static leaving_out find_left_out(const scene *picture, const octree *tree)
{
    leaving_out l = {.picture = picture, .shown = resize_memory(NULL, picture->boxes.count * sizeof *l.shown)};
    for (size_t i = 0; i < picture->boxes.count; i++)
        if (picture->boxes.items[i].style.layer == LAYER_NODES)
            l.shown[l.count++] = picture->boxes.items[i].id;
    qsort(l.shown, l.count, sizeof *l.shown, by_address);
    must(octree_walk(tree, look_at, &l));
    free(l.shown);
    return l;
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

typedef struct drawing {
    const subject *subject;
    view view;
    picture picture;
    scene scene;
} drawing;

static void draw(void *contestant)
{
    drawing *d = contestant;
    octreel_error why;
    subject_show(d->subject, &d->view, &d->scene);
    if (!picture_draw(&d->picture, &d->scene, &why))
        stop_with_error("%s", why.text);
}

static size_t count_quads(const scene *picture)
{
    painter p = {0};
    if (!painter_paint_scene(&p, picture))
        stop_with_error("there is no memory for a frame");
    const size_t count = p.quads.count;
    painter_release(&p);
    return count;
}

static void add_row(table *t, const char *scene, const char *variant, const drawing *d, const drawing *whole,
                    const image *reference, double ns)
{
    const leaving_out l = find_left_out(&d->scene, subject_tree(d->subject));
    const double bound = d->view.lod, edge = nextafter(bound, 0); /* what is exactly as large is not left out */
    table_add(t, scene, variant,
              (double[]){bound, peak_signal_to_noise(&d->picture.frame, reference),
                         peak_signal_to_noise(&d->picture.frame, &whole->picture.frame), l.largest, edge, (double)l.out,
                         ns / 1e6, (double)count_quads(&d->scene),
                         (double)(d->view.width * d->view.height * d->view.aa * d->view.aa)});
}

static void measure_samples(const run *r, table *t, const char *name, const subject *s, const image *reference, int aa)
{
    drawing drawings[LODS];
    double ns[LODS];
    octreel_error why;
    for (int i = 0; i < LODS; i++) {
        drawings[i] = (drawing){.subject = s, .view = view_with(samples[aa], lods[i])};
        if (!picture_open(&drawings[i].picture, &drawings[i].view, &(renderer_choice){0}, &why))
            stop_with_error("%s", why.text);
        draw(&drawings[i]); /* the first frame is slower */
    }
    time_in_turn(draw, drawings, sizeof drawings[0], LODS, r->rounds, ns);
    for (int i = 0; i < LODS; i++)
        add_row(t, name, names[aa], &drawings[i], &drawings[0], reference, ns[i]);
    if (strcmp(name, "session") == 0)
        attach_picture(r, t, &drawings[2].picture.frame, 96, 54, names[aa]);
    else if (aa == 0 && strcmp(name, "clusters-50000") == 0) {
        attach_picture(r, t, &drawings[0].picture.frame, 96, 54, "--lod 0");
        attach_picture(r, t, &drawings[LODS - 1].picture.frame, 96, 54, "--lod 8");
    }
    for (int i = 0; i < LODS; i++) {
        picture_close(&drawings[i].picture);
        scene_release(&drawings[i].scene);
    }
}

static void measure(const run *r, table *t)
{
    static const frame_kind kinds[] = {{"session", 0}, {"clusters-2000", 2000}, {"clusters-50000", 50000}};
    for (size_t i = 0; i < (r->quick ? 1 : sizeof kinds / sizeof kinds[0]); i++) {
        subject *s = subject_make(&kinds[i]);
        const view v = view_with(REFERENCE_SAMPLES, 0);
        scene whole = {0};
        subject_show(s, &v, &whole);
        image reference = draw_reference(&whole);
        for (int aa = 0; aa < SAMPLES; aa++)
            measure_samples(r, t, kinds[i].name, s, &reference, aa);
        image_release(&reference);
        scene_release(&whole);
        subject_free(s);
    }
}

/* The picture that is least like the one with nothing left out, in decibels. */
static double least_psnr_lod(const table *t, double lod)
{
    double least = INFINITY;
    for (size_t i = 0; i < t->count; i++)
        if (t->rows[i].values[0] == lod)
            least = fmin(least, table_value(t, &t->rows[i], "psnr_lod"));
    return least;
}

static void tell_lod(const table *t, double lod, FILE *out)
{
    const ratio faster =
        table_ratios(t, (pick){.variant = "aa1", .setting = 0}, (pick){.variant = "aa1", .setting = lod}, "ms");
    const double psnr = least_psnr_lod(t, lod);
    fprintf(out, "%g saves up to %.0f %% of the time and ", lod, 100 * (1 - 1 / faster.most));
    if (isinf(psnr))
        fputs("no pixel differs", out);
    else
        fprintf(out, "the picture differs by %.0f dB at worst", psnr);
    fprintf(out, " (largest box left out %.2f pixels, proven %g)",
            table_most(t, (pick){.variant = "aa1", .setting = lod}, "largest_left_out"), lod);
}

static void tell(const table *t, FILE *out)
{
    const pick one = {.variant = "aa1", .setting = 2};
    fputs("One sample a pixel is the default", out);
    for (int aa = 0; aa < SAMPLES; aa++) {
        const pick p = {.variant = names[aa], .setting = 2};
        fprintf(out, "%s %.1f dB",
                aa == 0   ? " and comes to"
                : aa == 1 ? "; --aa 2 comes to"
                          : ", --aa 4 to",
                table_sum(t, p, "psnr") / (double)table_count(t, p));
        if (aa > 0)
            fprintf(out, " for %.1f x the time", table_ratio(t, p, one, "ms"));
    }
    fputs(". --lod 2 is the default: against 0, ", out);
    tell_lod(t, 2, out);
    fputs("; ", out);
    tell_lod(t, 4, out);
    fputs("; ", out);
    tell_lod(t, 8, out);
    fputc('.', out);
}

/* The largest --lod with which no pixel of any scene differs. */
static double largest_lossless(const table *t)
{
    double largest = 0;
    for (int i = 0; i < LODS; i++)
        if (isinf(least_psnr_lod(t, lods[i])))
            largest = fmax(largest, lods[i]);
    return largest;
}

static void defend(const table *t, FILE *out)
{
    const double lod = 2, lossless = largest_lossless(t);
    const pick one = {.variant = "aa1", .setting = lod}, two = {.variant = "aa2", .setting = lod};
    const ratio more = table_ratios(t, one, (pick){.variant = "aa1", .setting = 2 * lod}, "ms");
    fprintf(
        out,
        "--aa 1 is kept: --aa 2 takes %.1f x the time, and has too many colours for a palette. --lod %g is %s: %g is "
        "the "
        "largest with which no pixel differs; twice as much saves %.0f %% more (median of the scenes; up to %.0f %%).",
        table_ratio(t, two, one, "ms"), lod, lossless == lod ? "kept" : "not the best", lossless,
        100 * (1 - 1 / more.median), 100 * (1 - 1 / more.most));
}

const knob knob_picture = {
    .name = "picture",
    .title = "Samples a pixel (--aa), and boxes too small to show (--lod)",
    .trades = "Time of a frame for nearness to the picture with nothing left out and every edge smooth.",
    .preset = "--aa 1, --lod 2",
    .proven =
        "No box of lod pixels or more is left out, and none without a drawn one around it. For samples nothing is "
        "proven: the reference says what they are worth.",
    .truth = "The same tick at 640 x 360 with 16 x 16 samples a pixel and lod 0, without text; the size of boxes from "
             "their eight corners.",
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
