/* SPDX-License-Identifier: MIT */
/* mask.c - converts masks between bytes and run lengths. */
#include "mask.h"
#include "array.h"

#include <stdlib.h>
#include <string.h>

static bool pack_mask(pixel_mask *mask, const uint8_t *bytes)
{
    const size_t size = (size_t)mask->width * (size_t)mask->height;
    size_t room = 0;
    mask->count = 0;
    free(mask->runs);
    mask->runs = NULL;
    for (size_t i = 0; i < size; mask->count++) {
        const size_t first = i;
        if (!array_grow(&mask->runs, mask->count + 1, &room, sizeof *mask->runs))
            return false;
        while (i < size && (bytes[i] != 0) == (mask->count % 2 != 0))
            i++;
        mask->runs[mask->count] = (uint32_t)(i - first);
    }
    return true;
}

bool mask_add(pixel_mask *mask, const uint8_t *bytes, int width, int height)
{
    const size_t size = (size_t)width * (size_t)height;
    if (!mask->runs) {
        mask->width = width;
        mask->height = height;
        return pack_mask(mask, bytes);
    }
    if (mask->width != width || mask->height != height)
        return true;
    uint8_t *both = mask_unpack(mask);
    for (size_t i = 0; both && i < size; i++)
        both[i] |= bytes[i];
    const bool ok = both && pack_mask(mask, both);
    free(both);
    return ok;
}

void mask_release(pixel_mask *mask)
{
    free(mask->runs);
    *mask = (pixel_mask){0};
}

uint8_t *mask_unpack(const pixel_mask *mask)
{
    uint8_t *bytes = mask->runs ? malloc((size_t)mask->width * (size_t)mask->height) : NULL;
    size_t at = 0;
    for (size_t i = 0; bytes && i < mask->count; at += mask->runs[i++])
        memset(bytes + at, i % 2 ? 1 : 0, mask->runs[i]);
    return bytes;
}
