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
    size_t acceptance; /* in a baseline, the index of the digest's acceptance in side->acceptances */
} frame_digest;

/* An acceptance: the date on which digests were accepted, and the reason. All digests of an acceptance have the same
 * size and kind. */
typedef struct acceptance {
    char id[3], date[11]; /* id: two characters of 0-9a-z; date: YYYY-MM-DD */
    int width, height;
    image_digest_kind kind;
    char *reason; /* the reason for accepting the digests; owned */
} acceptance;

typedef struct diff_frame {
    /* a picture's file name, or its path in the folder of the side, such as "menu/1.png"; owned */
    char *name;
    char *path;             /* the path of the picture; in a baseline null, unless a store has the picture; owned */
    const image *pixels;    /* the picture, if it is in memory; else null, and it is read from `path`; not owned */
    frame_digest digest;    /* in a baseline, the variant that was accepted last; else zero */
    frame_digest *variants; /* in a baseline, all accepted digests of the frame; else null; owned */
    size_t variant_count;
} diff_frame;

struct baseline_rule;

typedef struct diff_side {
    /* the name in messages, and the path of a folder: "standard input" if the user gave "-", else equal to `source`;
     * not owned */
    const char *path;
    const char *source; /* the path that the user gave; a file is opened by it, because "-" is not a name; not owned */
    diff_kind kind;
    diff_frame *frames; /* the frames, sorted by name in byte order; names are unique; owned */
    size_t count, room;
    bool no_frames; /* true: the recording was made without frames, so its ticks are compared instead */
    /* set by the caller: a recording with more ticks than this is not replayed; 0: the default limit */
    uint64_t max_ticks;
    image_color background;  /* in a baseline, the color that was drawn behind transparent pixels */
    acceptance *acceptances; /* the acceptances of a baseline; owned */
    size_t acceptance_count, acceptance_room;
    struct baseline_rule *rules; /* the rules of a baseline, in the order of their lines; owned */
    size_t rule_count, rule_room;
    char *notes; /* the lines of the rules and comments of a baseline, each with a line end; owned */
    size_t notes_size, notes_room;
} diff_side;

/* Which folders are not searched for frames. */
typedef struct diff_search {
    bool flat; /* true: no subfolder is searched */
    /* paths of folders whose files and subfolders are skipped, such as the folder of the other side; null: no path;
     * not owned */
    const char *left_out[2];
} diff_search;

/* Open the side at a path. The path "-" reads a PNG or a baseline from standard input. Return false with an error if
 * the path is not a picture, folder, recording or baseline, or if a subfolder cannot be read. The side is then empty.
 *
 * The frames of a folder are the PNG files in it and in its subfolders. Links to folders are not followed. Three kinds
 * of entries are skipped: names that begin with a dot, folders of evidence, and the folders that `search` excludes.
 * `search` may be null. The subfolders of a recording are not searched. A recording in a subfolder of a folder is
 * searched like any other subfolder. */
bool diff_side_open(diff_side *side, const char *path, const diff_search *search, octreel_error *error);
void diff_side_release(diff_side *side);

/* Sort the frames by name, in byte order. */
void diff_side_sort_frames(diff_side *side);

/* Return the frame with this name, or null. The frames must be sorted. Cost: O(log frames). */
const diff_frame *diff_side_find_frame(const diff_side *side, const char *name);

/* The name of the file that marks a folder as evidence, and the beginning of the file's text. diff --output writes
 * the file. */
#define EVIDENCE_MARKER "evidence.txt"
#define EVIDENCE_MARKER_BEGINNING "octreel evidence 1\n"

/* Return whether a folder is a folder of evidence: it contains the file EVIDENCE_MARKER. */
bool diff_is_evidence_folder(const char *folder);

/* Return "picture", "folder", "recording" or "baseline". */
const char *diff_kind_name(diff_kind kind);

/* Return the length of a file name without its ending ".png". If the name has another ending, return its whole
 * length. */
size_t diff_stem_length(const char *name);

/* Append a frame. The side copies the name and the digest. If the side is not a baseline, the frame also gets the
 * path of its file. */
bool diff_side_add_frame(diff_side *side, const char *name, frame_digest digest, octreel_error *error);

/* Read a picture and set *digest to its size and digest. The caller must first set digest->kind to the kind of
 * digest to compute. Return false with an error if the picture cannot be read. */
bool digest_picture(const char *path, image_color background, frame_digest *digest, octreel_error *error);

#endif
