/* number.c - decimal text as doubles, whatever the locale. */
#include "number.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The powers of ten that are doubles exactly. */
static const double exact_powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

enum {
    LARGEST_EXACT_POWER = 22,
    MANTISSA_DIGITS = 19,    /* any so many digits fit 64 bits */
    DECIDING_DIGITS = 768,   /* digits behind these matter only by being zero or not */
    EXPONENT_LIMIT = 100000, /* further out everything is zero or infinite, with DECIDING_DIGITS digits too */
};

#define EXPLICIT_EXPONENT_LIMIT INT64_C(1000000000000000000)

/* A number's parts: its digits, read as one integer, times ten to the exponent. */
typedef struct decimal {
    bool negative;
    const char *first, *last; /* the significant digits, with perhaps a point between them */
    uint64_t mantissa;        /* of the first MANTISSA_DIGITS significant digits */
    size_t digits;            /* how many are significant: leading zeros are not */
    int64_t exponent;
} decimal;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Take the digits from `at` on; returns where they end. */
static const char *scan_digits(const char *at, const char *limit, decimal *number)
{
    for (; at < limit && is_digit(*at); at++) {
        if (number->digits == 0 && *at == '0')
            continue;
        if (number->digits == 0)
            number->first = at;
        if (number->digits < MANTISSA_DIGITS)
            number->mantissa = number->mantissa * 10 + (uint64_t)(*at - '0');
        number->digits++;
    }
    return at;
}

/* Take an exponent if a whole one is at `at`; returns where it ends, or `at`. */
static const char *scan_exponent(const char *at, const char *limit, decimal *number)
{
    const char *digit = at;
    if (digit == limit || (*digit != 'e' && *digit != 'E'))
        return at;
    digit++;
    bool negative = digit < limit && *digit == '-';
    if (digit < limit && (*digit == '-' || *digit == '+'))
        digit++;
    if (digit == limit || !is_digit(*digit))
        return at;
    int64_t exponent = 0;
    for (; digit < limit && is_digit(*digit); digit++)
        if (exponent < EXPLICIT_EXPONENT_LIMIT / 10)
            exponent = exponent * 10 + (*digit - '0');
    number->exponent += negative ? -exponent : exponent;
    return digit;
}

/* Returns where the number ends, or null when there is none. */
static const char *scan(const char *begin, const char *limit, decimal *number)
{
    const char *at = begin;
    *number = (decimal){.negative = at < limit && *at == '-'};
    if (at < limit && (*at == '-' || *at == '+'))
        at++;
    const char *whole = at;
    at = scan_digits(at, limit, number);
    size_t seen = (size_t)(at - whole);
    if (at < limit && *at == '.') {
        const char *fraction = at + 1;
        at = scan_digits(fraction, limit, number);
        seen += (size_t)(at - fraction);
        number->exponent = -(int64_t)(at - fraction);
    }
    number->last = at;
    return seen > 0 ? scan_exponent(at, limit, number) : NULL;
}

/* Clinger's fast path: an exact integer and an exact power of ten make one correctly rounded operation. */
static bool convert_exactly(const decimal *number, double *value)
{
    if (number->digits > MANTISSA_DIGITS || number->mantissa > UINT64_C(1) << DBL_MANT_DIG)
        return false;
    if (number->exponent < -LARGEST_EXACT_POWER || number->exponent > LARGEST_EXACT_POWER)
        return false;
    double mantissa = (double)number->mantissa;
    *value =
        number->exponent < 0 ? mantissa / exact_powers[-number->exponent] : mantissa * exact_powers[number->exponent];
    return true;
}

/* Let strtod round an integer and an exponent: without a point there is nothing that a locale could change. */
static double convert_by_library(const decimal *number)
{
    char text[DECIDING_DIGITS + 32];
    size_t length = 0;
    int64_t exponent = number->exponent;
    bool inexact = false;
    for (const char *at = number->first; at < number->last; at++) {
        if (!is_digit(*at))
            continue;
        if (length < DECIDING_DIGITS) {
            text[length++] = *at;
            continue;
        }
        inexact = inexact || *at != '0';
        exponent++;
    }
    if (inexact) {
        text[length++] = '1';
        exponent--;
    }
    if (exponent < -EXPONENT_LIMIT)
        exponent = -EXPONENT_LIMIT;
    if (exponent > EXPONENT_LIMIT)
        exponent = EXPONENT_LIMIT;
    snprintf(text + length, sizeof text - length, "e%d", (int)exponent);
    return strtod(text, NULL);
}

bool number_parse(const char *begin, const char *limit, const char **end, double *value)
{
    decimal number;
    double magnitude = 0;
    const char *stop = scan(begin, limit, &number);
    *end = stop ? stop : begin;
    if (!stop)
        return false;
    if (number.digits > 0 && !convert_exactly(&number, &magnitude))
        magnitude = convert_by_library(&number);
    if (!isfinite(magnitude))
        return false;
    *value = number.negative ? -magnitude : magnitude;
    return true;
}

bool numbers_parse(const char *text, double *values, size_t count)
{
    const char *at = text, *limit = text + strlen(text);
    for (size_t i = 0; i < count; i++, at++)
        if (!number_parse(at, limit, &at, &values[i]) || *at != (i + 1 < count ? ',' : 0))
            return false;
    return true;
}

bool whole_parse(const char **text, uint64_t max, uint64_t *value)
{
    char *end;
    if (!is_digit(**text))
        return false;
    errno = 0;
    const unsigned long long number = strtoull(*text, &end, 10);
    if (errno || number > max)
        return false;
    *value = number;
    *text = end;
    return true;
}

static bool starts_with(const char *at, const char *limit, const char *word)
{
    size_t length = strlen(word);
    return (size_t)(limit - at) >= length && strncasecmp(at, word, length) == 0;
}

bool number_parse_nonfinite(const char *begin, const char *limit, const char **end)
{
    static const char *const words[] = {"infinity", "inf", "nan"};
    const char *at = begin;
    *end = begin;
    if (at < limit && (*at == '-' || *at == '+'))
        at++;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (!starts_with(at, limit, words[i]))
            continue;
        *end = at + strlen(words[i]);
        const char *close = *end < limit && **end == '(' ? memchr(*end, ')', (size_t)(limit - *end)) : NULL;
        if (close)
            *end = close + 1;
        return true;
    }
    return false;
}
