/* SPDX-License-Identifier: MIT */
/* accept.h - makes new frames the reference. */
#ifndef DIFF_ACCEPT_H
#define DIFF_ACCEPT_H

#include "baseline.h"
#include "diff.h"
#include "frame_list.h"

#include <stdio.h>

/* A callback that chooses the frames to accept, after the comparison: it appends their names to `chosen`. It returns
 * false with an error if nothing is to be accepted because of a failure. */
typedef bool accept_chooser(void *context, diff_side *reference, const diff_side *frames, diff_result *result,
                            frame_list *chosen, octreel_error *error);

typedef struct accept_options {
    const char *reference; /* the reference: a PNG, a folder, a recording or a baseline; created if it does not exist */
    const char *frames;    /* the new frames: a PNG, a folder or a recording */
    bool flat;             /* true: the subfolders of a folder are not searched for frames */
    /* The names of the frames to accept. If the list is empty, all frames are accepted, and each reference without a
     * new frame is removed. */
    frame_list *names;
    /* The callback that fills the list; null: the list is complete. If the callback leaves it empty, nothing is
     * accepted. The names that it appends are valid until accept_frames() returns. */
    accept_chooser *choose;
    void *choose_context;

    /* The members `note`, `store` and `variant` are used only for baselines. If a reason is given, a reference that
     * does not exist becomes a baseline. */
    acceptance_note note; /* note.reason is null if no reason was given */
    const char *store;    /* the folder in which accepted pictures are stored; null: no pictures are stored */
    bool variant;         /* true: a frame keeps its previously accepted digests */
    bool json;            /* true: the summary is one JSON object that lists all changed frames */
} accept_options;

/* Compare the new frames with the references, then replace the references that differ. References with equal pixels are
 * not written, unless a whole recording is accepted: then all its files are replaced. At the end a summary is printed
 * to `out`, unless `out` is null. Return false with an error on failure. If a side, a new frame or a name is invalid,
 * no file has been changed.
 *
 * Each call locks the folder that holds the reference, so concurrent calls run one after the other. Each new file is
 * first written as NAME.part. Only when all new files are complete are they renamed, so on a full disk the reference is
 * unchanged. With a picture store, the pictures are stored before the baseline is renamed. If the process dies between
 * two renames, each file is either the old file or the new file, and no reference has been removed. Calling accept
 * again completes the change. */
bool accept_frames(const accept_options *options, FILE *out, octreel_error *error);

#endif
