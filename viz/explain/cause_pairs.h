/* SPDX-License-Identifier: MIT */
/* cause_pairs.h - which element of a list belongs to which of another, where they have no ids: queries, shapes and
 * answers. */
#ifndef EXPLAIN_CAUSE_PAIRS_H
#define EXPLAIN_CAUSE_PAIRS_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#define CAUSE_ALONE SIZE_MAX

/* Write the place in `a` that each element of `b` belongs to, or CAUSE_ALONE: the same element; else one of the same
 * kind, which is the name of its first member, that has most values in common with it. No place is written twice.
 * False when there is no memory. Cost: O(n log n), for at most PAIR_CANDIDATES of a kind are looked at for each. */
bool cause_pair(json_t *a, json_t *b, size_t *mates);

/* The name of an element's first member: a query's, a shape's or an answer's kind; "" where it has none. */
const char *cause_kind_of(json_t *element);

#endif
