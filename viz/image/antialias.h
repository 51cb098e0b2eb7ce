/* antialias.h - pixels that differ because an edge was anti-aliased. For this folder.
 *
 * After V. Vysniauskas, "Anti-aliased Pixel and Intensity Slope Detector", 2009, as pixelmatch and odiff do it: such a
 * pixel has both a darker and a brighter neighbour, at most two as bright as itself, and its darkest or its brightest
 * neighbour lies, in both images, in a patch of one colour: three of that one's neighbours are its equals. What lies
 * beyond the picture's border counts as one equal neighbour.
 */
#ifndef IMAGE_ANTIALIAS_H
#define IMAGE_ANTIALIAS_H

#include "image.h"

/* Whether a pixel lies on an anti-aliased edge of either image. Both have the same size. Reads 5 x 5 pixels. */
bool antialias_explains(const image *a, const image *b, int x, int y);

#endif
