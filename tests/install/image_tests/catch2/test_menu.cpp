/* SPDX-License-Identifier: MIT */
// An image test with Catch2, version 2 (Debian 12) or 3.
#include "../menu.h"

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#else
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
#include <octreel/compare.h>

TEST_CASE("the menu looks as accepted")
{
    octreel_comparison found;
    const octreel_pixels menu = octreel_make_pixels(draw_menu(), MENU_WIDTH, MENU_HEIGHT, OCTREEL_RGBA8);
    octreel_compare_pixels_to_file(&menu, "golden/menu.png", nullptr, &found);
    INFO(found.sentence);
    REQUIRE(found.verdict == OCTREEL_VERDICT_SAME);
}
