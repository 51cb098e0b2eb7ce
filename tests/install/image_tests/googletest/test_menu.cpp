/* SPDX-License-Identifier: MIT */
// An image test with GoogleTest.
#include "../menu.h"

#include <gtest/gtest.h>
#include <octreel/compare.h>

TEST(Menu, LooksAsAccepted)
{
    octreel_comparison found;
    const octreel_pixels menu = octreel_make_pixels(draw_menu(), MENU_WIDTH, MENU_HEIGHT, OCTREEL_RGBA8);
    EXPECT_EQ(octreel_compare_pixels_to_file(&menu, "golden/menu.png", nullptr, &found), OCTREEL_VERDICT_SAME)
        << found.sentence;
}
