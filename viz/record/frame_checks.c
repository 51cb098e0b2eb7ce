/* SPDX-License-Identifier: MIT */
/* frame_checks.c - draws a few frames of a recording a second time, with GL, and compares the pixels. */
#include "frame_checks.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *frame_checks_title(draw_context by)
{
    return by == DRAW_EGL ? "EGL" : "OSMesa";
}

static size_t count_samples(const image *drawn)
{
    return (size_t)drawn->width * (size_t)drawn->height;
}

static uint64_t count_different_samples(const image *drawn, const uint8_t *by_gl)
{
    uint64_t count = 0;
    for (size_t i = 0; i < count_samples(drawn); i++)
        count += drawn->pixels[i] != by_gl[i];
    return count;
}

/* Write p->frame to a PNG file. The path of the file is `prefix`, a dot, `rasterizer` and ".png". */
static bool save_picture(const picture *p, const char *prefix, const char *rasterizer, octreel_error *error)
{
    const size_t size = strlen(prefix) + sizeof ".integers.png";
    char *path = malloc(size);
    if (!path)
        return error_no_memory(error);
    snprintf(path, size, "%s.%s.png", prefix, rasterizer);
    const bool kept = image_write_png(&p->frame, path, NULL, 0, error);
    free(path);
    return kept;
}

static bool save_both_pictures(picture *p, const scene *s, const uint8_t *by_gl, const char *prefix,
                               octreel_error *error)
{
    image *drawn = picture_samples(p);
    if (!save_picture(p, prefix, "integers", error))
        return false;
    memcpy(drawn->pixels, by_gl, count_samples(drawn));
    return picture_finish(p, s, error) && save_picture(p, prefix, "gl", error);
}

static bool compare_with_gl(frame_checks *checks, picture *p, const scene *s, const uint8_t *by_gl, const char *name,
                            const char *prefix, octreel_error *error)
{
    octreel_error unkept;
    const uint64_t different = count_different_samples(picture_samples(p), by_gl);
    const char *gl = frame_checks_title(checks->by);
    const char *differ = different == 1 ? " differs" : "s differ";
    checks->count += different == 0;
    if (different == 0)
        return true;
    if (!save_both_pictures(p, s, by_gl, prefix, &unkept))
        return error_set(error,
                         "%s: %" PRIu64 " sample%s between the integer rasterizer and %s; the two pictures "
                         "cannot be kept: %s",
                         name, different, differ, gl, unkept.text);
    return error_set(error,
                     "%s: %" PRIu64 " sample%s between the integer rasterizer and %s. Report this bug, and draw "
                     "with --fill gl meanwhile. Both pictures are kept: %s.integers.png and %s.gl.png",
                     name, different, differ, gl, prefix, prefix);
}

bool frame_checks_compare(frame_checks *checks, picture *p, const scene *s, const char *name, const char *prefix,
                          octreel_error *error)
{
    if (*checks->reason.text)
        return true;
    uint8_t *by_gl = malloc(count_samples(picture_samples(p)));
    if (!by_gl) {
        error_no_memory(&checks->reason);
        return true;
    }
    const bool same = !renderer_redraw_with_gl(p->renderer, by_gl, &checks->by, &checks->reason) ||
                      compare_with_gl(checks, p, s, by_gl, name, prefix, error);
    free(by_gl);
    return same;
}
