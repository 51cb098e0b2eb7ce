/* SPDX-License-Identifier: MIT */
/* progress.h - how far a long task is, shown on a terminal; and signals that ask to end it. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

/* A bar on stderr where that is a terminal and not a dumb one, as TERM says, and nothing is to be quiet; nothing
 * otherwise. It is written over without escape sequences. */
typedef struct progress {
    const char *unit;
    double started, shown; /* seconds of the monotonic clock; 0: not yet */
    double fraction;       /* that was shown last, 0 to 1; below 0: there is no bar */
    int length;            /* of the line that is there */
    bool visible;
} progress;

/* `unit` says what is counted: "ticks". */
progress progress_start(const char *unit);

/* `total` 0: nobody knows how many come. */
void progress_show(progress *p, uint64_t done, uint64_t total);

/* Show a sentence beside the bar, which stays where it is: for a step that cannot be counted. */
void progress_say(progress *p, const char *format, ...);

/* Remove the bar. */
void progress_end(progress *p);

/* Seconds since the start. */
double progress_seconds(const progress *p);

/* A task that can be stopped: its progress is shown, and SIGHUP, SIGINT and SIGTERM are blocked, where they are not
 * ignored, until it has put its files in order. There is no handler: the task asks whether a signal is pending. */
typedef struct watch {
    progress progress;
    sigset_t held, before;
} watch;

watch watch_begin(const char *unit);

/* The task's callbacks; their context is the watch. */
void watch_progress(uint64_t done, uint64_t total, void *context);
bool watch_keep_going(void *context);

/* Unblock the signals. One that is pending ends the program by that signal, as its sender expects. */
void watch_end(const watch *w);

#endif
