/* SPDX-License-Identifier: MIT */
/* images.h - makes, writes and reads pictures for the tests of viz/image. */
#ifndef IMAGES_H
#define IMAGES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "image_compare.h"
#include "png_read.h"
#include "png_write.h"

/* An indexed picture and its RGB twin. */
typedef struct image_twins {
    image indexed; /* four colours, the last two of them equal */
    image rgb;
} image_twins;

image_twins make_twins(int width, int height);
void release_twins(image_twins *twins);

/* Write or read a file; the test fails with the error if that fails. */
void assert_written(const image *image, const char *path);
image assert_read(const char *path);

/* Read a file like assert_read(), and convert the picture to 8-bit RGB. */
image assert_read_rgb(const char *path);

/* An error must be one sentence: the path, then a reason that contains `reason`. */
void assert_sentence(const octreel_error *error, const char *path, const char *reason);

#endif
