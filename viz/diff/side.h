/* SPDX-License-Identifier: MIT */
/* side.h - one side of a comparison: a picture, a folder of pictures, a recording, or a baseline. */
#ifndef DIFF_SIDE_H
#define DIFF_SIDE_H

#include "folder.h"
#include "image_digest.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum diff_kind { DIFF_PICTURE, DIFF_FOLDER, DIFF_RECORDING, DIFF_BASELINE } diff_kind;

/* The digest and the size of a frame. */
typedef struct frame_digest {
    uint64_t pixels; /* the digest of the pixels, by image_digest() */
    int width, height;
    image_digest_kind kind;
    size_t acceptance; /* in a baseline: the index in side->acceptances */
} frame_digest;

/* An acceptance: the date and the reason for which a set of digests was accepted. All digests of an acceptance have
 * the same size and kind. */
typedef struct acceptance {
    char id[3], date[11]; /* id: two characters of 0-9a-z; date: YYYY-MM-DD */
    int width, height;
    image_digest_kind kind;
    char *reason; /* owned */
} acceptance;

typedef struct diff_frame {
    char *name;             /* the file name without its folder */
    char *path;             /* null in a baseline, unless the picture was found in a store */
    frame_digest digest;    /* in a baseline: the variant that was accepted last; otherwise zero */
    frame_digest *variants; /* in a baseline: all accepted digests; owned */
    size_t variant_count;
} diff_frame;

typedef struct diff_side {
    const char *path;   /* the path as given, or "standard input", for messages and for opening a folder; not owned */
    const char *source; /* the path as given, for opening a file; not owned */
    diff_kind kind;
    diff_frame *frames; /* sorted by name with strcmp(); names are unique; owned */
    size_t count, room;
    bool no_frames;          /* a recording made without frames: its ticks are compared instead */
    image_color background;  /* in a baseline: the color behind transparent pixels */
    acceptance *acceptances; /* the acceptances of a baseline; owned */
    size_t acceptance_count, acceptance_room;
} diff_side;

/* Open the side at a path. The path "-" reads a PNG or a baseline from standard input. The frames of a folder are
 * the PNG files directly in it, except files whose names begin with a dot. Return false with an error if the path is
 * not a picture, folder, recording or baseline. The side is then empty. */
bool diff_side_open(diff_side *side, const char *path, octreel_error *error);
void diff_side_release(diff_side *side);

/* Return "picture", "folder", "recording" or "baseline". */
const char *diff_kind_name(diff_kind kind);

/* Return the length of a file name without its ending ".png". If the name has another ending, return its whole
 * length. */
size_t diff_stem_length(const char *name);

/* Append a frame. The side copies the name and the digest. Unless the side is a baseline, the frame also gets its
 * path. */
bool diff_side_add_frame(diff_side *side, const char *name, frame_digest digest, octreel_error *error);

/* Set *digest to the size and the digest of a picture. The caller sets digest->kind to the wanted kind. Return false
 * with an error when the picture cannot be read. */
bool digest_picture(const char *path, image_color background, frame_digest *digest, octreel_error *error);

#endif
