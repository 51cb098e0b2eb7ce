/* SPDX-License-Identifier: MIT */
/* image_digest.h - one number for the size and the colours of a picture. */
#ifndef IMAGE_IMAGE_DIGEST_H
#define IMAGE_IMAGE_DIGEST_H

#include "image.h"

/* A digest of size and colours (not of how they are stored): equal for an indexed image and its RGB twin. */
uint64_t image_digest(const image *image);

/* The same of a PNG as image_read_png_over() reads it, row by row. `about` is the image without pixels. */
bool image_digest_png(const char *path, image_color background, image *about, uint64_t *digest, octreel_error *error);

/* The ways in which digests were ever made, the newest last, and the name of each in files that hold digests of several
 * kinds: what was accepted by an old kind is compared by that kind. */
#define IMAGE_DIGEST_MAP(X) X(RUNS, "runs") X(ROWS, "rows")

typedef enum image_digest_kind {
#define IMAGE_DIGEST_ENUM(kind, name) IMAGE_DIGEST_##kind,
    IMAGE_DIGEST_MAP(IMAGE_DIGEST_ENUM)
#undef IMAGE_DIGEST_ENUM
        IMAGE_DIGEST_KINDS
} image_digest_kind;

#define IMAGE_DIGEST_NEWEST ((image_digest_kind)(IMAGE_DIGEST_KINDS - 1)) /* that of the functions above */

const char *image_digest_kind_name(image_digest_kind kind);

/* The kind of a name; IMAGE_DIGEST_KINDS where there is none such, as in a file of a later version. */
image_digest_kind image_digest_kind_of(const char *name, size_t length);

/* A digest as frames tell it, with its kind: "rows-0123456789abcdef", and the digits alone for that of runs. Returns
 * `text`. */
#define IMAGE_DIGEST_TEXT 24
char *image_digest_print(image_digest_kind kind, uint64_t digest, char text[IMAGE_DIGEST_TEXT]);

/* Read it back. False for anything else, as what a later version writes; both are then unchanged. */
bool image_digest_parse(const char *text, image_digest_kind *kind, uint64_t *digest);

/* image_digest() and image_digest_png() of any kind. */
uint64_t image_digest_of(image_digest_kind kind, const image *image);
bool image_digest_png_of(image_digest_kind kind, const char *path, image_color background, image *about,
                         uint64_t *digest, octreel_error *error);

#endif
