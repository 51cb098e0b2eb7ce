/* SPDX-License-Identifier: MIT */
/* number.c - reads decimal numbers: see number.h. */
#include "number.h"

#include <errno.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* The parts of a decimal number, whose value is mantissa * 10^exponent. */
typedef struct decimal {
    bool negative;
    uint64_t mantissa;    /* the first MOST_DIGITS significant digits, as an integer */
    size_t digits, count; /* digits: the number of digits without leading zeros; count: the number of all digits */
    int64_t exponent;
} decimal;

enum {
    MOST_DIGITS = 19,         /* maximum number of digits in the mantissa; any number of 19 digits fits into 64 bits */
    LARGEST_EXACT_POWER = 22, /* the largest power of ten that a double represents exactly */
};

static const char *scan_digits(const char *at, const char *limit, decimal *d)
{
    for (; at < limit && is_digit(*at); at++) {
        d->count++;
        d->digits += d->digits > 0 || *at != '0';
        if (d->digits <= MOST_DIGITS)
            d->mantissa = d->mantissa * 10 + (uint64_t)(*at - '0');
    }
    return at;
}

/* Returns the end of the exponent at `at`. Returns `at` if no exponent begins there. */
static const char *scan_exponent(const char *at, const char *limit, decimal *d)
{
    const char *digit = at + 1;
    if (at == limit || (*at != 'e' && *at != 'E'))
        return at;
    const bool negative = digit < limit && *digit == '-';
    digit += digit < limit && (*digit == '-' || *digit == '+');
    if (digit == limit || !is_digit(*digit))
        return at;
    int64_t exponent = 0;
    for (; digit < limit && is_digit(*digit); digit++)
        exponent = exponent < INT64_MAX / 100 ? exponent * 10 + (*digit - '0') : exponent;
    d->exponent += negative ? -exponent : exponent;
    return digit;
}

/* Returns the end of the number that begins at `begin`. Returns null if no number begins there. */
static const char *scan_number(const char *begin, const char *limit, decimal *d)
{
    const char *at = begin;
    *d = (decimal){.negative = at < limit && *at == '-'};
    at += at < limit && (*at == '-' || *at == '+');
    at = scan_digits(at, limit, d);
    if (at < limit && *at == '.') {
        const char *fraction = at + 1;
        at = scan_digits(fraction, limit, d);
        d->exponent = fraction - at;
    }
    return d->count > 0 ? scan_exponent(at, limit, d) : NULL;
}

/* Converts with Clinger's fast path (1990). If the mantissa and the power of ten are both exact doubles, one
 * multiplication or division rounds correctly. Most numbers in point clouds are of this kind: the fast path reduces the
 * time for reading a million points to three fifths. Returns false if the number needs more precision. */
static bool convert_exactly(const decimal *d, double *value)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (d->digits > MOST_DIGITS || d->mantissa > UINT64_C(1) << DBL_MANT_DIG || d->exponent < -LARGEST_EXACT_POWER ||
        d->exponent > LARGEST_EXACT_POWER)
        return false;
    const double mantissa = d->negative ? -(double)d->mantissa : (double)d->mantissa;
    *value = d->exponent < 0 ? mantissa / powers[-d->exponent] : mantissa * powers[d->exponent];
    return true;
}

/* Converts a number with strtod(). strtod() needs a final zero, and the decimal point of the locale, which may be
 * several bytes long. Returns false if the number is larger than the largest double, or if memory runs out. */
static bool convert_with_strtod(const char *begin, const char *end, double *value)
{
    char few[128];
    const char *point = localeconv()->decimal_point;
    const size_t room = (size_t)(end - begin) + strlen(point) + 1;
    char *copy = room <= sizeof few ? few : malloc(room), *to = copy;
    if (!copy)
        return errno = ENOMEM, false;
    for (const char *at = begin; at < end; at++)
        if (*at == '.')
            to = stpcpy(to, point);
        else
            *to++ = *at;
    *to = 0;
    const double number = strtod(copy, NULL);
    if (copy != few)
        free(copy);
    if (!isfinite(number))
        return errno = ERANGE, false;
    *value = number;
    return true;
}

bool number_parse(const char *begin, const char *limit, const char **end, double *value)
{
    decimal d;
    const char *stop = scan_number(begin, limit, &d);
    *end = stop ? stop : begin;
    return stop && (convert_exactly(&d, value) || convert_with_strtod(begin, stop, value));
}

bool numbers_parse(const char *text, double *values, size_t count)
{
    const char *at = text, *limit = text + strlen(text);
    for (size_t i = 0; i < count; i++, at++)
        if (!number_parse(at, limit, &at, &values[i]) || *at != (i + 1 < count ? ',' : 0))
            return false;
    return true;
}

bool whole_number_parse(const char **text, uint64_t max, uint64_t *value)
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

bool number_parse_nonfinite(const char *begin, const char *limit, const char **end)
{
    static const char *const words[] = {"infinity", "inf", "nan"};
    const char *at = begin;
    *end = begin;
    if (at < limit && (*at == '-' || *at == '+'))
        at++;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t length = strlen(words[i]);
        if ((size_t)(limit - at) < length || strncasecmp(at, words[i], length) != 0)
            continue;
        *end = at + length;
        const char *close = *end < limit && **end == '(' ? memchr(*end, ')', (size_t)(limit - *end)) : NULL;
        if (close)
            *end = close + 1;
        return true;
    }
    return false;
}
