/* SPDX-License-Identifier: MIT */
/* test_baseline_bombs.c - no baseline takes more memory than baseline.h allows for its size. */
#include "baseline.h"
#include "fixture.h"
#include "text_bomb.h"

enum { MOST_BYTES_A_BYTE = 16 };

static octreel_error error;
static size_t frames;

static void read_baseline(char *text, size_t size)
{
    diff_side side = {.path = "bomb"};
    error.text[0] = 0;
    baseline_parse(&side, text, size, &error);
    frames = side.count;
    diff_side_release(&side);
}

#define HEAD "octreel-digests "
#define GROUND "\nbackground ffffff\n"
#define ACCEPTED "accepted 7f 2026-11-22 8x8 runs a\n"
#define DIGEST "0123456789abcdef "

static const text_bomb files[] = {
    {"sizes", HEAD "2" GROUND "accepted 7f 2026-11-22 ", "1", "x8 runs a\n"},
    {"one name", HEAD "2" GROUND ACCEPTED "7f " DIGEST, "a", "\n"},
    {"empty lines", HEAD "2" GROUND, "\n", ""},
    {"a line", HEAD, "2", ""},
    {"frames", HEAD "2" GROUND ACCEPTED, "7f " DIGEST "@\n", ""},
    {"variants", HEAD "2" GROUND ACCEPTED, "7f 0123456789@ a\n", ""},
    {"one frame", HEAD "2" GROUND ACCEPTED, "7f " DIGEST "a\n", ""},
    {"acceptances", HEAD "2" GROUND, ACCEPTED, ""},
    {"reasons", HEAD "2" GROUND "accepted 7f 2026-11-22 8x8 runs ", "a", "\n"},
};

static void baseline_takes_at_most_16_bytes_of_memory_per_byte(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const double each = text_bomb_measure(&files[i], read_baseline);
        print_message("%-12s %5.1f bytes a byte; %zu frames; %s\n", files[i].name, each, frames, error.text);
        assert_true(each < MOST_BYTES_A_BYTE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(baseline_takes_at_most_16_bytes_of_memory_per_byte)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
