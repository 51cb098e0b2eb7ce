/* query_options.h - queries on a command line. */
#ifndef CLI_QUERY_OPTIONS_H
#define CLI_QUERY_OPTIONS_H

#include "octree/game.h"

/* Read a query as in --nearest X,Y,Z[,K], --radius X,Y,Z,R and --range X0,Y0,Z0,X1,Y1,Z1. False, with the sentence
 * printed, where `text` does not fit. */
bool read_nearest(const char *text, octree_query *query);
bool read_radius(const char *text, octree_query *query);
bool read_range(const char *text, octree_query *query);

#endif
