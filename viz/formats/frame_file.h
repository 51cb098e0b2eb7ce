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
char *frame_print_name(uint64_t tick, char name[FRAME_NAME]);

/* Parse the name of a frame. False for any other name. */
bool frame_parse_name(const char *name, uint64_t *tick);

/* True if a recording with this interval of frames has a frame of the tick. 0: no tick has a frame. */
bool frame_is_due(uint64_t tick, uint64_t every);

/* True if a name is that of a frame of a recording with `ticks` ticks and this interval of frames. */
bool frame_is_name_of_recording(const char *name, uint64_t ticks, uint64_t every);

/* The origin of a frame, as the texts in its PNG file state it. */
typedef struct frame_origin {
    uint64_t tick, session, scene; /* the tick's number, and the digests of session.json and of the tick's scene */
    uint64_t left_out;             /* number of elements that could not be drawn; 0 is not written */
    image_digest_kind kind;        /* how `pixels` is computed */
    uint64_t pixels;               /* the digest of the pixels; set by checks */
} frame_origin;

/* Write a picture as the frame of its tick. */
bool frame_write(const char *folder, const image *picture, const frame_origin *origin, octreel_error *error);

/* Read the tick of a frame from its text. Returns false, with an error, for a picture by `octreel inspect` and for a
 * PNG file by another program. */
bool frame_read_tick(const char *path, uint64_t *tick, octreel_error *error);

/* Read the session digest from the frame of a tick. False if the file or its text is missing. */
bool frame_read_session_digest(const char *folder, uint64_t tick, uint64_t *session);

/* Read the scene digest from the frame of a tick. False if the file or its text is missing. */
bool frame_read_scene_digest(const char *folder, uint64_t tick, uint64_t *scene);

/* Read all of a frame's texts: its tick, and the digests of its session, scene and pixels. The file may have any name.
 * False if a text is missing. */
bool frame_read_origin(const char *path, frame_origin *origin);

/* Replace the session digest in the frame of a tick. The digest of a session that is still being written is known only
 * at its end. */
bool frame_replace_session_digest(const char *folder, uint64_t tick, uint64_t session, octreel_error *error);

/* Check the frame of a tick: the file exists and is complete, states this tick, session and scene, and its decoded
 * pixels have the stated digest. Sets left_out from its text. If the pixels can be decoded, `pixels` becomes their
 * digest, of the kind in the text, even if the check fails. Returns false, with an error, if the check fails. */
bool frame_check_tick(const char *folder, frame_origin *origin, octreel_error *error);

/* frame_check_tick() for a file of any name. */
bool frame_check_file(const char *path, frame_origin *origin, octreel_error *error);

#endif
