/* cause_value.h - the values of facts: a count, a number, a word, places. */
#ifndef DIFF_CAUSE_VALUE_H
#define DIFF_CAUSE_VALUE_H

#include "octree/octree.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum cause_type {
    VALUE_NONE,
    VALUE_WHOLE,
    VALUE_NUMBER,
    VALUE_WORD,
    VALUE_PLACE,   /* three numbers */
    VALUE_SEGMENT, /* one end, then the other */
    VALUE_BOX,     /* its min, then its max */
} cause_type;

typedef struct cause_value {
    cause_type type;
    uint64_t whole;
    double numbers[6];
    char word[48]; /* a label of a shape is one */
} cause_value;

cause_value cause_whole(uint64_t whole);
cause_value cause_number(double number);
cause_value cause_word(const char *word);
cause_value cause_place(const double place[3]);
cause_value cause_box(const octree_box *box);
cause_value cause_ends(cause_type type, const double from[3], const double to[3]); /* a segment or a box */

/* -1, 0 or 1, by the first that differ. The sign of zero counts: it is printed. */
int cause_order_numbers(const double *a, const double *b, size_t count);

bool cause_same_value(const cause_value *a, const cause_value *b);

/* "8", "0.5", "grow", "(1, 2, 3)", "(0, 0, 0) to (1, 1, 1)"; nothing for VALUE_NONE. */
void cause_print_value(FILE *out, const cause_value *value);

#endif
