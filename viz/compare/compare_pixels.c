/* SPDX-License-Identifier: MIT */
/* compare_pixels.c - turns the pixels of a caller into an image: directly, or by a copy that is made row by row. */
#include "compare_pixels.h"
#include "image_blend.h"

#include <stdlib.h>

/* How a format stores a pixel. `place[i]` is the index of the sample that is the i-th of r, g, b, alpha. */
typedef struct layout {
    int samples; /* per pixel: 1, 3 or 4 */
    bool wide;   /* true: samples have 16 bits */
    uint8_t place[4];
} layout;

static const layout layouts[OCTREEL_PIXEL_FORMATS] = {
    [OCTREEL_GREY8] = {1, false, {0, 0, 0, 0}}, [OCTREEL_RGB8] = {3, false, {0, 1, 2, 0}},
    [OCTREEL_RGBA8] = {4, false, {0, 1, 2, 3}}, [OCTREEL_BGRA8] = {4, false, {2, 1, 0, 3}},
    [OCTREEL_RGB16] = {3, true, {0, 1, 2, 0}},  [OCTREEL_RGBA16] = {4, true, {0, 1, 2, 3}},
};

static size_t find_row_size(const layout *l, int width)
{
    return (size_t)width * (size_t)l->samples * (l->wide ? 2 : 1);
}

static bool check_pixels(const octreel_pixels *p, const char *which, octreel_error *error)
{
    if (!p || !p->data)
        return error_set(error, "%s: the pointer to the pixels is null; pass the first byte of the picture", which);
    if (p->width < 1 || p->height < 1 || p->width > IMAGE_MAX_SIDE || p->height > IMAGE_MAX_SIDE)
        return error_set(error, "%s: the size is %dx%d; each side must be from 1 to %d pixels", which, p->width,
                         p->height, IMAGE_MAX_SIDE);
    if ((unsigned)p->format >= OCTREEL_PIXEL_FORMATS)
        return error_set(error, "%s: %d is not a pixel format; use a value such as OCTREEL_RGBA8", which,
                         (int)p->format);
    const size_t row = find_row_size(&layouts[p->format], p->width);
    return p->stride == 0 || p->stride >= row ||
           error_set(error,
                     "%s: the stride is %zu bytes, but a row of pixels has %zu; use 0 if no bytes lie between the rows",
                     which, p->stride, row);
}

/* Copy a row. Samples are put into the order r, g, b, alpha; only OCTREEL_BGRA8 has another. */
static void copy_row(const layout *l, const uint8_t *from, uint8_t *to, int width)
{
    memcpy(to, from, find_row_size(l, width));
    if (l->place[0] == 0)
        return;
    for (int x = 0; x < width; x++, from += 4, to += 4) {
        to[0] = from[l->place[0]];
        to[2] = from[l->place[2]];
    }
}

/* Copy the rows into image->pixels, which has room for them, blended with the background. */
static void convert_rows(const octreel_pixels *p, image_color background, image *image, uint8_t *row)
{
    const layout *l = &layouts[p->format];
    const size_t tight = find_row_size(l, p->width), stride = p->stride ? p->stride : tight;
    const size_t size = (size_t)p->width * image_pixel_size(image);
    for (int y = 0; y < p->height; y++) {
        const int at = p->bottom_up ? p->height - 1 - y : y;
        copy_row(l, (const uint8_t *)p->data + (size_t)at * stride, row, p->width);
        if (l->samples == 4)
            (l->wide ? image_blend_wide_pixels : image_blend_pixels)(row, (size_t)p->width, background);
        memcpy(image->pixels + (size_t)y * size, row, size);
    }
    image_narrow_if_exact(image);
}

static bool has_image_layout(const octreel_pixels *p)
{
    const layout *l = &layouts[p->format];
    return l->samples != 4 && !l->wide && !p->bottom_up && (p->stride == 0 || p->stride == find_row_size(l, p->width));
}

static image_palette make_grey_palette(void)
{
    image_palette palette = {.count = 256};
    for (int i = 0; i < 256; i++)
        palette.colors[i] = (image_color){(uint8_t)i, (uint8_t)i, (uint8_t)i};
    return palette;
}

bool pixels_to_image(const octreel_pixels *p, const char *which, image_color background, image *image, uint8_t **owned,
                     octreel_error *error)
{
    *owned = NULL;
    memset(image, 0, sizeof *image);
    if (!check_pixels(p, which, error))
        return false;
    const layout *l = &layouts[p->format];
    image->width = p->width;
    image->height = p->height;
    image->channels = l->samples == 1 ? 1 : 3;
    image->wide = l->wide;
    if (l->samples == 1)
        image->palette = make_grey_palette();
    image->pixels = (uint8_t *)p->data; /* only read */
    if (has_image_layout(p))
        return true;
    uint8_t *row = malloc(find_row_size(l, p->width));
    image->pixels = *owned = malloc((size_t)p->width * (size_t)p->height * image_pixel_size(image));
    const bool ok = row && *owned;
    if (ok)
        convert_rows(p, background, image, row);
    free(row);
    return ok || error_no_memory(error);
}
