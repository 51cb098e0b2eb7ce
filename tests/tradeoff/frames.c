/* SPDX-License-Identifier: MIT */
/* frames.c - see frames.h. */
#include "frames.h"

#include <math.h>

#include "renderer.h"
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
