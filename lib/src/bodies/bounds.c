/* SPDX-License-Identifier: MIT */
/* bounds.c - lower bounds of distances and times for the eight octants of a cell. */
#include "bounds.h"
#include "../query/search.h"

void bound_squares_of_octants(const double target[3], double scale, const cell_halves *h, double bounds[8])
{
    double gaps[3][2];
    for (int i = 0; i < 3; i++)
        for (int half = 0; half < 2; half++)
            gaps[i][half] = bound_gap(target[i], h->center[i][half], h->outer[i][half]) * scale;
    for (unsigned o = 0; o < 8; o++)
        bounds[o] = bound_square(gaps[0][o >> 2], gaps[1][o >> 1 & 1], gaps[2][o & 1]);
}

void bound_times_of_octants(const cast *c, const cell_halves *h, double bounds[8])
{
    time_span spans[3][2];
    for (int i = 0; i < 3; i++)
        for (int half = 0; half < 2; half++) {
            spans[i][half] = (time_span){0, c->length};
            narrow_span(&spans[i][half], c, i, h->center[i][half], h->outer[i][half]);
        }
    for (unsigned o = 0; o < 8; o++) {
        const time_span *x = &spans[0][o >> 2], *y = &spans[1][o >> 1 & 1], *z = &spans[2][o & 1];
        const time_span all = {larger(larger(x->enter, y->enter), z->enter),
                               -larger(larger(-x->leave, -y->leave), -z->leave)};
        bounds[o] = begin_of_span(&all);
    }
}
