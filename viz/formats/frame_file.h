/* SPDX-License-Identifier: MIT */
/* frame_file.h - the PNG file of a frame: its name, its PNG texts, and checks that a file is the expected frame. A PNG
 * text is a keyword and a value in a text chunk. The PNG texts of a frame state the frame's tick, session and scene. */
#ifndef FORMATS_FRAME_FILE_H
#define FORMATS_FRAME_FILE_H

#include "file.h"
#include "image_digest.h"

#include <stdint.h>

/* Keywords of the PNG texts that state the digests of the scene and of the pixels. `octreel inspect` writes these
 * texts, too. */
#define FRAME_SCENE_KEYWORD "octreel-scene"
#define FRAME_PIXELS_KEYWORD "octreel-pixels"

#define FRAME_NAME 40
char *frame_print_name(uint64_t tick, char name[FRAME_NAME]);

/* Parses the file name of a frame. Returns false if the name is not the name of a frame. */
bool frame_parse_name(const char *name, uint64_t *tick);

/* A recording has a frame for every `every`-th tick. Returns whether this tick has a frame. If `every` is 0, no tick
 * has a frame. */
bool frame_is_due(uint64_t tick, uint64_t every);

/* Returns whether a file name belongs to a frame of a recording that has `ticks` ticks and a frame for every
 * `every`-th tick. */
bool frame_is_name_of_recording(const char *name, uint64_t ticks, uint64_t every);

/* The origin of a frame, as its PNG texts state it. */
typedef struct frame_origin {
    /* the tick's number, the digest of session.json, and the digest of the tick's scene */
    uint64_t tick, session, scene;
    /* the number of elements of the scene that were not drawn; the number 0 is not written as a PNG text */
    uint64_t left_out;
    image_digest_kind kind; /* how the digest `pixels` is computed */
    uint64_t pixels;        /* the digest of the pixels, set by the functions that check a frame */
} frame_origin;

/* Writes a picture as the frame of origin->tick. Returns false with an error. */
bool frame_write(const char *folder, const image *picture, const frame_origin *origin, octreel_error *error);

/* Reads the number of a frame's tick from its PNG text. Returns false with an error if the file is not a frame, but
 * a picture by `octreel inspect` or a PNG file of another program. */
bool frame_read_tick(const char *path, uint64_t *tick, octreel_error *error);

/* Reads the digest of the session from the PNG text of a tick's frame. Returns false if the file or the PNG text is
 * missing. */
bool frame_read_session_digest(const char *folder, uint64_t tick, uint64_t *session);

/* Reads the digest of the scene from the PNG text of a tick's frame. Returns false if the file or the PNG text is
 * missing. */
bool frame_read_scene_digest(const char *folder, uint64_t tick, uint64_t *scene);

/* Reads all PNG texts of a frame: its tick, and the digests of its session, scene and pixels. The file may have any
 * name. Returns false if a text is missing. */
bool frame_read_origin(const char *path, frame_origin *origin);

/* Replaces the digest of the session in the frame of a tick. While a session is being written, its digest is
 * unknown, so frames drawn meanwhile get the digest later. Returns false with an error. */
bool frame_replace_session_digest(const char *folder, uint64_t tick, uint64_t session, octreel_error *error);

/* Checks the frame of a tick. The file must exist and be complete, and its PNG texts must state the tick, session and
 * scene of *origin. Its decoded pixels must have the stated digest. Returns false with an error if the check fails.
 *
 * Sets origin->left_out from the PNG text. If the pixels can be decoded, sets origin->pixels to their digest, of the
 * kind that the PNG text names, even if the check fails.
 */
bool frame_check_tick(const char *folder, frame_origin *origin, octreel_error *error);

/* Checks a frame as frame_check_tick() does. The file may have any name. */
bool frame_check_file(const char *path, frame_origin *origin, octreel_error *error);

#endif
