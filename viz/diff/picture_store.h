/* SPDX-License-Identifier: MIT */
/* picture_store.h - a folder that holds pictures under the digests of their pixels: DIR/runs/01/0123456789abcdef.png.
 *
 * A store complements a baseline. It lies outside of git, for example in a CI cache or a mounted bucket. Its pictures
 * show how a frame should look. With a tolerance, they also decide the verdict of frames whose digests differ. A
 * picture is used only if its pixels have the digest in its file name.
 */
#ifndef DIFF_PICTURE_STORE_H
#define DIFF_PICTURE_STORE_H

#include "diff.h"

/* Copy a picture into the store. The copy is written under a temporary unique name and then renamed, so the file is
 * complete even with concurrent writers. An existing picture is replaced only if it is damaged. */
bool picture_store_add(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error);

/* Return the path of the picture with a digest. The caller frees the path. Return null with an error if the store
 * lacks the picture, the picture is damaged, or memory runs out. */
char *picture_store_find(const char *store, const frame_digest *digest, image_color background, octreel_error *error);

/* If the options of the result name a store, do the following for each differing pair of a baseline: fetch the
 * picture of the reference and compare the pixels. A pair within the tolerance of an accepted picture is no longer
 * different. The verdict of other pairs does not improve. If the store has no picture for a pair, the reason is
 * written to pair->no_picture. */
void picture_store_fetch(diff_side *reference, diff_result *result);

#endif
