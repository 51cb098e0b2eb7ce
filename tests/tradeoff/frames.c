/* SPDX-License-Identifier: MIT */
/* frames.c - see frames.h. */
#include "frames.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "png_write.h"
#include "renderer.h"
#include "text.h"
#include "fixture.h"
#include "tick_scene.h"
#include "must.h"
#include "workload.h"

struct subject {
    octree *tree;
    octree_game *game;
};

subject *subject_make(const frame_kind *kind)
{
    enum { TICK = 219 };
    subject *s = resize_memory(NULL, sizeof *s);
    *s = (subject){0};
    if (kind->points > 0) {
        workload w = workload_sample(kind->name, OCTREE_SAMPLE_CLUSTERED, cube(-1000, 1000), kind->points, 1);
        s->tree = workload_tree(&w, 32, OCTREE_MAX_DEPTH);
        workload_free(&w);
        return s;
    }
    static octree_session session; /* a game borrows it */
    session = octree_session_default();
    must(octree_game_create(&session, &s->game));
    for (int tick = 0; tick < TICK; tick++)
        must(octree_game_advance(s->game));
    return s;
}

void subject_free(subject *s)
{
    octree_destroy(s->tree);
    if (s->game)
        octree_game_destroy(s->game);
    free(s);
}

const octree *subject_tree(const subject *s)
{
    return s->game ? octree_game_tree(s->game) : s->tree;
}

void subject_show(const subject *s, const view *v, scene *picture)
{
    const tree_subject bare = {.title = ""};
    const bool shown =
        s->game ? tick_scene_build(picture, v, s->game, NULL, NULL) : tree_scene_build(picture, v, s->tree, &bare);
    if (!shown)
        stop_with_error("there is no memory for a scene");
}

static image draw_samples(const scene *picture)
{
    const int samples = picture->view.aa;
    const int width = picture->view.width * samples, height = picture->view.height * samples;
    image drawn;
    octreel_error why;
    renderer *r = renderer_open(width, height, &(renderer_choice){0}, &why);
    if (!r)
        stop_with_error("%s", why.text);
    if (!image_create(&drawn, width, height, 1))
        stop_with_error("there is no memory for a picture of %d x %d pixels", width, height);
    if (!renderer_draw_scene(r, picture, drawn.pixels, &why))
        stop_with_error("%s", why.text);
    renderer_close(r);
    drawn.palette.count = THEME_COLORS;
    for (int i = 0; i < THEME_COLORS; i++) {
        const theme_color color = theme_color_at((uint8_t)i);
        drawn.palette.colors[i] = (image_color){color.r, color.g, color.b};
    }
    return drawn;
}

image draw_reference(const scene *picture)
{
    image drawn = draw_samples(picture), small;
    if (!image_create(&small, picture->view.width, picture->view.height, 3) ||
        !image_shrink(&drawn, NULL, REFERENCE_SAMPLES, &small))
        stop_with_error("there is no memory for a picture");
    image_release(&drawn);
    return small;
}

/* A part of a frame around its middle. */
static image crop(const image *frame, int width, int height)
{
    const size_t pixel = image_pixel_size(frame);
    image part;
    if (!image_create(&part, width, height, frame->channels))
        stop_with_error("there is no memory for a picture");
    part.palette = frame->palette;
    for (int y = 0; y < height; y++) {
        const int row = (frame->height - height) / 2 + y, column = (frame->width - width) / 2;
        memcpy(part.pixels + (size_t)y * (size_t)width * pixel,
               frame->pixels + ((size_t)row * (size_t)frame->width + (size_t)column) * pixel, (size_t)width * pixel);
    }
    return part;
}

/* A file in base64. The text must be freed. */
static char *read_base64(const char *path)
{
    char *text = NULL;
    size_t size;
    FILE *in = fopen(path, "rb"), *out = open_memstream(&text, &size);
    if (!in || !out)
        stop_with_error("%s cannot be read", path);
    base64_encode(in, out);
    fclose(in);
    fclose(out);
    return text;
}

void attach_picture(const run *r, table *t, const image *frame, int width, int height, const char *caption)
{
    char path[4200];
    octreel_error why;
    image part = crop(frame, width, height);
    snprintf(path, sizeof path, "%s/part.png", r->folder);
    if (!image_write_png(&part, path, NULL, 0, &why))
        stop_with_error("%s", why.text);
    char *text = read_base64(path);
    if (!t->pictures)
        t->pictures = json_array();
    json_array_append_new(t->pictures, json_pack("{s:s, s:s}", "caption", caption, "png", text));
    free(text);
    unlink(path);
    image_release(&part);
}

double peak_signal_to_noise(const image *a, const image *b)
{
    double sum = 0;
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            const image_color p = image_color_at(a, x, y), q = image_color_at(b, x, y);
            const double off[3] = {p.r - q.r, p.g - q.g, p.b - q.b};
            sum += off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
        }
    return 10 * log10(255.0 * 255.0 * 3 * a->width * a->height / sum);
}
