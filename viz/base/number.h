/* SPDX-License-Identifier: MIT */
/* number.h - converts doubles to decimal text and back, independently of the locale.
 *
 * Reading is correctly rounded. Text that number_print() wrote reads back to the same bits.
 */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Read a decimal number at `begin`: an optional sign, digits with an optional point, and an optional exponent ("1",
 * "-.5", "+2.", "1e-3"). No whitespace is skipped, and no character at `limit` or beyond is read. *end becomes the
 * first character after the number. Returns false and leaves *value unchanged if
 * - there is no number, as in "nan" and "inf": *end is `begin` (in "0x10" the number is 0);
 * - the number is larger than the largest double: *end is after it, and errno is ERANGE;
 * - memory runs out, which needs more than about 100 characters: *end is after it, and errno is ENOMEM. */
bool number_parse(const char *begin, const char *limit, const char **end, double *value);

/* True if the text at `begin` is a NaN or infinity as C prints them, in upper or lower case: "nan", "-nan(ind)", "inf",
 * "Infinity". *end becomes the first character after it, or `begin`. */
bool number_parse_nonfinite(const char *begin, const char *limit, const char **end);

/* Read a whole text as `count` numbers separated by commas. On failure, returns false and may have changed *values. */
bool numbers_parse(const char *text, double *values, size_t count);

/* Read a decimal whole number at *text and move *text past it. False: a sign, no digits, or more than `max`. */
bool whole_number_parse(const char **text, uint64_t max, uint64_t *value);

/* The value of a numeric macro as a string literal. */
#define NUMBER_DIGITS(macro) NUMBER_DIGITS_OF(macro)
#define NUMBER_DIGITS_OF(number) #number

/* Room for the text of any number and a final zero. */
#define NUMBER_TEXT 32

/* Write a finite double as the shortest of %.15g, %.16g and %.17g that reads back to the same bits: a '.' for the
 * point, no point in integers, "-0" for minus zero. Returns the length. */
size_t number_print(double value, char text[NUMBER_TEXT]);

/* Returns the double with the fewest decimal digits that rounds to a finite float: 0.1 for 0.1f. At most FLT_MAX. */
double number_from_float(float value);

/* Write a double with at most `digits` significant digits. Returns `text`. */
const char *number_format(double value, int digits, char text[NUMBER_TEXT]);

/* Returns the smallest number of the form 1, 2 or 5 times a power of ten that is at least `limit`; 0 if it underflows
 * or overflows. */
double number_round_up_to_1_2_5(double limit);

#endif
