/* SPDX-License-Identifier: MIT */
/* naive.h - how one would film without giving it much thought: the yardstick of octreel-bench.
 *
 * The scene of a tick through OSMesa into its own buffer: twelve GL_LINES a box, a GL_POINT a marker, GL's own
 * matrices, text as the rectangles of its letters; then RGB through libpng with its defaults. It is not made slow on
 * purpose: vertices go as arrays, one call a kind, and nothing is computed that the picture does not need.
 */
#ifndef BENCH_NAIVE_H
#define BENCH_NAIVE_H

#include "scene.h"

typedef struct naive naive;

/* For pictures of this size; null, and a sentence, where there is no OSMesa. */
naive *naive_open(int width, int height, const char **why);
void naive_close(naive *n);

bool naive_draw(naive *n, const scene *s);
bool naive_write(const naive *n, const char *path);

#endif
