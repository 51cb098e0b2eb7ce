/* SPDX-License-Identifier: MIT */
// The library from C++: pixels of a vector, with a tolerance and an ignored rectangle.
#include <octreel/compare.h>

#include <string>
#include <vector>

int main()
{
    std::vector<unsigned char> before(3 * 8 * 8, 100), after = before;
    after[0] = 101; // slightly different
    after[3 * 63] = 255;
    const octreel_pixels a = octreel_make_pixels(before.data(), 8, 8, OCTREEL_RGB8);
    const octreel_pixels b = octreel_make_pixels(after.data(), 8, 8, OCTREEL_RGB8);
    const octreel_rectangle corner = {7, 7, 1, 1};
    octreel_compare_def def = octreel_compare_def_default();
    octreel_comparison found;
    if (octreel_compare_pixels(&b, &a, &def, &found) != OCTREEL_VERDICT_DIFFERENT || found.counted != 2 ||
        found.worst_x != 7 || found.worst_y != 7)
        return 1;
    def.max_delta = 0.02;
    def.ignored = &corner;
    def.ignored_count = 1;
    if (octreel_compare_pixels(&b, &a, &def, &found) != OCTREEL_VERDICT_SAME || found.close != 1 || found.ignored != 1)
        return 1;
    return std::string(found.sentence).find("forgiven: ") == std::string::npos;
}
