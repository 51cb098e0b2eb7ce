/* SPDX-License-Identifier: MIT */
/* test_cli_mistakes.c - each mistake on the command line gets one sentence with a remedy and writes nothing; and help
 * is complete. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "file_kind.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"
#include "layer.h"
#include "view_options.h"

/* One file of each kind, and a recording. */
static int make_kinds(void **state)
{
    if (temp_folder_make(state) != 0)
        return -1;
    file_write_text(place_in(*state, "my.json").path, "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 2}\n");
    file_write_text(place_in(*state, "sesion.json").path, "{\"octreel\": \"sesion\", \"version\": 1, \"ticks\": 2}\n");
    file_write_text(place_in(*state, "cloud.txt").path, "x y z\n1 2 3\n4 5 6\n");
    file_write_text(place_in(*state, "notes").path, "no cloud, no session\n");
    file_write_text(place_in(*state, "a.jpg").path, "\xff\xd8\xff\xe0 and so on");
    file_write_text(place_in(*state, "a.laz").path, "LASF and so on");
    gallery_write(place_in(*state, "a.png").path, 1, 0);
    gallery_make(*state, "pictures", "1.png");
    const temp_folder *own = *state;
    command_result made =
        run_script("cd %s && ln -s %s octreel && ./octreel record my.json --size 32x32 -o rec >/dev/null "
                   "&& env -u CI ./octreel accept a.digests rec --reason x >/dev/null",
                   own->name, octreel_program());
    assert_done(&made);
    command_release(&made);
    return 0;
}

/* An argument list, and a part of the sentence. */
typedef struct mistake {
    const char *arguments, *sentence;
} mistake;

static void assert_mistakes(void **state, const mistake *rows, size_t count)
{
    const temp_folder *own = *state;
    const int before = temp_folder_count(own);
    for (size_t i = 0; i < count; i++) {
        command_result result = run_script("cd %s && env -u CI ./octreel %s", own->name, rows[i].arguments);
        assert_trouble(&result, rows[i].sentence);
        if (temp_folder_count(own) != before)
            fail_msg("octreel %s writes a file", rows[i].arguments);
    }
}

#define ASSERT_MISTAKES(state, rows) assert_mistakes(state, rows, sizeof rows / sizeof rows[0])

static void misspelled_words_get_the_nearest_name_as_hint(void **state)
{
    static const mistake rows[] = {
        {"recrod -o x", "unknown command \"recrod\", did you mean record? "},
        {"compare a b", "unknown command \"compare\", did you mean diff? "},
        {"checksum", "unknown command \"checksum\", did you mean accept? "},
        {"hash", "unknown command \"hash\", did you mean accept? "},
        {"banana", "unknown command \"banana\"; "},
        {"help recrod", "unknown help topic \"recrod\", did you mean record? "},
        {"help sesion", "did you mean session? "},
        {"help record diff", "help: unexpected argument \"diff\""},
        {"--verison", "did you mean --version? "},
        {"-o x record", "expected a command before the option \"-o\""},
        {"record --colour-by depth -o x", "record: unknown option --colour-by, did you mean --color-by? "},
        {"record --camra=iso -o x", "record: unknown option --camra, did you mean --camera? "},
        {"record --banana -o x", "record: unknown option --banana; "},
        {"record -z -o x", "record: unknown option -z; "},
        {"verify rec --jsn", "did you mean --json? "},
        {"record --la all -o x", "--la is ambiguous: --layers, --labels"},
        {"record --camera isso -o x", "unknown camera \"isso\", did you mean iso? choose from iso, top"},
        {"record --camera TOP -o x", "did you mean top? "},
        {"record --layers nodes,point -o x", "unknown layer \"point\", did you mean points? "},
        {"record --color-by dept -o x", "did you mean depth? "},
        {"record --context eg -o x", "--context: unknown value \"eg\", did you mean egl? "},
        {"diff rec rec --ignore-layer txt", "unknown layer \"txt\", did you mean text? "},
    };
    ASSERT_MISTAKES(state, rows);
}

/* record has --replace and --force, the other commands of the list only --force. */
static void other_names_of_overwriting_get_the_option_of_the_command(void **state)
{
    static const char *const commands[] = {"record", "play", "film", "audit", "inspect", "diff", "accept"};
    static const char *const words[] = {"overwrite", "clobber", "replace"};
    for (size_t c = 0; c < sizeof commands / sizeof commands[0]; c++)
        for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
            char arguments[64], sentence[128];
            if (c == 0 && strcmp(words[i], "replace") == 0)
                continue;
            snprintf(arguments, sizeof arguments, "%s --%s", commands[c], words[i]);
            snprintf(sentence, sizeof sentence, "%s: unknown option --%s, did you mean --%s? ", commands[c], words[i],
                     c == 0 ? "replace" : "force");
            assert_mistakes(state, &(mistake){arguments, sentence}, 1);
        }
}

static void long_option_with_one_dash_is_suggested_with_two(void **state)
{
    static const mistake rows[] = {
        {"inspect cloud.txt -size 3x3", "inspect: unknown option -size, did you mean --size? "},
        {"inspect cloud.txt -size=3x3", "inspect: unknown option -size, did you mean --size? "},
        {"inspect -json cloud.txt", "inspect: unknown option -json, did you mean --json? "},
        {"record -q -keys w", "record: unknown option -keys, did you mean --keys? "},
        {"record -quiet my.json", "record: unknown option -quiet, did you mean --quiet? "},
        {"record my.json -output x", "record: unknown option -output, did you mean --output? "},
        {"verify rec -size 3x3", "verify: unknown option -s; "},
        {"record -qz", "record: unknown option -z; "},
    };
    ASSERT_MISTAKES(state, rows);
}

static void missing_or_surplus_values_are_reported(void **state)
{
    static const mistake rows[] = {
        {"record -o", "-o needs a value; see "},
        {"record -o x --size", "--size needs a value; see "},
        {"record --size -o x", "--size needs a value, but the next argument is the option -o"},
        {"record my.json -o --resume", "-o needs a value, but the next argument is the option --resume"},
        {"verify rec --json=3", "--json takes no value"},
        {"verify --help=3", "--help takes no value"},
    };
    ASSERT_MISTAKES(state, rows);
}

static void file_of_another_kind_gets_a_hint_at_its_command(void **state)
{
    static const mistake rows[] = {
        {"record cloud.txt -o x", "cloud.txt is a point cloud, but record takes one session; "},
        {"record rec -o x", "rec is a recording, but record takes one session; "},
        {"record a.png -o x", "a.png is a PNG, but record takes"},
        {"record pictures -o x", "pictures is a folder without a recording"},
        {"record a.digests -o x", "octreel diff compares frames with it"},
        {"record rec/ticks.jsonl -o x", "rec/ticks.jsonl is a file of a recording"},
        {"record rec/recording.json -o x", "give the folder that contains it"},
        {"record absent.json -o x", "absent.json: no such file or folder"},
        {"record notes -o x", "notes:1: '{' expected"},
        {"record sesion.json -o x", "sesion.json:1: octreel: expected \"session\""},
        {"inspect my.json", "my.json is a session, but inspect takes one point cloud; "},
        {"inspect a.png", "a.png is a PNG, but inspect takes"},
        {"inspect rec", "octreel verify replays it"},
        {"inspect a.laz", "a.laz:byte 14: the file ends in its header"},
        {"record a.laz -o x", "a.laz is a point cloud, but record takes one session; "},
        {"verify a.png", "octreel diff compares pictures, and octreel pick names"},
        {"verify rec/frame_000000.png", "is a PNG, but verify takes the folder of one recording: use rec\n"},
        {"verify rec/session.json", "is a session, but verify takes the folder of one recording: use rec\n"},
        {"join rec/ticks.jsonl", "takes the folder of one recording: use rec\n"},
        {"verify pictures", "octreel diff compares folders of PNGs"},
        {"verify absent", "absent: no such file or folder"},
        {"pick my.json 1 1", "octreel record films it"},
        {"pick rec 1 1", "rec is a recording, but pick takes a frame"},
        {"diff rec cloud.txt", "octreel inspect draws it"},
        {"diff a.jpg a.png", "a.jpg is a picture in another format than PNG, but diff takes two sides"},
        {"verify a.digests", "a.digests is a baseline, but verify takes"},
        {"digest rec", "octreel digest was removed; use octreel accept BASELINE FRAMES"},
        {"accept pictures cloud.txt", "cloud.txt is a point cloud, but accept takes"},
        {"record --camera-from my.json -o x", "my.json is a session, and --camera-from takes the folder"},
        {"record --camera-from absent -o x", "absent: no such file or folder"},
        {"rec", "unknown command \"rec\": it is a recording; "},
        {"my.json", "unknown command \"my.json\": it is a session; "},
    };
    ASSERT_MISTAKES(state, rows);
}

static void invalid_numbers_and_colours_are_refused(void **state)
{
    static const mistake rows[] = {
        {"diff rec rec --background ff80", "--background takes a colour such as ff8000, not \"ff80\""},
        {"diff rec rec --background ff80zz", "not \"ff80zz\""},
        {"diff rec rec --background '#'", "not \"#\""},
        {"diff a.png a.png --max-delta 2", "--max-delta takes a number from 0 to 1, not \"2\""},
        {"diff a.png a.png --max-delta -0.1", "not \"-0.1\""},
        {"diff a.png a.png --ignore 1,2,0,4", "--ignore takes left, top, width and height"},
        {"diff a.png a.png --ignore 1,2,4,0", "not \"1,2,4,0\""},
        {"diff a.png a.png --ignore 1,2,3", "not \"1,2,3\""},
        {"inspect cloud.txt $(yes -- '--nearest 1,2,3' | head -n 101)", "at most 100 queries can be given"},
    };
    ASSERT_MISTAKES(state, rows);
}

static void colour_may_begin_with_a_hash(void **state)
{
    const place picture = place_in(*state, "a.png");
    command_result with = run_octreel(NULL, "diff %s %s --json --background #aBcdef", picture.path, picture.path);
    command_result without = run_octreel(NULL, "diff %s %s --json --background abcdef", picture.path, picture.path);
    assert_done(&with);
    assert_non_null(strstr(with.out, "\"background\": \"#abcdef\""));
    assert_string_equal(with.out, without.out);
    command_release(&with);
    command_release(&without);
}

static void errors_about_outputs_name_option_and_kind_of_file(void **state)
{
    static const mistake rows[] = {
        {"record my.json x", "unexpected argument \"x\", did you mean -o x?"},
        {"record my.json x.jpg", "unexpected argument \"x.jpg\": "},
        {"record my.json rec", "unexpected argument \"rec\": "},
        {"record my.json -o -", "-o needs a folder, but \"-\" is standard output"},
        {"diff a.png a.png -o -", "-o needs a folder, but \"-\" is standard output"},
        {"inspect cloud.txt -o - --json", "only one output can go to standard output"},
        {"inspect cloud.txt -o - --nodes -", "only one output can go to standard output"},
        {"diff - -", "\"-\" is given twice, but standard input can be read only once"},
        {"verify -", "\"-\" is standard input, but verify takes the folder of one recording"},
        {"join -", "\"-\" is standard input, but join takes the folder"},
        {"pick - 1 2", "\"-\" is standard input, but pick takes a frame"},
        {"accept - a.png", "\"-\" is standard input, but accept takes a reference"},
        {"record my.json my.json", "unexpected argument \"my.json\": "},
        {"record -- my.json -o", "unexpected argument \"-o\": "},
        {"record my.json x -o y", "unexpected argument \"x\": "},
        {"inspect cloud.txt tree.png", "did you mean -o tree.png?"},
        {"inspect cloud.txt cloud.txt", "for several files: for f in *.pcd; do "},
        {"diff a.png a.png evidence", "did you mean -o evidence?"},
        {"record my.json -o x.jpg", "-o needs a folder, but \"x.jpg\" names a picture"},
        {"record my.json -o x.PNG", "-o needs a folder, but \"x.PNG\" names a picture"},
        {"record my.json -o x.mp4", "names a film: record into a folder, then make a film"},
        {"record my.json -o my.json", "-o needs a folder, but \"my.json\" names a file"},
        {"record my.json -o .", "-o needs a folder of its own, but \".\" is or contains the current folder"},
        {"record my.json -o ../\"$(basename \"$(pwd)\")\"/", "is or contains the current folder"},
        {"inspect cloud.txt -o x.jpg", "-o needs the name of a PNG file or an .html page, not \"x.jpg\""},
        {"inspect cloud.txt -o .", "-o needs a file, but \".\" is a folder"},
        {"inspect cloud.txt --nodes x.png", "--nodes writes text, but \"x.png\" names a picture"},
        {"diff a.png a.png -o x.html", "-o needs a folder"},
        {"diff a.png a.png --junit x.png", "--junit writes text"},
    };
    ASSERT_MISTAKES(state, rows);
}

/* These folders are outside of the test's folder. If one of them holds a recording, it could be resumed, and its rows
 * are skipped. */
static void output_folder_above_the_current_folder_is_refused(void **state)
{
    static const mistake root[] = {
        {"record my.json -o /", "-o needs a folder of its own, but \"/\" is or contains the current folder"},
        {"record my.json -o /.", "is or contains the current folder"},
    };
    static const mistake parent[] = {
        {"record my.json -o ..", "is or contains the current folder"},
        {"record --replace -o ..", "is or contains the current folder"},
    };
    const temp_folder *own = *state;
    if (file_kind_of("/") != KIND_RECORDING)
        ASSERT_MISTAKES(state, root);
    if (file_kind_of(place_in(own, "..").path) != KIND_RECORDING)
        ASSERT_MISTAKES(state, parent);
}

/* An existing recording may have a name that looks like a picture, and may be the current folder. */
static void existing_recording_of_any_name_is_resumed(void **state)
{
    const temp_folder *own = *state;
    command_result result = run_script("cd %s && mv rec rec.png && ./octreel record --resume -o rec.png >/dev/null && "
                                       "cd rec.png && ../octreel record --resume -o .",
                                       own->name);
    assert_done(&result);
    const char *frames = strstr(result.out, " frames, of which "), *there = strstr(result.out, " existed already, ");
    assert_true(frames && there && strstr(result.out, "frames a second") == NULL);
    command_release(&result);
}

static void hints_name_the_program_as_the_user_called_it(void **state)
{
    const temp_folder *own = *state;
    static const char *const arguments[] = {"banana", "record --banana", "record cloud.txt -o x", "help record"};
    for (size_t i = 0; i < sizeof arguments / sizeof arguments[0]; i++) {
        command_result result = run_script("cd %s && mkdir -p 'my bin' && ln -sf ../octreel 'my bin/oct' && "
                                           "'my bin/oct' %s",
                                           own->name, arguments[i]);
        if (strstr(i == 3 ? result.out : result.err, "'my bin/oct' ") == NULL)
            fail_msg("%s: %s", arguments[i], result.err);
        command_release(&result);
    }
}

static void help_is_available_for_commands_and_sessions(void **state)
{
    (void)state;
    command_result help = run_octreel(NULL, "help"), option = run_octreel(NULL, "--help");
    assert_done(&help);
    assert_string_equal(help.out, option.out);
    assert_non_null(strstr(help.out, "help session"));
    command_release(&help);
    command_release(&option);
    help = run_octreel(NULL, "help record");
    option = run_octreel(NULL, "record --help");
    assert_done(&help);
    assert_string_equal(help.out, option.out);
    command_release(&help);
    command_release(&option);
    help = run_octreel(NULL, "help session");
    assert_done(&help);
    assert_non_null(strstr(help.out, "{\"octreel\": \"session\", \"version\": 2"));
    command_release(&help);
}

/* The words of a text, separated by single blanks; the caller frees it. */
static char *words_of(const char *text)
{
    char *words = malloc(strlen(text) + 2), *to = words;
    assert_non_null(words);
    for (; *text; text++)
        if (!strchr(" \n", *text))
            *to++ = *text;
        else if (to > words && to[-1] != ' ')
            *to++ = ' ';
    *to = 0;
    return words;
}

/* `help` is the result of words_of(). */
static void assert_explains(const char *help, const char *name, const char *words)
{
    char line[160];
    snprintf(line, sizeof line, " %s %s ", name, words);
    if (strstr(help, line) == NULL)
        fail_msg("the help does not contain%s", line);
}

static void help_explains_every_value_and_key(void **state)
{
    static const char *const commands[] = {"record", "inspect"};
    (void)state;
    for (size_t c = 0; c < 2; c++) {
        command_result help = run_octreel(NULL, "%s --help", commands[c]);
        char *words = words_of(help.out);
        for (int i = 0; i < LAYER_COUNT; i++)
            assert_explains(words, layer_rows[i].name, layer_rows[i].help);
        for (size_t i = 0; view_option_at(i); i++)
            for (int n = 0; view_option_at(i)->member.names && view_option_at(i)->member.names(n); n++)
                assert_explains(words, view_option_at(i)->member.names(n), view_option_at(i)->words(n));
        assert_true(c == 1 || strstr(words, ". wait, q end") != NULL);
        free(words);
        command_release(&help);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_kinds, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(misspelled_words_get_the_nearest_name_as_hint),
        IN_FOLDER(other_names_of_overwriting_get_the_option_of_the_command),
        IN_FOLDER(long_option_with_one_dash_is_suggested_with_two),
        IN_FOLDER(missing_or_surplus_values_are_reported),
        IN_FOLDER(file_of_another_kind_gets_a_hint_at_its_command),
        IN_FOLDER(invalid_numbers_and_colours_are_refused),
        IN_FOLDER(colour_may_begin_with_a_hash),
        IN_FOLDER(errors_about_outputs_name_option_and_kind_of_file),
        IN_FOLDER(output_folder_above_the_current_folder_is_refused),
        IN_FOLDER(existing_recording_of_any_name_is_resumed),
        IN_FOLDER(hints_name_the_program_as_the_user_called_it),
        cmocka_unit_test(help_is_available_for_commands_and_sessions),
        cmocka_unit_test(help_explains_every_value_and_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
