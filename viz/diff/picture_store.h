/* SPDX-License-Identifier: MIT */
/* picture_store.h - a folder of pictures by the digests of their pixels: DIR/runs/01/0123456789abcdef.png. It lies
 * beside a file of digests, say in a CI cache or on the mount of a bucket. No verdict depends on it: a picture is
 * fetched to show what was expected, and believed only if its pixels have the digest that is its name. */
#ifndef DIFF_PICTURE_STORE_H
#define DIFF_PICTURE_STORE_H

#include "diff.h"

/* Copy a picture into the store, under a name of its own first and then by a rename: whoever else puts the same there,
 * it is whole. One that is there already stays, unless it is damaged. */
bool picture_store_put(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error);

/* The path of a digest's picture, which the caller frees; null, with a sentence, where there is none, it is not what
 * its name says, or there is no memory. */
char *picture_store_get(const char *store, const frame_digest *digest, image_color background, octreel_error *error);

/* Give each pair that is known by digests alone, and has not the same pixels, the picture of its reference, and compare
 * them; where there is none the pair says so. The verdict stays. */
bool picture_store_fetch(const char *store, diff_side *reference, diff_result *result, octreel_error *error);

#endif
