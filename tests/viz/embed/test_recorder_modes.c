/* SPDX-License-Identifier: MIT */
/* test_recorder_modes.c - a program in any floating-point mode records the same bytes as in the default mode, and keeps
 * its mode. */
#include "fixture.h"

#include <fenv.h>

#include "files.h"
#include "film_again.h"
#include "moving_tree.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

typedef struct mode {
    int rounding;
    bool flushes; /* subnormal numbers to zero, if the processor can */
} mode;

static unsigned flush_bits(void)
{
#if defined(__SSE2__)
    return _mm_getcsr() & 0x8040u;
#else
    return 0;
#endif
}

static void set_mode(const mode *m)
{
    assert_int_equal(fesetround(m->rounding), 0);
#if defined(__SSE2__)
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | (m->flushes ? 0x8040u : 0));
#endif
}

/* After a call: the mode is still set; the test itself goes on in the default mode. */
static void assert_kept(const mode *m)
{
    const int rounding = fegetround();
    const unsigned bits = flush_bits();
    set_mode(m);
    const unsigned expected = flush_bits();
    set_mode(&(mode){FE_TONEAREST, false});
    assert_int_equal(rounding, m->rounding);
    assert_int_equal(bits, expected);
}

static octreel_recorder *open_in_mode(const octreel_recorder_def *def, const mode *m)
{
    octreel_recorder *recorder;
    octreel_error error = {""};
    set_mode(m);
    const octreel_status status = octreel_recorder_open(def, &recorder, &error);
    assert_kept(m);
    if (status != OCTREEL_OK)
        fail_msg("%s", error.text);
    return recorder;
}

static void record_in_mode(octreel_recorder *recorder, const moving_tree *tree, moving_tree_source source,
                           moving_edits *edits, const mode *m)
{
    set_mode(m);
    const octreel_status status = record_tick_from(recorder, tree, source, edits);
    assert_kept(m);
    if (status != OCTREEL_OK)
        fail_msg("%s", octreel_recorder_error(recorder));
    set_mode(m);
    const octreel_status refused = octreel_recorder_tick(recorder, tree->tree, &(octreel_tick_info){.query_count = 1});
    assert_kept(m);
    assert_int_equal(refused, OCTREEL_NULL_ARGUMENT);
}

/* Record a program whose points are a tree, lists or changes. A ring is written at the end. */
static void record_program(const char *folder, moving_tree_source source, size_t ring, const mode *m)
{
    moving_tree tree;
    static moving_edits edits;
    edits = (moving_edits){.count = 0};
    moving_tree_make(&tree, OCTREE_GROW, 5);
    octreel_recorder_def def = small_recorder(&tree, ring ? NULL : folder);
    def.ring = ring;
    def.lod = 0.1; /* prints as another number in other rounding modes */
    octreel_recorder *recorder = open_in_mode(&def, m);
    for (int tick = 0; tick < 12; tick++) {
        moving_edits_make(&edits, &tree);
        record_in_mode(recorder, &tree, source, &edits, m);
        moving_tree_step(&tree);
    }
    set_mode(m);
    const octreel_status written = ring ? octreel_recorder_write(recorder, folder, NULL) : OCTREEL_GAPS;
    const octreel_status closed = octreel_recorder_close(recorder);
    assert_kept(m);
    assert_int_equal(written, OCTREEL_GAPS);
    assert_int_equal(closed, OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    moving_tree_release(&tree);
}

static void check_source(void **state, moving_tree_source source, size_t ring)
{
    static const mode modes[] = {{FE_UPWARD, false}, {FE_DOWNWARD, false}, {FE_TOWARDZERO, true}, {FE_TONEAREST, true}};
    static const char *const names[] = {"up", "down", "zero", "flush"};
    const place usual = place_in(*state, "usual");
    record_program(usual.path, source, ring, &(mode){FE_TONEAREST, false});
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        const place folder = place_in(*state, names[i]);
        record_program(folder.path, source, ring, &modes[i]);
        assert_same_folders(usual.path, folder.path, NULL);
    }
}

static void tree_is_recorded_the_same_in_every_mode(void **state)
{
    check_source(state, MOVING_TREE, 0);
}

static void lists_are_recorded_the_same_in_every_mode(void **state)
{
    check_source(state, MOVING_LIST, 0);
}

static void changes_are_recorded_the_same_in_every_mode(void **state)
{
    check_source(state, MOVING_CHANGES, 0);
}

static void ring_is_written_the_same_in_every_mode(void **state)
{
    check_source(state, MOVING_TREE, 5);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(tree_is_recorded_the_same_in_every_mode),
        TEST(lists_are_recorded_the_same_in_every_mode),
        TEST(changes_are_recorded_the_same_in_every_mode),
        TEST(ring_is_written_the_same_in_every_mode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
