/* SPDX-License-Identifier: MIT */
/* progress.h - shows the progress of a long task on a terminal, and lets signals stop it in an orderly way. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

/* A progress bar on standard error. It is shown only on a terminal, not with TERM=dumb, and not with --quiet. It is
 * overwritten with carriage returns, without escape sequences. */
typedef struct progress {
    const char *unit;
    double started, shown; /* seconds of the monotonic clock; shown 0: not yet */
    double fraction;       /* shown last, 0 to 1; negative: no bar, since the total is unknown */
    int length;            /* length of the shown line */
    bool visible;
} progress;

/* `unit` names what is counted: "ticks". */
progress progress_start(const char *unit);

/* Update the bar, at most 10 times a second. `total` 0: unknown. */
void progress_show(progress *p, uint64_t done, uint64_t total);

/* Show a sentence beside the bar, for a step that cannot be counted. */
void progress_say(progress *p, const char *format, ...);

/* Erase the bar. */
void progress_end(progress *p);

/* Returns the seconds since progress_start(). */
double progress_seconds(const progress *p);

/* A task that signals can stop. SIGHUP, SIGINT and SIGTERM are blocked, unless they are ignored, so that the task can
 * finish its files. There is no signal handler: watch_keep_going() asks whether a signal is pending. */
typedef struct watch {
    progress progress;
    sigset_t held, before;
} watch;

watch watch_begin(const char *unit);

/* Callbacks for the task. Their context is the watch. */
void watch_progress(uint64_t done, uint64_t total, void *context);
bool watch_keep_going(void *context);

/* Unblock the signals. A pending signal then ends the program, as its sender expects. */
void watch_end(const watch *w);

#endif
