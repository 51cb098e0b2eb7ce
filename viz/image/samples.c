/* SPDX-License-Identifier: MIT */
/* samples.c - reads the pixels of an image as red, green and blue. */
#include "samples.h"

int common_sample_range(const image *a, const image *b)
{
    return a->wide || b->wide ? 65535 : 255;
}

void read_samples(const image *image, size_t n, int count, int range, pixel_samples *span)
{
    const uint16_t scale = range == 65535 ? 257 : 1;
    const uint8_t *at = image->pixels + n * image_pixel_size(image);
    uint16_t *samples = (uint16_t *)(void *)span;
    if (image->wide) {
        memcpy(span, at, (size_t)count * sizeof *span);
    } else if (image->channels == 3) {
        for (int i = 0; i < 3 * count; i++)
            samples[i] = (uint16_t)(scale * at[i]);
    } else {
        for (int i = 0; i < count; i++) {
            const image_color color = image->palette.colors[at[i]];
            span[i] = (pixel_samples){
                {(uint16_t)(color.r * scale), (uint16_t)(color.g * scale), (uint16_t)(color.b * scale)}};
        }
    }
}
