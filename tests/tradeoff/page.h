/* SPDX-License-Identifier: MIT */
/* page.h - tradeoff.html: all knobs on one page that needs no other file. */
#ifndef TRADEOFF_PAGE_H
#define TRADEOFF_PAGE_H

#include "knob.h"

/* What became of a knob. */
typedef struct chapter {
    const knob *knob;
    table table;
    char *headline, *defence;
    size_t beyond; /* values beyond their bound */
} chapter;

/* Write <folder>/tradeoff.html; the plots, where there are any, are taken in from the folder. */
void page_write(const chapter *chapters, size_t count, const run *r, bool plotted);

#endif
