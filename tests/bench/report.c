/* SPDX-License-Identifier: MIT */
/* report.c - prints the measurements: a table for people, and one JSON object per line for programs. */
#include "report.h"

#include <stdio.h>

void report_heading(const workload *w, int rounds)
{
    printf("\n%zu %s points: CPU nanoseconds an operation, the median of %d round%s\n", w->count, w->name, rounds,
           rounds == 1 ? "" : "s");
    printf("%-16s %10s %8s %12s  %-16s %6s  %s\n", "operation", "octree", "bytes", "best other", "who", "ratio",
           "goal");
}

static const contender *best_other(const lineup *l)
{
    const contender *best = l->count > 1 ? &l->of[1] : NULL;
    for (int i = 2; i < l->count; i++)
        if (l->of[i].ns < best->ns)
            best = &l->of[i];
    return best;
}

static void print_goal(goal wanted, double ratio)
{
    if (wanted.kind == NO_GOAL)
        return;
    const bool least = wanted.kind == AT_LEAST;
    const bool holds = least ? ratio >= wanted.ratio : ratio <= wanted.ratio;
    printf("  %s %.3g %s", least ? ">=" : "<=", wanted.ratio, holds ? "holds" : "missed");
}

void report_row(const op *o, const workload *w, const lineup *l, void *context)
{
    (void)w;
    (void)context;
    const contender *mine = &l->of[0], *other = best_other(l);
    printf("%-16s %10.1f %8.1f", o->name, mine->ns, (double)mine->memory / (double)mine->points);
    if (other) {
        printf(" %12.1f  %-16s %6.2f", other->ns, other->who, other->ns / mine->ns);
        print_goal(o->goal, other->ns / mine->ns);
    }
    if (o->note)
        printf("  (%s)", o->note);
    putchar('\n');
    fflush(stdout);
}

void report_json(const op *o, const workload *w, const lineup *l, void *context)
{
    (void)context;
    for (int i = 0; i < l->count; i++) {
        const contender *c = &l->of[i];
        printf("{\"op\":\"%s\",\"set\":\"%s\",\"n\":%zu,\"who\":\"%s\",\"ns\":%.1f,\"bytes_per_point\":%.1f}\n",
               o->name, w->name, w->count, c->who, c->ns, (double)c->memory / (double)c->points);
    }
    fflush(stdout);
}
