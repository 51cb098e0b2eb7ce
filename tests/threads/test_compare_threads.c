/* SPDX-License-Identifier: MIT */
/* test_compare_threads.c - eight threads compare at once, with shared references, and find what one thread finds. */
#include "fixture.h"
#include "octreel/compare.h"

#include <png.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 40, KINDS = 6, THREADS = 8, ROUNDS = 60 };

/* The picture of a kind: kinds 0 and 1 have equal pixels. */
static unsigned char pixels[KINDS][4 * SIDE * SIDE];
static char files[KINDS][64];
static octreel_comparison expected[KINDS][KINDS][3];

static void make_files(const char *folder)
{
    for (int kind = 0; kind < KINDS; kind++) {
        png_image picture = {.version = PNG_IMAGE_VERSION, .width = SIDE, .height = SIDE, .format = PNG_FORMAT_RGBA};
        for (int i = 0; i < 4 * SIDE * SIDE; i++)
            pixels[kind][i] = (unsigned char)(i % 4 == 3 ? 255 - 10 * (kind / 2) : i * (1 + kind / 2));
        snprintf(files[kind], sizeof files[kind], "%s/%d.png", folder, kind);
        assert_true(png_image_write_to_file(&picture, files[kind], 0, pixels[kind], 0, NULL));
    }
    assert_int_equal(truncate(files[KINDS - 1], 100), 0); /* the last file is damaged */
}

/* Compare two kinds in three ways. */
static void compare(int a, int b, octreel_comparison found[3])
{
    const octreel_rectangle corner = {0, 0, 3, 3};
    octreel_compare_def def = octreel_compare_def_default();
    def.antialias = (a + b) % 2 == 0;
    def.ignored = &corner;
    def.ignored_count = 1;
    def.background = 0x204060;
    const octreel_pixels pixels_a = octreel_make_pixels(pixels[a], SIDE, SIDE, OCTREEL_RGBA8);
    const octreel_pixels pixels_b = octreel_make_pixels(pixels[b], SIDE, SIDE, OCTREEL_RGBA8);
    octreel_compare_pixels(&pixels_a, &pixels_b, &def, &found[0]);
    octreel_compare_pixels_to_file(&pixels_a, files[b], &def, &found[1]);
    octreel_compare_files(files[a], files[b], &def, &found[2]);
}

static bool is_same_result(const octreel_comparison *x, const octreel_comparison *y)
{
    return x->verdict == y->verdict && x->different == y->different && x->counted == y->counted &&
           x->ignored == y->ignored && x->antialiased == y->antialiased && x->worst_delta == y->worst_delta &&
           x->worst_x == y->worst_x && x->max_y == y->max_y && strcmp(x->sentence, y->sentence) == 0;
}

/* A thread's work. Returns null if every result is the expected one. */
static void *compare_all(void *context)
{
    const int first = *(const int *)context;
    for (int round = 0; round < ROUNDS; round++) {
        const int n = (first + round * 7) % (KINDS * KINDS), a = n / KINDS, b = n % KINDS;
        octreel_comparison found[3];
        compare(a, b, found);
        for (int way = 0; way < 3; way++)
            if (!is_same_result(&found[way], &expected[a][b][way]))
                return &expected[a][b][way];
    }
    return NULL;
}

static void threads_find_what_one_thread_finds(void **state)
{
    (void)state;
    char folder[] = "compare_threads_XXXXXX";
    pthread_t threads[THREADS];
    int numbers[THREADS], verdicts[3] = {0};
    assert_non_null(mkdtemp(folder));
    make_files(folder);
    for (int n = 0; n < KINDS * KINDS; n++) {
        compare(n / KINDS, n % KINDS, expected[n / KINDS][n % KINDS]);
        for (int way = 0; way < 3; way++)
            verdicts[expected[n / KINDS][n % KINDS][way].verdict]++;
    }
    for (int i = 0; i < 3; i++)
        assert_in_range(verdicts[i], 10, 3 * KINDS * KINDS); /* every verdict occurs */
    for (int i = 0; i < THREADS; i++) {
        numbers[i] = i * 5;
        assert_int_equal(pthread_create(&threads[i], NULL, compare_all, &numbers[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        void *wrong;
        assert_int_equal(pthread_join(threads[i], &wrong), 0);
        if (wrong)
            fail_msg("expected: %s", ((const octreel_comparison *)wrong)->sentence);
    }
    for (int kind = 0; kind < KINDS; kind++)
        remove(files[kind]);
    rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_find_what_one_thread_finds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
