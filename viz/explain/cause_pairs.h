/* SPDX-License-Identifier: MIT */
/* cause_pairs.h - pairs the elements of two lists that have no ids: queries, shapes and answers. */
#ifndef EXPLAIN_CAUSE_PAIRS_H
#define EXPLAIN_CAUSE_PAIRS_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#define CAUSE_ALONE SIZE_MAX

/* For each element of `b`, write the index of its partner in `a`, or CAUSE_ALONE. The partner is an equal element
 * or, if there is none, a similar element of the same kind (see cause_pairs.c). No element is the partner of two
 * others. Return false if memory runs out. Cost: O(n log n). */
bool cause_pair_elements(json_t *a, json_t *b, size_t *mates);

/* Return the kind of a query, a shape or an answer: the name of its first member, or "" if it has no member. */
const char *cause_kind_of(json_t *element);

#endif
