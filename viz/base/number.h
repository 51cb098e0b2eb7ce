/* SPDX-License-Identifier: MIT */
/* number.h - doubles as decimal text and back, whatever the locale.
 *
 * Reading is correctly rounded; what number_print() wrote reads back to the same bits.
 */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Read the decimal number that starts at begin, no blanks before it, and never look at limit or beyond: a sign or
 * none, digits with a point or none, an exponent or none ("1", "-.5", "+2.", "1e-3"). *end is the first character
 * that is not part of it. False when there is none (*end is then begin: so for "nan", "inf" and the like; of "0x10"
 * it reads the 0), when it is beyond the largest double (*end is then after it, and errno is ERANGE), or when there is
 * no memory (the same with ENOMEM), which numbers of up to a hundred letters do not take; *value is then untouched. */
bool number_parse(const char *begin, const char *limit, const char **end, double *value);

/* True when begin starts with what C prints for a NaN or an infinity, in any case: "nan", "-nan(ind)", "inf",
 * "Infinity". *end is the first character after it, or begin. */
bool number_parse_nonfinite(const char *begin, const char *limit, const char **end);

/* Read a whole text as `count` numbers with commas between. False, and *values may then be changed, when it is none. */
bool numbers_parse(const char *text, double *values, size_t count);

/* Read a decimal whole number at *text, which is moved past it. False on a sign, no digits, or more than `max`. */
bool whole_parse(const char **text, uint64_t max, uint64_t *value);

/* The digits of a macro that is a plain number, for text that is put together when it is compiled. */
#define NUMBER_DIGITS(macro) NUMBER_DIGITS_OF(macro)
#define NUMBER_DIGITS_OF(number) #number

/* Room for any number's text, with its final zero. */
#define NUMBER_TEXT 32

/* Write a finite double as the shortest of %.15g, %.16g and %.17g that reads back to the same bits: a '.' for the
 * point, no point in integers, "-0" for minus zero. Returns the length. */
size_t number_print(double value, char text[NUMBER_TEXT]);

/* A finite float as the double of the fewest digits that rounds to it, and is no larger than FLT_MAX: 0.1f as 0.1. */
double number_from_float(float value);

/* Write a double with at most so many significant digits, as people read it. Returns `text`. */
const char *number_text(double value, int digits, char text[NUMBER_TEXT]);

/* The smallest of 1, 2 and 5 times a power of ten that is at least `limit`; 0 where doubles end, at either side. */
double number_round_up(double limit);

#endif
