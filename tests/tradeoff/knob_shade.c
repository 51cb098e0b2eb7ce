/* SPDX-License-Identifier: MIT */
/* knob_shade.c - how dense clouds are shown: time for light that tells depth, and for leaves that can be seen. */
#include <math.h>
#include <string.h>

#include "image.h"
#include "frames.h"
#include "knob.h"
#include "layer.h"
#include "must.h"
#include "picture.h"
#include "point_scale.h"
#include "fixture.h"
#include "tick_scene.h"
#include "timing.h"
#include "recording_file.h"

static const column columns[] = {
    {"setting", "points are moved at random by up to so many pixels: `depth` away or nearer, `place` across", NULL},
    {"worst_levels", "the most that a pixel differs by then, of 255 levels of white points", "bound_levels"},
    {"bound_levels", "proven for `depth`: by the slopes that so much changes around a pixel", NULL},
    {"mean_levels", "the mean over pixels", NULL},
    {"ms", "processor milliseconds a frame: scene, quads, pixels", NULL},
    {"seen", "neighbouring pixels of different leaves whose colours differ by 24 levels or more: of all such, %", NULL},
    {"false", "neighbouring pixels of one leaf whose colours differ so: of all such, %", NULL},
};

static const chart charts[] = {
    {.title = "Change of a pixel", .x = "setting", .y = "worst_levels", .bound = "bound_levels", .x_log = true},
    {.title = "Edges of leaves that are seen", .x = "ms", .y = "seen"},
};

static const gain gains[] = {
    {"bands instead of eye-dome lighting", {.variant = "edl", .setting = 0}, {.variant = "bands", .setting = 0}, "ms"},
};

enum { VISIBLE = 24 };

static const double errors[] = {0.125, 0.25, 0.5, 1, 2};
enum { ERRORS = sizeof errors / sizeof errors[0] };

/* What a cloud may be shown by. The first ones are lit or not, the others are for leaves. */
static const struct way {
    const char *name;
    view_point_color color;
    view_shade shade;
    bool boxes; /* of leaves, in place of points */
} ways[] = {
    {"none", POINTS_BY_FILE, SHADE_NONE, false},    {"bands", POINTS_BY_FILE, SHADE_BANDS, false},
    {"edl", POINTS_BY_FILE, SHADE_EDL, false},      {"plain", POINTS_BY_PLAIN, SHADE_BANDS, false},
    {"height", POINTS_BY_HEIGHT, SHADE_EDL, false}, {"leaf", POINTS_BY_LEAF, SHADE_EDL, false},
    {"boxes", POINTS_BY_PLAIN, SHADE_BANDS, true},
};
enum { NONE, BANDS, EDL, WAYS = sizeof ways / sizeof ways[0] };

typedef struct showing {
    workload *cloud;
    octree *tree;
    view view;
    picture picture;
    scene scene;
} showing;

static view view_by(const struct way *way, int height)
{
    view v = view_make_default();
    v.width = height * 16 / 9;
    v.height = height;
    v.camera = CAMERA_TOP;
    v.layers = 1u << (way->boxes ? LAYER_NODES : LAYER_POINTS);
    v.coloring = COLORING_OCCUPANCY;
    v.filter.leaves = way->boxes;
    v.point_color = way->color;
    v.shade = way->shade;
    v.budget = 0;
    return v;
}

static void draw(void *contestant)
{
    showing *s = contestant;
    const tree_subject bare = {.title = ""};
    octreel_error why;
    if (!tree_scene_build(&s->scene, &s->view, s->tree, &bare))
        stop_with_error("there is no memory for a scene");
    if (!picture_draw(&s->picture, &s->scene, &why))
        stop_with_error("%s", why.text);
}

static showing show(workload *cloud, octree *tree, const struct way *way, int height)
{
    showing s = {.cloud = cloud, .tree = tree, .view = view_by(way, height)};
    octreel_error why;
    if (!picture_fit_view(&s.view, tree, NULL, &why) || !picture_open(&s.picture, &s.view, &(renderer_choice){0}, &why))
        stop_with_error("%s", why.text);
    draw(&s);
    return s;
}

static void close_showing(showing *s)
{
    picture_close(&s->picture);
    scene_release(&s->scene);
}

static int unlikeness(image_color a, image_color b)
{
    const int r = abs(a.r - b.r), g = abs(a.g - b.g), blue = abs(a.b - b.b);
    return r > g ? (r > blue ? r : blue) : g > blue ? g : blue;
}

/* ---- What an error of depth or place costs -------------------------------------------------------------------- */

/* Of depths in eighths of a pixel that are off by up to `d` each: the slopes of four pairs change by up to 4 d each, at
 * each of two distances, of which one counts a quarter. Whole numbers are rounded twice. */
static double levels_at_most(double pixels)
{
    const theme_color white = theme_color_at(theme_color_index(ROLE_POINT, 0)), ground = theme_color_at(0);
    const double d = ceil(8 * pixels), slopes = 16 * d + 4 * d + 1;
    const double light = 256 - 256 * 160 / (160 + slopes) + 1;
    return fmax(white.r - ground.r, fmax(white.g - ground.g, white.b - ground.b)) * light / 256 + 1;
}

/* Draw the cloud with each point moved by up to `pixels` along an axis. */
static void move_points(showing *moved, const octree_point *points, double pixels, int axis)
{
    uint64_t seed = 7;
    const double length = pixels / point_scale_length_in_pixels(&moved->scene.camera, 1);
    for (size_t i = 0; i < moved->cloud->count; i++)
        moved->cloud->points[i].position[axis] =
            points[i].position[axis] + length * ((double)random_below(&seed, 1999) / 1000 - 0.999);
    octree_destroy(moved->tree);
    moved->tree = workload_tree(moved->cloud, 64, OCTREE_MAX_DEPTH);
    draw(moved);
}

static void add_error(table *t, const char *name, const char *variant, const image *before, const image *after,
                      double pixels, double bound)
{
    int worst = 0;
    double sum = 0;
    for (int y = 0; y < before->height; y++)
        for (int x = 0; x < before->width; x++) {
            const int off = unlikeness(image_color_at(before, x, y), image_color_at(after, x, y));
            worst = off > worst ? off : worst;
            sum += off;
        }
    table_add(t, name, variant, (double[]){pixels, worst, bound, sum / before->width / before->height, NAN, NAN, NAN});
}

static void measure_errors(table *t, const char *name, const showing *still)
{
    showing moved =
        show(still->cloud, workload_tree(still->cloud, 64, OCTREE_MAX_DEPTH), &ways[EDL], still->view.height);
    octree_point *points = resize_memory(NULL, still->cloud->count * sizeof *points);
    memcpy(points, still->cloud->points, still->cloud->count * sizeof *points);
    moved.view = still->view; /* the scale of the points as they were */
    for (int i = 0; i < ERRORS; i++) {
        move_points(&moved, points, errors[i], 2);
        add_error(t, name, "depth", &still->picture.frame, &moved.picture.frame, errors[i], levels_at_most(errors[i]));
        memcpy(still->cloud->points, points, still->cloud->count * sizeof *points);
        move_points(&moved, points, errors[i], 0);
        add_error(t, name, "place", &still->picture.frame, &moved.picture.frame, errors[i], NAN);
        memcpy(still->cloud->points, points, still->cloud->count * sizeof *points);
    }
    octree_destroy(moved.tree);
    close_showing(&moved);
    free(points);
}

/* ---- What is seen of leaves ----------------------------------------------------------------------------------- */

typedef struct pixel_owner {
    double height;
    octree_address leaf; /* 0: no point */
} pixel_owner;

/* The leaf of the highest point of each pixel, by another way than draw's. */
static pixel_owner *find_owners(const showing *s)
{
    const int width = s->view.width, height = s->view.height;
    pixel_owner *owners = resize_memory(NULL, (size_t)width * (size_t)height * sizeof *owners);
    memset(owners, 0, (size_t)width * (size_t)height * sizeof *owners);
    for (size_t i = 0; i < s->cloud->count; i++) {
        const double *at = s->cloud->points[i].position;
        double seen[3], pixel[2];
        octree_node leaf;
        camera_transform(&s->scene.camera, at, seen);
        camera_project(&s->scene.camera, seen, pixel);
        if (!(pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < width && pixel[1] < height))
            continue;
        pixel_owner *owner = &owners[(size_t)pixel[1] * (size_t)width + (size_t)pixel[0]];
        if (owner->leaf && owner->height >= at[2])
            continue;
        must(octree_locate(s->tree, at, &leaf));
        *owner = (pixel_owner){at[2], leaf.address};
    }
    return owners;
}

/* The parts of pairs of pixels beside each other that look unlike: [0] those of one leaf, [1] of two. */
static void look_for_leaves(const showing *s, const pixel_owner *owners, double parts[2])
{
    double pairs[2] = {0, 0}, unlike[2] = {0, 0};
    const image *frame = &s->picture.frame;
    for (int y = 0; y < frame->height; y++)
        for (int x = 0; x + 1 < frame->width; x++) {
            const pixel_owner *a = &owners[(size_t)y * (size_t)frame->width + (size_t)x], *b = a + 1;
            if (a->leaf == 0 || b->leaf == 0)
                continue;
            const bool two = a->leaf != b->leaf;
            pairs[two]++;
            unlike[two] += unlikeness(image_color_at(frame, x, y), image_color_at(frame, x + 1, y)) >= VISIBLE;
        }
    for (int two = 0; two < 2; two++)
        parts[two] = pairs[two] > 0 ? 100 * unlike[two] / pairs[two] : NAN;
}

/* ---- Both ----------------------------------------------------------------------------------------------------- */

static void measure_cloud(const run *r, table *t, const char *name, size_t points, int height)
{
    workload cloud = workload_sample(name, OCTREE_SAMPLE_SURFACE,
                                     (octree_box){{-1000, -1000, -1000}, {1000, 1000, 1000}}, points, 1);
    octree *tree = workload_tree(&cloud, 64, OCTREE_MAX_DEPTH);
    showing all[WAYS];
    double ns[WAYS];
    for (int i = 0; i < WAYS; i++)
        all[i] = show(&cloud, tree, &ways[i], height);
    time_in_turn(draw, all, sizeof all[0], WAYS, r->rounds, ns);
    pixel_owner *owners = find_owners(&all[0]);
    for (int i = 0; i < WAYS; i++) {
        double parts[2];
        look_for_leaves(&all[i], owners, parts);
        table_add(t, name, ways[i].name, (double[]){0, NAN, NAN, NAN, ns[i] / 1e6, parts[1], parts[0]});
    }
    for (int i = 0; i < WAYS; i++)
        if (height > 90 && strcmp(name, "sparse") != 0 && (i == EDL || i < 2))
            attach_picture(r, t, &all[i].picture.frame, 96, 54, ways[i].name);
    free(owners);
    measure_errors(t, name, &all[EDL]);
    for (int i = 0; i < WAYS; i++)
        close_showing(&all[i]);
    octree_destroy(tree);
    workload_free(&cloud);
}

static void measure(const run *r, table *t)
{
    if (r->quick) {
        measure_cloud(r, t, "sparse", 2000, 90);
        return;
    }
    measure_cloud(r, t, "sparse", 20000, 360);
    measure_cloud(r, t, "dense", 1000000, 360);
}

static pick still(const table *t, const char *variant)
{
    return (pick){.scene = t->rows[t->count - 1].scene, .variant = variant, .setting = 0};
}

static void tell(const table *t, FILE *out)
{
    const pick quarter = {.variant = "depth", .setting = 0.25}, place = {.variant = "place", .setting = 0.25};
    fprintf(out,
            "Eye-dome lighting takes %.2f x the time of bands. Depths that are off by a quarter of a pixel change a "
            "pixel by %.1f levels of 255 on average and %.0f at worst (proven: %.0f), places by %.1f on average.",
            table_ratio(t, (pick){.variant = "edl", .setting = 0}, (pick){.variant = "bands", .setting = 0}, "ms"),
            table_sum(t, quarter, "mean_levels") / (double)table_count(t, quarter),
            table_most(t, quarter, "worst_levels"), table_most(t, quarter, "bound_levels"),
            table_sum(t, place, "mean_levels") / (double)table_count(t, place));
}

static void defend(const table *t, FILE *out)
{
    fprintf(out, "Of the densest cloud's boundaries of leaves");
    for (int i = EDL + 1; i < WAYS; i++)
        fprintf(out, "%s %s shows %.0f %% (and %.0f %% where there is none) in %.0f ms", i > EDL + 1 ? "," : "",
                ways[i].name, table_most(t, still(t, ways[i].name), "seen"),
                table_most(t, still(t, ways[i].name), "false"), table_most(t, still(t, ways[i].name), "ms"));
    fputs(".", out);
}

const knob knob_shade = {
    .name = "shade",
    .title = "Light and colours of dense clouds (--shade, --color-points)",
    .trades = "Time of a frame for light that tells depth, and for boundaries of leaves that can be seen.",
    .preset = "inspect: --shade edl where points close surfaces, --color-points leaf where they outnumber pixels",
    .proven = "Where depths are off by up to e pixels, light changes by no more than slopes that differ by 160 e + 1 "
              "eighths of a pixel: nothing is proven for places, which change what is nearest.",
    .truth = "The same cloud, an ellipsoid from above, with its points where they are; the leaf of the highest point "
             "of each pixel.",
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
