/* SPDX-License-Identifier: MIT */
/* test_readme_job.c - the GitHub job of the action's README and the action itself work; frames of a test stand for
 * those of a user. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "workflow.h"

/* A checkout of a user's repository, and the job that runs in it. */
typedef struct job {
    void *folder; /* a temp_folder */
    json_t *yaml;
    workflow run;
} job;

/* The YAML block of the action's README. */
static json_t *read_block(void)
{
    static const char fence[] = "\n```yaml\n";
    char *readme = file_read(OCTREEL_ROOT "/.github/actions/diff/README.md", NULL), *begin = strstr(readme, fence);
    assert_non_null(begin);
    begin += sizeof fence - 1;
    char *end = strstr(begin, "```");
    assert_non_null(end);
    *end = 0;
    json_t *block = yaml_read(begin);
    free(readme);
    return block;
}

static void in_folder(const job *j, const char *line)
{
    command_result result =
        run_script("cd %s && PATH=\"$PWD/bin:$PATH\" && %s", ((temp_folder *)j->folder)->name, line);
    assert_done(&result);
    command_release(&result);
}

/* Create the checkout: a game that records a session, and accepted frames of it. */
static void check_out(const job *j)
{
    static const char game[] = "#!/bin/sh\nexec octreel record my.json --size 160x90 --every 5 -o \"$2\" >game.log\n";
    char line[4096];
    file_write_text(place_in(j->folder, "my-game").path, game);
    snprintf(line, sizeof line,
             "mkdir bin && ln -s %s bin/octreel && cp %s . && chmod +x my-game && ./my-game --film golden",
             octreel_program(), shell_quote(OCTREEL_ROOT "/tests/examples/my.json").text);
    in_folder(j, line);
}

static int prepare_job(void **state)
{
    job *j = calloc(1, sizeof *j);
    *state = j;
    if (j == NULL || temp_folder_make(&j->folder) != 0)
        return -1;
    j->yaml = read_block();
    check_out(j);
    workflow_open(&j->run, j->folder, OCTREEL_ROOT "/.github/actions");
    return 0;
}

static int forget_job(void **state)
{
    job *j = *state;
    workflow_close(&j->run);
    json_decref(j->yaml);
    const int status = nested_folder_remove(&j->folder);
    free(j);
    return status;
}

static int run_job(job *j)
{
    const json_t *frames = json_object_get(json_object_get(j->yaml, "jobs"), "frames");
    return workflow_run(&j->run, json_object_get(frames, "steps"));
}

/* Change the game: another key at tick 5. */
static void change_game(const job *j)
{
    in_folder(j, "sed 's/wwddeen/wwddaen/' my.json >changed && ! cmp -s changed my.json && mv changed my.json");
}

static void assert_summary_says(const job *j, const char *part)
{
    char *summary = file_read(place_in(j->folder, "summary").path, NULL);
    assert_contains(summary, part);
    free(summary);
}

/* The folder that the job uploaded, as the last action of another project received it. */
static const char *uploaded(const job *j)
{
    const json_t *last = json_array_get(j->run.used, json_array_size(j->run.used) - 1);
    assert_contains(json_string_value(json_object_get(last, "uses")), "actions/upload-artifact@");
    return json_string_value(json_object_get(json_object_get(last, "with"), "path"));
}

static void assert_uploads(const job *j, const char *file)
{
    const place folder = place_in(j->folder, uploaded(j));
    if (!file_exists(place_below(folder.path, file).path))
        fail_msg("%s is not in the evidence, %s", file, folder.path);
}

/* ---- The job -------------------------------------------------------------------------------------------------- */

static void job_passes_if_nothing_differs(void **state)
{
    job *j = *state;
    assert_int_equal(run_job(j), 0);
    assert_string_equal(j->run.err, "");
    assert_summary_says(j, "### octreel diff: same: 8 frames");
    assert_int_equal(json_array_size(j->run.used), 1); /* only the checkout: nothing is uploaded */
}

/* The evidence is uploaded, and the summary is appended to the existing one. */
static void job_fails_and_uploads_evidence_if_a_frame_differs(void **state)
{
    job *j = *state;
    change_game(j);
    file_write_text(place_in(j->folder, "summary").path, "Of an earlier step.\n");
    assert_int_equal(run_job(j), 1);
    assert_string_equal(j->run.err, "");
    assert_summary_says(j, "Of an earlier step.\n### octreel diff: different: ");
    assert_summary_says(j, "<code>frame_000005.png</code> and 6 more: ticks 10 to 35");
    assert_contains(j->run.out, "\n::error file=frames/frame_000005.png,title=octreel diff%3A ");
    assert_uploads(j, "report.html");
    assert_uploads(j, "frame_000005.difference.png");
}

/* ---- The action ----------------------------------------------------------------------------------------------- */

/* Names that a shell would execute if they were inserted into a command. */
static const char *const hostile[] = {
    "two words",
    "$(touch owned)",
    "`touch owned`",
    "'; touch owned; '",
    "\"; touch owned; \"",
    "; touch owned",
    "--help",
    "*",
    "$HOME",
};

static json_t *action_inputs(const char *reference, const char *frames, const char *evidence, const char *options)
{
    return json_pack("{s:s, s:s, s:s, s:s}", "reference", reference, "frames", frames, "evidence", evidence, "options",
                     options);
}

static int run_action(job *j, json_t *inputs)
{
    const int status = workflow_run_action(&j->run, "diff", inputs, "it");
    json_decref(inputs);
    return status;
}

static const char *output_of(const job *j, const char *name)
{
    char expression[64];
    snprintf(expression, sizeof expression, "steps.it.outputs.%s", name);
    return json_string_value(json_object_get(j->run.values, expression));
}

static void action_accepts_any_folder_name(void **state)
{
    job *j = *state;
    char line[4096], evidence[64];
    change_game(j);
    in_folder(j, "./my-game --film frames");
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; i++) {
        snprintf(evidence, sizeof evidence, "%s of it", hostile[i]);
        snprintf(line, sizeof line, "cp -R golden ./%s", shell_quote(hostile[i]).text);
        in_folder(j, line);
        if (run_action(j, action_inputs(hostile[i], "frames", evidence, "")) != 1)
            fail_msg("%s: %s", hostile[i], j->run.err);
        assert_string_equal(output_of(j, "status"), "1");
        assert_string_equal(uploaded(j), evidence);
        assert_uploads(j, "report.html");
        assert_false(file_exists(place_in(j->folder, "owned").path));
    }
    assert_string_equal(j->run.err, "");
}

/* Options are neither executed nor expanded as file patterns, octreel reports invalid ones, and a run that compares
 * nothing fails. */
static void action_splits_options_into_words(void **state)
{
    job *j = *state;
    in_folder(j, "cp -R golden frames && : >--help");
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; i++) {
        assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", hostile[i])), 2);
        assert_string_equal(output_of(j, "status"), "2");
        assert_false(file_exists(place_in(j->folder, "owned").path));
    }
    assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", "--max-delta 0.1\n  --max-pixels\t3\n")),
                     0);
}

static void action_summary_counts_tolerated_frames(void **state)
{
    job *j = *state;
    change_game(j);
    in_folder(j, "./my-game --film frames");
    assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", "--max-delta 1")), 0);
    assert_string_equal(output_of(j, "status"), "0");
    assert_contains(output_of(j, "summary"), "octreel diff: same");
    assert_contains(output_of(j, "summary"), "forgiven");
    assert_int_not_equal(output_of(j, "summary")[strlen(output_of(j, "summary")) - 1], ' ');
}

static void action_reports_errors(void **state)
{
    job *j = *state;
    assert_int_equal(run_action(j, action_inputs("golden", "no\nframes", "why", "")), 2);
    assert_string_equal(output_of(j, "status"), "2");
    assert_contains(output_of(j, "summary"), "no such file or folder");
    assert_contains(j->run.out, "\n::error title=octreel diff::octreel: ");
    assert_summary_says(j, "### octreel diff: error\n");
    assert_int_equal(json_array_size(j->run.used), 0);
}

/* A file name that looks like a workflow command is printed while workflow commands are disabled. */
static void action_does_not_execute_file_names_as_commands(void **state)
{
    job *j = *state;
    in_folder(j, "rm golden/*.json* && cp -R golden frames && cp golden/frame_000005.png \"$(printf "
                 "'golden/x\\n::add-mask::a.png')\"");
    assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", "")), 1);
    const char *off = strstr(j->run.out, "::stop-commands::"), *name = strstr(j->run.out, "\n::add-mask::");
    char on[64] = "\n::";
    assert_non_null(off);
    strncat(on, off + sizeof "::stop-commands::" - 1, 32);
    assert_true(name == NULL || (name > off && name < strstr(j->run.out, on)));
}

/* The key of the last step that looks into the cache. */
static char *cache_key(const job *j)
{
    const json_t *step = NULL;
    for (size_t i = 0; i < json_array_size(j->run.used); i++)
        if (strstr(json_string_value(json_object_get(json_array_get(j->run.used, i), "uses")), "actions/cache@"))
            step = json_object_get(json_array_get(j->run.used, i), "with");
    assert_non_null(step);
    assert_contains(json_string_value(json_object_get(step, "path")), "/temp/octreel");
    return strdup(json_string_value(json_object_get(step, "key")));
}

/* If octreel is not installed, the action builds it with viz/setup, which is replaced by a script here. */
static void action_builds_octreel_if_it_is_not_installed(void **state)
{
    job *j = *state;
    static const char setup[] = "#!/bin/sh\nmkdir -p \"$2/bin\" && mv octreel \"$2/bin\"\n";
    if (is_program_installed("octreel"))
        skip();
    in_folder(j, "cp -R golden frames && mkdir -p source/.github/actions source/viz source/lib && touch "
                 "source/CMakeLists.txt && mv bin/octreel . && "
                 "printf '#!/bin/sh\\nshift\\nexec \"$@\"\\n' >bin/sudo && chmod +x bin/sudo");
    file_write_text(place_in(j->folder, "source/viz/setup").path, setup);
    command_result result =
        run_script("cd %s && chmod +x source/viz/setup && cp -R %s source/.github/actions && pwd",
                   ((temp_folder *)j->folder)->name, shell_quote(OCTREEL_ROOT "/.github/actions/diff").text);
    assert_int_equal(result.status, 0);
    char actions[1200];
    snprintf(actions, sizeof actions, "%.*s/source/.github/actions", (int)strcspn(result.out, "\n"), result.out);
    command_release(&result);
    j->run.actions = actions;
    assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", "")), 0);
    assert_true(file_exists(place_in(j->folder, "temp/octreel/bin/octreel").path));
    char *first = cache_key(j);
    in_folder(j, "rm source/viz/setup && echo >source/lib/new.c"); /* nothing can be built */
    assert_int_equal(run_action(j, action_inputs("golden", "frames", "why", "")), 0);
    char *second = cache_key(j);
    assert_contains(first, "octreel-");
    assert_string_not_equal(first, second);
    assert_string_equal(j->run.err, "");
    free(first);
    free(second);
}

#define JOB(test) cmocka_unit_test_setup_teardown(test, prepare_job, forget_job)

int main(void)
{
    skip_without_yaml();
    const struct CMUnitTest tests[] = {
        JOB(job_passes_if_nothing_differs),
        JOB(job_fails_and_uploads_evidence_if_a_frame_differs),
        JOB(action_accepts_any_folder_name),
        JOB(action_splits_options_into_words),
        JOB(action_summary_counts_tolerated_frames),
        JOB(action_reports_errors),
        JOB(action_does_not_execute_file_names_as_commands),
        JOB(action_builds_octreel_if_it_is_not_installed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
