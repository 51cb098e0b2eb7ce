/* worker.c - see worker.h. */
#include "worker.h"

#include <fenv.h>
#include <signal.h>
#include <stddef.h>

static void *run(void *context)
{
    const worker *w = context;
    fesetenv(FE_DFL_ENV); /* a thread begins with the mode of the one that started it */
    w->work(w->context);
    return NULL;
}

bool worker_start(worker *w, void (*work)(void *context), void *context)
{
    sigset_t all, before;
    w->work = work;
    w->context = context;
    sigfillset(&all);
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0) /* a thread begins with that of its maker, too */
        return false;
    const bool started = pthread_create(&w->thread, NULL, run, w) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

void worker_join(worker *w)
{
    pthread_join(w->thread, NULL);
}
