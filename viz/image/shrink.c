/* shrink.c - many samples become one pixel: a box filter in whole numbers, the same on every machine. */
#include "image.h"

/* One block of samples, whose first is at `at`. */
typedef struct block {
    const uint8_t *at;
    size_t row; /* samples from one row to the next */
    int side;
} block;

/* Most blocks are of one colour. */
static bool is_flat(const block *b)
{
    for (int y = 0; y < b->side; y++)
        for (int x = 0; x < b->side; x++)
            if (b->at[(size_t)y * b->row + (size_t)x] != *b->at)
                return false;
    return true;
}

static image_color mean_of(const block *b, const image_palette *palette)
{
    const unsigned count = (unsigned)(b->side * b->side);
    unsigned sums[3] = {count / 2, count / 2, count / 2}; /* to the nearest */
    for (int y = 0; y < b->side; y++) {
        for (int x = 0; x < b->side; x++) {
            const image_color *color = &palette->colors[b->at[(size_t)y * b->row + (size_t)x]];
            sums[0] += color->r;
            sums[1] += color->g;
            sums[2] += color->b;
        }
    }
    return (image_color){(uint8_t)(sums[0] / count), (uint8_t)(sums[1] / count), (uint8_t)(sums[2] / count)};
}

bool image_shrink(const image *from, int factor, image *small)
{
    if (factor < 1 || factor > 16 || from->channels != 1 || small->channels != 3 ||
        from->width != small->width * factor || from->height != small->height * factor)
        return false;
    block b = {.row = (size_t)from->width, .side = factor};
    uint8_t *out = small->pixels;
    for (int y = 0; y < small->height; y++) {
        b.at = from->pixels + (size_t)y * (size_t)factor * b.row;
        for (int x = 0; x < small->width; x++, b.at += factor, out += 3) {
            const image_color color = is_flat(&b) ? from->palette.colors[*b.at] : mean_of(&b, &from->palette);
            out[0] = color.r;
            out[1] = color.g;
            out[2] = color.b;
        }
    }
    return true;
}
