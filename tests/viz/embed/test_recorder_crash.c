/* SPDX-License-Identifier: MIT */
/* test_recorder_crash.c - the recording of a killed program is resumed. The test forks before anything is drawn, which
 * is why it is a program of its own. */
#include "fixture.h"

#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands.h"
#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"

/* Kill a program while it records some thirty ticks. */
static void record_and_die(const place *folder)
{
    const pid_t child = fork();
    if (child == 0) {
        moving_tree m;
        moving_tree_make(&m, OCTREE_GROW, 6);
        const octreel_recorder_def def = small_recorder(&m, folder->path);
        octreel_recorder *recorder = open_recorder(&def);
        record_steps(recorder, &m, 30);
        kill(getpid(), SIGKILL);
    }
    int status;
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFSIGNALED(status));
}

/* All passed ticks are recorded, except those in the queue. The last line may be torn, for example after a full disk.
 */
static void recording_of_a_crashed_program_is_resumed(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const place live = place_below(folder.path, "session.json.live");
    record_and_die(&folder);
    assert_false(file_exists(place_below(folder.path, "session.json").path));
    FILE *torn = fopen(live.path, "a");
    assert_non_null(torn);
    assert_true(fputs("{\"tick\": 99, \"edits\": [{\"ins", torn) >= 0 && fclose(torn) == 0);
    command_result result = run_octreel(NULL, "record --resume -o %s", folder.path);
    assert_done(&result);
    command_release(&result);
    const size_t ticks = for_each_line(folder.path, NULL, NULL);
    assert_true(ticks > 10 && ticks <= 30); /* the queue holds 16 ticks */
    assert_films_again(&folder, &again, ticks);
    assert_false(file_exists(live.path));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(recording_of_a_crashed_program_is_resumed, temp_folder_make,
                                        nested_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
