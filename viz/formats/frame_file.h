/* SPDX-License-Identifier: MIT */
/* frame_file.h - the PNG file of a frame: its name, the texts in it that name its tick, session and scene, and checks
 * that a file is the expected frame. */
#ifndef FORMATS_FRAME_FILE_H
#define FORMATS_FRAME_FILE_H

#include "file.h"
#include "image_digest.h"

#include <stdint.h>

/* Keywords of the PNG texts with the digests of the scene and of the pixels. `octreel inspect` also writes these two.
 */
#define FRAME_SCENE_KEYWORD "octreel-scene"
#define FRAME_PIXELS_KEYWORD "octreel-pixels"

#define FRAME_NAME 40
char *frame_name(uint64_t tick, char name[FRAME_NAME]);

/* Parse the name of a frame. False for any other name. */
bool frame_parse_name(const char *name, uint64_t *tick);

/* Whether a tick has a frame in a recording with this interval of frames. 0: no tick has a frame. */
bool frame_is_due(uint64_t tick, uint64_t every);

/* Whether a name is that of a frame of a recording with this number of ticks and this interval. */
bool frame_is_name(const char *name, uint64_t ticks, uint64_t every);

/* The origin of a frame, as its texts state it. */
typedef struct frame_origin {
    uint64_t tick, session, scene; /* its number, and the digests of session.json and of the tick's scene */
    uint64_t left_out;             /* count of elements of the scene that could not be drawn; no text if it is 0 */
    image_digest_kind kind;        /* how `pixels` is computed */
    uint64_t pixels;               /* the digest of the pixels; set by checks */
} frame_origin;

/* Write a picture as the frame of its tick. */
bool frame_write(const char *folder, const image *picture, const frame_origin *origin, octreel_error *error);

/* Read the tick of a frame from its text. False, with a sentence, for a picture by `octreel inspect` and for a file
 * that is not from Octreel. */
bool frame_read_tick(const char *path, uint64_t *tick, octreel_error *error);

/* Read the session digest from the frame of a tick. False if the file or its text is missing. */
bool frame_session(const char *folder, uint64_t tick, uint64_t *session);

/* Read the scene digest from the frame of a tick. False if the file or its text is missing. */
bool frame_scene(const char *folder, uint64_t tick, uint64_t *scene);

/* Read all of a frame's texts: its tick, and the digests of its session, scene and pixels. The file may have any name.
 * False if a text is missing. */
bool frame_read_origin(const char *path, frame_origin *origin);

/* Replace the session digest in the frame of a tick. A session that is still being written has its digest only at its
 * end. */
bool frame_set_session(const char *folder, uint64_t tick, uint64_t session, octreel_error *error);

/* Check that the file of a tick exists, is complete, and states this tick, session and scene, and that its decoded
 * pixels have the stated digest. Sets left_out from its text. False with a sentence otherwise. If the pixels can be
 * decoded, `pixels` becomes their digest in either case, of the kind that the text has. */
bool frame_check(const char *folder, frame_origin *origin, octreel_error *error);

/* frame_check() for a file of any name. */
bool frame_check_file(const char *path, frame_origin *origin, octreel_error *error);

#endif
