#include "antialias.h"

#include <string.h>

/* Three equal neighbours make a patch; a pixel with as many is itself in one. */
#define PATCH 3

/* A pixel and its neighbours: the part of 3 x 3 that lies within the image. */
typedef struct window {
    int x, y;
    int left, right, top, bottom;
    int equal_outside; /* 1 at the border */
} window;

static window window_at(const image *image, int x, int y)
{
    window w = {.x = x, .y = y};
    w.left = x > 0 ? x - 1 : x;
    w.top = y > 0 ? y - 1 : y;
    w.right = x + 1 < image->width ? x + 1 : x;
    w.bottom = y + 1 < image->height ? y + 1 : y;
    w.equal_outside = w.left == x || w.right == x || w.top == y || w.bottom == y;
    return w;
}

/* Luma in 1e-8 of a level: whole numbers, so that equal means equal. */
static int64_t brightness(const image *image, int x, int y)
{
    const image_color color = image_color_at(image, x, y);
    return INT64_C(29889531) * color.r + INT64_C(58662247) * color.g + INT64_C(11448223) * color.b;
}

static bool in_patch(const image *image, int x, int y)
{
    const window w = window_at(image, x, y);
    const image_color own = image_color_at(image, x, y);
    int equal = w.equal_outside - 1; /* the pixel meets itself too */
    for (int j = w.top; j <= w.bottom; j++) {
        for (int i = w.left; i <= w.right; i++) {
            const image_color color = image_color_at(image, i, j);
            equal += memcmp(&color, &own, sizeof own) == 0;
        }
    }
    return equal >= PATCH;
}

/* A neighbour and by how much it is brighter. */
typedef struct neighbor {
    int x, y;
    int64_t brighter;
} neighbor;

/* The darkest and the brightest neighbour, of equals the first, column by column. False when there are not both, or
 * when too many are as bright as the pixel itself. */
static bool find_slope(const image *image, int x, int y, neighbor *darkest, neighbor *brightest)
{
    const window w = window_at(image, x, y);
    const int64_t own = brightness(image, x, y);
    int equal = w.equal_outside - 1;
    *darkest = *brightest = (neighbor){x, y, 0};
    for (int i = w.left; i <= w.right; i++) {
        for (int j = w.top; j <= w.bottom; j++) {
            const neighbor n = {i, j, brightness(image, i, j) - own};
            equal += n.brighter == 0;
            if (n.brighter < darkest->brighter)
                *darkest = n;
            if (n.brighter > brightest->brighter)
                *brightest = n;
        }
    }
    return equal < PATCH && darkest->brighter < 0 && brightest->brighter > 0;
}

static bool on_edge(const image *image, const struct image *other, int x, int y)
{
    neighbor darkest, brightest;
    return find_slope(image, x, y, &darkest, &brightest) &&
           ((in_patch(image, darkest.x, darkest.y) && in_patch(other, darkest.x, darkest.y)) ||
            (in_patch(image, brightest.x, brightest.y) && in_patch(other, brightest.x, brightest.y)));
}

bool antialias_explains(const image *a, const image *b, int x, int y)
{
    return on_edge(a, b, x, y) || on_edge(b, a, x, y);
}
