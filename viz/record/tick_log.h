/* SPDX-License-Identifier: MIT */
/* tick_log.h - ticks.jsonl while it grows: whole lines, whatever happens. */
#ifndef RECORD_TICK_LOG_H
#define RECORD_TICK_LOG_H

#include "folder.h"

#include <sys/types.h>

typedef struct tick_log {
    FILE *stream; /* null: not open */
    char *path;
    off_t whole; /* bytes up to the end of its last whole line */
    off_t kept;  /* bytes of an earlier log that may be the next lines; 0: none */
} tick_log;

/* Begin a file of the folder anew; with `keep` its lines stay as long as the added lines are the same, so that nothing
 * is lost where fewer are added. False where another process or recorder has it open: two would overwrite each other's
 * frames. */
bool tick_log_open(tick_log *log, const char *folder, const char *name, bool keep, octreel_error *error);

/* Add a line, its newline included. What cannot be written whole is cut off, and the log closed. */
bool tick_log_add(tick_log *log, const char *line, size_t size, octreel_error *error);

/* Close a log, open or not. A log that is whole ends with the last line that was added. */
bool tick_log_close(tick_log *log, bool whole, octreel_error *error);

#endif
