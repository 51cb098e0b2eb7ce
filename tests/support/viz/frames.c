/* SPDX-License-Identifier: MIT */
/* frames.c - see frames.h. */
#include "frames.h"

#include <stdlib.h>
#include <string.h>

static renderer *open_chosen(const renderer_choice *choice, int width, int height)
{
    octreel_error error = {""};
    renderer *r = renderer_open(width, height, choice, &error);
    if (!r)
        fail_msg("%s", error.text);
    return r;
}

renderer *open_renderer(int width, int height)
{
    return open_chosen(&(renderer_choice){0}, width, height);
}

renderer *open_renderer_of(draw_context kind, int width, int height)
{
    return open_chosen(&(renderer_choice){.context = kind, .fill = DRAW_FILL_GL}, width, height);
}

renderer *open_gl_renderer(int width, int height)
{
    return open_renderer_of(DRAW_AUTO, width, height);
}

renderer *open_renderer_for(const scene *s)
{
    const int samples = s->view.aa;
    return open_renderer(s->view.width * samples, s->view.height * samples);
}

size_t frame_samples(const scene *s)
{
    const size_t samples = (size_t)s->view.aa;
    return (size_t)s->view.width * (size_t)s->view.height * samples * samples;
}

uint8_t *draw(renderer *r, const scene *s)
{
    octreel_error error = {""};
    uint8_t *frame = malloc(frame_samples(s));
    assert_non_null(frame);
    memset(frame, 255, frame_samples(s));
    if (!renderer_draw_scene(r, s, frame, &error))
        fail_msg("%s", error.text);
    for (size_t i = 0; i < frame_samples(s); i++)
        if (frame[i] >= THEME_COLORS && frame[i] != THEME_OWN)
            fail_msg("pixel %zu has the index %d of no role", i, frame[i]);
    return frame;
}

uint8_t *draw_once(const scene *s)
{
    renderer *r = open_renderer_for(s);
    uint8_t *frame = draw(r, s);
    renderer_close(r);
    return frame;
}

size_t lit_pixels(const uint8_t *frame, const scene *s)
{
    size_t count = 0;
    for (size_t i = 0; i < frame_samples(s); i++)
        count += frame[i] != 0;
    return count;
}

void assert_same_frame(const uint8_t *a, const uint8_t *b, const scene *s)
{
    assert_memory_equal(a, b, frame_samples(s));
}
