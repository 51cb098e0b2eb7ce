/* SPDX-License-Identifier: MIT */
/* test_text_memory.c - a text that is printed into memory is whole, or the end of its stream reports that memory ran
 * out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "failing_memory.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

enum { LINES = 20000, LINE = 6 };

/* Print while all allocations after the first `count` fail, or one alone does. Returns whether one failed. */
static bool print_with_failure(long count)
{
    text_stream s;
    char *text;
    fail_allocations_after(count);
    if (text_stream_begin(&s))
        for (int i = 0; i < LINES; i++)
            fprintf(s.stream, "%05d\n", i);
    const bool whole = text_stream_end(&s, &text), failed = memory_has_failed();
    assert_true(whole != failed);
    assert_true((text != NULL) == whole);
    if (whole) {
        assert_int_equal(s.size, LINES * LINE);
        assert_string_equal(text + s.size - LINE, "19999\n");
    }
    free(text);
    return failed;
}

static void no_part_of_a_text_is_left_out(void **state)
{
    long failures = 0;
    (void)state;
#ifndef __GLIBC__
    skip(); /* open_memstream() allocates with a malloc() that does not fail here */
#endif
    while (print_with_failure(failures))
        failures++;
    assert_true(failures > 3); /* the text grows */
}

static void no_part_is_left_out_if_memory_is_free_again(void **state)
{
    fail_one_allocation();
    no_part_of_a_text_is_left_out(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_part_of_a_text_is_left_out),
        cmocka_unit_test(no_part_is_left_out_if_memory_is_free_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
