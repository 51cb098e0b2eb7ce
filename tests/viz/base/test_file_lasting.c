/* SPDX-License-Identifier: MIT */
/* test_file_lasting.c - files that a power cut leaves whole: synced before they take the place of the old ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "file.h"
#include "temp_folder.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static struct {
    const char *path; /* of which the old bytes are looked for when something is synced */
    int calls, reason;
    bool old_was_there;
} sync_seen;

static bool holds(const char *path, const char *text)
{
    char found[16] = "";
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(found, 1, sizeof found - 1, file) : 0;
    if (file)
        fclose(file);
    return size == strlen(text) && memcmp(found, text, size) == 0;
}

/* In place of the system's. */
int fsync(int file)
{
    (void)file;
    sync_seen.calls++;
    sync_seen.old_was_there = holds(sync_seen.path, "old");
    errno = sync_seen.reason;
    return sync_seen.reason ? -1 : 0;
}

static bool write_text(const char *path, const char *text, bool lasting)
{
    file_writer file;
    octreel_error error;
    assert_true(file_writer_open(&file, path, &error));
    file.lasting = lasting;
    fputs(text, file.stream);
    return file_writer_close(&file, &error);
}

/* Written over an old file while fsync() says this; how often it was asked. */
static int syncs(temp_folder *folder, bool lasting, int reason, bool *written)
{
    const char *path = temp_file(folder, "a");
    assert_true(write_text(path, "old", false));
    memset(&sync_seen, 0, sizeof sync_seen);
    sync_seen.path = path;
    sync_seen.reason = reason;
    *written = write_text(path, "new", lasting);
    assert_int_equal(temp_folder_count(folder), 1); /* nothing half written */
    return sync_seen.calls;
}

static void what_lasts_is_synced_while_the_old_file_is_there(void **state)
{
    bool written;
    assert_int_equal(syncs(*state, true, 0, &written), 1);
    assert_true(written && sync_seen.old_was_there && holds(sync_seen.path, "new"));
}

static void other_files_are_not_waited_for(void **state)
{
    bool written;
    assert_int_equal(syncs(*state, false, 0, &written), 0);
    assert_true(written && holds(sync_seen.path, "new"));
}

static void writer_that_could_not_be_opened_can_be_discarded(void **state)
{
    file_writer file;
    octreel_error error;
    const char *path = temp_file(*state, "missing/a");
    assert_false(file_writer_open(&file, path, &error));
    assert_null(file.temp);
    assert_false(file_writer_discard(&file));
}

static void a_disk_that_fails_leaves_the_old_file(void **state)
{
    bool written;
    assert_int_equal(syncs(*state, true, EIO, &written), 1);
    assert_true(!written && holds(sync_seen.path, "old"));
}

static void a_file_system_that_cannot_sync_is_written_all_the_same(void **state)
{
    bool written;
    assert_int_equal(syncs(*state, true, EINVAL, &written), 1);
    assert_true(written && holds(sync_seen.path, "new"));
}

static bool copy_beside(const char *from, const char *to, octreel_error *error)
{
    file_writer file;
    assert_true(file_copy_prepare(&file, from, to, error));
    assert_true(holds(to, "old"));
    return file_writer_rename(&file, error);
}

static void copies_that_last_are_synced_too(void **state)
{
    char from[sizeof((temp_folder *)0)->path];
    octreel_error error;
    bool (*const copies[])(const char *, const char *, octreel_error *) = {copy_beside, file_copy_unique};
    snprintf(from, sizeof from, "%s", temp_file(*state, "b"));
    assert_true(write_text(from, "new", false));
    const char *path = temp_file(*state, "a");
    for (int i = 0; i < 2; i++) {
        assert_true(write_text(path, "old", false));
        memset(&sync_seen, 0, sizeof sync_seen);
        sync_seen.path = path;
        assert_true(copies[i](from, path, &error));
        assert_true(sync_seen.calls == 1 && sync_seen.old_was_there && holds(path, "new"));
    }
}

int main(void)
{
#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(what_lasts_is_synced_while_the_old_file_is_there),
        IN_A_FOLDER(other_files_are_not_waited_for),
        IN_A_FOLDER(a_disk_that_fails_leaves_the_old_file),
        IN_A_FOLDER(a_file_system_that_cannot_sync_is_written_all_the_same),
        IN_A_FOLDER(copies_that_last_are_synced_too),
        IN_A_FOLDER(writer_that_could_not_be_opened_can_be_discarded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
