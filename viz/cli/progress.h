/* SPDX-License-Identifier: MIT */
/* progress.h - a progress bar for long tasks, and stop signals that take effect only when the files of a task are
 * complete. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

/* A progress bar on standard error. It is shown only if standard error is a terminal, TERM is not "dumb" and --quiet
 * was not given. A carriage return precedes each new bar, which overwrites the old bar. No escape sequences are
 * printed. */
typedef struct progress {
    const char *unit;
    /* The time when the task was started, and the time when the bar was last updated, in seconds. `shown` is 0 before
     * the first update. */
    double started, shown;
    /* The fraction of the task that is done, 0 to 1. Negative: the fraction is unknown, so no bar is drawn. */
    double fraction;
    int length; /* the number of characters in the line on the terminal */
    bool visible;
} progress;

/* Starts a progress bar. `unit` names the steps that are counted, such as "ticks". */
progress progress_start(const char *unit);

/* Updates the bar, at most 10 times a second. A `total` of 0 means that the total is unknown. `context` points to a
 * `progress`, so that this function can be the callback of a task. */
void progress_show(uint64_t done, uint64_t total, void *context);

/* Shows a sentence beside the bar, for a step whose progress cannot be counted. */
void progress_show_sentence(progress *p, const char *format, ...);

/* Erases the bar from the terminal. */
void progress_end(progress *p);

/* Returns the number of seconds since progress_start(). */
double progress_seconds(const progress *p);

/* Signals that stop a task between two of its steps.
 *
 * After defer_stop_signals(), SIGHUP, SIGINT and SIGTERM are only recorded; a signal that was ignored stays ignored.
 * Between two steps the task calls has_no_stop_signal(), which returns false if a signal was recorded. The unused
 * parameter lets this function be a callback. After the task, deliver_stop_signal() restores the previous handlers; if
 * a signal was recorded, it raises the signal again, so that the program ends as the sender of the signal expects. If a
 * task does not stop within five seconds, for example because nobody reads its output, the signal ends the program. No
 * system call is interrupted. Children made by fork() record their own signals. */
void defer_stop_signals(void);
bool has_no_stop_signal(void *context);
void deliver_stop_signal(void);

#endif
