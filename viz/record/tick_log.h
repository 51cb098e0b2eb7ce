/* SPDX-License-Identifier: MIT */
/* tick_log.h - appends to ticks.jsonl so that it has whole lines only, whatever happens. */
#ifndef RECORD_TICK_LOG_H
#define RECORD_TICK_LOG_H

#include "folder.h"

#include <sys/types.h>

typedef struct tick_log {
    FILE *stream; /* null: not open */
    char *path;
    off_t whole; /* the offset of the end of the last whole line */
    off_t kept;  /* the size of an earlier log, whose lines may be the next ones; 0: none */
} tick_log;

/* Open a file of a folder and lock it. It is emptied; with `keep`, old lines stay as long as the added lines are equal
 * to them, so that stopping early loses nothing. False also where another process or recorder has it open. */
bool tick_log_open(tick_log *log, const char *folder, const char *name, bool keep, octreel_error *error);

/* Append a line with its newline. If it cannot be written whole, it is cut off, and the log is closed. */
bool tick_log_add(tick_log *log, const char *line, size_t size, octreel_error *error);

/* Close a log, which may not be open. `whole`: the log is complete, so old lines after the last added one are removed.
 */
bool tick_log_close(tick_log *log, bool whole, octreel_error *error);

#endif
