/* SPDX-License-Identifier: MIT */
/* A program may have functions of any name. These have names that the library has inside, and it never calls them. */
#include <octreel/compare.h>

#include <stdlib.h>
#include <string.h>

void compare_pixels(void);
void error_set(void);
void image_compare_within(void);

void compare_pixels(void)
{
    abort();
}

void error_set(void)
{
    abort();
}

void image_compare_within(void)
{
    abort();
}

int main(void)
{
    const unsigned char grey[] = {0, 128, 255, 7}, rgb[] = {0, 0, 0, 128, 128, 128, 255, 255, 255, 7, 7, 8};
    const octreel_pixels a = octreel_make_pixels(grey, 2, 2, OCTREEL_GREY8);
    const octreel_pixels b = octreel_make_pixels(rgb, 2, 2, OCTREEL_RGB8);
    octreel_comparison found;
    if (octreel_compare_pixels(&a, &a, NULL, NULL) != OCTREEL_VERDICT_SAME ||
        octreel_compare_pixels(&a, &b, NULL, &found) != OCTREEL_VERDICT_DIFFERENT || found.different != 1)
        return 1;
    if (octreel_compare_files("missing.png", "missing.png", NULL, &found) != OCTREEL_VERDICT_TROUBLE)
        return 1;
    return strstr(found.sentence, "missing.png: no reference") == found.sentence ? 0 : 1;
}
