/* SPDX-License-Identifier: MIT */
/* flip_color.c - the arithmetic of FLIP on rows of pixels.
 *
 * A pixel takes six cube roots and two powers. The C library computes them one at a time, in 20 ns each, and not with
 * the same last bits everywhere. Here each is a few products without a branch, which compilers turn into operations on
 * four pixels at once. The inverse of a cube root starts from the exponent divided by -3, a guess with an error of 4 %,
 * and a series makes it exact without a division. A power is 2^(y log2 x). log2 is the exponent plus a series in
 * (m - 1) / (m + 1), and 2^z a series in the fraction of z.
 *
 * Floats are exact enough: the functions have relative errors below 1e-6 for the numbers of an image, and the mean of
 * an image is off by less than 5e-5. sqrtf() is the one function of the C library: IEEE 754 defines its result to the
 * bit.
 *
 * Source of the formulae: see flip.c. */
#include "flip_color.h"
#include "portable_math.h"

#include <float.h>
#include <math.h>

#if FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 1 || FLT_EVAL_METHOD == 2
#error "FLIP needs floats that are not evaluated as doubles (see FLT_EVAL_METHOD): use -fexcess-precision=fast"
#endif

/* ---- Functions that are computed for several pixels at once ------------------------------------------------------ */

static inline int32_t bits_of(float x)
{
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float from_bits(int32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Returns the cube root of a positive normal number, and some number for 0: x times the square of y = x^(-1/3). With a
 * guess y and r = 1 - x y^3 it is y (1 - r)^(-1/3), whose binomial series takes six terms for |r| < 0.11. */
static inline float cube_root(float x)
{
    const float y = from_bits(0x54a2fa8c - (int32_t)((float)bits_of(x) * (1 / 3.0f)));
    const float r = 1 - x * y * y * y;
    const float series =
        1 / 3.0f + r * (2 / 9.0f + r * (14 / 81.0f + r * (35 / 243.0f + r * (91 / 729.0f + r * (728 / 6561.0f)))));
    const float inverse = y + y * r * series;
    return x * inverse * inverse;
}

/* Returns the binary logarithm of a positive normal number, and -127 for 0. */
static inline float log_2(float x)
{
    enum { MANTISSA = 0x007fffff, HALF_OCTAVE = 0x3504f3 /* the mantissa of sqrt(2) */ };
    const int32_t exponent = ((bits_of(x) + (MANTISSA - HALF_OCTAVE)) >> 23) - 127;
    const float m = from_bits(bits_of(x) - exponent * (MANTISSA + 1)); /* from sqrt(1/2) to sqrt(2) */
    const float t = (m - 1) / (m + 1), s = t * t;
    const float series = 1 + s * (1 / 3.0f + s * (1 / 5.0f + s * (1 / 7.0f + s * (1 / 9.0f))));
    return (float)exponent + 2.88539008f * t * series; /* 2 / ln 2 */
}

/* Returns 2 to the power of z, for z from -127 to 127. Results below 2^-126 are 0. */
static inline float exp_2(float z)
{
    const int32_t whole = (int32_t)(z + 127.5f); /* not negative, so that the conversion rounds down */
    const float r = (z - (float)(whole - 127)) * 0.693147181f;
    const float series =
        1 + r * (1 + r * (1 / 2.0f + r * (1 / 6.0f + r * (1 / 24.0f + r * (1 / 120.0f + r * (1 / 720.0f))))));
    return series * from_bits(whole * 0x00800000);
}

/* Returns x to the power of y, for x from 0 to 1e6 and y from 0 to 1. 0 to the power of 0 is 1. */
static inline float power(float x, float y)
{
    const float result = exp_2(y * log_2(x));
    return x > 0 || y <= 0 ? result : 0;
}

/* ---- Colours ----------------------------------------------------------------------------------------------------- */

void flip_fill_linear_table(int range, float *table)
{
    for (int i = 0; i <= range; i++) {
        const double sample = (double)i / range;
        table[i] = (float)(sample > 0.04045 ? portable_pow((sample + 0.055) / 1.055, 2.4) : sample / 12.92);
    }
}

/* From linear sRGB to X, Y and Z as parts of those of white (IEC 61966-2-1), and back: the rows of the first matrix add
 * up to 1, and the second matrix is its inverse. */
static const float TO_XYZ[3][3] = {{0.433895388832f, 0.376242372622f, 0.189862238546f},
                                   {0.212636821677f, 0.715182981841f, 0.072180196481f},
                                   {0.017752423152f, 0.109465628662f, 0.872781948186f}};
static const float TO_RGB[3][3] = {{3.080341988280f, -1.537398969489f, -0.542943018792f},
                                   {-0.921178396165f, 1.875929983695f, 0.045248412470f},
                                   {0.052881292876f, -0.204011206124f, 1.151129913248f}};

static inline float dot(const float row[3], float a, float b, float c)
{
    return row[0] * a + row[1] * b + row[2] * c;
}

void flip_convert_samples(const pixel_samples *samples, const float *table, int count, float *restrict y,
                          float *restrict x, float *restrict z)
{
    for (int i = 0; i < count; i++) {
        x[i] = table[samples[i].of[0]];
        y[i] = table[samples[i].of[1]];
        z[i] = table[samples[i].of[2]];
    }
    for (int i = 0; i < count; i++) {
        const float r = x[i], g = y[i], b = z[i], middle = dot(TO_XYZ[1], r, g, b);
        x[i] = dot(TO_XYZ[0], r, g, b) - middle;
        y[i] = middle;
        z[i] = middle - dot(TO_XYZ[2], r, g, b);
    }
}

static inline float at_most_1(float x)
{
    return x < 1 ? x : 1;
}

static inline float clip(float x)
{
    return at_most_1(x > 0 ? x : 0);
}

/* The function f of CIELAB: the cube root, and a line for small numbers. */
static inline float lightness(float t)
{
    const float root = cube_root(t), line = t * (841 / 108.0f) + 4 / 29.0f;
    return t > 216 / 24389.0f ? root : line;
}

/* Store f() of X, Y or Z. */
static void find_lightness(const float row[3], const flip_opponent *rgb, int count, float *restrict to)
{
    for (int i = 0; i < count; i++)
        to[i] = lightness(dot(row, rgb->x[i], rgb->y[i], rgb->z[i]));
}

static void convert_to_rgb(flip_opponent *colors, int count)
{
    for (int i = 0; i < count; i++) {
        const float x = colors->y[i] + colors->x[i], y = colors->y[i], z = colors->y[i] - colors->z[i];
        colors->x[i] = clip(dot(TO_RGB[0], x, y, z));
        colors->y[i] = clip(dot(TO_RGB[1], x, y, z));
        colors->z[i] = clip(dot(TO_RGB[2], x, y, z));
    }
}

void flip_convert_to_lab(flip_opponent *colors, int count, flip_lab *restrict to)
{
    convert_to_rgb(colors, count);
    find_lightness(TO_XYZ[0], colors, count, to->a);
    find_lightness(TO_XYZ[1], colors, count, to->l);
    find_lightness(TO_XYZ[2], colors, count, to->b);
    for (int i = 0; i < count; i++) {
        const float l = 116 * to->l[i] - 16;
        to->a[i] = 5 * l * (to->a[i] - to->l[i]);
        to->b[i] = 2 * l * (to->l[i] - to->b[i]);
        to->l[i] = l;
    }
}

/* ---- The value of a pixel ---------------------------------------------------------------------------------------- */

/* The constants of the paper: the exponent of colour differences; and the part of the largest difference that is mapped
 * to LARGE, so that small differences take up most of the range. */
#define COLOR_EXPONENT 0.7f
#define PART 0.4f
#define LARGE 0.95f
/* The largest difference of two sRGB colours, that of green and blue, to the power of COLOR_EXPONENT. The test
 * largest_difference_is_that_of_green_and_blue computes it. */
#define MOST 41.2760984f

/* Map a difference of colours, to the power of COLOR_EXPONENT, to 0..1. */
static inline float redistribute(float difference)
{
    const float below = difference * (LARGE / (PART * MOST));
    const float above = LARGE + (difference - PART * MOST) * ((1 - LARGE) / (MOST - PART * MOST));
    return at_most_1(difference < PART * MOST ? below : above);
}

void flip_find_lengths(float *restrict x, const float *y, int count)
{
    for (int i = 0; i < count; i++)
        x[i] = sqrtf(x[i] * x[i] + y[i] * y[i]);
}

void flip_combine(const flip_lab colors[2], float features[4][FLIP_STRIP], int count, float *restrict values)
{
    float exponents[FLIP_STRIP], others[FLIP_STRIP];
    for (int i = 0; i < count; i++) {
        const float edge = fabsf(features[0][i] - features[2][i]), point = fabsf(features[1][i] - features[3][i]);
        exponents[i] = 1 - sqrtf(0.707106781f * (edge > point ? edge : point));
        values[i] = colors[0].a[i] - colors[1].a[i];
        others[i] = colors[0].b[i] - colors[1].b[i];
    }
    flip_find_lengths(values, others, count);
    /* Three loops, because gcc 12 does not vectorize one loop of all. */
    for (int i = 0; i < count; i++)
        values[i] = power(values[i] + fabsf(colors[0].l[i] - colors[1].l[i]), COLOR_EXPONENT);
    for (int i = 0; i < count; i++)
        values[i] = redistribute(values[i]);
    for (int i = 0; i < count; i++)
        values[i] = at_most_1(power(values[i], exponents[i]));
}
