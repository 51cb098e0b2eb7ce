/* SPDX-License-Identifier: MIT */
/* test_menu.c - an image test with cmocka. */
#include "../menu.h"

#include <octreel/compare.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static void menu_looks_as_accepted(void **state)
{
    (void)state;
    octreel_comparison found;
    const octreel_pixels menu = octreel_make_pixels(draw_menu(), MENU_WIDTH, MENU_HEIGHT, OCTREEL_RGBA8);
    if (octreel_compare_pixels_to_file(&menu, "golden/menu.png", NULL, &found) != OCTREEL_VERDICT_SAME)
        fail_msg("%s", found.sentence);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(menu_looks_as_accepted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
