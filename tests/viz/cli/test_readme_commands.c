/* SPDX-License-Identifier: MIT */
/* test_readme_commands.c - the README's lines on films and clouds are run as they stand there, one after the other. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

/* The README's block that begins with this fence and these words; the caller frees it. */
static char *read_block(const char *fence)
{
    char *readme = file_read(OCTREEL_README, NULL), *begin = strstr(readme, fence);
    assert_non_null(begin);
    begin = strchr(begin, '\n') + 1;
    char *block = strndup(begin, (size_t)(strstr(begin, "```") - begin));
    free(readme);
    return block;
}

/* A cloud in which node 0/3/7 is one of many. */
static void write_scan(const char *path)
{
    enum { POINTS = 8000 };
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\nHEIGHT 1\n"
            "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA ascii\n",
            POINTS, POINTS);
    uint64_t random = 1;
    for (int i = 0; i < POINTS; i++)
        fprintf(file, "%.4f %.4f %.4f\n", random_between(&random, -5, 5), random_between(&random, -5, 5),
                random_between(&random, -5, 5));
    assert_int_equal(fclose(file), 0);
}

/* What a line needs that the machine may not have; null: nothing. */
static const char *missing(const char *line)
{
    if (strncmp(line, "sbatch ", 7) == 0)
        return "sbatch";
    if (strncmp(line, "parallel ", 9) == 0 && !program_is_there("parallel"))
        return "parallel";
    return NULL;
}

/* The parts that the next line joins, where what the README makes them with is not there. */
static const char parts[] = "for i in 0 25 50 75; do build/bin/octreel record my.json --jobs 1 --ticks $i:$((i + 25)) "
                            "-o film || exit; done";

static void run_line(const temp_folder *folder, const char *line)
{
    file_write_text(place_in(folder, "line").path, line);
    command_result result = run_script("cd %s && sh -e line", folder->name);
    if (result.status != 0)
        fail_msg("%s: status %d: %s", line, result.status, result.err);
    command_release(&result);
}

static void films_and_clouds(void **state)
{
    const temp_folder *folder = *state;
    char *session = read_block("```json"), *lines = read_block("```sh\nbuild/bin/octreel record");
    file_write_text(place_in(folder, "my.json").path, session);
    write_scan(place_in(folder, "scan.pcd").path);
    command_result made =
        run_script("cd %s && mkdir -p build/bin && ln -s %s build/bin/octreel", folder->name, octreel_program());
    assert_done(&made);
    command_release(&made);
    unsigned run = 0;
    for (char *next = NULL, *line = lines; line != NULL && *line != 0; line = next) {
        next = strchr(line, '\n');
        for (; next != NULL && next[-1] == '\\'; next = strchr(next + 1, '\n'))
            continue;
        if (next != NULL)
            *next++ = 0;
        const char *what = missing(line);
        if (what == NULL)
            run_line(folder, line);
        else if (strcmp(what, "parallel") == 0)
            run_line(folder, parts);
        run += what == NULL;
    }
    assert_true(run >= 9);
    static const char *const made_by[] = {"flight", "orbit", "cut", "film", "tree.png", "node.png", "q.png"};
    for (size_t i = 0; i < sizeof made_by / sizeof made_by[0]; i++)
        assert_true(file_exists(place_in(folder, made_by[i]).path));
    free(session);
    free(lines);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(films_and_clouds, temp_folder_make, nested_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
