/* SPDX-License-Identifier: MIT */
/* stored_picture.h - finds pictures in a picture store, compares a frame with the pictures of its accepted digests, and
 * applies the rule for the frame. picture_store.h describes the store. */
#ifndef DIFF_STORED_PICTURE_H
#define DIFF_STORED_PICTURE_H

#include "pair.h"

/* Return the path of the picture with a digest: DIR/runs/01/0123456789abcdef.png. The caller frees the path. Return
 * null if memory runs out. */
char *stored_picture_path(const char *store, const frame_digest *digest);

/* Return whether a file is a picture with this digest. If the file is not such a picture, the error says why. */
bool stored_picture_check(const char *path, const frame_digest *digest, image_color background, octreel_error *error);

/* If the digest of a pair differs, compare the frame with the picture of its newest variant in the store
 * options->store. If the store does not have this picture, or the frame differs from it beyond the tolerance, try the
 * pictures of the other variants. If the store has none of these pictures, pair->no_picture says why the newest is
 * missing. `reference` is pair->a; its path becomes that of the picture. Does nothing without a store. */
void stored_picture_compare(diff_pair *pair, diff_frame *reference, const diff_options *options);

/* Decide whether the rule for a pair that differs is applied: pair->effect becomes RULE_EXCEEDED, or the reason why it
 * is not. Call this after stored_picture_compare(). `is_recording`: the frame is of a recording. */
void stored_picture_choose_rule(diff_pair *pair, const diff_options *options, bool is_recording);

/* If the rule of the pair is applied, compare the pictures again under the rule: pair->effect becomes RULE_FORGAVE if
 * the difference is within it. The masks of layers must be in pair->mask. */
void stored_picture_apply_rule(diff_pair *pair, diff_frame *reference, const diff_options *options);

#endif
