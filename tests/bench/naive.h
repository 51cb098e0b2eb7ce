/* SPDX-License-Identifier: MIT */
/* naive.h - the renderer that a programmer would write first: the yardstick of octreel-bench.
 *
 * It draws the scene of a tick through OSMesa into its own buffer, with twelve GL_LINES for each box, a GL_POINT for
 * each marker, GL's own matrices, and text as the rectangles of its letters; then it writes RGB through libpng with
 * default settings. It is not made slow on purpose: vertices are passed as arrays, one call for each kind, and nothing
 * is computed that the picture does not need. */
#ifndef BENCH_NAIVE_H
#define BENCH_NAIVE_H

#include "scene.h"

typedef struct naive naive;

/* Open a renderer for pictures of this size. Null, with a reason, if there is no OSMesa. */
naive *naive_open(int width, int height, const char **why);
void naive_close(naive *n);

bool naive_draw(naive *n, const scene *s);
bool naive_write(const naive *n, const char *path);

#endif
