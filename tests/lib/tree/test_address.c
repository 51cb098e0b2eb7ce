/* SPDX-License-Identifier: MIT */
/* test_address.c - addresses and their text. */
#include "fixture.h"

#include <string.h>

static void the_root_is_one_and_has_depth_zero(void **state)
{
    (void)state;
    char text[OCTREE_ADDRESS_TEXT];
    assert_true(OCTREE_ROOT == 1);
    assert_int_equal(octree_address_depth(OCTREE_ROOT), 0);
    assert_true(octree_address_format(OCTREE_ROOT, text) == text);
    assert_string_equal(text, "root");
}

static void an_address_lists_its_octants_from_the_root_down(void **state)
{
    (void)state;
    octree_address address = ((OCTREE_ROOT << 3 | 0) << 3 | 3) << 3 | 7;
    char text[OCTREE_ADDRESS_TEXT];
    assert_int_equal(octree_address_depth(address), 3);
    assert_int_equal(octree_address_octant(address, 0), 0);
    assert_int_equal(octree_address_octant(address, 1), 3);
    assert_int_equal(octree_address_octant(address, 2), 7);
    assert_string_equal(octree_address_format(address, text), "0/3/7");
}

static void an_invalid_address_has_depth_zero_and_no_octants(void **state)
{
    (void)state;
    octree_address address;
    assert_int_equal(octree_address_depth(0), 0);
    assert_int_equal(octree_address_octant(0, 0), 0);
    assert_int_equal(octree_address_octant(OCTREE_ROOT, 0), 0);
    assert_int_equal(octree_address_octant(017, 1), 0);
    assert_false(octree_address_parse(NULL, &address));
    assert_false(octree_address_parse("0", NULL));
}

static void text_and_address_are_inverse(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 2000; i++) {
        octree_address address = OCTREE_ROOT;
        unsigned depth = (unsigned)(i % (OCTREE_MAX_DEPTH + 1));
        for (unsigned level = 0; level < depth; level++)
            address = address << 3 | (i < 22 ? 7 : random_below(&random, 8));
        char text[OCTREE_ADDRESS_TEXT];
        octree_address parsed = 0;
        octree_address_format(address, text);
        assert_true(strlen(text) < OCTREE_ADDRESS_TEXT);
        assert_true(octree_address_parse(text, &parsed));
        assert_true(parsed == address);
        assert_int_equal(octree_address_depth(address), depth);
    }
}

static void parse_accepts_both_names_of_the_root(void **state)
{
    (void)state;
    octree_address address = 0;
    assert_true(octree_address_parse("root", &address));
    assert_true(address == OCTREE_ROOT);
    address = 0;
    assert_true(octree_address_parse("/", &address));
    assert_true(address == OCTREE_ROOT);
}

static void parse_refuses_text_that_is_not_an_address(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",
        " ",
        "8",
        "9",
        "a",
        "0/",
        "/0",
        "//",
        "0//1",
        "0/8",
        "01",
        "0 / 1",
        "0/1 ",
        " 0",
        "-1",
        "+1",
        "0,1",
        "Root",
        "root/0",
        "roo",
        "roots",
        "0/3/7/",
        "0/3/7\n",
        "1e0",
        "0x1",
        "0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0", /* 22 octants */
        "7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7/7",
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        octree_address address;
        if (octree_address_parse(bad[i], &address))
            fail_msg("\"%s\" was taken for an address", bad[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_root_is_one_and_has_depth_zero),
        cmocka_unit_test(an_address_lists_its_octants_from_the_root_down),
        cmocka_unit_test(an_invalid_address_has_depth_zero_and_no_octants),
        cmocka_unit_test(text_and_address_are_inverse),
        cmocka_unit_test(parse_accepts_both_names_of_the_root),
        cmocka_unit_test(parse_refuses_text_that_is_not_an_address),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
