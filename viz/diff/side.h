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
    char *name;             /* the path below the side's folder, such as "menu/1.png"; of a picture, its file name */
    char *path;             /* null in a baseline, unless the picture was found in a store */
    frame_digest digest;    /* in a baseline: the variant that was accepted last; otherwise zero */
    frame_digest *variants; /* in a baseline: all accepted digests; owned */
    size_t variant_count;
} diff_frame;

typedef struct diff_side {
    const char *path;   /* the path as given, or "standard input", for messages and for opening a folder; not owned */
    const char *source; /* the path as given, for opening a file; not owned */
    diff_kind kind;
    diff_frame *frames; /* sorted by name, in byte order; names are unique; owned */
    size_t count, room;
    bool no_frames;          /* a recording made without frames: its ticks are compared instead */
    uint64_t max_ticks;      /* set by the caller: a recording with more ticks is not replayed; 0: the default */
    image_color background;  /* in a baseline: the color behind transparent pixels */
    acceptance *acceptances; /* the acceptances of a baseline; owned */
    size_t acceptance_count, acceptance_room;
} diff_side;

/* Which subfolders of a folder are searched for frames. */
typedef struct diff_search {
    bool flat;               /* none */
    const char *left_out[2]; /* paths that the search skips, with all folders in them, such as the other side; null:
                                none; not owned */
} diff_search;

/* Open the side at a path. The path "-" reads a PNG or a baseline from standard input. Return false with an error if
 * the path is not a picture, folder, recording or baseline, or if a subfolder cannot be read. The side is then empty.
 *
 * The frames of a folder are the PNG files in it and in its subfolders. Links to folders are not followed. Files and
 * folders whose names begin with a dot are left out, and so are folders of evidence and those that `search` names. A
 * null `search` leaves out nothing else. A recording has no subfolders; one that lies in a folder is a plain folder. */
bool diff_side_open(diff_side *side, const char *path, const diff_search *search, octreel_error *error);
void diff_side_release(diff_side *side);

/* Sort the frames by name, in byte order. */
void diff_side_sort_frames(diff_side *side);

/* The file that marks a folder of evidence, which diff --output writes, and how its text begins. */
#define EVIDENCE_MARKER "evidence.txt"
#define EVIDENCE_MARKER_BEGINNING "octreel evidence 1\n"

/* Return whether a folder has the marker. */
bool diff_is_evidence_folder(const char *folder);

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
