/* SPDX-License-Identifier: MIT */
/* test_workflow.c - the steps of this project's workflows run, on a machine whose installers and compilers only record
 * that they were called. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "workflow.h"

#define WORKFLOW OCTREEL_ROOT "/.github/workflows/ci.yml"
#define HUNT OCTREEL_ROOT "/.github/workflows/hunt.yml"
#define SITE OCTREEL_ROOT "/.github/workflows/site.yml"
#define ACTIONS OCTREEL_ROOT "/.github/actions"

typedef struct machine {
    void *folder; /* a temp_folder */
    json_t *jobs; /* the jobs of all workflows */
    char *done;   /* one line for each program call */
} machine;

/* Fake programs. octreel is one of them, wherever something is built. */
static const char fakes[] =
    "for name in apt-cache apt-get cmake ctest dpkg-query hunt lintian octreel octreel-failure-campaign setup site; "
    "do\n"
    "    printf '#!/bin/sh\\necho \"%s $*\" >>\"%s/done\"\\n' $name \"$PWD\" >bin/$name\n"
    "    chmod +x bin/$name\n"
    "done\n"
    "printf 'mkdir -p build/bin\\ncp \"%s/bin/octreel\"* build/bin\\n' \"$PWD\" >>bin/setup\n"
    "printf 'for a; do case $a in --markdown=*) echo same >\"${a#*=}\" ;; esac; done\\n' >>bin/octreel\n"
    "printf 'echo install ok installed\\n' >>bin/dpkg-query\n";

static int prepare_machine(void **state)
{
    machine *m = calloc(1, sizeof *m);
    *state = m;
    if (m == NULL || temp_folder_make(&m->folder) != 0)
        return -1;
    json_t *workflow = yaml_read_file(WORKFLOW), *hunt = yaml_read_file(HUNT), *site = yaml_read_file(SITE);
    m->jobs = json_incref(json_object_get(workflow, "jobs"));
    assert_int_equal(json_object_update_missing(m->jobs, json_object_get(hunt, "jobs")), 0);
    assert_int_equal(json_object_update_missing(m->jobs, json_object_get(site, "jobs")), 0);
    json_decref(workflow);
    json_decref(hunt);
    json_decref(site);
    const shell_word root = shell_quote(OCTREEL_ROOT);
    file_write_text(place_in(m->folder, "fakes").path, fakes);
    command_result result =
        run_script("cd %s && mkdir -p bin viz tests && cp -R %s/viz/setup %s/viz/demo viz && "
                   "cp -R %s/tests/run %s/tests/examples tests && cp -R %s/.ci . && sh -e fakes",
                   ((temp_folder *)m->folder)->name, root.text, root.text, root.text, root.text, root.text);
    assert_done(&result);
    command_release(&result);
    return 0;
}

static int forget_machine(void **state)
{
    machine *m = *state;
    json_decref(m->jobs);
    free(m->done);
    const int status = nested_folder_remove(&m->folder);
    free(m);
    return status;
}

/* Replace viz/setup, which takes long and has a test of its own. */
static void fake_setup(const machine *m)
{
    const char *folder = ((temp_folder *)m->folder)->name;
    command_result result = run_script("cd %s && mv bin/setup viz/setup", folder);
    assert_done(&result);
    command_release(&result);
}

/* Run a job with these values of its matrix; m->done receives the calls. */
static void run_job(machine *m, const char *name, const char *key, const char *value)
{
    char expression[64];
    const json_t *job = json_object_get(m->jobs, name);
    workflow w;
    workflow_open(&w, m->folder, ACTIONS);
    workflow_set(&w, "strategy.job-index", "0");
    workflow_set(&w, "github.run_id", "1");
    snprintf(expression, sizeof expression, "matrix.%s", key);
    workflow_set(&w, expression, value);
    remove(place_in(m->folder, "done").path);
    const int status = workflow_run(&w, json_object_get(job, "steps"));
    if (status != 0 || w.steps == 0)
        fail_msg("job %s, %s %s: status %d: %s", name, key, value, status, w.err);
    workflow_close(&w);
    free(m->done);
    m->done = file_read(place_in(m->folder, "done").path, NULL);
}

static void assert_called(const machine *m, const char *part)
{
    if (strstr(m->done, part) == NULL)
        fail_msg("not called: %s\n%s", part, m->done);
}

static void job_tests_builds_and_runs_tests(void **state)
{
    machine *m = *state;
    fake_setup(m);
    run_job(m, "tests", "image", "debian:12");
    assert_called(m, "setup tests ");
    assert_called(m, "ctest --test-dir ");
}

/* There is one job for each build, and together they run everything that tests/run --all runs. */
static void job_all_runs_each_build(void **state)
{
    static const struct {
        const char *part, *argument;
    } parts[] = {
        {"build", "-DOCTREEL_REQUIRE_ORACLES=ON"},
        {"build-sanitize", "-DOCTREEL_SANITIZE=ON"},
        {"build-clang", "-DBUILD_SHARED_LIBS=ON"},
        {"build-fuzz", "-DOCTREEL_FUZZ=ON"},
    };
    machine *m = *state;
    fake_setup(m);
    const json_t *strategy = json_object_get(json_object_get(m->jobs, "all"), "strategy");
    const json_t *named = json_object_get(json_object_get(strategy, "matrix"), "part");
    assert_int_equal(json_array_size(named), sizeof parts / sizeof *parts);
    command_result all = run_script("cd %s && PATH=\"$PWD/bin:$PATH\" && ./tests/run --all && cat done",
                                    ((temp_folder *)m->folder)->name);
    assert_int_equal(all.status, 0);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        char folder[64];
        assert_string_equal(json_string_value(json_array_get(named, i)), parts[i].part);
        run_job(m, "all", "part", parts[i].part);
        snprintf(folder, sizeof folder, "/%s --output-on-failure --no-tests=error -C all", parts[i].part);
        assert_called(m, folder);
        assert_called(m, parts[i].argument);
        for (char *save = NULL, *line = strtok_r(m->done, "\n", &save); line; line = strtok_r(NULL, "\n", &save))
            if (strstr(all.out, line) == NULL)
                fail_msg("./tests/run --all does not do this: %s", line);
    }
    command_release(&all);
}

static void job_page_records_and_compares_the_demo(void **state)
{
    machine *m = *state;
    fake_setup(m);
    run_job(m, "page", "none", "");
    assert_called(m, "octreel record --replace -o ");
    assert_called(m, "octreel diff --annotate --output=octreel-evidence ");
}

/* Packages are missing at first; the line that the script prints installs them. */
static void job_user_runs_the_line_that_a_script_prints(void **state)
{
    static const char lacking[] =
        "printf '#!/bin/sh\\n[ -e there ] || { echo sudo apt-get install gcc >&2; exit 2; }\\n' |"
        " cat - viz/setup >s && mv s viz/setup && chmod +x viz/setup &&"
        " printf '#!/bin/sh\\necho \"sudo $*\" >>done\\ntouch there\\n' >bin/sudo &&"
        " chmod +x bin/sudo";
    static const char *const scripts[][2] = {{"./viz/demo", "octreel record --replace -o "},
                                             {"./tests/run", "setup tests "},
                                             {"./.ci/run", "-DOCTREEL_FUZZ=ON"}};
    machine *m = *state;
    fake_setup(m);
    command_result made = run_script("cd %s && %s", ((temp_folder *)m->folder)->name, lacking);
    assert_done(&made);
    command_release(&made);
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; i++) {
        remove(place_in(m->folder, "there").path);
        run_job(m, "user", "script", scripts[i][0]);
        assert_called(m, "sudo apt-get install gcc\n");
        assert_called(m, scripts[i][1]);
    }
}

static void job_action_compares_frames(void **state)
{
    machine *m = *state;
    assert_int_equal(mkdir(place_in(m->folder, "golden").path, 0755), 0);
    run_job(m, "action", "none", "");
    assert_called(m, "octreel diff --annotate --output=octreel-evidence ");
}

static void job_packages_builds_checks_and_installs_packages(void **state)
{
    machine *m = *state;
    run_job(m, "packages", "image", "debian:12");
    assert_called(m, "--target package ");
    assert_called(m, "lintian --fail-on error,warning build/packages/");
    assert_called(m, "apt-get install -y ./build/packages/");
    assert_called(m, "octreel record ");
}

/* Each fuzzer has a job. */
static void hunt_runs_each_fuzzer_and_the_failure_campaign(void **state)
{
    machine *m = *state;
    char all[512] = "", line[128];
    size_t i;
    const json_t *name, *strategy = json_object_get(json_object_get(m->jobs, "fuzz"), "strategy");
    fake_setup(m);
    command_result made =
        run_script("cd %s && mkdir tests/fuzz && mv bin/hunt tests/fuzz", ((temp_folder *)m->folder)->name);
    assert_done(&made);
    command_release(&made);
    json_array_foreach(json_object_get(json_object_get(strategy, "matrix"), "fuzzer"), i, name)
    {
        run_job(m, "fuzz", "fuzzer", json_string_value(name));
        snprintf(line, sizeof line, "hunt --minutes 300 %s\n", json_string_value(name));
        assert_called(m, line);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s.c\n", json_string_value(name));
    }
    command_result there = run_script("cd %s/tests/fuzz && ls fuzz_*.c", shell_quote(OCTREEL_ROOT).text);
    assert_string_equal(there.out, all);
    command_release(&there);
    run_job(m, "newest", "part", "build");
    assert_called(m, "/build --output-on-failure --no-tests=error -C all");
    run_job(m, "failures", "none", "");
    assert_called(m, "octreel-failure-campaign");
}

/* The site is made from a whole build, and only the job that publishes it may write pages. */
static void the_site_is_built_and_published(void **state)
{
    machine *m = *state;
    fake_setup(m);
    command_result made =
        run_script("cd %s && mkdir -p tests/tradeoff && mv bin/site tests/tradeoff", ((temp_folder *)m->folder)->name);
    assert_done(&made);
    command_release(&made);
    run_job(m, "build", "none", "");
    assert_called(m, "setup all build");
    assert_called(m, "site build site");
    const json_t *permissions = json_object_get(json_object_get(m->jobs, "publish"), "permissions");
    assert_int_equal(json_object_size(permissions), 2);
    assert_string_equal(json_string_value(json_object_get(permissions, "pages")), "write");
    assert_string_equal(json_string_value(json_object_get(permissions, "id-token")), "write");
    assert_null(json_object_get(json_object_get(m->jobs, "build"), "permissions"));
}

/* User input reaches a shell only in environment variables, and workflows have only read permissions. */
static void workflow_commands_contain_no_expressions(void **state)
{
    const machine *m = *state;
    const char *name;
    json_t *job, *action = yaml_read_file(ACTIONS "/diff/action.yml"), *step;
    json_object_set(m->jobs, "the action", json_object_get(action, "runs"));
    json_object_foreach(m->jobs, name, job)
    {
        size_t i;
        json_array_foreach(json_object_get(job, "steps"), i, step)
        {
            const json_t *run = json_object_get(step, "run");
            if (run && strstr(json_string_value(run), "${{"))
                fail_msg("%s: an expression in a line: %s", name, json_string_value(run));
        }
    }
    json_decref(action);
    static const char *const files[] = {WORKFLOW, HUNT, SITE};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        json_t *workflow = yaml_read_file(files[i]);
        const json_t *permissions = json_object_get(workflow, "permissions");
        assert_int_equal(json_object_size(permissions), 1);
        assert_string_equal(json_string_value(json_object_get(permissions, "contents")), "read");
        json_decref(workflow);
    }
}

/* A tag can be moved to other code; a commit cannot. Own actions need none. */
static void actions_of_others_are_pinned_by_commit(void **state)
{
    (void)state;
    command_result lines =
        run_script("cd %s && grep -rn '\\buses: ' README.md .github viz/cli", shell_quote(OCTREEL_ROOT).text);
    command_result unpinned = run_script("cd %s && grep -rn '\\buses: ' README.md .github viz/cli | "
                                         "grep -vE 'uses: (\\./|OWNER/octreel/|.*@[0-9a-f]{40} # v[0-9.]+$)'",
                                         shell_quote(OCTREEL_ROOT).text);
    assert_contains(lines.out, "actions/checkout@");
    assert_string_equal(unpinned.out, "");
    command_release(&lines);
    command_release(&unpinned);
}

#define ON_MACHINE(test) cmocka_unit_test_setup_teardown(test, prepare_machine, forget_machine)

int main(void)
{
    skip_without_yaml();
    const struct CMUnitTest tests[] = {
        ON_MACHINE(job_tests_builds_and_runs_tests),
        ON_MACHINE(job_all_runs_each_build),
        ON_MACHINE(job_page_records_and_compares_the_demo),
        ON_MACHINE(job_user_runs_the_line_that_a_script_prints),
        ON_MACHINE(job_action_compares_frames),
        ON_MACHINE(job_packages_builds_checks_and_installs_packages),
        ON_MACHINE(hunt_runs_each_fuzzer_and_the_failure_campaign),
        ON_MACHINE(the_site_is_built_and_published),
        ON_MACHINE(workflow_commands_contain_no_expressions),
        cmocka_unit_test(actions_of_others_are_pinned_by_commit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
