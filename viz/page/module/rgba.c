/* SPDX-License-Identifier: MIT */
/* rgba.c - converts the pixels of a frame to the format of an HTML canvas.
 *
 * The conversion takes a large part of a frame's time. Each pixel is therefore written as one 32-bit word, and palette
 * indices are looked up in a table. Most of a picture is background, the index 0: eight such pixels need no look-up. */
#include "rgba.h"

#include <string.h>

static uint32_t rgba_word(image_color color)
{
    const uint8_t bytes[4] = {color.r, color.g, color.b, 255};
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

static void convert_indices(const image *frame, size_t pixels, uint32_t *rgba)
{
    enum { RUN = 8 };
    const uint8_t *from = frame->pixels;
    uint32_t words[256] = {0};
    for (int i = 0; i < frame->palette.count; i++)
        words[i] = rgba_word(frame->palette.colors[i]);
    const uint32_t ground = words[0];
    size_t at = 0;
    for (; at + RUN <= pixels; at += RUN) {
        uint64_t run;
        memcpy(&run, from + at, sizeof run);
        if (run == 0)
            for (int i = 0; i < RUN; i++)
                rgba[at + i] = ground;
        else
            for (int i = 0; i < RUN; i++)
                rgba[at + i] = words[from[at + i]];
    }
    for (; at < pixels; at++)
        rgba[at] = words[from[at]];
}

void rgba_convert(const image *frame, uint32_t *rgba)
{
    const size_t pixels = (size_t)frame->width * (size_t)frame->height;
    const uint8_t *from = frame->pixels;
    if (frame->channels == 1)
        convert_indices(frame, pixels, rgba);
    else
        for (size_t i = 0; i < pixels; i++, from += 3)
            rgba[i] = rgba_word((image_color){from[0], from[1], from[2]});
}
