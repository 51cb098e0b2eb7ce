/* antialias.h - pixels that differ because an edge was anti-aliased. Private to this folder. */
#ifndef OCTREEL_IMAGE_ANTIALIAS_H
#define OCTREEL_IMAGE_ANTIALIAS_H

#include "image.h"

/* Whether a pixel lies on an anti-aliased edge of either image. Both have the same size. Reads 5 x 5 pixels. */
bool antialias_explains(const image *a, const image *b, int x, int y);

#endif
