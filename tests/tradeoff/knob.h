/* SPDX-License-Identifier: MIT */
/* knob.h - what trades speed for accuracy: one table of knobs, one file for each. */
#ifndef TRADEOFF_KNOB_H
#define TRADEOFF_KNOB_H

#include "table.h"
#include "workload.h"

/* How much is measured. */
typedef struct run {
    bool quick;
    int rounds;         /* of each timing */
    const char *folder; /* where files go */
    workloads *loads;
} run;

/* A chart of the page. Its series are the scenes of the table, or the variants; the page asks which of the others to
 * show. */
typedef struct chart {
    const char *title;
    const char *x, *y;             /* columns */
    const char *x_label, *y_label; /* with units; null: the meaning of the column */
    const char *bound;             /* the column of the proven bound of y; null: none */
    bool x_log, y_log, by_variant;
    bool matrix; /* instead of a chart: scenes by variants, a verdict in each cell */
} chart;

/* What a knob buys: the cost of an accurate setting, divided by the cost of a fast one. */
typedef struct gain {
    const char *what;
    pick slow, fast;  /* if the setting of `fast` is NaN, the one with the largest gain */
    const char *cost; /* a column */
} gain;

typedef struct knob {
    const char *name; /* of its files, and for --knob */
    const char *title;
    const char *trades; /* what for what */
    const char *preset; /* the default */
    const char *proven; /* the bound, and where it is from */
    const char *truth;  /* what is compared with */
    const column *columns;
    size_t column_count;
    const chart *charts;
    size_t chart_count;
    const gain *gains;
    size_t gain_count;
    void (*measure)(const run *r, table *t);
    void (*tell)(const table *t, FILE *out);   /* the headline: one sentence, computed from the data */
    void (*defend)(const table *t, FILE *out); /* why the default is kept, computed from the data */
} knob;

extern const knob knob_index, knob_breaks, knob_mode, knob_nearest_epsilon, knob_range_epsilon, knob_leaf, knob_float,
    knob_sweep, knob_tick, knob_fill, knob_picture, knob_png, knob_shade, knob_diff;

#endif
