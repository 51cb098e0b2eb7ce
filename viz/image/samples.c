/* samples.c - see samples.h. */
#include "image_compare.h"

#include <string.h>

void samples_read(const image *image, size_t n, int count, int range, pixel_samples *span)
{
    const size_t step = image_pixel_size(image);
    const unsigned scale = range == 65535 ? 257 : 1;
    const uint8_t *at = image->pixels + n * step;
    if (image->wide) {
        memcpy(span, at, (size_t)count * sizeof *span);
        return;
    }
    for (int i = 0; i < count; i++, at += step) {
        const image_color color =
            image->channels == 1 ? image->palette.colors[*at] : (image_color){at[0], at[1], at[2]};
        span[i] =
            (pixel_samples){{(uint16_t)(color.r * scale), (uint16_t)(color.g * scale), (uint16_t)(color.b * scale)}};
    }
}
