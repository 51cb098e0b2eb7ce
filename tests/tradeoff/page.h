/* SPDX-License-Identifier: MIT */
/* page.h - tradeoff.html: all chapters on one page that needs no other file, and reading such a page again. */
#ifndef TRADEOFF_PAGE_H
#define TRADEOFF_PAGE_H

#include "knob.h"

/* Where and when the figures were measured. The texts are allocated. */
typedef struct measured_where {
    char *date, *machine, *compiler, *libraries, *points;
    bool quick;
    int rounds;
} measured_where;

/* A knob with its figures. */
typedef struct chapter {
    const knob *knob;
    table table;
    char *headline, *defence;
    size_t beyond; /* values beyond their bound */
} chapter;

/* Describe this machine, this build and this run. */
measured_where where_now(const run *r);
void where_free(measured_where *where);

/* Write a page. page.css and page.js, which lie beside the source, become part of it. */
void page_write(const char *path, const chapter *chapters, size_t count, const measured_where *where);

/* Read the whole text of a file, which must be freed. Stops the program if that fails. */
char *read_text(const char *path);

/* Read where a page's figures were measured. Stops the program if the text is no such page. */
measured_where page_read_where(const char *path, const char *text);

/* Read the table of a knob from a page. False if the page has none; stops the program if its columns are others. */
bool page_read_table(const char *path, const char *text, const knob *k, table *t);

#endif
