/* SPDX-License-Identifier: MIT */
/* tick_log.h - appends lines to ticks.jsonl. The file never ends with an incomplete line, even if a write fails. */
#ifndef RECORD_TICK_LOG_H
#define RECORD_TICK_LOG_H

#include "folder.h"

#include <sys/types.h>

typedef struct tick_log {
    FILE *stream; /* null: the log is not open */
    char *path;
    off_t whole; /* offset of the end of the last complete line */
    /* Size in bytes of the earlier log, which may already contain the lines that are added next; 0: no earlier log. */
    off_t kept;
} tick_log;

/* Open a file in a folder and lock it. Without `keep` the file is truncated. With `keep`, old lines stay as long as the
 * added lines equal them, so a recording that is resumed and stopped early loses nothing. Returns false with an error
 * on failure, and also if another process, or another recording in this process, has the file open. */
bool tick_log_open(tick_log *log, const char *folder, const char *name, bool keep, octreel_error *error);

/* Append a line with its newline. If the line cannot be written completely, the written part is removed and the log is
 * closed. */
bool tick_log_add(tick_log *log, const char *line, size_t size, octreel_error *error);

/* Close a log, which may already be closed. If `whole` is true, the log is complete, and old lines after the last added
 * line are removed. */
bool tick_log_close(tick_log *log, bool whole, octreel_error *error);

#endif
