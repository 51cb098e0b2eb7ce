/* watch.c - a long work is watched: its progress is shown, and signals that ask to end it are held back until it has
 * put things in order. */
#include "command.h"

static const int signals[] = {SIGHUP, SIGINT, SIGTERM};

#define SIGNALS (sizeof signals / sizeof signals[0])

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

watch watch_begin(const char *unit)
{
    watch w = {.progress = progress_start(unit)};
    sigemptyset(&w.held);
    for (size_t i = 0; i < SIGNALS; i++)
        if (!is_ignored(signals[i])) /* as under nohup: it stays so */
            sigaddset(&w.held, signals[i]);
    sigprocmask(SIG_BLOCK, &w.held, &w.before);
    return w;
}

void watch_progress(uint64_t done, uint64_t total, void *context)
{
    watch *w = context;
    progress_show(&w->progress, done, total);
}

bool watch_keep_going(void *context)
{
    const watch *w = context;
    sigset_t pending;
    if (sigpending(&pending) != 0)
        return true;
    for (size_t i = 0; i < SIGNALS; i++)
        if (sigismember(&w->held, signals[i]) == 1 && sigismember(&pending, signals[i]) == 1)
            return false;
    return true;
}

void watch_end(const watch *w)
{
    sigprocmask(SIG_SETMASK, &w->before, NULL);
}
