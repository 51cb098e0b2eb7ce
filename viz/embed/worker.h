/* worker.h - a thread that leaves the program's alone: its signals go to others, its floating-point mode is the
 * default, and what GL context the program has is not its own. Private to this folder. */
#ifndef EMBED_WORKER_H
#define EMBED_WORKER_H

#include <pthread.h>
#include <stdbool.h>

typedef struct worker {
    pthread_t thread;
    void (*work)(void *context);
    void *context;
} worker;

/* Start work; *w stays where it is until worker_join(). False when there is no thread. */
bool worker_start(worker *w, void (*work)(void *context), void *context);

/* Wait for its end. */
void worker_join(worker *w);

#endif
