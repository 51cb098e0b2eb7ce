/* timing.c - see timing.h. */
#include "timing.h"

#include <stdlib.h>
#include <time.h>

#include "trouble.h"

double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void time_in_turn(timed_work *work, void *contestants, size_t size, size_t count, int rounds, double *ns)
{
    double all[CONTESTANTS_AT_MOST][ROUNDS_AT_MOST];
    if (count > CONTESTANTS_AT_MOST || rounds > ROUNDS_AT_MOST)
        stop("there are too many contestants or rounds");
    for (int round = 0; round < rounds; round++)
        for (size_t i = 0; i < count; i++) {
            const double start = processor_time();
            work((char *)contestants + i * size);
            all[i][round] = processor_time() - start;
        }
    for (size_t i = 0; i < count; i++) {
        qsort(all[i], (size_t)rounds, sizeof all[i][0], by_value);
        ns[i] = (all[i][(rounds - 1) / 2] + all[i][rounds / 2]) / 2;
    }
}
