/* SPDX-License-Identifier: MIT */
/* exact.c - exact sums of products of doubles, and directed rounding of a sum.
 *
 * Problem: the sign of a sum such as |a - t|^2 - |b - t|^2 decides which point is nearer. Rounding can reverse this
 * sign or hide a tie. Long double or compensated sums only make such errors rarer.
 *
 * Idea (Kulisch's long accumulator): a double is an integer times a power of two, so a product of two doubles is an
 * integer at a fixed bit position of one very wide fixed-point number. Adding integers loses nothing. The fixed-point
 * number is stored in digits of 32 bits. Each digit is a signed 64-bit integer, which absorbs 2^20 additions before a
 * carry must be propagated; exact_sign() propagates all carries once. Only the digits in use are initialized, and terms
 * of similar size use only a few digits.
 *
 * Why not multi-precision integers or expansions (Shewchuk): the former allocate memory, the latter need branches for
 * each term, and neither method is simpler than this one. Cost: three additions of digits per product and one pass over
 * the digits in use. Callers compare doubles first and use exact sums only for near ties.
 */
#include "exact.h"
#include "bits.h"

/* A finite double: sign * mantissa * 2^exponent. The mantissa is an integer below 2^53. */
typedef struct decomposed {
    uint64_t mantissa;
    int exponent; /* the exponent of the mantissa's lowest bit, at least -1074 */
    int sign;
} decomposed;

static decomposed decompose_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int biased = (int)(bits >> 52 & 0x7ff);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    return (decomposed){
        .mantissa = biased ? fraction | UINT64_C(1) << 52 : fraction,
        .exponent = (biased ? biased : 1) - 1075,
        .sign = bits >> 63 ? -1 : 1,
    };
}

bool has_exact_double_arithmetic(void)
{
    /* volatile, so that the results are not computed at compile time */
    static const volatile double inexact = 1 + 0x1p-30, rounded_square = 1 + 0x1p-29, one = 1, tiny = 0x1p-60;
    const double x = inexact, y = one;
    return x * x - rounded_square == 0 && (y + tiny) - y == 0;
}

void exact_clear(exact_sum *sum)
{
    sum->first = sum->end = 0;
}

/* Returns a pointer to the three digits from index `place` on. If necessary, the range of digits in use grows to
 * include these three; new digits are 0. */
static int64_t *reserve_digits_at(exact_sum *sum, int place)
{
    if (sum->first == sum->end)
        sum->first = sum->end = place;
    while (sum->first > place)
        sum->digits[--sum->first] = 0;
    while (sum->end < place + 3)
        sum->digits[sum->end++] = 0;
    return sum->digits + place;
}

/* Add sign * value * 2^offset to the sum. With an offset of 0, the lowest bit of `value` is added to the lowest bit of
 * the fixed-point number. The offset must not be negative. */
static void add_shifted(exact_sum *sum, int sign, uint64_t value, int offset)
{
    const int shift = offset % 32;
    const uint64_t low = (value & UINT32_MAX) << shift;
    const uint64_t high = (value >> 32) << shift;
    int64_t *digits = reserve_digits_at(sum, offset / 32);
    digits[0] += sign * (int64_t)(low & UINT32_MAX);
    digits[1] += sign * (int64_t)((low >> 32) + (high & UINT32_MAX));
    digits[2] += sign * (int64_t)(high >> 32);
}

void exact_add_product(exact_sum *sum, int factor, double a, double b)
{
    const decomposed p = decompose_double(a), q = decompose_double(b);
    const int sign = p.sign * q.sign * (factor < 0 ? -1 : 1);
    const int offset = p.exponent + q.exponent + 2 * 1074 + (factor == 2 || factor == -2);
    const uint64_t p_low = p.mantissa & UINT32_MAX, p_high = p.mantissa >> 32;
    const uint64_t q_low = q.mantissa & UINT32_MAX, q_high = q.mantissa >> 32;
    add_shifted(sum, sign, p_low * q_low, offset);
    add_shifted(sum, sign, p_low * q_high + p_high * q_low, offset + 32);
    add_shifted(sum, sign, p_high * q_high, offset + 64);
}

int exact_sign(exact_sum *sum)
{
    int64_t carry = 0;
    int any = 0;
    for (int i = sum->first; i < sum->end; i++) {
        const int64_t digit = sum->digits[i] + carry;
        sum->digits[i] = digit & UINT32_MAX;
        carry = (digit - sum->digits[i]) / (INT64_C(1) << 32);
        any |= sum->digits[i] != 0;
    }
    /* The last carry is never positive: a product adds less than 2^9 to its highest digit, and at most 2^20 products
     * are added. */
    return carry < 0 ? -1 : any;
}

double exact_round(exact_sum *sum)
{
    const int sign = exact_sign(sum);
    for (int i = sum->first; sign < 0 && i < sum->end; i++)
        sum->digits[i] = -sum->digits[i];
    if (sign < 0) /* carry again, now with a positive sum */
        exact_sign(sum);
    int top = sum->end - 1;
    while (top >= sum->first && sum->digits[top] == 0)
        top--;
    if (top < sum->first)
        return 0;
    /* The 64 highest bits, whose lowest bit is also set if any lower bit is: the conversion rounds correctly. The sum
     * is value * 2^(32 * (top - 1) - shift - 2148). */
    uint64_t bits = (uint64_t)sum->digits[top] << 32, rest = 0;
    if (top > sum->first)
        bits |= (uint64_t)sum->digits[top - 1];
    if (top - 1 > sum->first)
        rest = (uint64_t)sum->digits[top - 2];
    const int shift = 63 - (int)bits_highest(bits);
    bits = shift ? bits << shift | rest >> (32 - shift) : bits;
    bool lower = (rest << shift & UINT32_MAX) != 0;
    for (int i = sum->first; i < top - 2 && !lower; i++)
        lower = sum->digits[i] != 0;
    const double value = ldexp((double)(bits | lower), 32 * (top - 1) - shift - 2 * 1074);
    return sign < 0 ? -value : value;
}

int exact_sign_of_sum(const double terms[], int count)
{
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < count; i++)
        exact_add_product(&sum, 1, terms[i], 1);
    return exact_sign(&sum);
}

double exact_add_down(double a, double b)
{
    const double sum = a + b;
    if (isinf(sum))
        return sum > 0 ? DBL_MAX : sum;
    return exact_error_of_sum(a, b, sum) < 0 ? exact_step_down(sum) : sum;
}

double exact_add_up(double a, double b)
{
    return -exact_add_down(-a, -b);
}
