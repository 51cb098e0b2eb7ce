/* SPDX-License-Identifier: MIT */
/* test_cli_outputs.c - octreel never overwrites an input or another output, whatever their paths look like; a refused
 * command writes nothing; left-out elements are reported. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "fixture.h"
#include "galleries.h"

enum { NOBODY = 65534, NOT_RUN = 127 };

static const char points[] = "0 0 0\n1 2 3\n4 5 6\n";

/* Run octreel in the folder of the test. */
static command_result run_in(void **state, const char *arguments)
{
    const temp_folder *own = *state;
    return run_script("cd %s && %s %s", own->name, octreel_program(), arguments);
}

static void do_in(void **state, const char *arguments)
{
    command_result result = run_in(state, arguments);
    assert_done(&result);
    command_release(&result);
}

static void assert_refused(void **state, const char *arguments, const char *sentence)
{
    const temp_folder *own = *state;
    const int count = (int)temp_folder_count(own);
    command_result result = run_in(state, arguments);
    assert_trouble(&result, sentence);
    assert_int_equal(temp_folder_count(own), count);
}

static void assert_text(void **state, const char *name, const char *expected)
{
    char *text = file_read(place_in(*state, name).path, NULL);
    assert_string_equal(text, expected);
    free(text);
}

static void assert_has_text(void **state, const char *name, const char *part, bool there)
{
    char *text = file_read(place_in(*state, name).path, NULL);
    if ((strstr(text, part) != NULL) != there)
        fail_msg("\"%s\" %s \"%s\"", text, there ? "does not say" : "says", part);
    free(text);
}

static void cloud_is_not_overwritten(void **state)
{
    file_write_text(place_in(*state, "p").path, points);
    assert_int_equal(link(place_in(*state, "p").path, place_in(*state, "linked").path), 0);
    assert_refused(state, "inspect p -o p", "-o p is the same file as p, which is read");
    assert_refused(state, "inspect p -o ./p", "-o ./p is the same file as p, which is read");
    assert_refused(state, "inspect p --nodes p", "--nodes p is the same file as p");
    assert_refused(state, "inspect p --nodes linked", "--nodes linked is the same file as p");
    file_write_text(place_in(*state, "q").path, points);
    assert_refused(state, "inspect q --nodes p", "--nodes p is a point cloud: name another file, or add --force");
    assert_text(state, "p", points);
}

static void two_outputs_of_inspect_must_be_different_files(void **state)
{
    file_write_text(place_in(*state, "p.xyz").path, points);
    assert_refused(state, "inspect p.xyz -o n --nodes n", "--nodes n is the same file as -o n");
    assert_refused(state, "inspect p.xyz -o ./n --nodes n", "--nodes n is the same file as -o ./n");
    file_write_text(place_in(*state, "n").path, "");
    assert_refused(state, "inspect p.xyz -o ./n --nodes n", "--nodes n is the same file as -o ./n");
}

/* A link to a frame, whose name does not look like a picture. */
static void link_both(void **state)
{
    static const char *const folders[] = {"a", "b"};
    for (size_t i = 0; i < 2; i++) {
        const place folder = place_in(*state, folders[i]);
        assert_int_equal(link(place_below(folder.path, "2.png").path, place_below(folder.path, "two").path), 0);
    }
}

static void recording_files_are_not_overwritten(void **state)
{
    do_in(state, "record --size 16x16 --keys w -o r");
    assert_refused(state, "diff r r --markdown r/ticks.jsonl", "is the same file as r/ticks.jsonl, which is read");
    assert_refused(state, "diff r r --junit r/session.json", "is the same file as r/session.json, which is read");
}

static void reports_overwrite_no_compared_file(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    gallery_make(*state, "b", "1.png 2.png");
    link_both(state);
    do_in(state, "accept a.dig a --reason x");
    char *before = file_read(place_in(*state, "a.dig").path, NULL);
    assert_refused(state, "diff a.dig b --junit a.dig", "--junit a.dig is the same file as a.dig, which is read");
    assert_refused(state, "diff a/1.png b/2.png --markdown b/two", "--markdown b/two is the same file as b/2.png");
    assert_refused(state, "diff a b --junit b/two", "--junit b/two is the same file as b/2.png, which is read");
    gallery_make(*state, "c", "menu/old/1.png");
    assert_int_equal(link(place_in(*state, "c/menu/old/1.png").path, place_in(*state, "c/three").path), 0);
    assert_refused(state, "diff c c --junit c/three", "--junit c/three is the same file as c/menu/old/1.png, which is");
    assert_text(state, "a.dig", before);
    assert_same_folders(place_in(*state, "a").path, place_in(*state, "b").path, NULL);
    free(before);
}

/* Following two links that lead back doubles the work at each of forty levels. */
static void links_to_folders_are_not_searched_for_inputs(void **state)
{
    gallery_make(*state, "a", "1.png");
    for (int i = 0; i < 2; i++)
        assert_int_equal(symlink(".", place_in(*state, i ? "a/frame_1" : "a/frame_2").path), 0);
    file_write_text(place_in(*state, "report").path, "old");
    do_in(state, "diff a a --junit report >said");
    assert_has_text(state, "report", "<testsuite", true);
}

/* Only a command that searches such a folder reports it. */
static void folders_that_cannot_be_listed_are_no_inputs(void **state)
{
    const temp_folder *own = *state;
    const place frames = gallery_make(own, "a", "1.png lost/2.png"), lost = place_below(frames.path, "lost"),
                report = place_in(own, "report");
    file_write_text(report.path, "old");
    assert_int_equal(chmod(own->name, 0777) + chmod(report.path, 0666) + chmod(lost.path, 0), 0);
    const bool root = geteuid() == 0;
#ifdef __SANITIZE_ADDRESS__
    if (root)
        skip(); /* a program with another effective user does not read ASAN_OPTIONS */
#endif
    if (root && seteuid(NOBODY) != 0)
        skip(); /* root can list everything, and this container has no other user */
    command_result flat =
                       run_octreel(NULL, "diff --no-recursive %s %s --junit %s", frames.path, frames.path, report.path),
                   all = run_octreel(NULL, "diff %s %s --junit %s", frames.path, frames.path, report.path);
    assert_true(!root || seteuid(0) == 0);
    assert_int_equal(chmod(lost.path, 0755), 0);
    if (root && flat.status == NOT_RUN)
        skip(); /* the other user cannot search the folder of octreel */
    assert_done(&flat);
    assert_has_text(state, "report", "<testsuite", true);
    assert_trouble(&all, "a/lost: the folder cannot be read: Permission denied");
    command_release(&flat);
}

static void two_reports_must_be_different_files(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    assert_refused(state, "diff a a --junit x --markdown x", "--markdown x is the same file as --junit x");
    assert_refused(state, "diff a a --junit x --markdown a/../x", "--markdown a/../x is the same file as --junit x");
    assert_refused(state, "diff a a -o ev --junit ev/report.html", "--junit ev/report.html is the same file as -o ev/");
    do_in(state, "diff a a --junit /dev/null --markdown /dev/null");
    assert_refused(state, "diff a a --junit /dev/stdout --json", "only one output can go to standard output");
}

/* A recording, a cloud, a baseline, and links to files of the recording. */
static void make_valuable_files(void **state)
{
    file_write_text(place_in(*state, "p.xyz").path, points);
    do_in(state, "record -q --size 16x16 --keys w -o film && ln -s film/frame_000001.png soft && ln -s film dir && "
                 "ln film/frame_000001.png hard && ln film/ticks.jsonl ticks && ln -s film/renderer.json renderer && "
                 "cp -r film kept");
    do_in(state, "accept base.txt film --reason x && cp base.txt kept.txt");
}

static void valuable_files_are_not_replaced(void **state)
{
    static const char *const rows[][2] = {
        {"inspect p.xyz -o film/frame_000001.png", "-o film/frame_000001.png is a file of the recording in film: name "
                                                   "another file, or add --force to overwrite it"},
        {"inspect p.xyz -o ./film/../film/frame_000001.png", " is a file of the recording in ./film/../film: "},
        {"inspect p.xyz -o film/frame_000009.png", "-o film/frame_000009.png is a file of the recording in film"},
        {"inspect p.xyz -o dir/frame_000000.png", "-o dir/frame_000000.png is a file of the recording in dir"},
        {"inspect p.xyz -o soft", "-o soft is a file of the recording in /"},
        {"inspect p.xyz -o hard", "-o hard is a frame of a recording: name another file, or add --force"},
        {"inspect p.xyz --nodes ticks", "--nodes ticks is a file of a recording"},
        {"inspect p.xyz --nodes renderer", "--nodes renderer is a file of the recording in /"},
        {"inspect p.xyz --nodes base.txt", "--nodes base.txt is a baseline: name another file, or add --force"},
        {"audit film/session.json --junit film/recording.json", "--junit film/recording.json is a file of the rec"},
        {"audit film --junit film/session.json", "--junit film/session.json is the same file as film/session.json"},
        {"audit film --html film/index.html", "--html film/index.html is the same file as film/index.html, which is r"},
        {"audit film --html /", "--html needs a folder of its own, but \"/\" is or contains the current folder: name a "
                                "new folder, or add --force to write into this one"},
        {"diff base.txt film -o ..", "-o needs a folder of its own, but \"..\""},
        {"diff film film --markdown base.txt", "--markdown base.txt is a baseline"},
        {"play -o film/index.html", "-o film/index.html is a file of the recording in film"},
        {"play -o base.txt", "-o base.txt is a baseline"},
        {"accept new film --store .", "--store needs a folder of its own, but \".\""},
    };
    make_valuable_files(state);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_refused(state, rows[i][0], rows[i][1]);
    assert_same_folders(place_in(*state, "film").path, place_in(*state, "kept").path, NULL);
    assert_same_files(place_in(*state, "base.txt").path, place_in(*state, "kept.txt").path);
}

static void force_replaces_valuable_files(void **state)
{
    make_valuable_files(state);
    do_in(state, "inspect p.xyz --size 16x16 -o film/frame_000001.png --nodes base.txt --force >said");
    assert_has_text(state, "base.txt", "address", true);
    do_in(state, "play --force -o film/index.html >said");
    do_in(state, "inspect p.xyz --nodes p.xyz --force >said");
    assert_has_text(state, "p.xyz", "address", true);
    do_in(state, "record -q --size 16x16 --keys w --no-frames --force -o .");
    assert_refused(state, "record -q --keys w --force -o .", ".: already holds a recording");
}

/* Opening a pipe for writing waits for a reader. */
static void pipe_without_a_reader_is_refused(void **state)
{
    file_write_text(place_in(*state, "p").path, points);
    assert_int_equal(mkfifo(place_in(*state, "pipe").path, 0600), 0);
    assert_refused(state, "inspect p --nodes pipe", "pipe: cannot be written: no process reads this pipe; start its");
    assert_refused(state, "inspect p -o pipe", "pipe: ");
    const temp_folder *own = *state;
    command_result read = run_script("cd %s && exec 3<>pipe && %s inspect p --nodes pipe >said && head -n 1 <&3",
                                     own->name, octreel_program());
    assert_done(&read);
    assert_non_null(strstr(read.out, "address"));
    command_release(&read);
    do_in(state, "inspect p --nodes /dev/null >said");
}

/* The file behind such a name was opened by the shell. It is neither replaced nor overwritten. */
static void open_files_are_written_by_their_names(void **state)
{
    static const char *const names[] = {"/dev/stdout >>got", "/dev/stdout | cat >>got", "/dev/fd/3 3>>got",
                                        "/dev/stderr 2>>got"};
    file_write_text(place_in(*state, "p").path, points);
    do_in(state, "inspect p --nodes expected >said");
    char *nodes = file_read(place_in(*state, "expected").path, NULL);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char line[80];
        file_write_text(place_in(*state, "got").path, "before\n");
        snprintf(line, sizeof line, "inspect p --nodes %s", names[i]);
        command_result result = run_in(state, line);
        assert_int_equal(result.status, 0); /* the report is on the stream that the nodes leave free */
        command_release(&result);
        char *got = file_read(place_in(*state, "got").path, NULL);
        assert_int_equal(strncmp(got, "before\n", 7), 0);
        assert_int_equal(strncmp(got + 7, nodes, strlen(nodes)), 0);
        free(got);
    }
    free(nodes);
}

static void refused_comparison_writes_no_evidence(void **state)
{
    gallery_make(*state, "a", "1.png 2.png");
    do_in(state, "accept a.dig a --reason x && mkdir none nil");
    assert_refused(state, "diff a a/1.png -o ev", "cannot compare one picture with a folder");
    assert_refused(state, "diff none nil -o ev", "nothing to compare");
    assert_refused(state, "diff a.dig a --max-pixels 1 -o ev", "a baseline holds digests, which allow no tolerance");
}

/* Without the text layer the frame itself does not report it. */
static void record_reports_elements_left_out_by_lod(void **state)
{
    static const char sentence[] = "\n2 frames leave out nodes smaller than --lod\n";
    static const char session[] = "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 1, \"points\": {\"sample\": "
                                  "\"clustered\", \"count\": 2000, \"seed\": 1}}";
    file_write_text(place_in(*state, "s.json").path, session);
    do_in(state, "record s.json --size 64x36 --layers -text -o film >said");
    assert_has_text(state, "said", sentence, true);
    do_in(state, "record s.json --size 64x36 --layers -text --lod 0 -o whole >said");
    assert_has_text(state, "said", "--lod", false);
    do_in(state, "record s.json --size 64x36 --layers -text --json -o json >said");
    assert_has_text(state, "said", "\"below_lod\": 2", true);
}

static void inspect_reports_elements_left_out_by_lod_once(void **state)
{
    FILE *out = fopen(place_in(*state, "p").path, "w");
    assert_non_null(out);
    for (int i = 0; i < 500; i++)
        fprintf(out, "%d %d %d\n", i * i % 97, i * 7 % 89, i * i * i % 83);
    assert_int_equal(fclose(out), 0);
    static const char inspect[] = "inspect p --capacity 1 --size 64x36 -o t.png --json %s 2>said >/dev/null";
    static const struct {
        const char *options;
        bool told;
    } rows[] = {{"--layers -text", true}, {"", false}, {"--layers -text --lod 0", false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[160];
        snprintf(line, sizeof line, inspect, rows[i].options);
        do_in(state, line);
        assert_has_text(state, "said", "octreel: t.png leaves out nodes smaller than --lod\n", rows[i].told);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    unsetenv("CI"); /* accept refuses to run if CI is set */
    const struct CMUnitTest tests[] = {
        IN_FOLDER(cloud_is_not_overwritten),
        IN_FOLDER(two_outputs_of_inspect_must_be_different_files),
        IN_FOLDER(recording_files_are_not_overwritten),
        IN_FOLDER(reports_overwrite_no_compared_file),
        IN_FOLDER(links_to_folders_are_not_searched_for_inputs),
        IN_FOLDER(folders_that_cannot_be_listed_are_no_inputs),
        IN_FOLDER(two_reports_must_be_different_files),
        IN_FOLDER(valuable_files_are_not_replaced),
        IN_FOLDER(force_replaces_valuable_files),
        IN_FOLDER(pipe_without_a_reader_is_refused),
        IN_FOLDER(open_files_are_written_by_their_names),
        IN_FOLDER(refused_comparison_writes_no_evidence),
        IN_FOLDER(record_reports_elements_left_out_by_lod),
        IN_FOLDER(inspect_reports_elements_left_out_by_lod_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
