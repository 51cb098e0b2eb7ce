/* SPDX-License-Identifier: MIT */
/* picture.c - draws scenes into an image. */
#include "picture.h"
#include "filter.h"
#include "camera.h"
#include "octree/octree.h"
#include "point_scale.h"

_Static_assert(VIEW_MAX_SIDE <= IMAGE_MAX_SIDE,
               "each picture that can be drawn can also be saved as a PNG and read back");

static image_palette theme_palette(void)
{
    image_palette palette = {.count = THEME_COLORS};
    for (int i = 0; i < THEME_COLORS; i++) {
        const theme_color color = theme_color_at((uint8_t)i);
        palette.colors[i] = (image_color){color.r, color.g, color.b};
    }
    return palette;
}

bool picture_fit_view(view *v, const octree *tree, const point_values *values, octreel_error *error)
{
    char reason[FILTER_TEXT];
    const octree_def def = octree_definition(tree);
    camera_fit_points(v, tree);
    if (!point_scale_compute(v, tree, values))
        return error_no_memory(error);
    return !filter_find_problem(&v->filter, &def, reason) || error_set(error, "%s", reason);
}

static bool check_samples(const view *v, octreel_error *error)
{
    const int samples = v->aa;
    if (samples != 1 && samples != 2 && samples != 4)
        return error_set(error, "anti-aliasing must be 1, 2 or 4, not %d", samples);
    if (samples == 1 || (v->width <= VIEW_MAX_SIDE / samples && v->height <= VIEW_MAX_SIDE / samples))
        return true;
    return error_set(
        error,
        "a picture of %d x %d pixels is too large for %d x %d samples per pixel: width and height must each "
        "be 1 to %d pixels",
        v->width, v->height, samples, samples, VIEW_MAX_SIDE / samples);
}

static bool create_images(picture *p, const view *v)
{
    const int samples = v->aa;
    const bool rgb = view_is_rgb(v);
    image *drawn = rgb ? &p->samples : &p->frame;
    if (!image_create(drawn, v->width * samples, v->height * samples, 1) ||
        (rgb && !image_create(&p->frame, v->width, v->height, 3)))
        return false;
    drawn->palette = theme_palette();
    return true;
}

bool picture_open(picture *p, const view *v, const renderer_choice *choice, octreel_error *error)
{
    *p = (picture){0};
    if (!check_samples(v, error))
        return false;
    p->renderer = renderer_open(v->width * v->aa, v->height * v->aa, choice, error);
    if (!p->renderer)
        return false;
    if (create_images(p, v))
        return true;
    picture_close(p);
    return error_no_memory(error);
}

void picture_close(picture *p)
{
    renderer_close(p->renderer);
    image_release(&p->frame);
    image_release(&p->samples);
    p->renderer = NULL;
}

image *picture_samples(picture *p)
{
    return p->samples.pixels ? &p->samples : &p->frame;
}

bool picture_finish(picture *p, const scene *s, octreel_error *error)
{
    return !p->samples.pixels ||
           image_shrink(&p->samples, renderer_sample_colors(p->renderer), s->view.aa, &p->frame) ||
           error_set(error, "the scene and the picture have different anti-aliasing");
}

bool picture_draw(picture *p, const scene *s, octreel_error *error)
{
    return renderer_draw_scene(p->renderer, s, picture_samples(p)->pixels, error) && picture_finish(p, s, error);
}
