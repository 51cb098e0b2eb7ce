/* SPDX-License-Identifier: MIT */
/* test_readme_commands.c - the README's lines of shell are run as they stand there, one after the other, in a folder
 * that has of a fresh clone what they name. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

/* What is left out here, by how its line begins, and why. */
static const struct {
    const char *line, *reason;
} left_out[] = {
    {"./viz/demo", "it installs with apt and builds; tests/install/set_up runs it"},
    {"./tests/run", "it installs with apt, builds, and would run this test"},
    {"sbatch ", "it needs Slurm, and a cluster"},
    {"cmake --install ", "tests/install/install_and_use runs it"},
    {"cc ", "tests/install/install_and_use runs it"},
};

/* The README's next block behind this fence, from *at on, which it moves beyond; null when there is none. The caller
 * frees it. */
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

/* End the line at its end, which may be some lines below, and return the next. */
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
        return program_is_there("python3") ? NULL : "there is no python3";
    for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; i++)
        if (strncmp(line, left_out[i].line, strlen(left_out[i].line)) == 0)
            return left_out[i].reason;
    return NULL;
}

/* What is compared differs, or the line would show nothing. Returns what it says, which the caller frees. */
static char *run_line(const temp_folder *folder, const char *line)
{
    const bool compares = strncmp(line, "build/bin/octreel diff ", 23) == 0;
    file_write_text(place_in(folder, "line").path, line);
    command_result result = run_script("cd '%s' && unset CI && sh -e line", folder->name);
    if (result.status != compares || (compares && strncmp(result.out, "different: ", 11) != 0))
        fail_msg("%s: status %d: %s%s", line, result.status, result.out, result.err);
    char *said = strdup(result.out);
    command_release(&result);
    return said;
}

/* The README quotes what the comparison of two recordings says. */
static void assert_quoted(const char *readme, const char *said)
{
    static const char before[] = "Of recordings it says why: `";
    const char *quote = strstr(readme, before);
    assert_non_null(quote);
    quote += sizeof before - 1;
    char *words = strndup(quote, strcspn(quote, "`"));
    if (strstr(said, words) == NULL)
        fail_msg("\"%s\" is not in: %s", words, said);
    free(words);
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

static void every_line_of_shell_does_what_it_says(void **state)
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
            char *said = run_line(folder, line);
            if (!quoted && strncmp(said, "different: ", 11) == 0)
                assert_quoted(readme, said);
            quoted = quoted || strncmp(said, "different: ", 11) == 0;
            free(said);
            run++;
        }
    }
    assert_true(quoted && run >= 12);
    static const char *const made_by[] = {"flight", "orbit", "hunt", "cloud.png", "asked.png", "evidence"};
    for (size_t i = 0; i < sizeof made_by / sizeof made_by[0]; i++)
        assert_true(file_exists(place_in(folder, made_by[i]).path));
    free(readme);
}

/* What the README shows is the example that its lines film. */
static void session_shown_is_the_example(void **state)
{
    char *readme = file_read(OCTREEL_ROOT "/README.md", NULL);
    char *example = file_read(OCTREEL_ROOT "/tests/examples/my.json", NULL);
    const char *at = readme;
    char *shown = next_block(&at, "\n```json\n");
    (void)state;
    assert_non_null(shown);
    assert_string_equal(shown, example);
    free(shown);
    free(example);
    free(readme);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_line_of_shell_does_what_it_says, temp_folder_make, nested_folder_remove),
        cmocka_unit_test(session_shown_is_the_example),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
