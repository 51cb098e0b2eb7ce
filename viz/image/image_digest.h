/* SPDX-License-Identifier: MIT */
/* image_digest.h - a 64-bit digest of the size and the colours of a picture. */
#ifndef IMAGE_IMAGE_DIGEST_H
#define IMAGE_IMAGE_DIGEST_H

#include "image.h"

/* Returns the digest of an image's size and colours. The digest does not depend on the image's format: an indexed image
 * and an RGB image with the same colours have the same digest. */
uint64_t image_digest(const image *image);

/* All digest algorithms that Octreel has used, from the oldest to the newest, with their names in baseline files. A
 * frame that was accepted with an older algorithm is compared by that algorithm. */
#define IMAGE_DIGEST_MAP(X) X(IMAGE_DIGEST_RUNS, "runs") X(IMAGE_DIGEST_ROWS, "rows")

#define IMAGE_DIGEST_VALUE(kind, name) kind,
typedef enum image_digest_kind { IMAGE_DIGEST_MAP(IMAGE_DIGEST_VALUE) IMAGE_DIGEST_KINDS } image_digest_kind;
#undef IMAGE_DIGEST_VALUE

#define IMAGE_DIGEST_NEWEST ((image_digest_kind)(IMAGE_DIGEST_KINDS - 1)) /* the algorithm that image_digest() uses */

const char *image_digest_kind_name(image_digest_kind kind);

/* Returns the algorithm with this name. Returns IMAGE_DIGEST_KINDS if this version of Octreel does not know the name; a
 * later version may. */
image_digest_kind image_find_digest_kind(const char *name, size_t length);

/* Print a digest in the form in which PNG frames store it: "rows-0123456789abcdef"; for the algorithm "runs" only the
 * 16 digits. Returns `text`. */
#define IMAGE_DIGEST_TEXT 24
char *image_digest_print(image_digest_kind kind, uint64_t digest, char text[IMAGE_DIGEST_TEXT]);

/* Parse a digest that image_digest_print() printed. Returns false and changes nothing for any other text, including
 * digests with algorithms of later versions. */
bool image_digest_parse(const char *text, image_digest_kind *kind, uint64_t *digest);

/* Returns the digest of an image by a given algorithm. */
uint64_t image_digest_with(image_digest_kind kind, const image *image);

/* Compute the digest of a PNG file. The file is read in bands of rows, under the rules of image_read_png_over(). *about
 * receives the image's description without its pixels. Returns false and sets *error if the file cannot be read. */
bool image_digest_png(image_digest_kind kind, const char *path, image_color background, image *about, uint64_t *digest,
                      octreel_error *error);

#endif
