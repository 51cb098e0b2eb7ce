/* test_json_thin.c - JSON copied for a page: nothing but blanks and the ends of long lists is lost, what is no JSON is
 * refused, and nothing in it ends a script element. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "fixture.h"
#include "json_thin.h"

/* A copy with lists of up to `kept` entries; null when it was refused. The caller frees it. */
static char *thinned(const char *text, size_t kept)
{
    char *copy;
    size_t size;
    FILE *in = fmemopen((void *)(uintptr_t)text, strlen(text), "r"), *out = open_memstream(&copy, &size);
    assert_non_null(in);
    assert_non_null(out);
    bool ok = json_thin(in, out, kept);
    for (int c = getc(in); ok && c != EOF; c = getc(in))
        ok = strchr(" \t\r\n", c) != NULL; /* nothing else may follow */
    fclose(in);
    assert_int_equal(fclose(out), 0);
    if (ok)
        return copy;
    free(copy);
    return NULL;
}

static void assert_thinned(const char *text, size_t kept, const char *expected)
{
    char *copy = thinned(text, kept);
    if (copy == NULL)
        fail_msg("refused: %s", text);
    assert_string_equal(copy, expected);
    free(copy);
}

static void blanks_go_and_values_stay(void **state)
{
    (void)state;
    assert_thinned("{\"a\": 1, \"b\": [true, false, null]}", 9, "{\"a\":1,\"b\":[true,false,null]}");
    assert_thinned(" {\n\t\"a b\" :\r [ { } , [ ] , \"\" ] }", 9, "{\"a b\":[{},[],\"\"]}");
    assert_thinned("[-0, 1e300, 5e-324, 0.1, -12.50E+07]", 9, "[-0,1e300,5e-324,0.1,-12.50E+07]");
    assert_thinned("\"\\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e4 \xc3\xa4 \xe2\x82\xac\"", 9,
                   "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e4 \xc3\xa4 \xe2\x82\xac\"");
    assert_thinned("7", 9, "7");
}

static void nothing_in_the_copy_ends_a_script(void **state)
{
    (void)state;
    assert_thinned("{\"</script>\": \"<!--<script>\"}", 9, "{\"\\u003c/script>\":\"\\u003c!--\\u003cscript>\"}");
    assert_thinned("\"\xe2\x80\xa8\xe2\x80\xa9\xe2\x80\xaa\xe2\x80\"", 9, "\"\\u2028\\u2029\xe2\x80\xaa\xe2\x80\"");
    assert_thinned("\"\xe2\xe2\x80\xa8\xe2<\xe2\"", 9, "\"\xe2\\u2028\xe2\\u003c\xe2\"");
}

static void long_lists_are_cut_and_counted(void **state)
{
    (void)state;
    assert_thinned("[1, 2, 3]", 3, "[1,2,3]");
    assert_thinned("[1, 2, 3]", 2, "[1,2,{\"more\":1}]");
    assert_thinned("[1, 2, 3]", 0, "[{\"more\":3}]");
    assert_thinned("[]", 0, "[]");
    assert_thinned("{\"a\": [[1, 2], [3], {\"b\": [4, 5]}]}", 1, "{\"a\":[[1,{\"more\":1}],{\"more\":2}]}");
    assert_thinned("[[], [[], [], []], \"]\", {\"c\": [6, 7, 8]}, 9]", 2, "[[],[[],[],{\"more\":1}],{\"more\":3}]");
}

/* A million entries: the copy is short, and the count is right. */
static void a_million_entries_leave_a_few(void **state)
{
    enum { COUNT = 1000000 };
    char *text = malloc(4 * COUNT + 2);
    (void)state;
    assert_non_null(text);
    strcpy(text, "[");
    for (size_t i = 0; i < COUNT; i++)
        memcpy(text + 1 + 4 * i, i + 1 < COUNT ? "[7]," : "[7]]", 4);
    text[4 * COUNT + 1] = '\0';
    assert_thinned(text, 2, "[[7],[7],{\"more\":999998}]");
    free(text);
}

static bool is_refused(const char *text)
{
    char *copy = thinned(text, 2);
    free(copy);
    return copy == NULL;
}

static void what_is_no_json_is_refused(void **state)
{
    static const char *const texts[] = {
        "",
        " ",
        "{",
        "[",
        "\"",
        "}",
        "]",
        ",",
        "nul",
        "nulll",
        "True",
        "01",
        "-",
        "1.",
        ".5",
        "+1",
        "1e",
        "1e+",
        "0x10",
        "NaN",
        "Infinity",
        "'a'",
        "[1,]",
        "[,1]",
        "[1 2]",
        "[1}",
        "{1: 2}",
        "{\"a\"}",
        "{\"a\":}",
        "{\"a\":1,}",
        "{,\"a\":1}",
        "{\"a\" 1}",
        "{\"a\":1]",
        "\"\\x\"",
        "\"\\u12g4\"",
        "\"\n\"",
        "1 2",
        "[1]]",
        "{}{}",
        "<script>",
        "[<]",
        "\"a\\",
        "[1, 2, 3, x]",
        "[1, 2, [3}]",
        "\"\\u12",
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (!is_refused(texts[i]))
            fail_msg("taken: %s", texts[i]);
}

/* Levels of lists in each other. */
static char *nested(size_t depth)
{
    char *text = malloc(2 * depth + 1);
    assert_non_null(text);
    memset(text, '[', depth);
    memset(text + depth, ']', depth);
    text[2 * depth] = '\0';
    return text;
}

static void depth_has_a_limit(void **state)
{
    char *deepest = nested(JSON_THIN_DEPTH), *deeper = nested(JSON_THIN_DEPTH + 1), *abyss = nested(1000000);
    (void)state;
    assert_thinned(deepest, 1, deepest);
    assert_true(is_refused(deeper));
    assert_true(is_refused(abyss));
    free(deepest);
    free(deeper);
    free(abyss);
}

static void a_word_without_end_is_refused(void **state)
{
    char digits[1001];
    (void)state;
    memset(digits, '1', 1000);
    digits[1000] = '\0';
    assert_true(is_refused(digits));
}

/* Texts a few characters away from JSON: jansson says which are. */
static void takes_what_another_reader_takes(void **state)
{
    static const char alphabet[] = "{}[]:,\" \\01-.eEtruefalsn/<";
    static const char start[] = "{\"a\": [1, -2.5e3, true, {\"b\\n\": null}, []], \"c\": \"d\", \"f\": false}";
    uint64_t random = 20;
    size_t taken = 0;
    (void)state;
    for (int i = 0; i < 30000; i++) {
        char text[sizeof start];
        strcpy(text, start);
        for (uint64_t changes = random_below(&random, 4); changes > 0; changes--)
            text[random_below(&random, sizeof start - 1)] = alphabet[random_below(&random, sizeof alphabet - 1)];
        json_t *value = json_loads(text, JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL | JSON_ALLOW_NUL, NULL);
        char *copy = thinned(text, SIZE_MAX);
        if ((value != NULL) != (copy != NULL))
            fail_msg("%s: %s", value ? "refused" : "taken", text);
        if (copy != NULL) {
            json_t *again = json_loads(copy, JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL | JSON_ALLOW_NUL, NULL);
            assert_true(json_equal(value, again));
            json_decref(again);
            taken++;
        }
        json_decref(value);
        free(copy);
    }
    assert_true(taken > 8000 && taken < 25000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blanks_go_and_values_stay),      cmocka_unit_test(nothing_in_the_copy_ends_a_script),
        cmocka_unit_test(long_lists_are_cut_and_counted), cmocka_unit_test(a_million_entries_leave_a_few),
        cmocka_unit_test(what_is_no_json_is_refused),     cmocka_unit_test(depth_has_a_limit),
        cmocka_unit_test(a_word_without_end_is_refused),  cmocka_unit_test(takes_what_another_reader_takes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
