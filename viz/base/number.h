/* SPDX-License-Identifier: MIT */
/* number.h - converts doubles to decimal text and back, independently of the locale.
 *
 * number_parse() rounds correctly. Text that number_print() wrote reads back to the same bits.
 */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Parses a decimal number at `begin`: an optional sign, digits with an optional point, and an optional exponent ("1",
 * "-.5", "+2.", "1e-3"). No whitespace is skipped, and no character at `limit` or beyond is read. *end becomes the
 * first character after the number. Returns false and leaves *value unchanged if
 * - there is no number, as in "nan" and "inf": *end is `begin` (in "0x10" the number is 0);
 * - the number is larger than the largest double: *end is after the number, and errno is ERANGE;
 * - memory runs out, possible for numbers of more than about 100 characters: *end is after the number, errno is
 * ENOMEM. */
bool number_parse(const char *begin, const char *limit, const char **end, double *value);

/* Returns whether the text at `begin` is a NaN or an infinity as C prints them, in upper or lower case: "nan",
 * "-nan(ind)", "inf", "Infinity". Sets *end to the first character after the text, or to `begin` if the result is
 * false. */
bool number_parse_nonfinite(const char *begin, const char *limit, const char **end);

/* Parses a whole text as `count` numbers separated by commas. Returns false if the text is invalid; *values may then
 * have changed. */
bool numbers_parse(const char *text, double *values, size_t count);

/* Parses a decimal whole number at *text and moves *text past the number. Returns false for a sign, for a text without
 * digits, and for a number above `max`. */
bool whole_number_parse(const char **text, uint64_t max, uint64_t *value);

/* Turns a macro whose value is a number into a string literal of this number. */
#define NUMBER_DIGITS(macro) NUMBER_DIGITS_OF(macro)
#define NUMBER_DIGITS_OF(number) #number

/* The size of a buffer for the text of any number and a final zero, in bytes. */
#define NUMBER_TEXT 32

/* Writes a finite double as the shortest of %.15g, %.16g and %.17g that reads back to the same bits. The decimal point
 * is always '.'; integers have no decimal point; minus zero is "-0". Returns the length of the text. */
size_t number_print(double value, char text[NUMBER_TEXT]);

/* Returns the double with the fewest decimal digits that rounds to a given finite float: 0.1 for 0.1f. The result is at
 * most FLT_MAX. */
double widen_float_as_printed(float value);

/* Writes a double with at most `digits` significant digits. Returns `text`. */
const char *number_format(double value, int digits, char text[NUMBER_TEXT]);

/* Returns the smallest number that is at least `limit` and is 1, 2 or 5 times a power of ten. Returns 0 if this
 * number underflows or overflows. */
double number_round_up_to_1_2_5(double limit);

#endif
