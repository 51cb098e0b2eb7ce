/* SPDX-License-Identifier: MIT */
/* frame_list.h - reads a list of frame names, one name on each line. The report page saves such a list, accept.txt,
 * with the frames that a person ticked. Empty lines are ignored. */
#ifndef DIFF_FRAME_LIST_H
#define DIFF_FRAME_LIST_H

#include "octreel/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct listed_frame {
    const char *name;
    /* the number of the line that holds the name in the list's file; 0: the name is from the command line */
    size_t line;
} listed_frame;

/* A list of frame names. A zeroed list is empty. */
typedef struct frame_list {
    listed_frame *frames; /* the frames, in the order in which they were added; owned */
    size_t count, room;
    char *text; /* the text of the list's file, into which the names point; owned */
} frame_list;

/* Append a name. The name must outlive the list. */
bool frame_list_add(frame_list *list, const char *name, size_t line, octreel_error *error);

/* Append the names in a file or in standard input. Return false with an error if the file cannot be read or holds no
 * name: an empty list would mean all frames. */
bool frame_list_read(frame_list *list, const char *path, octreel_error *error);
void frame_list_release(frame_list *list);

#endif
