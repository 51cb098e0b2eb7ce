/* SPDX-License-Identifier: MIT */
/* query_looks.h - how each kind of query is drawn, and its option on the command line.
 *
 * Each kind has a row in OCTREE_QUERY_MAP (octree/query.h), a row here, and a layer_type in viz/layers. */
#ifndef SCENE_QUERY_LOOKS_H
#define SCENE_QUERY_LOOKS_H

/* One row for each kind of query, in painter's order. The first columns describe the layer of the query kind: its name,
 * a phrase for it in sentences, its description in --help, and its colour (a row of theme.h; kinds may share a colour).
 *
 * The next columns describe the option of octreel inspect that makes such a query. They are: the option's value in
 * --help (null: the kind has no option of its own); the query kind that the option makes if its value has more numbers
 * than this kind; the option's description in --help; and a phrase for the expected value, for error messages.
 *
 * Each row calls Y(X, row...): the tables of layers and of options pass a Y that selects their columns. */
#define QUERY_LOOKS(Y, X)                                                                                              \
    Y(X, RANGE, "range", "range queries", "boxes of range queries, and the points found in them", ROLE_RANGE,          \
      "X0,Y0,Z0,X1,Y1,Z1", RANGE,                                                                                      \
      "print and draw the points in a box; this and other query options can be given several times",                   \
      "two corners as in -10,-10,-10,10,10,10")                                                                        \
    Y(X, RADIUS, "radius", "radius queries", "balls of radius queries, and the points found in them", ROLE_RADIUS,     \
      "X,Y,Z,R", RADIUS, "print and draw the points at a distance of at most R from a position",                       \
      "a centre and a radius as in 1,2,3,10")                                                                          \
    Y(X, KNEAREST, "knearest", "k-nearest queries", "lines to the k nearest points, with their ranks", ROLE_KNEAREST,  \
      NULL, KNEAREST, NULL, NULL)                                                                                      \
    Y(X, NEAREST, "nearest", "nearest queries", "a line to the nearest point", ROLE_NEAREST, "X,Y,Z[,K]", KNEAREST,    \
      "print and draw the point nearest to a position, or the K nearest points",                                       \
      "a position, and the number of neighbours if it is not 1, as in 1,2,3 or 1,2,3,8")                               \
    Y(X, RAY, "ray", "rays", "rays, the places at which they hit points, and the ranks of these hits", ROLE_RADIUS,    \
      "X,Y,Z,DX,DY,DZ[,K[,THICKNESS[,LENGTH]]]", RAY,                                                                  \
      "print and draw the first point that a ray from a position in a direction hits, or the first K points. A point " \
      "is hit if it is at most THICKNESS from the ray on each axis (if missing: chosen from the sizes of the "         \
      "leaves). "                                                                                                      \
      "The ray ends after LENGTH times the direction, or never",                                                       \
      "a position, a direction, and optionally the number of hits, the thickness and the length of the ray, as in "    \
      "0,0,0,1,0,0 or 0,0,0,1,0,0,8,0.5,100")                                                                          \
    Y(X, FRUSTUM, "frustum", "frustum queries", "edges of frusta, and the points found in them", ROLE_RANGE,           \
      "NX,NY,NZ,D[,NX,NY,NZ,D...]", FRUSTUM,                                                                           \
      "print and draw the points in up to 8 half-spaces: those with NX*x + NY*y + NZ*z <= D for each",                 \
      "1 to 8 half-spaces of four numbers each, as in 1,0,0,10,0,1,0,10")                                              \
    Y(X, SWEEP, "sweep", "sweep queries", "moving boxes, and the points that they hit, with their ranks", ROLE_RADIUS, \
      NULL, SWEEP, NULL, NULL)

#define QUERY_LAYER(X, kind, name, words, help, role, ...) X(kind, name, words, help, role, false, true)

#endif
