/* SPDX-License-Identifier: MIT */
/* frame_file.h - the frame of a tick as a file of a recording: its name, what traces it to the tick that made it, and
 * whether the one that is there is that one. */
#ifndef FORMATS_FRAME_FILE_H
#define FORMATS_FRAME_FILE_H

#include "file.h"
#include "image_digest.h"

#include <stdint.h>

/* Keywords of texts that the pictures of trees alone have too: the digests of the scene, and of the pixels. */
#define FRAME_SCENE_KEYWORD "octreel-scene"
#define FRAME_PIXELS_KEYWORD "octreel-pixels"

#define FRAME_NAME 40
char *frame_name(uint64_t tick, char name[FRAME_NAME]);

/* The tick of a frame's name; false for any other name. */
bool frame_parse_name(const char *name, uint64_t *tick);

/* Whether a tick has a frame in a recording of which each every-th tick is filmed; with 0, none is. */
bool frame_is_due(uint64_t tick, uint64_t every);

/* Whether it is the name of a frame of such a recording with so many ticks. */
bool frame_is_name(const char *name, uint64_t ticks, uint64_t every);

/* Where a frame comes from; its texts say so. */
typedef struct frame_origin {
    uint64_t tick, session, scene; /* its number, and the digests of session.json and of the tick's scene */
    uint64_t left_out;             /* elements of the scene that could not be drawn; said where there are any */
    image_digest_kind kind;        /* of a frame that was checked, the digest of its pixels: */
    uint64_t pixels;
} frame_origin;

/* Write a picture as the frame of its tick. */
bool frame_write(const char *folder, const image *picture, const frame_origin *origin, octreel_error *error);

/* The tick that a file says it is the frame of. False, with a sentence, for the picture of a tree that octreel inspect
 * drew, and for what is none of octreel's. */
bool frame_read_tick(const char *path, uint64_t *tick, octreel_error *error);

/* The session that the frame of a tick says it is of. False where it is not there or says nothing. */
bool frame_session(const char *folder, uint64_t tick, uint64_t *session);

/* The same for the digest of the scene that it shows. */
bool frame_scene(const char *folder, uint64_t tick, uint64_t *scene);

/* What a frame of any name says of itself: its tick, and the digests of its session, its scene and its pixels. False
 * where something of it is missing. */
bool frame_read_origin(const char *path, frame_origin *origin);

/* Let the frame of a tick say that it is of another session: what one is like may be known at its end alone. */
bool frame_set_session(const char *folder, uint64_t tick, uint64_t session, octreel_error *error);

/* True when the file is there, whole, and the frame of this tick, session and scene: its texts say so, and the digest
 * among them is that of the pixels that are decoded. left_out is read from it. Else one sentence. In any case pixels
 * becomes the digest of the pixels, of the kind that the text is, where they can be decoded. */
bool frame_check(const char *folder, frame_origin *origin, octreel_error *error);

/* frame_check() for a file of any name. */
bool frame_check_file(const char *path, frame_origin *origin, octreel_error *error);

#endif
