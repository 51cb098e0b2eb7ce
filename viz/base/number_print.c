/* SPDX-License-Identifier: MIT */
/* number_print.c - prints doubles as the shortest of %.15g, %.16g and %.17g that reads back to the same bits.
 *
 * The plain method prints 15 digits, reads them back with strtod(), and tries 16 and 17 digits if the bits differ. That
 * doubles the time for recording 100,000 points.
 *
 * Numbers from 2^-7 to 1e14 are therefore printed with integer arithmetic. The fraction becomes a 60-bit fixed-point
 * number, which represents it exactly. Multiplying the fraction by ten moves the next digit in front of the point, and
 * nothing is rounded on the way. `half_last`, half of the double's last bit, is multiplied by ten as well. The digits
 * read back to the same double if their error is less than `half_last`, so no strtod() is needed.
 *
 * All other numbers are printed with printf. General algorithms (Ryu, Grisu) need tables of large powers for exponents
 * that are rare here. Cost: a few divisions.
 */
#include "number.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Printing with integers --------------------------------------------------------------------------------- */

enum {
    FEWEST_DIGITS = 15, /* a decimal number of 15 digits always survives conversion to double and back */
    HALF_BITS = 30,     /* number of bits in half of the fraction: such a half times 10^9 fits into 64 bits */
    FRACTION_BITS = 2 * HALF_BITS,
    MOST_AT_ONCE = 9, /* maximum number of digits that append_digits() moves at once */
};

#define FRACTION_ONE (UINT64_C(1) << FRACTION_BITS)
#define HALF_MASK ((UINT64_C(1) << HALF_BITS) - 1)

/* The limits of the numbers that are printed with integers. From SMALLEST_PLAIN on, half of a double's last bit is an
 * integer multiple of 2^-60. Below LARGEST_PLAIN, the 15th digit lies after the decimal point. */
#define SMALLEST_PLAIN 0x1p-7
#define LARGEST_PLAIN 1e14

static const uint64_t powers[] = {1,           10,           100,           1000,           10000,
                                  100000,      1000000,      10000000,      100000000,      1000000000,
                                  10000000000, 100000000000, 1000000000000, 10000000000000, 100000000000000};

/* The exact expansion of a number between SMALLEST_PLAIN and LARGEST_PLAIN: the digits found so far, as one integer,
 * and the remaining fraction. */
typedef struct expansion {
    uint64_t digits;
    /* if >= 0, the number of significant digits found so far; if negative, minus the number of zeros after the decimal
     * point that are still to be skipped */
    int count;
    int places; /* the number of digits after the decimal point */
    /* the part of the number after the digits found so far, as a fraction of one unit of the last digit; FRACTION_ONE
     * is 1 */
    uint64_t rest;
    uint64_t half_last; /* half of the double's last bit, in the same unit as `rest` */
    bool even;          /* true: the double's last bit is 0, so that a tie reads back as this double */
} expansion;

static expansion begin_expansion(double magnitude)
{
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    const int exponent = (int)(bits >> (DBL_MANT_DIG - 1)) - (DBL_MAX_EXP - 1);
    const uint64_t whole = (uint64_t)magnitude;
    expansion x = {.digits = whole,
                   .rest = (uint64_t)((magnitude - (double)whole) * (double)FRACTION_ONE),
                   .half_last = UINT64_C(1) << (exponent + FRACTION_BITS - DBL_MANT_DIG),
                   .even = bits % 2 == 0};
    if (whole == 0)
        /* skip zeros directly after the decimal point, which are not significant */
        x.count = magnitude < 0.01 ? -2 : magnitude < 0.1 ? -1 : 0;
    else
        while (x.count < FEWEST_DIGITS && powers[x.count] <= whole)
            x.count++;
    return x;
}

/* Moves the next `count` digits from the fraction x->rest to x->digits. */
static void append_digits(expansion *x, int count)
{
    const uint64_t power = powers[count], low = (x->rest & HALF_MASK) * power,
                   high = (x->rest >> HALF_BITS) * power + (low >> HALF_BITS);
    x->rest = (high & HALF_MASK) << HALF_BITS | (low & HALF_MASK);
    x->half_last *= power;
    x->digits = x->digits * power + (high >> HALF_BITS);
    x->count += count;
    x->places += count;
}

/* Returns whether the remaining fraction rounds the digits up. A tie rounds to the even digit, as in printf. */
static bool is_rounded_up(const expansion *x)
{
    return x->rest > FRACTION_ONE / 2 || (x->rest == FRACTION_ONE / 2 && x->digits % 2 != 0);
}

/* Returns whether the rounded digits read back to the same double: their error must be at most half of the double's
 * last bit. Just below a power of two the spacing of doubles is only half as large. Powers of two need no special case:
 * between SMALLEST_PLAIN and LARGEST_PLAIN, they have at most 14 digits. */
static bool has_enough_digits(const expansion *x)
{
    const uint64_t off = is_rounded_up(x) ? FRACTION_ONE - x->rest : x->rest;
    return off < x->half_last || (off == x->half_last && x->even);
}

/* Returns the fewest digits, at least 15, that read back to the same double, without trailing zeros. */
static expansion find_shortest_digits(double magnitude)
{
    expansion x = begin_expansion(magnitude);
    while (x.count < FEWEST_DIGITS) {
        const int left = FEWEST_DIGITS - x.count;
        append_digits(&x, left < MOST_AT_ONCE ? left : MOST_AT_ONCE);
    }
    while (x.count < DBL_DECIMAL_DIG && !has_enough_digits(&x))
        append_digits(&x, 1);
    x.digits += is_rounded_up(&x);
    for (; x.places > 0 && x.digits % 10 == 0; x.places--)
        x.digits /= 10;
    return x;
}

/* Writes the last `count` digits of *digits in front of `end`, and removes these digits from *digits. Returns where the
 * written digits begin. */
static char *write_digits(char *end, uint64_t *digits, int count)
{
    static const char pairs[] = "00010203040506070809101112131415161718192021222324252627282930313233343536373839"
                                "40414243444546474849505152535455565758596061626364656667686970717273747576777879"
                                "8081828384858687888990919293949596979899";
    for (; count > 1; count -= 2, *digits /= 100)
        memcpy(end -= 2, pairs + *digits % 100 * 2, 2);
    if (count > 0) {
        *--end = (char)('0' + *digits % 10);
        *digits /= 10;
    }
    return end;
}

/* Prints a number as %g does, without an exponent. Returns the length, or 0 if the number is not between
 * SMALLEST_PLAIN and LARGEST_PLAIN. */
static size_t print_with_integers(double value, char text[NUMBER_TEXT])
{
    expansion x = {.digits = 0};
    const double magnitude = fabs(value);
    if (value != 0 && !(magnitude >= SMALLEST_PLAIN && magnitude < LARGEST_PLAIN))
        return 0;
    if (value != 0)
        x = find_shortest_digits(magnitude);
    char room[NUMBER_TEXT], *const end = room + sizeof room, *at = end;
    if (x.places > 0) {
        at = write_digits(at, &x.digits, x.places);
        *--at = '.';
    }
    do
        at = write_digits(at, &x.digits, 1);
    while (x.digits > 0);
    if (signbit(value))
        *--at = '-';
    const size_t size = (size_t)(end - at);
    memcpy(text, at, size);
    text[size] = 0;
    return size;
}

/* ---- Printing with printf ----------------------------------------------------------------------------------- */

/* Replaces the locale's decimal point, which may be several bytes long, by '.'. Returns the new length. */
static size_t replace_locale_point(char *text)
{
    char *point = text + strspn(text, "-0123456789");
    size_t foreign = strcspn(point, "+-0123456789e");
    if (foreign == 0)
        return strlen(text);
    *point = '.';
    memmove(point + 1, point + foreign, strlen(point + foreign) + 1);
    return strlen(text);
}

size_t number_print(double value, char text[NUMBER_TEXT])
{
    const size_t size = print_with_integers(value, text);
    if (size > 0)
        return size;
    for (int digits = FEWEST_DIGITS; digits < DBL_DECIMAL_DIG; digits++) {
        snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return replace_locale_point(text);
    }
    snprintf(text, NUMBER_TEXT, "%.*g", DBL_DECIMAL_DIG, value);
    return replace_locale_point(text);
}

const char *number_format(double value, int digits, char text[NUMBER_TEXT])
{
    snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
    replace_locale_point(text);
    return text;
}

double number_round_up_to_1_2_5(double limit)
{
    double power = 1;
    while (power > limit)
        power /= 10;
    while (power > 0 && isfinite(power) && power * 10 <= limit)
        power *= 10;
    const double steps[] = {power, 2 * power, 5 * power, 10 * power};
    for (int i = 0; i < 4; i++)
        if (steps[i] >= limit && isfinite(steps[i]))
            return steps[i];
    return 0;
}

double widen_float_as_printed(float value)
{
    for (int digits = FLT_DIG; digits < FLT_DECIMAL_DIG; digits++) {
        char text[NUMBER_TEXT];
        const char *end;
        double shorter;
        number_format((double)value, digits, text);
        if (number_parse(text, text + strlen(text), &end, &shorter) && fabs(shorter) <= FLT_MAX &&
            (float)shorter == value)
            return shorter;
    }
    return (double)value;
}
