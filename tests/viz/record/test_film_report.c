/* SPDX-License-Identifier: MIT */
/* test_film_report.c - the commands for ffmpeg that record prints: a shell runs them, and they use every frame. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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
    print_message("ffmpeg is not installed: the commands are not run\n");
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
    assert_non_null(
        strstr(text, "\nrefused points, edits and steps, without steps out of the world: 2; ticks.jsonl lists them\n"));
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
        char *text = written(film_report_empty, &(film_summary){0}, &options);
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

/* Run the command at the end of the last line. */
static void run_command(const char *told)
{
    static const char before[] = "\nits index.html shows it in a browser; as a film: ";
    const char *line = strstr(told, before);
    assert_non_null(line);
    assert_shell_done("{ %s\n} </dev/null", line + sizeof before - 1);
}

/* The properties that ffprobe reports of a file. */
typedef struct probe {
    int width, height, frames;
    char pixels[16];
} probe;

static probe probe_file(const char *path)
{
    char line[2048];
    probe seen = {0};
    snprintf(line, sizeof line,
             "ffprobe -v error -count_frames -show_entries stream=width,height,pix_fmt,nb_read_frames -of csv=p=0 "
             "\"%s\" </dev/null",
             path);
    command_result result = run_shell(line);
    if (sscanf(result.out, "%d,%d,%15[^,],%d", &seen.width, &seen.height, seen.pixels, &seen.frames) != 4)
        fail_msg("%s: %s%s", path, result.out, result.err);
    command_release(&result);
    return seen;
}

static void assert_film(const char *path, const view *v, int frames)
{
    const probe film = probe_file(path);
    assert_int_equal(film.width, (v->width + 1) / 2 * 2);
    assert_int_equal(film.height, (v->height + 1) / 2 * 2);
    assert_string_equal(film.pixels, "yuv420p");
    assert_int_equal(film.frames, frames);
}

static image frame_at(const film_options *options, uint64_t index)
{
    char name[32];
    snprintf(name, sizeof name, "frame_%06" PRIu64 ".png", index * options->every);
    return assert_read(place_below(options->folder, name).path);
}

/* The test fails unless the animation consists of the recording's pictures. */
static void assert_animation(const temp_folder *own, const char *path, const film_options *options, int frames)
{
    char folder[32];
    snprintf(folder, sizeof folder, "parts%d", frames);
    const place parts = place_in(own, folder);
    assert_int_equal(probe_file(path).frames, frames);
    assert_int_equal(mkdir(parts.path, 0777), 0);
    assert_shell_done("ffmpeg -v error -i \"%s\" \"%s/%%d.png\" </dev/null", path, parts.path);
    for (int i = 0; i < frames; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.png", i + 1);
        image expected = frame_at(options, (uint64_t)i), shown = assert_read(place_below(parts.path, name).path);
        const image_difference difference = image_compare(&expected, &shown);
        assert_true(image_has_no_difference(&difference));
        image_release(&expected);
        image_release(&shown);
    }
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
    char *told = filmed_and_told(&options), path[1200];
    run_command(told);
    free(told);
    snprintf(path, sizeof path, "%s/film.mp4", folder.path);
    assert_film(path, &options.view, r->frames);
}

static void printed_commands_use_every_frame(void **state)
{
    need_ffmpeg();
    assert_row(*state, &(row){"film", 1, 160, 90, 33});
}

static void printed_commands_use_every_frame_of_a_recording_with_gaps(void **state)
{
    need_ffmpeg();
    assert_row(*state, &(row){"gaps", 4, 63, 37, 9}); /* yuv420p does not allow odd sides */
}

static void printed_commands_work_for_a_single_frame(void **state)
{
    need_ffmpeg();
    assert_row(*state, &(row){"one", 1000, 64, 36, 1});
}

static void printed_commands_quote_special_characters(void **state)
{
    need_ffmpeg();
    assert_row(*state, &(row){"-it's a:b 50%d 5$ [x]*", 1, 64, 36, 33});
    assert_row(*state, &(row){"-it's c:d 50%d 5$ [x]*", 8, 64, 36, 5});
}

static void program_prints_the_commands(void **state)
{
    need_ffmpeg();
    const place folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record --keys wdwd --size 64x36 -o %s//", folder.path);
    assert_done(&result);
    run_command(result.out);
    command_release(&result);
    const film_options options = {.folder = folder.path, .view = {.width = 64, .height = 36}, .every = 1};
    assert_film(place_below(folder.path, "film.mp4").path, &options.view, 5);
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
    size_t run = 0;
    for (char *line = strtok(result.out, "\n"); line; line = strtok(NULL, "\n")) {
        const char *command = strstr(line, "(cd frames && ffmpeg");
        if (command && ++run > 0)
            assert_shell_done("cd \"%s/..\" && { %s; } </dev/null", folder.path, command);
    }
    command_release(&result);
    assert_int_equal(run, 2);
    assert_animation(*state, place_below(folder.path, "film.apng").path, &options, 33);
    assert_sheet(place_below(folder.path, "sheet.png").path, &options, 33);
}

/* ---- Without ffmpeg ----------------------------------------------------------------------------------------- */

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

/* No name is taken for an option by the shell, or looked up elsewhere by cd. */
static void folder_names_are_quoted_for_shells(void **state)
{
    static const char *const rows[][2] = {
        {"film", "as a film: (cd ./film && ffmpeg "},
        {"film//", "(cd ./film// && "},
        {".", "(cd ./. && "},
        {"/a/", "(cd /a/ && "},
        {"-x", "(cd ./'./-x' && "},
        {"a'b c", "(cd ./'a'\\''b c' && "},
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
