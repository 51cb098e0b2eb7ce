/* SPDX-License-Identifier: MIT */
/* picture_store.h - a folder that holds pictures under the digests of their pixels: DIR/runs/01/0123456789abcdef.png.
 *
 * It complements a baseline and lies outside of git, for example in a CI cache or a mounted bucket. No verdict depends
 * on it: its pictures only show what a frame should look like. A picture is used only if its pixels have the digest in
 * its name. */
#ifndef DIFF_PICTURE_STORE_H
#define DIFF_PICTURE_STORE_H

#include "diff.h"

/* Copy a picture into the store, to a unique name first, which is then renamed: concurrent writers leave a complete
 * file. An existing picture stays, unless it is damaged. */
bool picture_store_add(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error);

/* The path of the picture with a digest; the caller frees it. Null with an error if the store lacks it, it is damaged,
 * or memory runs out. */
char *picture_store_find(const char *store, const frame_digest *digest, image_color background, octreel_error *error);

/* For each differing pair of a baseline, fetch the picture of the reference and compare the pixels. If there is no
 * picture, store the reason in the pair. The verdict does not change. */
bool picture_store_fetch(const char *store, diff_side *reference, diff_result *result, octreel_error *error);

#endif
