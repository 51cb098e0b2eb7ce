/* SPDX-License-Identifier: MIT */
/* image_digest.h - a 64-bit digest of the size and the colours of a picture. */
#ifndef IMAGE_IMAGE_DIGEST_H
#define IMAGE_IMAGE_DIGEST_H

#include "image.h"

/* Returns the digest of an image's size and colours. It does not depend on how they are stored: an indexed image and an
 * RGB image with the same colours have the same digest. */
uint64_t image_digest(const image *image);

/* All digest algorithms that Octreel has used, the newest last, with their names in baseline files. A frame that was
 * accepted with an older algorithm is compared with that algorithm. */
#define IMAGE_DIGEST_MAP(X) X(IMAGE_DIGEST_RUNS, "runs") X(IMAGE_DIGEST_ROWS, "rows")

#define IMAGE_DIGEST_VALUE(kind, name) kind,
typedef enum image_digest_kind { IMAGE_DIGEST_MAP(IMAGE_DIGEST_VALUE) IMAGE_DIGEST_KINDS } image_digest_kind;
#undef IMAGE_DIGEST_VALUE

#define IMAGE_DIGEST_NEWEST ((image_digest_kind)(IMAGE_DIGEST_KINDS - 1)) /* used by image_digest() */

const char *image_digest_kind_name(image_digest_kind kind);

/* Returns the kind with this name; IMAGE_DIGEST_KINDS if the name is unknown, as in a file by a later version. */
image_digest_kind image_find_digest_kind(const char *name, size_t length);

/* Print a digest as it is written in frames: "rows-0123456789abcdef"; for the kind "runs" only the digits. Returns
 * `text`. */
#define IMAGE_DIGEST_TEXT 24
char *image_digest_print(image_digest_kind kind, uint64_t digest, char text[IMAGE_DIGEST_TEXT]);

/* Parse a printed digest. Returns false and changes nothing for any other text, including kinds of later versions. */
bool image_digest_parse(const char *text, image_digest_kind *kind, uint64_t *digest);

/* Returns the digest by a given algorithm. */
uint64_t image_digest_with(image_digest_kind kind, const image *image);

/* Compute the digest of a PNG file, read row by row under the rules of image_read_png_over(). *about receives the
 * image's description without pixels. Returns false and sets *error if the file cannot be read. */
bool image_digest_png(image_digest_kind kind, const char *path, image_color background, image *about, uint64_t *digest,
                      octreel_error *error);

#endif
