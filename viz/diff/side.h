/* SPDX-License-Identifier: MIT */
/* side.h - one of the two things that are compared: a picture, a folder of them, a recording, or a file of digests. */
#ifndef DIFF_SIDE_H
#define DIFF_SIDE_H

#include "folder.h"
#include "image_digest.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum diff_kind { DIFF_PICTURE, DIFF_FOLDER, DIFF_RECORDING, DIFF_BASELINE } diff_kind;

/* What a file of digests knows of a frame. */
typedef struct frame_digest {
    uint64_t pixels; /* image_digest() */
    int width, height;
    image_digest_kind kind;
    size_t acceptance; /* in a baseline: by which it was taken over, in side->acceptances */
} frame_digest;

/* Digests that were taken over together: when and why, as a person has said it. They are of pictures of one size, and
 * of one kind. */
typedef struct acceptance {
    char id[3], date[11]; /* two of 0-9a-z; YYYY-MM-DD */
    int width, height;
    image_digest_kind kind;
    char *reason; /* owned */
} acceptance;

typedef struct diff_frame {
    char *name;             /* of the file, without folders */
    char *path;             /* null in a file of digests, unless the picture was found in a store */
    frame_digest digest;    /* zero where there is a path; of several that which was accepted last */
    frame_digest *variants; /* in a baseline: all that are accepted; owned */
    size_t variant_count;
} diff_frame;

typedef struct diff_side {
    const char *path;   /* for sentences, and of a folder to open: as it was given, or "standard input"; not owned */
    const char *source; /* of a file, to open: as it was given */
    diff_kind kind;
    diff_frame *frames; /* in the order of their names' bytes, no name twice */
    size_t count, room;
    bool no_frames;          /* a recording that was made without: its ticks are compared */
    image_color background;  /* of a file of digests: what transparent pixels were laid over */
    acceptance *acceptances; /* of a baseline; owned */
    size_t acceptance_count, acceptance_room;
} diff_side;

/* Open what a path names; "-" is a PNG or digests from standard input. A folder has the PNG files directly in it whose
 * names do not begin with a dot; a recording has its frames, of which it may say that there are none. False with an
 * error when it is none of the four; side is then empty. */
bool diff_side_open(diff_side *side, const char *path, octreel_error *error);
void diff_side_release(diff_side *side);

/* False with an error where an output is a file that is read for this side: a frame, the file of digests, or one of
 * a recording's files beside its frames. */
bool diff_side_spared(const diff_side *side, const output_file *output, octreel_error *error);

/* "picture", "folder", "recording", "baseline". */
const char *diff_kind_name(diff_kind kind);

/* Append a frame: a copy of its name, its path where the side's kind has paths, and its digest. */
bool diff_side_add(diff_side *side, const char *name, frame_digest digest, octreel_error *error);

/* Set *digest to the size and the digest of a picture; digest->kind selects the kind. Return false with an error when
 * the picture cannot be read. */
bool digest_picture(const char *path, image_color background, frame_digest *digest, octreel_error *error);

#endif
