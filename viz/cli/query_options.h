/* SPDX-License-Identifier: MIT */
/* query_options.h - queries on a command line: --nearest, --radius, --range. */
#ifndef CLI_QUERY_OPTIONS_H
#define CLI_QUERY_OPTIONS_H

#include "octree/game.h"

#include <getopt.h>
#include <stdio.h>

#define QUERY_OPTION 512 /* the first of getopt's numbers for them */
#define MOST_QUERIES 100

/* The queries that were given, in their order. */
typedef struct query_options {
    octree_query items[MOST_QUERIES];
    size_t count;
} query_options;

/* Write the options where getopt_long will read them, at most one for each kind of query; returns their number. */
size_t list_query_options(struct option *options);

/* Whether an option that getopt_long found is one of them. */
bool is_query_option(int option);

/* Read one. False, with the sentence printed, where `text` does not fit. */
bool read_query(query_options *queries, int option, const char *text);

/* Their part of a --help text. */
void print_query_options(FILE *out);

#endif
