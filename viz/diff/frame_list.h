/* SPDX-License-Identifier: MIT */
/* frame_list.h - names of frames in a file, one a line: what a person has ticked in the page of a comparison, which
 * saves it as accept.txt. Empty lines are passed over. */
#ifndef DIFF_FRAME_LIST_H
#define DIFF_FRAME_LIST_H

#include "octreel/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct listed_frame {
    const char *name;
    size_t line; /* 0: it is of no file */
} listed_frame;

/* A zeroed one is empty. */
typedef struct frame_list {
    listed_frame *frames; /* owned */
    size_t count, room;
    char *text; /* that the names are in; owned */
} frame_list;

/* Append a name, which must outlive the list. */
bool frame_list_add(frame_list *list, const char *name, size_t line, octreel_error *error);

/* Append those of one file, or of standard input. False with an error where it cannot be read or names nothing: an
 * empty list is no choice of all frames. */
bool frame_list_read(frame_list *list, const char *path, octreel_error *error);
void frame_list_release(frame_list *list);

#endif
