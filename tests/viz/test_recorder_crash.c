/* test_recorder_crash.c - what is left of the recording of a program that is killed. It forks, which it may while it
 * has drawn nothing: hence a program of its own.
 */
#include "fixture.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files.h"
#include "moving_tree.h"
#include "recordings.h"
#include "session_file.h"

/* The process dies without a word. What it had handed over, but for what was in the queue, is in session.json.live. */
static void what_a_crash_leaves_can_be_filmed(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    const place live = place_below(folder.path, "session.json.live");
    const pid_t child = fork();
    if (child == 0) {
        moving_tree m;
        moving_tree_make(&m, OCTREE_GROW, 6);
        const octreel_recorder_def def = small_recorder(&m, folder.path);
        octreel_recorder *recorder = open_recorder(&def);
        record_steps(recorder, &m, 30);
        kill(getpid(), SIGKILL);
    }
    int status;
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFSIGNALED(status));
    session_file file;
    session_error error = {""};
    if (!session_read(live.path, &file, &error))
        fail_msg("%s", error.text);
    assert_true(file.session.ticks >= 10); /* the queue holds 16 */
    const film_options options = small_film(again.path);
    const film_summary summary = assert_filmed(&file.session, &options);
    assert_int_equal(summary.ticks, file.session.ticks + 1);
    session_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_a_crash_leaves_can_be_filmed, temp_folder_make, nested_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
