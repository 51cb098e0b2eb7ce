/* SPDX-License-Identifier: MIT */
/* test_readme_job.c - the README's job for GitHub: its lines are run as they stand there, but for the one that installs
 * with apt and builds. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

/* A folder as the job finds it, and the job. */
typedef struct job {
    void *folder; /* a temp_folder */
    char *yaml;
} job;

/* The README's block of YAML; the caller frees it. */
static char *read_block(void)
{
    static const char fence[] = "\n```yaml\n";
    char *readme = file_read(OCTREEL_ROOT "/README.md", NULL), *begin = strstr(readme, fence);
    assert_non_null(begin);
    begin += sizeof fence - 1;
    char *end = strstr(begin, "```");
    assert_non_null(end);
    char *block = strndup(begin, (size_t)(end - begin));
    free(readme);
    return block;
}

/* What is checked out and built: the program where the lines look for it, and the session. */
static void check_out(const job *j, const char *name)
{
    const char *folder = ((temp_folder *)j->folder)->name;
    const shell_word examples = shell_quote(OCTREEL_ROOT "/tests/examples");
    command_result result =
        run_script("cd '%s' && mkdir -p %s/build/bin %s/tests && ln -s %s %s/build/bin/octreel && cp -R %s %s/tests",
                   folder, name, name, octreel_program(), name, examples.text, name);
    assert_done(&result);
    command_release(&result);
}

static int prepare_job(void **state)
{
    job *j = calloc(1, sizeof *j);
    *state = j;
    if (j == NULL || temp_folder_make(&j->folder) != 0)
        return -1;
    j->yaml = read_block();
    check_out(j, "old");
    check_out(j, "new");
    return 0;
}

/* The change that the job is about: another key at tick 5. */
static void change_session(const job *j)
{
    command_result result = run_script("cd '%s/new/tests/examples' && sed 's/wwddeen/wwddaen/' my.json >changed && "
                                       "! cmp -s changed my.json && mv changed my.json",
                                       ((temp_folder *)j->folder)->name);
    assert_done(&result);
    command_release(&result);
}

static int forget_job(void **state)
{
    job *j = *state;
    const int status = nested_folder_remove(&j->folder);
    free(j->yaml);
    free(j);
    return status;
}

/* Run each step as the runner of a container does, up to one that fails. Returns its status. */
static int run_steps(const job *j)
{
    static const char run[] = "- run: ";
    int status = 0, steps = 0;
    for (const char *at = j->yaml; status == 0 && (at = strstr(at, run)) != NULL;) {
        at += sizeof run - 1;
        char *line = strndup(at, strcspn(at, "\n"));
        assert_non_null(line);
        if (strstr(line, "viz/setup") == NULL) {
            file_write_text(place_in(j->folder, "step").path, line);
            command_result result = run_script("cd %s && GITHUB_STEP_SUMMARY=\"$PWD/summary\" sh -e step",
                                               ((temp_folder *)j->folder)->name);
            status = result.status;
            if (status != 0)
                assert_string_equal(result.err, "");
            command_release(&result);
            steps++;
        }
        free(line);
    }
    assert_true(steps == 3 || status != 0);
    return status;
}

static void assert_summary_says(const job *j, const char *part)
{
    char *summary = file_read(place_in(j->folder, "summary").path, NULL);
    if (strstr(summary, part) == NULL)
        fail_msg("\"%s\" does not say \"%s\"", summary, part);
    free(summary);
}

static void job_passes_where_nothing_differs(void **state)
{
    const job *j = *state;
    assert_int_equal(run_steps(j), 0);
    assert_summary_says(j, "### octreel diff: same: 40 frames");
}

/* What is kept is what was left, and the summary is added to what there is already. */
static void job_fails_where_a_frame_differs_and_keeps_the_evidence(void **state)
{
    const job *j = *state;
    static const char path[] = "name: why, path: ";
    change_session(j);
    file_write_text(place_in(j->folder, "summary").path, "Of an earlier step.\n");
    assert_int_equal(run_steps(j), 1);
    assert_summary_says(j, "Of an earlier step.\n### octreel diff: different: ");
    assert_summary_says(j, "\n| <code>frame_000005.png</code> | ");
    const char *kept = strstr(j->yaml, path);
    assert_non_null(kept);
    char *folder = strndup(kept + sizeof path - 1, strcspn(kept + sizeof path - 1, "}\n"));
    assert_true(file_exists(place_below(place_in(j->folder, folder).path, "report.html").path));
    assert_true(file_exists(place_below(place_in(j->folder, folder).path, "frame_000005.difference.png").path));
    free(folder);
}

static void job_is_yaml(void **state)
{
    const job *j = *state;
    command_result result = run_shell("python3 -c 'import yaml' 2>/dev/null");
    const bool is_there = result.status == 0;
    command_release(&result);
    if (!is_there)
        skip();
    file_write_text(place_in(j->folder, "job.yml").path, j->yaml);
    result = run_script("python3 -c 'import sys, yaml\nsteps = yaml.safe_load(open(sys.argv[1]))[\"jobs\"][\"frames\"]"
                        "[\"steps\"]\nprint(len(steps), steps[-1][\"if\"], steps[-1][\"with\"][\"path\"])' %s",
                        place_in(j->folder, "job.yml").path);
    assert_done(&result);
    assert_string_equal(result.out, "7 failure() why\n");
    command_release(&result);
}

#define JOB(test) cmocka_unit_test_setup_teardown(test, prepare_job, forget_job)

int main(void)
{
    const struct CMUnitTest tests[] = {
        JOB(job_passes_where_nothing_differs),
        JOB(job_fails_where_a_frame_differs_and_keeps_the_evidence),
        JOB(job_is_yaml),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
