/* SPDX-License-Identifier: MIT */
/* fixture.h - helpers of most tests: cmocka, small trees, random numbers, neighbouring doubles. */
#ifndef FIXTURE_H
#define FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "octree/octree.h"

/* The box [low, high] on every axis. */
octree_box cube(double low, double high);

/* A definition that uses malloc; with a shuffled executor if the environment has OCTREE_TEST_EXECUTOR. */
octree_def define(octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf);

/* A new tree; the test fails if it cannot be created. */
octree *make_tree(octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf);

/* Insert points with ids from 1 on; the test fails if one is refused. */
void insert_all(octree *tree, const double (*positions)[3], size_t count);

/* The test fails with the sentence of octree_check() if an invariant does not hold. */
void assert_valid(const octree *tree);

/* The test fails unless the text contains a part; a null text fails. */
void assert_contains(const char *text, const char *part);

/* The number of nodes of a tree. */
size_t node_count(const octree *tree);

/* The next double above and below. */
double next_up(double value);
double next_down(double value);

/* A random whole number below `limit`, and a random double in [low, high]; the range may be wider than DBL_MAX. */
uint64_t random_below(uint64_t *state, uint64_t limit);
double random_between(uint64_t *state, double low, double high);

/* A random number from a list of critical ones: 0, the smallest subnormal, ..., DBL_MAX, with either sign. */
double random_extreme(uint64_t *state);

/* Whether coordinates are equal as numbers (-0.0 is +0.0), and whether a closed box holds a position. */
bool same_position(const double a[3], const double b[3]);
bool box_holds(const octree_box *box, const double position[3]);

#endif
