/* SPDX-License-Identifier: MIT */
/* watcher.h - callbacks by which a caller follows the progress of a long task and stops the task. */
#ifndef BASE_WATCHER_H
#define BASE_WATCHER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct watcher {
    void (*progress)(uint64_t done, uint64_t total, void *context); /* called after each step; may be null */
    bool (*keep_going)(void *context); /* called between steps; if it returns false, the task stops; may be null */
    void *context;
} watcher;

/* Reports progress. `w` may be null. */
static inline void watcher_report(const watcher *w, uint64_t done, uint64_t total)
{
    if (w && w->progress)
        w->progress(done, total, w->context);
}

/* Returns whether the task should continue. `w` may be null. */
static inline bool watcher_continues(const watcher *w)
{
    return !w || !w->keep_going || w->keep_going(w->context);
}

#endif
