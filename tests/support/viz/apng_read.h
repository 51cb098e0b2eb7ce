/* SPDX-License-Identifier: MIT */
/* apng_read.h - decodes animated PNGs chunk by chunk, with zlib but without libpng or the code of viz/image. */
#ifndef APNG_READ_H
#define APNG_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One frame as a player shows it. */
typedef struct apng_frame {
    uint8_t *rgb;                 /* the pixels of the whole picture */
    unsigned shown, rate;         /* the frame's duration is shown / rate seconds */
    int left, top, width, height; /* the rectangle that is stored */
    bool over;                    /* transparent pixels leave the pixels of the frame before */
} apng_frame;

typedef struct apng_film {
    int width, height;
    int colors;     /* number of palette entries; 0: the file is RGB */
    unsigned plays; /* 0: the film repeats for ever */
    apng_frame *frames;
    size_t count;
} apng_film;

/* The test fails unless every chunk is whole, in its place and rightly numbered, and every pixel of every rectangle is
 * there. */
apng_film apng_read(const char *path);
void apng_release(apng_film *film);

#endif
