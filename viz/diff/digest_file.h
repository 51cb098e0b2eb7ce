/* SPDX-License-Identifier: MIT */
/* digest_file.h - the pixels of many frames as a text file of a few kilobytes, to be compared with instead of pictures.
 *
 *   octreel-digests 1
 *   background ffffff
 *   0123456789abcdef 1280x720 frame_000000.png
 *   ...
 *
 * One line a frame, in the order of the names' bytes: the digest of its pixels (image_digest(), 16 hexadecimal digits),
 * its size, and its name up to the line's end. Transparent pixels were laid over the background.
 */
#ifndef DIFF_DIGEST_FILE_H
#define DIFF_DIGEST_FILE_H

#include "side.h"

#include <stdio.h>

/* Read the file at side->path into side. False with file, line and reason when it is invalid. */
bool digest_file_read(diff_side *side, octreel_error *error);

/* The same for text in memory, which is taken apart in place; it ends with a zero. */
bool digest_file_parse(diff_side *side, char *text, size_t size, octreel_error *error);

/* Write all frames of a side that has digests. False when a name has a character that no line can hold; whether the
 * stream took it all is left to the caller. */
bool digest_file_write(FILE *out, const diff_side *side, octreel_error *error);

/* The digest of a picture. False with an error when it cannot be read. */
bool digest_frame(const char *path, image_color background, frame_digest *digest, octreel_error *error);

/* Give every frame of a side its digest, on all cores. */
bool digest_all(diff_side *side, image_color background, octreel_error *error);

#endif
