/* SPDX-License-Identifier: MIT */
/* test_json_write.c - JSON onto a stream, and finding places in a JSON text. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "json_read.h"
#include "json_write.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A writer into memory. */
typedef struct page {
    char *text;
    size_t size;
    json_writer writer;
} page;

static void open_page(page *page)
{
    *page = (struct page){0};
    page->writer.out = open_memstream(&page->text, &page->size);
    assert_non_null(page->writer.out);
}

static void close_page(page *page, const char *expected)
{
    assert_int_equal(fclose(page->writer.out), 0);
    assert_string_equal(page->text, expected);
    free(page->text);
}

static void assert_string_is_written(const char *text, const char *expected)
{
    page page;
    open_page(&page);
    json_write_string(&page.writer, text);
    close_page(&page, expected);
}

static void assert_number_is_written(double value, const char *expected)
{
    page page;
    open_page(&page);
    json_write_number(&page.writer, value);
    close_page(&page, expected);
}

static void commas_stand_between_values_alone(void **state)
{
    static const double position[] = {1, -0.5, 1e300};
    page page;
    (void)state;
    open_page(&page);
    json_writer *writer = &page.writer;
    json_write_begin_object(writer);
    json_write_key(writer, "empty");
    json_write_begin_array(writer);
    json_write_end_array(writer);
    json_write_key(writer, "position");
    json_write_numbers(writer, position, 3);
    json_write_key(writer, "nested");
    json_write_begin_object(writer);
    json_write_key(writer, "yes");
    json_write_bool(writer, true);
    json_write_key(writer, "no");
    json_write_bool(writer, false);
    json_write_end_object(writer);
    json_write_key(writer, "none");
    json_write_null(writer);
    json_write_end_object(writer);
    close_page(&page, "{\"empty\": [], \"position\": [1, -0.5, 1e+300], \"nested\": {\"yes\": true, \"no\": false}, "
                      "\"none\": null}");
}

static void lines_break_where_they_are_told_to(void **state)
{
    page page;
    (void)state;
    open_page(&page);
    json_writer *writer = &page.writer;
    json_write_begin_array(writer);
    json_start_new_line(writer);
    json_write_integer(writer, 1);
    json_start_new_line(writer);
    json_start_new_line(writer);
    json_write_integer(writer, 2);
    json_write_integer(writer, 3);
    json_start_new_line(writer);
    json_write_end_array(writer);
    json_write_end_line(writer);
    json_write_begin_object(writer);
    json_start_new_line(writer);
    json_write_key(writer, "a");
    json_write_integer(writer, 4);
    json_write_end_object(writer);
    json_write_end_line(writer);
    close_page(&page, "[\n1,\n2, 3\n]\n{\n\"a\": 4}\n");
}

static void strings_are_escaped(void **state)
{
    (void)state;
    assert_string_is_written("", "\"\"");
    assert_string_is_written("a\"b\\c/d", "\"a\\\"b\\\\c/d\"");
    assert_string_is_written("\n\t\r\x01\x1f\x7f", "\"\\n\\t\\u000d\\u0001\\u001f\x7f\"");
}

static void utf8_passes_and_other_bytes_are_replaced(void **state)
{
#define REPLACEMENT "\xef\xbf\xbd"
    (void)state;
    assert_string_is_written("\xc3\xa9\xe2\x82\xac\xf0\x9f\x8c\xb2", "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x8c\xb2\"");
    assert_string_is_written("\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf",
                             "\"\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf\"");
    assert_string_is_written("a\x80z", "\"a" REPLACEMENT "z\"");
    assert_string_is_written("\xc3", "\"" REPLACEMENT "\"");
    assert_string_is_written("\xe2\x82", "\"" REPLACEMENT REPLACEMENT "\"");
    assert_string_is_written("\xc0\xaf", "\"" REPLACEMENT REPLACEMENT "\"");
    assert_string_is_written("\xed\xa0\x80", "\"" REPLACEMENT REPLACEMENT REPLACEMENT "\"");
    assert_string_is_written("\xf4\x90\x80\x80", "\"" REPLACEMENT REPLACEMENT REPLACEMENT REPLACEMENT "\"");
#undef REPLACEMENT
}

static void numbers_are_shortest_and_never_other_than_json(void **state)
{
    page page;
    (void)state;
    assert_number_is_written(0.1, "0.1");
    assert_number_is_written(-0.0, "-0");
    assert_number_is_written(1000, "1000");
    assert_number_is_written(0.1 + 0.2, "0.30000000000000004");
    assert_number_is_written(DBL_MAX, "1.7976931348623157e+308");
    assert_number_is_written((double)NAN, "null");
    assert_number_is_written((double)-INFINITY, "null");
    open_page(&page);
    json_write_integer(&page.writer, UINT64_MAX);
    close_page(&page, "18446744073709551615");
}

/* The longest there are, more than are gathered at once, on lines of their own or not. */
static void many_numbers_are_written_as_one_by_one(void **state)
{
    enum { COUNT = 40 };
    static const char number[] = "-2.2250738585072014e-308";
    double values[COUNT];
    char expected[COUNT * (sizeof number + 1) + 8] = "[\n";
    page page;
    (void)state;
    for (size_t i = 0; i < COUNT; i++) {
        values[i] = -DBL_MIN;
        strcat(strcat(expected, i > 0 ? ", " : ""), number);
    }
    open_page(&page);
    json_write_begin_array(&page.writer);
    json_start_new_line(&page.writer);
    json_write_elements(&page.writer, values, COUNT);
    json_start_new_line(&page.writer);
    json_write_integer(&page.writer, 7);
    json_write_end_array(&page.writer);
    close_page(&page, strcat(expected, ",\n7]"));
}

static void failed_stream_keeps_its_error(void **state)
{
    char room[4];
    FILE *full = fmemopen(room, sizeof room, "w");
    (void)state;
    assert_non_null(full);
    json_writer writer = {.out = full};
    json_write_string(&writer, "lost");
    fflush(full);
    json_write_null(&writer);
    assert_true(ferror(full));
    fclose(full);
}

/* ---- Places ------------------------------------------------------------------------------------------------- */

/* Each value on a line of its own. */
static const char text[] = "{\"a]\":\n\"}\\\"]\", \"points\" :\n[\n[1,\n2], {\"v\": [3, {\"w\":\ntrue}]} ,\n5 ],"
                           " \"\\u006b\":\n7, \"last\":\n8}";

static void assert_place(const json_place *place, const char *name, size_t line)
{
    const json_reader r = {.at = text, .limit = text + strlen(text), .line = 1};
    char found[64];
    assert_string_equal(json_place_format(place, found, sizeof found), name);
    assert_int_equal(json_find_line(&r, place), line);
}

static void places_are_named_and_found(void **state)
{
    json_place first = {NULL, "a]", 0}, last = {NULL, "last", 0}, points = {NULL, "points", 0};
    json_place row = {&points, NULL, 0}, object = {&points, NULL, 1}, number = {&points, NULL, 2};
    json_place second = {&row, NULL, 1}, v = {&object, "v", 0}, element = {&v, NULL, 1}, w = {&element, "w", 0};
    json_place escaped = {NULL, "k", 0};
    (void)state;
    assert_place(NULL, "", 1);
    assert_place(&first, "a]", 2);
    assert_place(&points, "points", 3);
    assert_place(&row, "points[0]", 4);
    assert_place(&second, "points[0][1]", 5);
    assert_place(&w, "points[1].v[1].w", 6);
    assert_place(&number, "points[2]", 7);
    assert_place(&escaped, "k", 8);
    assert_place(&last, "last", 9);
}

static void place_that_is_not_there_is_that_above_it(void **state)
{
    json_place missing = {NULL, "missing", 0}, below = {&missing, "last", 0};
    json_place points = {NULL, "points", 0}, beyond = {&points, NULL, 3}, member = {&points, "v", 0};
    (void)state;
    assert_place(&missing, "missing", 1);
    assert_place(&below, "missing.last", 1);
    assert_place(&beyond, "points[3]", 3);
    assert_place(&member, "points.v", 3);
}

static void long_name_of_a_place_is_cut(void **state)
{
    json_place points = {NULL, "points", 0}, row = {&points, NULL, 12345}, x = {&row, "position", 0};
    char name[16];
    (void)state;
    for (size_t size = 1; size <= sizeof name; size++) {
        json_place_format(&x, name, size);
        assert_true(strlen(name) < size);
        assert_memory_equal(name, "points[12345].position", strlen(name));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commas_stand_between_values_alone),
        cmocka_unit_test(lines_break_where_they_are_told_to),
        cmocka_unit_test(strings_are_escaped),
        cmocka_unit_test(utf8_passes_and_other_bytes_are_replaced),
        cmocka_unit_test(numbers_are_shortest_and_never_other_than_json),
        cmocka_unit_test(many_numbers_are_written_as_one_by_one),
        cmocka_unit_test(failed_stream_keeps_its_error),
        cmocka_unit_test(places_are_named_and_found),
        cmocka_unit_test(place_that_is_not_there_is_that_above_it),
        cmocka_unit_test(long_name_of_a_place_is_cut),
    };
    return cmocka_run_group_tests_name("json_write", tests, NULL, NULL);
}
