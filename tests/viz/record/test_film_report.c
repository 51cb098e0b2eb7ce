/* SPDX-License-Identifier: MIT */
/* test_film_report.c - the commands that record prints: a shell runs them, and they use every frame. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "apng_read.h"
#include "commands.h"
#include "files.h"
#include "film_report.h"
#include "fixture.h"
#include "images.h"
#include "recordings.h"
#include "image_compare.h"

static const char KEYS[] = "ddddeeeewwwwaaaassssffff.n.dewaf"; /* 33 ticks */

static bool has_ffmpeg(void)
{
    return is_program_installed("ffmpeg") && is_program_installed("ffprobe");
}

static void need_ffmpeg(void)
{
    if (has_ffmpeg())
        return;
    print_message("ffmpeg is not installed: its commands are not run\n");
    skip();
}

/* Record, and return the program's report. The caller frees it. */
static char *filmed_and_told(const film_options *options)
{
    char *text;
    size_t size;
    octree_session session = octree_session_default();
    session.keys = KEYS;
    session.query_count = 0;
    const film_summary summary = assert_filmed(&session, options);
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    film_report(out, &summary, options, 1, false);
    assert_int_equal(fclose(out), 0);
    return text;
}

/* The line of events counts ticks, and the next line counts the refusals in them. */
static void edit_of_a_missing_point_is_reported_as_refused(void **state)
{
    const place folder = place_in(*state, "film");
    static const octree_edit edits[] = {{2, OCTREE_EDIT_REMOVE, {.id = 999}}, {2, OCTREE_EDIT_MOVE, {.id = 998}}};
    octree_session session = octree_session_default();
    session.keys = NULL;
    session.query_count = 0;
    session.ticks = 3;
    session.bodies += 1;
    session.body_count = 1;
    session.edits = edits;
    session.edit_count = 2;
    const film_options options = small_film(folder.path);
    const film_summary summary = assert_filmed(&session, &options);
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    film_report(out, &summary, &options, 1, false);
    assert_int_equal(fclose(out), 0);
    assert_non_null(strstr(text, " refused 1,"));
    assert_non_null(strstr(
        text,
        "\nrefused points, edits and steps (steps out of the world are not counted): 2; ticks.jsonl lists them\n"));
    free(text);
}

static char *written(void (*report)(FILE *out, const film_summary *summary, const film_options *options),
                     const film_summary *summary, const film_options *options)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    report(out, summary, options);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void stopped_recording_is_reported_with_the_command_to_continue(void **state)
{
    static const struct {
        film_summary summary;
        uint64_t first, last;
        const char *text;
    } rows[] = {{{.ticks = 0, .total = 9}, 0, 0, "octreel: stopped before the first tick was recorded\n"},
                {{.ticks = 4, .total = 9},
                 0,
                 0,
                 "octreel: stopped after 4 of 9 ticks; to continue: octreel record --resume -o film\n"},
                {{.ticks = 4, .total = 9},
                 10,
                 19,
                 "octreel: stopped after 4 of 9 ticks; to continue: octreel record --resume --ticks 10:19 -o film\n"}};
    film_options options = small_film("film");
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        options.first = rows[i].first;
        options.last = rows[i].last;
        char *text = written(film_report_stopped, &rows[i].summary, &options);
        assert_string_equal(text, rows[i].text);
        free(text);
    }
}

static void left_out_elements_are_reported_in_one_list(void **state)
{
    static const char *const texts[] = {"",
                                        "nodes",
                                        "points",
                                        "nodes and points",
                                        "velocity arrows",
                                        "nodes and velocity arrows",
                                        "points and velocity arrows",
                                        "nodes, points and velocity arrows"};
    (void)state;
    for (unsigned i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char text[FILM_LEFT_OUT];
        assert_string_equal(film_left_out_text(i, text), texts[i]);
    }
}

static void view_of_a_tree_that_no_tick_has_is_reported(void **state)
{
    static const struct {
        view_tree tree;
        const char *text;
    } rows[] = {{TREE_FOREIGN, "--tree foreign shows no nodes\n"},
                {TREE_BOTH, "--tree both shows only the nodes of Octreel\n"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        film_options options = small_film("film");
        options.view.tree = rows[i].tree;
        char *text = written(film_report_useless_options, &(film_summary){0}, &options);
        assert_non_null(strstr(text, rows[i].text));
        free(text);
    }
}

static void assert_shell_done(const char *format, ...)
{
    char line[4096];
    va_list values;
    va_start(values, format);
    vsnprintf(line, sizeof line, format, values);
    va_end(values);
    command_result result = run_shell(line);
    if (result.status != 0)
        fail_msg("%s\nended with %d: %s", line, result.status, result.err);
    command_release(&result);
}

/* Run the command at the end of the last line, which begins with the name of octreel, and read the film. */
static apng_film run_command(const temp_folder *own, const char *told)
{
    static const char before[] = "\nits index.html shows it in a browser; as a film: ";
    const char *line = strstr(told, before), *command = line ? strstr(line, " film ") : NULL;
    assert_non_null(command);
    assert_shell_done("%s %.*s && mv film.png '%s'", octreel_program(), (int)strcspn(command, "\n"), command,
                      place_in(own, "film.png").path);
    return apng_read(place_in(own, "film.png").path);
}

static image frame_at(const film_options *options, uint64_t index)
{
    char name[32];
    snprintf(name, sizeof name, "frame_%06" PRIu64 ".png", index * options->every);
    return assert_read(place_below(options->folder, name).path);
}

/* The test fails unless the film consists of the recording's pictures. */
static void assert_film(apng_film *film, const film_options *options, int frames)
{
    int index = 0;
    assert_int_equal(film->width, options->view.width);
    assert_int_equal(film->height, options->view.height);
    for (size_t i = 0; i < film->count; i++)
        for (unsigned j = 0; j < film->frames[i].shown; j++) {
            image expected = frame_at(options, (uint64_t)index++);
            for (int at = 0; at < film->width * film->height; at++) {
                const image_color color = image_color_at(&expected, at % film->width, at / film->width);
                assert_memory_equal(film->frames[i].rgb + 3 * at, &color, 3);
            }
            image_release(&expected);
        }
    assert_int_equal(index, frames);
    apng_release(film);
}

static bool is_black(image_color color)
{
    return color.r == 0 && color.g == 0 && color.b == 0;
}

/* The test fails unless every tenth frame is a tile, in reading order, and the tiles after the last one are black. */
static void assert_sheet(const char *path, const film_options *options, int frames)
{
    image sheet = assert_read(path);
    const int width = options->view.width, height = options->view.height;
    assert_int_equal(sheet.width, 5 * width);
    assert_int_equal(sheet.height, 5 * height);
    for (int tile = 0; tile < 25; tile++) {
        const int left = tile % 5 * width, top = tile / 5 * height;
        if (tile * 10 >= frames) {
            assert_true(is_black(image_color_at(&sheet, left + width / 2, top + height / 2)));
            continue;
        }
        image frame = frame_at(options, (uint64_t)(tile * 10));
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                const image_color a = image_color_at(&frame, x, y), b = image_color_at(&sheet, left + x, top + y);
                assert_memory_equal(&a, &b, sizeof a);
            }
        image_release(&frame);
    }
    image_release(&sheet);
}

/* A recording, and the expected results of its commands. */
typedef struct row {
    const char *name; /* name of the folder */
    uint64_t every;
    int width, height, frames;
} row;

static void assert_row(const temp_folder *own, const row *r)
{
    const place folder = place_in(own, r->name);
    film_options options = small_film(folder.path);
    options.every = r->every;
    options.view.width = r->width;
    options.view.height = r->height;
    char *told = filmed_and_told(&options);
    apng_film film = run_command(own, told);
    free(told);
    assert_film(&film, &options, r->frames);
}

static void printed_commands_use_every_frame(void **state)
{
    assert_row(*state, &(row){"film", 1, 160, 90, 33});
}

static void printed_commands_use_every_frame_of_a_recording_with_gaps(void **state)
{
    assert_row(*state, &(row){"gaps", 4, 63, 37, 9});
}

static void printed_commands_work_for_a_single_frame(void **state)
{
    assert_row(*state, &(row){"one", 1000, 64, 36, 1});
}

static void printed_commands_quote_special_characters(void **state)
{
    assert_row(*state, &(row){"-it's a:b 50%d 5$ [x]*", 1, 64, 36, 33});
    assert_row(*state, &(row){"-it's c:d 50%d 5$ [x]*", 8, 64, 36, 5});
}

static void program_prints_the_commands(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record --keys wdwd --size 64x36 -o %s//", folder.path);
    assert_done(&result);
    apng_film film = run_command(*state, result.out);
    command_release(&result);
    const film_options options = {.folder = folder.path, .view = {.width = 64, .height = 36}, .every = 1};
    assert_film(&film, &options, 5);
}

/* The examples of the help use a recording with the name "frames". */
static void help_has_commands_for_an_animation_and_a_sheet(void **state)
{
    need_ffmpeg();
    const place folder = place_in(*state, "frames");
    film_options options = small_film(folder.path);
    options.view.width = 320;
    options.view.height = 180;
    free(filmed_and_told(&options));
    command_result result = run_octreel(NULL, "record --help");
    const char *film = strstr(result.out, " film frames -o film.png\n"),
               *sheet = strstr(result.out, "(cd frames && ffmpeg");
    assert_true(film && sheet);
    assert_shell_done("cd \"%s/..\" && %s%.*s && { %.*s; } </dev/null", folder.path, octreel_program(),
                      (int)strcspn(film, "\n"), film, (int)strcspn(sheet, "\n"), sheet);
    command_release(&result);
    apng_film read = apng_read(place_in(*state, "film.png").path);
    assert_film(&read, &options, 33);
    assert_sheet(place_below(folder.path, "sheet.png").path, &options, 33);
}

static void assert_told(const char *folder, uint64_t frames, const char *part)
{
    char *text;
    size_t size;
    const film_options options = {.folder = folder, .every = 1};
    const film_summary summary = {.ticks = frames, .frames = frames};
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    film_report_joined(out, &summary, &options, false);
    assert_int_equal(fclose(out), 0);
    if (strstr(text, part) == NULL)
        fail_msg("%s\nhas not %s", text, part);
    free(text);
}

/* No name is taken for an option. */
static void folder_names_are_quoted_for_shells(void **state)
{
    static const char *const rows[][2] = {
        {"film", "as a film: octreel film film -o film.png\n"},
        {"film//", "octreel film film// -o "},
        {".", "octreel film . -o "},
        {"/a/", "octreel film /a/ -o "},
        {"-x", "octreel film './-x' -o "},
        {"a'b c", "octreel film 'a'\\''b c' -o "},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_told(rows[i][0], 10, rows[i][1]);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

/* The test fails unless a report with this number of everything has these words. */
static void assert_counted(uint64_t count, const char *joined, const char *stopped)
{
    const film_summary summary = {.ticks = count,
                                  .frames = count,
                                  .total = count,
                                  .left_out = count,
                                  .over_budget = count,
                                  .beyond = LEFT_OUT_NODES};
    const film_options options = {.folder = "f"};
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    film_report_joined(out, &summary, &options, false);
    film_report_stopped(out, &summary, &options);
    assert_int_equal(fclose(out), 0);
    if (strncmp(text, joined, strlen(joined)) != 0 || !strstr(text, stopped))
        fail_msg("it says\n%s", text);
    free(text);
}

static void counts_of_one_are_in_the_singular(void **state)
{
    (void)state;
    assert_counted(1,
                   "f: 1 tick, 1 frame\n"
                   "1 element too far away to be drawn; the frames leave it out\n"
                   "1 frame leaves out nodes beyond --budget\n",
                   "octreel: stopped after 1 of 1 tick; ");
    assert_counted(2,
                   "f: 2 ticks, 2 frames\n"
                   "2 elements too far away to be drawn; the frames leave them out\n"
                   "2 frames leave out nodes beyond --budget\n",
                   "octreel: stopped after 2 of 2 ticks; ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(printed_commands_use_every_frame),
        IN_FOLDER(printed_commands_use_every_frame_of_a_recording_with_gaps),
        IN_FOLDER(edit_of_a_missing_point_is_reported_as_refused),
        IN_FOLDER(printed_commands_work_for_a_single_frame),
        IN_FOLDER(printed_commands_quote_special_characters),
        IN_FOLDER(program_prints_the_commands),
        IN_FOLDER(help_has_commands_for_an_animation_and_a_sheet),
        cmocka_unit_test(folder_names_are_quoted_for_shells),
        cmocka_unit_test(stopped_recording_is_reported_with_the_command_to_continue),
        cmocka_unit_test(left_out_elements_are_reported_in_one_list),
        cmocka_unit_test(view_of_a_tree_that_no_tick_has_is_reported),
        cmocka_unit_test(counts_of_one_are_in_the_singular),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
