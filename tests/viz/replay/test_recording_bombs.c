/* SPDX-License-Identifier: MIT */
/* test_recording_bombs.c - reading ticks.jsonl takes at most as much memory as the ticks of its session. */
#include <stdlib.h>
#include <string.h>

#include "heap_peak.h"
#include "recordings.h"
#include "verified.h"

enum { LARGE = 1 << 22 };

/* Without frames, so that no renderer is opened. */
static place film_ticks(const temp_folder *own)
{
    const place folder = place_in(own, "film");
    octree_session session = octree_session_default();
    session.keys = "ndwwd";
    session.ticks = 0;
    film_options options = small_film(folder.path);
    options.every = 0;
    assert_filmed(&session, &options);
    return folder;
}

static size_t peak_of(const place *folder, bool same)
{
    heap_peak_begin();
    const verify_report report = verify(folder);
    assert_int_equal(report.count == 0, same);
    return heap_peak();
}

/* Each text is as large as a file may be: one line, many lines, or a deeply nested line. */
static void ticks_jsonl_takes_no_more_memory_than_its_session(void **state)
{
    static const struct {
        const char *begin, *repeated;
    } rows[] = {{"", "a"}, {"", "\n"}, {"", "["}, {"{\"tick\":0,\"events\":[", "{},"}, {"{\"tick\":0,\"key\":\"", "w"}};
    const place folder = film_ticks(*state), ticks = place_below(folder.path, "ticks.jsonl");
    const size_t before = peak_of(&folder, true);
    char *large = malloc(LARGE);
    assert_non_null(large);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const size_t length = strlen(rows[i].begin), size = strlen(rows[i].repeated);
        memcpy(large, rows[i].begin, length);
        for (size_t at = length; at < LARGE; at++)
            large[at] = rows[i].repeated[(at - length) % size];
        file_write(ticks.path, large, LARGE);
        assert_true(peak_of(&folder, false) < 2 * before + 200000);
    }
    free(large);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(
        ticks_jsonl_takes_no_more_memory_than_its_session, temp_folder_make, nested_folder_remove)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
