/* samples.h - pixels as samples, however an image stores them. Private to this folder. */
#ifndef OCTREEL_IMAGE_SAMPLES_H
#define OCTREEL_IMAGE_SAMPLES_H

#include "delta.h"
#include "image.h"

/* Colours are compared in spans of this many pixels, small enough for the stack and the first cache. */
#define SPAN 128

/* What samples of both images are out of: 255, or 65535 where one of them is wide. */
static inline int samples_range(const image *a, const image *b)
{
    return a->wide || b->wide ? 65535 : 255;
}

/* `count` pixels from the n-th on, as wide as the range. */
void samples_read(const image *image, size_t n, int count, int range, pixel_samples *span);

static inline bool samples_equal(const pixel_samples *a, const pixel_samples *b)
{
    return a->of[0] == b->of[0] && a->of[1] == b->of[1] && a->of[2] == b->of[2];
}

#endif
