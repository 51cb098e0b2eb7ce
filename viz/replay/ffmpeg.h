/* SPDX-License-Identifier: MIT */
/* ffmpeg.h - writes a video through the program ffmpeg, if it is installed. */
#ifndef REPLAY_FFMPEG_H
#define REPLAY_FFMPEG_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ffmpeg ffmpeg;

/* Returns ffmpeg's name, such as "mp4", for the video format that the ending of a file's name selects. Returns null if
 * the ending selects no video. */
const char *ffmpeg_find_format(const char *path);

/* Start ffmpeg for a video of frames of this size. `path` must outlive the writer. Returns null and sets *error if
 * ffmpeg is not installed or the file cannot be written. Until the writer is closed or discarded, the process ignores
 * SIGPIPE. */
ffmpeg *ffmpeg_open(const char *path, int width, int height, unsigned rate, octreel_error *error);

/* Append a frame: `size` bytes of RGB pixels, three bytes for each pixel. Returns false and sets *error on failure. */
bool ffmpeg_add(ffmpeg *f, const uint8_t *rgb, size_t size, octreel_error *error);

/* Wait until ffmpeg has written the video, which then appears at its path by a rename. Returns false and sets *error
 * if ffmpeg failed; its own message is on standard error. Frees the writer in both cases. */
bool ffmpeg_close(ffmpeg *f, octreel_error *error);

/* Stop ffmpeg, remove the incomplete file and free the writer. */
void ffmpeg_discard(ffmpeg *f);

#endif
