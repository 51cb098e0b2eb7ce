/* SPDX-License-Identifier: MIT */
/* query_looks.h - how each kind of query is shown and asked on the command line, one row each.
 *
 * A kind is a row of OCTREE_QUERY_MAP (octree/query.h) and a row here. Its layer_type is in viz/layers.
 */
#ifndef SCENE_QUERY_LOOKS_H
#define SCENE_QUERY_LOOKS_H

/* For each kind: its name, its layer in words and in --help, its colour (a row
 * of theme.h, which kinds may share); then its option of octreel inspect:
 * the values in --help (null: the kind has no option of its own), the kind that is asked if one more number is given,
 * the text in --help, and what the option expects, for error messages. In painter's order. Each row calls
 * Y(X, row), so that the tables of layers and options can take their columns. */
#define QUERY_LOOKS(Y, X)                                                                                              \
    Y(X, RANGE, "range", "range queries", "boxes that are asked for, and the points found", ROLE_RANGE,                \
      "X0,Y0,Z0,X1,Y1,Z1", RANGE, "print and draw the points in a box; queries can be given several times",            \
      "two corners as in -10,-10,-10,10,10,10")                                                                        \
    Y(X, RADIUS, "radius", "radius queries", "balls that are asked for, and the points found", ROLE_RADIUS, "X,Y,Z,R", \
      RADIUS, "print and draw the points within R of a place", "a centre and a radius as in 1,2,3,10")                 \
    Y(X, KNEAREST, "knearest", "k-nearest queries", "lines to the k nearest points, with their ranks", ROLE_KNEAREST,  \
      NULL, KNEAREST, NULL, NULL)                                                                                      \
    Y(X, NEAREST, "nearest", "nearest queries", "a line to the nearest point", ROLE_NEAREST, "X,Y,Z[,K]", KNEAREST,    \
      "print and draw the point nearest to a place, or the K nearest",                                                 \
      "a place, and how many neighbours, where that is not 1, as in 1,2,3 or 1,2,3,8")

#define QUERY_LAYER(X, kind, name, words, help, role, ...) X(kind, name, words, help, role, false, true)

#endif
