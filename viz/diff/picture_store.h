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

/* For a comparison with a baseline, after diff_run(): find the rule for each frame. If the options name a store,
 * compare each differing pair with the pictures of its accepted digests. A pair within the tolerance, or within its
 * rule, is no longer different. The verdict of other pairs does not improve. If the store has no picture for a pair,
 * the reason is written to pair->no_picture; pair->effect says what the rule did. Return false with an error if the
 * layers of a rule cannot be drawn, SOURCE_DATE_EPOCH is invalid, or memory runs out. */
bool picture_store_fetch(diff_side *reference, const diff_side *compared, diff_result *result, octreel_error *error);

#endif
