/* exact.c - see exact.h. */
#include "exact.h"

#include <math.h>
#include <string.h>

/* A finite double as mantissa * 2^exponent, the mantissa an integer below 2^53 with the sign apart. */
typedef struct parts {
    uint64_t mantissa;
    int exponent; /* at least -1074 */
    int sign;
} parts;

static parts take_apart(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int biased = (int)(bits >> 52 & 0x7ff);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    return (parts){
        .mantissa = biased ? fraction | UINT64_C(1) << 52 : fraction,
        .exponent = (biased ? biased : 1) - 1075,
        .sign = bits >> 63 ? -1 : 1,
    };
}

void exact_clear(exact_sum *sum)
{
    sum->first = sum->after = 0;
}

/* Three digits from a place on. Those that come into use, and all between them and the others, begin as 0. */
static int64_t *use_digits(exact_sum *sum, int place)
{
    if (sum->first == sum->after)
        sum->first = sum->after = place;
    while (sum->first > place)
        sum->digits[--sum->first] = 0;
    while (sum->after < place + 3)
        sum->digits[sum->after++] = 0;
    return sum->digits + place;
}

/* Add sign * value * 2^offset, offset >= 0. */
static void add_at(exact_sum *sum, int sign, uint64_t value, int offset)
{
    const int shift = offset % 32;
    const uint64_t low = (value & UINT32_MAX) << shift;
    const uint64_t high = (value >> 32) << shift;
    int64_t *digits = use_digits(sum, offset / 32);
    digits[0] += sign * (int64_t)(low & UINT32_MAX);
    digits[1] += sign * (int64_t)((low >> 32) + (high & UINT32_MAX));
    digits[2] += sign * (int64_t)(high >> 32);
}

void exact_add_product(exact_sum *sum, int factor, double a, double b)
{
    const parts p = take_apart(a), q = take_apart(b);
    const int sign = p.sign * q.sign * (factor < 0 ? -1 : 1);
    const int offset = p.exponent + q.exponent + 2 * 1074 + (factor == 2 || factor == -2);
    const uint64_t p_low = p.mantissa & UINT32_MAX, p_high = p.mantissa >> 32;
    const uint64_t q_low = q.mantissa & UINT32_MAX, q_high = q.mantissa >> 32;
    add_at(sum, sign, p_low * q_low, offset);
    add_at(sum, sign, p_low * q_high + p_high * q_low, offset + 32);
    add_at(sum, sign, p_high * q_high, offset + 64);
}

int exact_sign(exact_sum *sum)
{
    int64_t carry = 0;
    int any = 0;
    for (int i = sum->first; i < sum->after; i++) {
        const int64_t digit = sum->digits[i] + carry;
        sum->digits[i] = digit & UINT32_MAX;
        carry = (digit - sum->digits[i]) / (INT64_C(1) << 32);
        any |= sum->digits[i] != 0;
    }
    return carry < 0 ? -1 : any || carry > 0;
}

double exact_step_down(double value)
{
    uint64_t bits;
    if (value == 0)
        return -0x1p-1074;
    memcpy(&bits, &value, sizeof bits);
    bits += value > 0 ? UINT64_MAX : 1;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The rounding error of sum = fl(a + b), exactly (Dekker's FastTwoSum; Knuth's TwoSum, which asks for no order, can
 * overflow on the way). */
static double sum_error(double a, double b, double sum)
{
    return fabs(a) >= fabs(b) ? b - (sum - a) : a - (sum - b);
}

double exact_add_down(double a, double b)
{
    const double sum = a + b;
    if (isinf(sum))
        return sum > 0 ? DBL_MAX : sum;
    return sum_error(a, b, sum) < 0 ? exact_step_down(sum) : sum;
}

double exact_add_up(double a, double b)
{
    return -exact_add_down(-a, -b);
}
