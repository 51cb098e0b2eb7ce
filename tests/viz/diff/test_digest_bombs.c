/* SPDX-License-Identifier: MIT */
/* test_digest_bombs.c - no file of digests takes more memory than digest_file.h says for its size. */
#include "digest_file.h"
#include "fixture.h"
#include "text_bomb.h"

enum { MOST_BYTES_A_BYTE = 16 };

static octreel_error error;
static size_t frames;

static void read_digests(char *text, size_t size)
{
    diff_side side = {.path = "bomb"};
    error.text[0] = 0;
    digest_file_parse(&side, text, size, &error);
    frames = side.count;
    diff_side_release(&side);
}

#define HEAD "octreel-digests "
#define GROUND "\nbackground ffffff\n"
#define ACCEPTED "accepted 7f 2026-11-22 8x8 runs a\n"
#define DIGEST "0123456789abcdef "

static const text_bomb files[] = {
    {"digests", HEAD "1" GROUND, DIGEST "1x1 @\n", ""},
    {"sizes", HEAD "1" GROUND, DIGEST "1000000000000x1000000000000 @\n", ""},
    {"one name", HEAD "1" GROUND DIGEST "1x1 ", "a", "\n"},
    {"empty lines", HEAD "1" GROUND, "\n", ""},
    {"a line", HEAD, "1", ""},
    {"frames", HEAD "2" GROUND ACCEPTED, "7f " DIGEST "@\n", ""},
    {"variants", HEAD "2" GROUND ACCEPTED, "7f 0123456789@ a\n", ""},
    {"one frame", HEAD "2" GROUND ACCEPTED, "7f " DIGEST "a\n", ""},
    {"acceptances", HEAD "2" GROUND, ACCEPTED, ""},
    {"reasons", HEAD "2" GROUND "accepted 7f 2026-11-22 8x8 runs ", "a", "\n"},
};

static void digests_take_16_bytes_a_byte(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const double each = text_bomb_measure(&files[i], read_digests);
        print_message("%-12s %5.1f bytes a byte; %zu frames; %s\n", files[i].name, each, frames, error.text);
        assert_true(each < MOST_BYTES_A_BYTE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(digests_take_16_bytes_a_byte)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
