/* SPDX-License-Identifier: MIT */
/* plots.h - the picture of a knob: gnuplot runs plots/<knob>.gp on its CSV file. */
#ifndef TRADEOFF_PLOTS_H
#define TRADEOFF_PLOTS_H

#include <stdbool.h>

#include "knob.h"

/* Whether gnuplot runs here. */
bool plots_can(void);

/* Draw <folder>/<knob>.png from <folder>/<knob>.csv, or stop. */
void plot(const knob *k, const table *t, const char *folder);

#endif
