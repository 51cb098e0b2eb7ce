/* SPDX-License-Identifier: MIT */
/* digest_file.h - the pixels of many frames as a text file of a few kilobytes, to be compared with instead of pictures.
 *
 *   octreel-digests 1
 *   background ffffff
 *   0123456789abcdef 1280x720 frame_000000.png
 *   ...
 *
 * One line a frame, in the order of the names' bytes: the digest of its pixels (image_digest(), 16 hexadecimal digits),
 * its size, and its name up to the line's end. Transparent pixels were laid over the background. Version 2, which says
 * who accepted what and why, is told in baseline.h.
 */
#ifndef DIFF_DIGEST_FILE_H
#define DIFF_DIGEST_FILE_H

#include "side.h"

#include <stdio.h>

/* Read the file at side->path into side. False with file, line and reason when it is invalid. Cost: O(size) in time; in
 * memory at most 16 bytes for each of the file's, itself included. */
bool digest_file_read(diff_side *side, octreel_error *error);

/* The same for text in memory, which is taken apart in place; it ends with a zero. */
bool digest_file_parse(diff_side *side, char *text, size_t size, octreel_error *error);

/* A name with a control character would end its line, or another one. */
bool digest_file_holds_control(const char *text);

/* The two lines that each version begins with. */
void digest_file_write_head(FILE *out, int version, image_color background);

/* The error about a name that no line can hold; returns false. */
bool digest_file_fail_name(const diff_side *side, const char *name, octreel_error *error);

/* "1280x720" and the character after it; *at is moved past both. */
bool digest_file_take_size(const char **at, char end, frame_digest *digest);

/* So many hexadecimal digits in lower case and the character that ends them; *at is moved past it. */
bool digest_file_take_hexadecimal(const char **at, size_t digits, char end, uint64_t *value);

/* Write all frames of a side that has digests. False when a name has a character that no line can hold; whether the
 * stream took it all is left to the caller. */
bool digest_file_write(FILE *out, const diff_side *side, octreel_error *error);

/* The digest of a picture, of the kind that *digest has, and its size. False with an error when it cannot be read. */
bool digest_frame(const char *path, image_color background, frame_digest *digest, octreel_error *error);

/* Give every frame of a side its digest, on all cores. */
bool digest_all(diff_side *side, image_color background, octreel_error *error);

#endif
