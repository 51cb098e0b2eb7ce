/* SPDX-License-Identifier: MIT */
/* test_number.c - doubles as text and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "number.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t next_random(uint64_t *state)
{
    uint64_t x = *state += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Parse a copy that ends where the text does, so that a sanitizer sees any look beyond. */
static bool parse(const char *text, size_t *used, double *value)
{
    size_t length = strlen(text);
    char *copy = malloc(length + (length == 0));
    assert_non_null(copy);
    memcpy(copy, text, length);
    const char *end;
    bool parsed = number_parse(copy, copy + length, &end, value);
    *used = (size_t)(end - copy);
    free(copy);
    return parsed;
}

/* strtod of the C locale is correctly rounded in glibc and musl. */
static void assert_parses_as_strtod(const char *text)
{
    size_t used;
    double value;
    assert_true(parse(text, &used, &value));
    assert_int_equal(used, strlen(text));
    if (bits_of(value) != bits_of(strtod(text, NULL)))
        fail_msg("%s became %a", text, value);
}

static void assert_round_trip(double value)
{
    char text[NUMBER_TEXT];
    size_t length = number_print(value, text), used;
    double again;
    assert_int_equal(length, strlen(text));
    assert_true(parse(text, &used, &again));
    assert_int_equal(used, length);
    if (bits_of(value) != bits_of(again))
        fail_msg("%a became %s", value, text);
}

static void assert_prints(double value, const char *expected)
{
    char text[NUMBER_TEXT];
    number_print(value, text);
    assert_string_equal(text, expected);
}

static void random_bits_round_trip(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 100000; i++) {
        double value = double_of(next_random(&random));
        if (isfinite(value))
            assert_round_trip(value);
    }
}

/* The definition: printf and strtod themselves, digit by digit more. */
static void assert_prints_as_printf(double value)
{
    char text[NUMBER_TEXT], expected[64];
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(expected, sizeof expected, "%.*g", precision, value);
        if (strtod(expected, NULL) == value)
            break;
    }
    number_print(value, text);
    assert_string_equal(text, expected);
}

static void numbers_are_printed_as_printf_prints_the_shortest(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < 30000; i++) {
        const uint64_t bits = next_random(&random);
        const double value = double_of(bits), unit = (double)(bits >> 11) * 0x1p-53;
        if (isfinite(value))
            assert_prints_as_printf(value);
        assert_prints_as_printf(unit * 2000 - 1000);
        assert_prints_as_printf((double)(bits % 2000001) / 1000 - 1000);              /* few digits */
        assert_prints_as_printf(((double)(bits % 20000001) + 0.5) * 0x1p-20);         /* ties of decimal digits */
        assert_prints_as_printf(ldexp((double)(bits >> 40), (int)(bits % 160) - 80)); /* exact in many digits */
    }
    for (int e = -330; e <= 308; e++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", e);
        const double power = strtod(text, NULL);
        assert_prints_as_printf(power);
        assert_prints_as_printf(-nextafter(power, 0));
        assert_prints_as_printf(nextafter(power, INFINITY));
        assert_prints_as_printf(ldexp(1, e));
    }
}

static void powers_of_ten_and_two_round_trip(void **state)
{
    (void)state;
    char text[16];
    for (int e = -330; e <= 308; e++) {
        snprintf(text, sizeof text, "1e%d", e);
        assert_parses_as_strtod(text);
        assert_round_trip(strtod(text, NULL));
    }
    for (int e = -1074; e <= 1023; e++) {
        assert_round_trip(ldexp(1, e));
        assert_round_trip(nextafter(ldexp(1, e), 0));
    }
}

static void subnormals_and_limits_round_trip(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int i = 0; i < 20000; i++)
        assert_round_trip(double_of(next_random(&random) >> 12));
    assert_round_trip(DBL_TRUE_MIN);
    assert_round_trip(DBL_MIN);
    assert_round_trip(DBL_MAX);
    assert_round_trip(-DBL_MAX);
    assert_round_trip(0.0);
    assert_round_trip(-0.0);
}

/* Digits and exponents about the limits of the fast path: 15 to 21 digits, exponents about 22. */
static void random_decimals_parse_as_strtod_does(void **state)
{
    (void)state;
    uint64_t random = 3;
    char text[64];
    for (int i = 0; i < 100000; i++) {
        int digits = 1 + (int)(next_random(&random) % 19);
        int exponent = (int)(next_random(&random) % 61) - 30;
        uint64_t mantissa = next_random(&random) % UINT64_C(10000000000000000000);
        for (int cut = digits; cut < 19; cut++)
            mantissa /= 10;
        const char *sign = next_random(&random) & 1 ? "-" : "";
        snprintf(text, sizeof text, "%s%llu.%03ue%d", sign, (unsigned long long)mantissa,
                 (unsigned)(next_random(&random) % 1000), exponent);
        assert_parses_as_strtod(text);
        snprintf(text, sizeof text, "%s%llue%d", sign, (unsigned long long)mantissa, exponent);
        assert_parses_as_strtod(text);
    }
}

/* The decimals exactly between two doubles have up to 767 digits: one digit behind them decides. */
static void ties_are_decided_by_the_last_of_many_digits(void **state)
{
    (void)state;
    uint64_t random = 4;
    char text[1400];
    for (int i = 0; i < 500; i++) {
        double low = double_of(next_random(&random) >> (i % 2 ? 12 : 2));
        double high = nextafter(low, INFINITY);
        if (!isfinite(high))
            continue;
        /* long double holds the midpoint of two doubles exactly where it has a wider exponent and mantissa. */
        long double middle = ((long double)low + (long double)high) / 2;
        snprintf(text, sizeof text - 8, "%.1100Le", middle);
        assert_parses_as_strtod(text);
        char *exponent = strchr(text, 'e');
        memmove(exponent + 1, exponent, strlen(exponent) + 1);
        *exponent = '1';
        assert_parses_as_strtod(text);
    }
}

static void every_form_is_read_to_its_end(void **state)
{
    static const struct {
        const char *text;
        double value;
        size_t used;
    } rows[] = {
        {"0", 0, 1},
        {"-0", -0.0, 2},
        {"+7", 7, 2},
        {".5", 0.5, 2},
        {"-.5", -0.5, 3},
        {"2.", 2, 2},
        {"2.e3", 2000, 4},
        {"1e3", 1000, 3},
        {"1E+3", 1000, 4},
        {"1e-3", 0.001, 4},
        {"1e", 1, 1},
        {"1e+", 1, 1},
        {"1e+x", 1, 1},
        {"1.5.2", 1.5, 3},
        {"1,5", 1, 1},
        {"12abc", 12, 2},
        {"0x10", 0, 1},
        {"1 2", 1, 1},
        {"1-2", 1, 1},
        {"007", 7, 3},
        {"0.000", 0, 5},
        {"1e-400", 0, 6},
        {"-1e-400", -0.0, 7},
        {"0e999999999999999999999", 0, 23},
        {"1e-99999999999999999999", 0, 23},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double value = 99;
        size_t used;
        assert_true(parse(rows[i].text, &used, &value));
        assert_int_equal(used, rows[i].used);
        assert_int_equal(bits_of(value), bits_of(rows[i].value));
    }
}

static void what_is_no_number_is_refused_and_left_in_place(void **state)
{
    static const char *const rows[] = {"",  "-",   "+",    ".",   "-.",  "e5",  "x",        " 1", "\t1",
                                       ",", "nan", "-nan", "inf", "INF", "+-1", "infinity", "--1"};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double value = 99;
        size_t used;
        assert_false(parse(rows[i], &used, &value));
        assert_int_equal(used, 0);
        assert_true(value == 99);
    }
}

static void what_is_beyond_a_double_is_refused_and_passed(void **state)
{
    static const char *const rows[] = {"1e309", "-1e400", "1.8e308", "1e99999999999999999999", "17976931348623159e292"};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double value = 99;
        size_t used;
        assert_false(parse(rows[i], &used, &value));
        assert_int_equal(used, strlen(rows[i]));
        assert_true(value == 99);
    }
}

static void nothing_at_or_behind_the_limit_is_read(void **state)
{
    static const char text[] = "12345e6";
    (void)state;
    for (size_t length = 1; length < 5; length++) {
        const char *end;
        double value;
        assert_true(number_parse(text, text + length, &end, &value));
        assert_ptr_equal(end, text + length);
    }
}

static void very_long_numbers_are_read(void **state)
{
    enum { LENGTH = 200000 };
    (void)state;
    char *text = malloc(LENGTH + 16);
    assert_non_null(text);
    memset(text, '0', LENGTH);
    text[1] = '.';
    strcpy(text + LENGTH, "25e199998");
    assert_parses_as_strtod(text);
    memset(text, '9', LENGTH);
    strcpy(text + LENGTH, "e-199990");
    assert_parses_as_strtod(text);
    free(text);
}

static void non_finite_words_are_told_apart(void **state)
{
    static const struct {
        const char *text;
        size_t used;
    } rows[] = {
        {"nan", 3},      {"NaN", 3},       {"-nan", 4}, {"-nan(ind)", 9}, {"nan(", 3}, {"inf", 3}, {"+Inf", 4},
        {"Infinity", 8}, {"-infinite", 4}, {"nano", 3}, {"na", 0},        {"", 0},     {"-", 0},   {"1", 0},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *end;
        bool found = number_parse_nonfinite(rows[i].text, rows[i].text + strlen(rows[i].text), &end);
        assert_int_equal(found, rows[i].used > 0);
        assert_int_equal(end - rows[i].text, rows[i].used);
    }
}

static void print_takes_the_shortest_of_three_precisions(void **state)
{
    (void)state;
    assert_prints(0.1, "0.1");
    assert_prints(-0.0, "-0");
    assert_prints(0.0, "0");
    assert_prints(-1000, "-1000");
    assert_prints(123456789012345, "123456789012345");
    assert_prints(1e15, "1e+15");
    assert_prints(1.0 / 3, "0.3333333333333333");
    assert_prints(0.1 + 0.2, "0.30000000000000004");
    assert_prints(DBL_MAX, "1.7976931348623157e+308");
    assert_prints(-2.2250738585072014e-308, "-2.2250738585072014e-308");
    assert_prints(485032.26806640625, "485032.26806640625");
}

static void floats_become_doubles_of_few_digits(void **state)
{
    static const struct {
        float value;
        double expected;
    } rows[] = {{0.1F, 0.1},
                {-0.0F, -0.0},
                {16777217.0F, 16777216.0},
                {1.1754944e-38F, 1.1754944e-38},
                {FLT_MAX, (double)FLT_MAX}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double found = widen_float_as_printed(rows[i].value);
        assert_memory_equal(&found, &rows[i].expected, sizeof found);
        assert_true((float)found == rows[i].value);
    }
}

static void a_locale_with_another_point_changes_nothing(void **state)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "ps_AF.UTF-8"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        size_t used;
        double value;
        if (!setlocale(LC_NUMERIC, names[i]))
            continue;
        assert_prints(-1.5e-7, "-1.5e-07");
        assert_prints(0.25, "0.25");
        assert_true(parse("0.3000000000000000444", &used, &value));
        assert_true(value == 0.3000000000000000444 && used == 21);
    }
    setlocale(LC_NUMERIC, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_bits_round_trip),
        cmocka_unit_test(numbers_are_printed_as_printf_prints_the_shortest),
        cmocka_unit_test(powers_of_ten_and_two_round_trip),
        cmocka_unit_test(subnormals_and_limits_round_trip),
        cmocka_unit_test(random_decimals_parse_as_strtod_does),
        cmocka_unit_test(ties_are_decided_by_the_last_of_many_digits),
        cmocka_unit_test(every_form_is_read_to_its_end),
        cmocka_unit_test(what_is_no_number_is_refused_and_left_in_place),
        cmocka_unit_test(what_is_beyond_a_double_is_refused_and_passed),
        cmocka_unit_test(nothing_at_or_behind_the_limit_is_read),
        cmocka_unit_test(very_long_numbers_are_read),
        cmocka_unit_test(non_finite_words_are_told_apart),
        cmocka_unit_test(print_takes_the_shortest_of_three_precisions),
        cmocka_unit_test(floats_become_doubles_of_few_digits),
        cmocka_unit_test(a_locale_with_another_point_changes_nothing),
    };
    return cmocka_run_group_tests_name("number", tests, NULL, NULL);
}
