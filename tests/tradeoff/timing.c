/* SPDX-License-Identifier: MIT */
/* timing.c - see timing.h. */
#include "timing.h"

#include "measuring.h"
#include "program.h"

void time_with_spread(timed_work *work, void *contestants, size_t size, size_t count, int rounds, double *ns,
                      double *spread)
{
    static double all[CONTESTANTS_AT_MOST][ROUNDS_AT_MOST];
    if (count > CONTESTANTS_AT_MOST || rounds > ROUNDS_AT_MOST)
        stop_with_error("there are too many contestants or rounds");
    for (int round = 0; round < rounds; round++)
        for (size_t i = 0; i < count; i++) {
            const double start = processor_time();
            work((char *)contestants + i * size);
            all[i][round] = processor_time() - start;
        }
    for (size_t i = 0; i < count; i++) {
        ns[i] = median(all[i], (size_t)rounds); /* which sorts */
        if (spread)
            spread[i] = (all[i][3 * rounds / 4] - all[i][rounds / 4]) / ns[i];
    }
}

void time_in_turn(timed_work *work, void *contestants, size_t size, size_t count, int rounds, double *ns)
{
    time_with_spread(work, contestants, size, count, rounds, ns, NULL);
}
