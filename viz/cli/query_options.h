/* SPDX-License-Identifier: MIT */
/* query_options.h - the options that ask queries: --ray, --nearest, --radius, --range. */
#ifndef CLI_QUERY_OPTIONS_H
#define CLI_QUERY_OPTIONS_H

#include "octree/game.h"
#include "options.h"

#define MOST_QUERIES 100

/* The queries on a command line, in the order in which they were given. */
typedef struct query_options {
    octree_query items[MOST_QUERIES];
    size_t count;
} query_options;

option_table_row query_option_row;

#endif
