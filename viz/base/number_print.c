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

/* ---- By integers -------------------------------------------------------------------------------------------- */

enum {
    FEWEST_DIGITS = 15, /* any so many survive a double */
    HALF_BITS = 30,     /* of a fraction, so that a half takes nine digits at a time in 64 bits */
    FRACTION_BITS = 2 * HALF_BITS,
    MOST_AT_ONCE = 9,
};

#define FRACTION_ONE (UINT64_C(1) << FRACTION_BITS)
#define HALF_MASK ((UINT64_C(1) << HALF_BITS) - 1)

/* From the first on, half of a number's last bit is above the last of the fraction's; up to the other, the 15th digit
 * lies after the point. */
#define SMALLEST_PLAIN 0x1p-7
#define LARGEST_PLAIN 1e14

static const uint64_t powers[] = {UINT64_C(1),
                                  UINT64_C(10),
                                  UINT64_C(100),
                                  UINT64_C(1000),
                                  UINT64_C(10000),
                                  UINT64_C(100000),
                                  UINT64_C(1000000),
                                  UINT64_C(10000000),
                                  UINT64_C(100000000),
                                  UINT64_C(1000000000),
                                  UINT64_C(10000000000),
                                  UINT64_C(100000000000),
                                  UINT64_C(1000000000000),
                                  UINT64_C(10000000000000),
                                  UINT64_C(100000000000000)};

/* A number between them, exactly: the digits that were taken so far, as one number, and what they leave. */
typedef struct expansion {
    uint64_t digits;
    int count;          /* of them that are significant, */
    int places;         /* and that stand after the point */
    uint64_t rest;      /* of the last digit's unit, in parts of FRACTION_ONE */
    uint64_t half_last; /* half of what the number's last bit is worth, in the same */
    bool even;          /* that bit is not set: halfway reads as this number */
} expansion;

static expansion expand(double magnitude)
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
        x.count = magnitude < 0.01 ? -2 : magnitude < 0.1 ? -1 : 0; /* zeros after the point are not significant */
    else
        while (x.count < FEWEST_DIGITS && powers[x.count] <= whole)
            x.count++;
    return x;
}

/* Take the next digits after the point. */
static void take_digits(expansion *x, int count)
{
    const uint64_t power = powers[count], low = (x->rest & HALF_MASK) * power,
                   high = (x->rest >> HALF_BITS) * power + (low >> HALF_BITS);
    x->rest = (high & HALF_MASK) << HALF_BITS | (low & HALF_MASK);
    x->half_last *= power;
    x->digits = x->digits * power + (high >> HALF_BITS);
    x->count += count;
    x->places += count;
}

/* Whether what was taken is rounded up; halfway to the even digit, as printf does. */
static bool goes_up(const expansion *x)
{
    return x->rest > FRACTION_ONE / 2 || (x->rest == FRACTION_ONE / 2 && x->digits % 2 != 0);
}

/* Whether what was taken, rounded, reads back: it is no farther off than half the last bit. It does not
 * matter that below a power of two bits are worth less: those of this size have at most 14 digits. */
static bool reads_back(const expansion *x)
{
    const uint64_t off = goes_up(x) ? FRACTION_ONE - x->rest : x->rest;
    return off < x->half_last || (off == x->half_last && x->even);
}

/* As few digits as do, without zeros at their end. */
static expansion shorten(double magnitude)
{
    expansion x = expand(magnitude);
    while (x.count < FEWEST_DIGITS) {
        const int left = FEWEST_DIGITS - x.count;
        take_digits(&x, left < MOST_AT_ONCE ? left : MOST_AT_ONCE);
    }
    while (x.count < DBL_DECIMAL_DIG && !reads_back(&x))
        take_digits(&x, 1);
    x.digits += goes_up(&x);
    for (; x.places > 0 && x.digits % 10 == 0; x.places--)
        x.digits /= 10;
    return x;
}

/* The last so many digits, which end at `end`, two by two. Returns where they begin. */
static char *put_digits(char *end, uint64_t *digits, int count)
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

/* As %g does where it needs no exponent. 0 for numbers that are too large or too small for it. */
static size_t print_exactly(double value, char text[NUMBER_TEXT])
{
    expansion x = {.digits = 0};
    const double magnitude = fabs(value);
    if (value != 0 && !(magnitude >= SMALLEST_PLAIN && magnitude < LARGEST_PLAIN))
        return 0;
    if (value != 0)
        x = shorten(magnitude);
    char room[NUMBER_TEXT], *const end = room + sizeof room, *at = end;
    if (x.places > 0) {
        at = put_digits(at, &x.digits, x.places);
        *--at = '.';
    }
    do
        at = put_digits(at, &x.digits, 1);
    while (x.digits > 0);
    if (signbit(value))
        *--at = '-';
    const size_t size = (size_t)(end - at);
    memcpy(text, at, size);
    text[size] = 0;
    return size;
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
    const size_t size = print_exactly(value, text);
    if (size > 0)
        return size;
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

double number_from_float(float value)
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
