/* SPDX-License-Identifier: MIT */
/* verified.c - see verified.h. */
#include "verified.h"

#include <string.h>

#include "recordings.h"

place film_short(const temp_folder *own)
{
    const place folder = place_in(own, "film");
    octree_session session = octree_session_default();
    session.keys = "ndwwwwddddnss";
    session.ticks = 0;
    film_options options = small_film(folder.path);
    options.every = SHORT_EVERY;
    const film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.ticks, SHORT_TICKS);
    assert_int_equal(summary.frames, SHORT_FRAMES);
    return folder;
}

void empty_test_folder(void **state)
{
    assert_int_equal(nested_folder_remove(state), 0);
    assert_int_equal(temp_folder_make(state), 0);
}

static verify_report verify_by(const place *folder, unsigned jobs)
{
    verify_report report;
    octreel_error error = {""};
    if (!verify_recording(folder->path, &(verify_options){.jobs = jobs}, &report, &error))
        fail_msg("%s", error.text);
    return report;
}

/* Several processes report what one process reports. */
verify_report verify(const place *folder)
{
    const verify_report several = verify_by(folder, 3), one = verify_by(folder, 1);
    assert_int_equal(several.count, one.count);
    for (size_t i = 0; i < one.count; i++)
        assert_memory_equal(&several.findings[i], &one.findings[i], sizeof one.findings[i]);
    assert_int_equal(several.ticks, one.ticks);
    assert_int_equal(several.frames, one.frames);
    assert_int_equal(several.gaps, one.gaps);
    assert_int_equal(several.pixels, one.pixels);
    assert_string_equal(several.drawn_now, one.drawn_now);
    assert_string_equal(several.fill, one.fill);
    return one;
}

void assert_identical(const place *folder, uint64_t ticks, uint64_t frames)
{
    const verify_report report = verify(folder);
    if (report.count)
        fail_msg("%s", report.findings[0].text);
    assert_int_equal(report.ticks, ticks);
    assert_int_equal(report.frames, frames);
}

verify_report assert_found(const place *folder, verify_kind kind, uint64_t tick, const char *part)
{
    const verify_report report = verify(folder);
    assert_int_equal(report.count, 1);
    const verify_finding *finding = &report.findings[0];
    if (finding->kind != kind || strstr(finding->text, part) == NULL)
        fail_msg("kind %d: %s", (int)finding->kind, finding->text);
    assert_true(finding->has_tick);
    assert_int_equal(finding->tick, tick);
    assert_int_equal(report.ticks, tick < SHORT_TICKS ? tick : SHORT_TICKS);
    return report;
}

void assert_not_verified(const place *folder, const char *part)
{
    const verify_options options = {.jobs = 1};
    verify_report report;
    octreel_error error = {""};
    assert_false(verify_recording(folder->path, &options, &report, &error));
    if (strstr(error.text, part) == NULL)
        fail_msg("%s", error.text);
}
