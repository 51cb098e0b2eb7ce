/* SPDX-License-Identifier: MIT */
/* test_readme_commands.c - every command of the README works, run in order in a folder that has what a fresh clone has.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

/* Lines of the README that are skipped, by their beginnings, and the reasons. */
static const struct {
    const char *line, *reason;
} left_out[] = {
    {"./viz/demo", "it installs with apt and builds; tests/install/set_up runs it"},
    {"./tests/run", "it installs with apt, builds, and would run this test"},
    {"sbatch ", "it needs Slurm, and a cluster"},
    {"cmake --build ", "tests/install/install_and_use runs it"},
    {"cc ", "tests/install/install_and_use runs it"},
};

/* The text of the next block after this fence, from *at on; *at moves past it. Null: there is none. The caller frees
 * it. */
static char *next_block(const char **at, const char *fence)
{
    const char *begin = strstr(*at, fence);
    if (begin == NULL)
        return NULL;
    begin += strlen(fence);
    const char *end = strstr(begin, "```");
    assert_non_null(end);
    *at = end + 3;
    return strndup(begin, (size_t)(end - begin));
}

/* Cut a shell command at its end, which may be several lines below. Returns the next command. */
static char *cut_line(char *line)
{
    char *end = strchr(line, '\n');
    while (end[-1] == '\\')
        end = strchr(end + 1, '\n');
    *end = 0;
    return end + 1;
}

static const char *reason_to_leave_out(const char *line)
{
    static const char mine[] = "build/bin/octreel audit mine";
    if (strncmp(line, "python3 ", 8) == 0 || strncmp(line, mine, strlen(mine)) == 0)
        return is_program_installed("python3") ? NULL : "there is no python3";
    for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; i++)
        if (strncmp(line, left_out[i].line, strlen(left_out[i].line)) == 0)
            return left_out[i].reason;
    return NULL;
}

/* `diff` of two recordings finds a difference; all other lines succeed. Returns the output, which the caller frees. */
static char *run_line(const temp_folder *folder, const char *line)
{
    const bool differs = strncmp(line, "build/bin/octreel diff flight other", 35) == 0;
    file_write_text(place_in(folder, "line").path, line);
    command_result result = run_script("cd '%s' && unset CI && sh -e line", folder->name);
    if (result.status != differs || (differs && strncmp(result.out, "different: ", 11) != 0))
        fail_msg("%s: status %d: %s%s", line, result.status, result.out, result.err);
    char *output = strdup(result.out);
    command_release(&result);
    return output;
}

/* The README quotes the cause that the comparison of two recordings prints. */
static void assert_quotes_cause(const char *readme, const char *output)
{
    static const char cause[] = "(top, was iso)";
    assert_non_null(strstr(readme, cause));
    if (strstr(output, "camera") == NULL || strstr(output, "top") == NULL || strstr(output, "was iso") == NULL)
        fail_msg("\"%s\" is not in: %s", cause, output);
}

static void lay_out_clone(const temp_folder *folder)
{
    const shell_word examples = shell_quote(OCTREEL_ROOT "/tests/examples");
    command_result made = run_script("cd '%s' && mkdir -p build/bin && ln -s %s build/bin/octreel && mkdir tests && "
                                     "ln -s %s tests",
                                     folder->name, octreel_program(), examples.text);
    assert_done(&made);
    command_release(&made);
}

static void every_command_of_the_readme_works(void **state)
{
    const temp_folder *folder = *state;
    char *readme = file_read(OCTREEL_ROOT "/README.md", NULL), *block;
    size_t run = 0;
    bool quoted = false;
    lay_out_clone(folder);
    for (const char *at = readme; (block = next_block(&at, "\n```sh\n")) != NULL; free(block)) {
        for (char *line = block, *next; *line != 0; line = next) {
            next = cut_line(line);
            const char *reason = reason_to_leave_out(line);
            if (reason != NULL) {
                print_message("left out: %s: %s\n", line, reason);
                continue;
            }
            char *output = run_line(folder, line);
            if (strncmp(output, "different: ", 11) == 0) {
                assert_quotes_cause(readme, output);
                quoted = true;
            }
            free(output);
            run++;
        }
    }
    assert_true(quoted && run >= 9);
    static const char *const made_by[] = {"flight",    "hunt", "hunt.png",     "cloud.html", "cloud.png",
                                          "asked.png", "mine", "baseline.txt", "evidence"};
    for (size_t i = 0; i < sizeof made_by / sizeof made_by[0]; i++)
        assert_true(file_exists(place_in(folder, made_by[i]).path));
    free(readme);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_command_of_the_readme_works, temp_folder_make, nested_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
