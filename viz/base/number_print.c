/* SPDX-License-Identifier: MIT */
/* number_print.c - doubles as the shortest decimal text that reads back, whatever the locale. Numbers of everyday size
 * are taken apart by integers alone, all others by printf: with printf alone, recording 100,000 points takes twice as
 * long. */
#include "number.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The digits of a number, "d.ddd..." times a power of ten. */
typedef struct printed {
    char digits[DBL_DECIMAL_DIG];
    int count, exponent;
    bool negative;
} printed;

/* As %g does where it needs no exponent. */
static size_t write_digits(const printed *d, char text[NUMBER_TEXT])
{
    int count = d->count;
    char *to = text;
    while (count > 1 && d->digits[count - 1] == '0')
        count--;
    const int before = d->exponent < 0 ? 0 : d->exponent + 1;
    if (d->negative)
        *to++ = '-';
    if (before == 0)
        *to++ = '0';
    for (int i = 0; i < before; i++)
        *to++ = i < count ? d->digits[i] : '0';
    if (count > before)
        *to++ = '.';
    for (int i = -1; before == 0 && i > d->exponent; i--)
        *to++ = '0';
    for (int i = before; i < count; i++)
        *to++ = d->digits[i];
    *to = 0;
    return (size_t)(to - text);
}

/* One more in the last place. */
static void round_up(printed *d)
{
    int at = d->count - 1;
    for (; at >= 0 && d->digits[at] == '9'; at--)
        d->digits[at] = '0';
    if (at >= 0) {
        d->digits[at]++;
        return;
    }
    d->digits[0] = '1'; /* 9.99 became 10.0 */
    d->exponent++;
}

/* ---- By integers -------------------------------------------------------------------------------------------- */

enum {
    FEWEST_DIGITS = 15, /* any so many survive a double */
    FRACTION_BITS = 60, /* a fixed point, below which four bits are free for a digit */
};

#define FRACTION_ONE (UINT64_C(1) << FRACTION_BITS)

/* From the first on, half of a number's last bit is above the last of the fraction's; up to the other, the 15th digit
 * lies after the point. */
#define SMALLEST_PLAIN 0x1p-7
#define LARGEST_PLAIN 1e14

/* A number between them, exactly: the digits that were taken so far, and what they leave. */
typedef struct expansion {
    printed taken;
    uint64_t rest;      /* of the last digit's unit, in parts of FRACTION_ONE */
    uint64_t half_last; /* half of what the number's last bit is worth, in the same */
    bool even;          /* that bit is not set: halfway reads as this number */
} expansion;

static expansion expand(double value)
{
    uint64_t bits;
    const double magnitude = fabs(value);
    memcpy(&bits, &magnitude, sizeof bits);
    const int exponent = (int)(bits >> (DBL_MANT_DIG - 1)) - (DBL_MAX_EXP - 1);
    uint64_t whole = (uint64_t)magnitude;
    expansion x = {.taken = {.negative = value < 0, .exponent = -1},
                   .rest = (uint64_t)((magnitude - (double)whole) * (double)FRACTION_ONE),
                   .half_last = UINT64_C(1) << (exponent + FRACTION_BITS - DBL_MANT_DIG),
                   .even = bits % 2 == 0};
    char digits[20];
    int count = 0;
    for (; whole > 0; whole /= 10)
        digits[count++] = (char)('0' + whole % 10);
    x.taken.exponent += count;
    while (count > 0)
        x.taken.digits[x.taken.count++] = digits[--count];
    return x;
}

/* Take the next digit after the point; zeros before the first are not significant. */
static void take_digit(expansion *x)
{
    x->rest *= 10;
    x->half_last *= 10;
    const unsigned digit = (unsigned)(x->rest >> FRACTION_BITS);
    x->rest &= FRACTION_ONE - 1;
    if (x->taken.count == 0 && digit == 0)
        x->taken.exponent--;
    else
        x->taken.digits[x->taken.count++] = (char)('0' + digit);
}

/* Whether what was taken is rounded up; halfway to the even digit, as printf does. */
static bool goes_up(const expansion *x)
{
    const bool odd = (x->taken.digits[x->taken.count - 1] - '0') % 2 != 0;
    return x->rest > FRACTION_ONE / 2 || (x->rest == FRACTION_ONE / 2 && odd);
}

/* Whether what was taken, rounded, reads back: it is no farther off than half the last bit. It does not
 * matter that below a power of two bits are worth less: those of this size have at most 14 digits. */
static bool reads_back(const expansion *x)
{
    const uint64_t off = goes_up(x) ? FRACTION_ONE - x->rest : x->rest;
    return off < x->half_last || (off == x->half_last && x->even);
}

/* False for numbers that are too large or too small for it. */
static bool print_exactly(double value, printed *shortest)
{
    if (value == 0) {
        *shortest = (printed){.digits = "0", .count = 1, .negative = signbit(value)};
        return true;
    }
    if (!(fabs(value) >= SMALLEST_PLAIN && fabs(value) < LARGEST_PLAIN))
        return false;
    expansion x = expand(value);
    while (x.taken.count < FEWEST_DIGITS)
        take_digit(&x);
    while (x.taken.count < DBL_DECIMAL_DIG && !reads_back(&x))
        take_digit(&x);
    *shortest = x.taken;
    if (goes_up(&x))
        round_up(shortest);
    return true;
}

/* ---- By printf ---------------------------------------------------------------------------------------------- */

/* Put a '.' where the locale's decimal point is, which may be several bytes. Returns the new length. */
static size_t restore_point(char *text)
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
    printed shortest;
    if (print_exactly(value, &shortest))
        return write_digits(&shortest, text);
    for (int digits = FEWEST_DIGITS; digits < DBL_DECIMAL_DIG; digits++) {
        snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return restore_point(text);
    }
    snprintf(text, NUMBER_TEXT, "%.*g", DBL_DECIMAL_DIG, value);
    return restore_point(text);
}

const char *number_text(double value, int digits, char text[NUMBER_TEXT])
{
    snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
    restore_point(text);
    return text;
}

double number_round_up(double limit)
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

double number_of_float(float value)
{
    for (int digits = FLT_DIG; digits < FLT_DECIMAL_DIG; digits++) {
        char text[NUMBER_TEXT];
        const char *end;
        double shorter;
        number_text((double)value, digits, text);
        if (number_parse(text, text + strlen(text), &end, &shorter) && fabs(shorter) <= FLT_MAX &&
            (float)shorter == value)
            return shorter;
    }
    return (double)value;
}
