/* SPDX-License-Identifier: MIT */
/* test_compare_memory.c - if the n-th allocation of a comparison fails, for n = 0, 1, 2 ..., the verdict is TROUBLE,
 * and nothing is lost. */
#include "accept.h"
#include "failing_memory.h"
#include "files.h"
#include "fixture.h"
#include "images.h"
#include "octreel/compare.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 20 };

/* Two pictures that differ, as pixels in a format that must be converted, and as files. */
typedef struct pictures {
    unsigned char pixels[2][4 * SIDE * SIDE];
    place files[2], baseline, store;
} pictures;

static void make_pictures(const temp_folder *folder, pictures *p)
{
    for (int i = 0; i < 2; i++) {
        image rgb;
        memset(p->pixels[i], 200 - 100 * i, sizeof p->pixels[i]);
        p->files[i] = place_in(folder, i ? "b.png" : "a.png");
        assert_true(image_create(&rgb, SIDE, SIDE, 3));
        memset(rgb.pixels, 200 - 100 * i, 3 * SIDE * SIDE);
        assert_written(&rgb, p->files[i].path);
        image_release(&rgb);
    }
    octreel_error error;
    frame_list all = {NULL, 0, 0, NULL};
    p->baseline = place_in(folder, "baseline.txt");
    p->store = place_in(folder, "store");
    assert_true(accept_frames(&(accept_options){.reference = p->baseline.path,
                                                .frames = p->files[0].path,
                                                .names = &all,
                                                .store = p->store.path,
                                                .note = {.date = "2026-11-27", .reason = "a test"}},
                              NULL, &error));
    char *text = file_read(p->baseline.path, NULL), with_rule[1000];
    snprintf(with_rule, sizeof with_rule, "%srule * max-pixels=9 ignore=0,0,2,2 reason=a test\n", text);
    file_write_text(p->baseline.path, with_rule);
    free(text);
}

enum { PIXELS, PIXELS_TO_FILE, FILES, PIXELS_TO_BASELINE, PIXELS_TO_STORE, WAYS };

/* Compare in one of these ways. They differ. */
static octreel_verdict compare(const pictures *p, int way, bool antialias, octreel_comparison *found)
{
    octreel_compare_def def = octreel_compare_def_default();
    const octreel_pixels a = octreel_make_pixels(p->pixels[1], SIDE, SIDE, OCTREEL_BGRA8);
    const octreel_pixels b = octreel_make_pixels(p->pixels[0], SIDE, SIDE, OCTREEL_BGRA8);
    def.antialias = antialias;
    if (way == PIXELS)
        return octreel_compare_pixels(&a, &b, &def, found);
    if (way == FILES)
        return octreel_compare_files(p->files[1].path, p->files[0].path, &def, found);
    if (way == PIXELS_TO_FILE)
        return octreel_compare_pixels_to_file(&a, p->files[0].path, &def, found);
    def.store = p->store.path;
    def.today = "2026-11-27";
    return octreel_compare_pixels_to_file(&a, p->baseline.path, way == PIXELS_TO_STORE ? &def : NULL, found);
}

static void lack_of_memory_is_trouble(void **state)
{
    pictures p;
    make_pictures(*state, &p);
    for (int way = 0; way < WAYS; way++) {
        for (int variant = 0; variant < 4; variant++) {
            long count = 0;
            bool failed = true;
            for (; failed && count < 1000; count++) {
                octreel_comparison found;
                fail_allocations_after(count);
                if (variant & 1)
                    fail_one_allocation();
                const octreel_verdict verdict = compare(&p, way, variant & 2, &found);
                failed = memory_has_failed();
                assert_int_equal(verdict, found.verdict);
                if (failed && verdict == OCTREEL_VERDICT_TROUBLE)
                    assert_non_null(strstr(found.sentence, "emory"));
                else
                    assert_int_equal(verdict, OCTREEL_VERDICT_DIFFERENT);
            }
            assert_in_range(count, 2, 999); /* some allocation failed, and at last none */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lack_of_memory_is_trouble, temp_folder_make, nested_folder_remove),
    };
    unsetenv("CI"); /* accept refuses to work there */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
