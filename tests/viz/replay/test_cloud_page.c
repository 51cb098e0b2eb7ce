/* SPDX-License-Identifier: MIT */
/* test_cloud_page.c - the page of a cloud draws the picture that octreel inspect draws, names points, measures between
 * them and asks queries. A damaged page says so, and no page overwrites a foreign file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "browser.h"
#include "commands.h"
#include "driven_page.h"
#include "fixture.h"
#include "page.h"

/* Write a spiral of points with values. Every 50th row is not a point, so that ids have gaps. */
static void write_cloud(const char *path, const char *columns, int count)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s\n", columns);
    for (int i = 0; i < count; i++) {
        const double turn = i * 0.05, r = 3 + turn / 8;
        if (i % 50 == 49)
            fputs("nan nan nan", file);
        else
            fprintf(file, "%.4f %.4f %.4f", r * cos(turn), r * sin(turn), turn / 2);
        fprintf(file, " %d %d %d\n", i % 256, 255 - i % 200, i * 7 % 256);
    }
    assert_int_equal(fclose(file), 0);
}

static void skip_without_module(void)
{
    if (page_can_play())
        return;
    print_message("octreel was built without WebAssembly: it makes no pages of clouds\n");
    skip();
}

/* Make the picture and the page of a cloud with the same options, and drive the page. Returns the reports; the caller
 * frees them. The test is skipped if pages do not play. */
static char *drive_cloud(const temp_folder *folder, const char *columns, const char *options)
{
    const place cloud = place_in(folder, "cloud.txt"), picture = place_in(folder, "cloud.png"),
                page = place_in(folder, "cloud.html");
    const char *outputs[] = {picture.path, page.path};
    skip_without_module();
    write_cloud(cloud.path, columns, 2000);
    for (int i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, "inspect --quiet %s -o %s %s", cloud.path, outputs[i], options);
        assert_done(&result);
        command_release(&result);
    }
    skip_without_playing_page(page.path);
    return run_scripts_in_page(folder, page.path, (const char *const[]){"drive_cloud.js", NULL});
}

static void assert_same_picture(const temp_folder *folder, const char *said)
{
    char digest[16];
    snprintf(digest, sizeof digest, "%08x", (unsigned)compute_png_digest(place_in(folder, "cloud.png").path));
    assert_reported_value(said, "pixels", digest);
    assert_reported_value(said, "errors", "");
    assert_reported_value(said, "facts of the page", "true");
}

static void page_draws_the_picture_of_inspect(void **state)
{
    static const char *const rows[][2] = {
        {"x y z red green blue", ""},
        {"x y z red green blue",
         "--capacity 8 --camera top --shade edl --size 640x360 --nearest 1,2,3,4 --radius 0,0,9,4 --node 0"},
        {"x y z intensity class other", "--color-points intensity --full refuse --depth 3 --slice z=12 --aa 2"},
        {"x y z intensity class other", "--color-points class --world=-9,-9,-1,9,9,20 --diagram beside"},
    };
    const temp_folder *folder = *state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *said = drive_cloud(folder, rows[i][0], rows[i][1]);
        assert_same_picture(folder, said);
        free(said);
    }
}

static void page_measures_asks_and_hides_the_parts_of_a_game(void **state)
{
    const temp_folder *folder = *state;
    char *said = drive_cloud(folder, "x y z red green blue", "");
    assert_reported_value(said, "hidden", "none none");
    assert_reported_value(said, "about", "driven 1,960 points · 1280 × 720 · iso");
    assert_reported_value(said, "keys", "false true");
    assert_reported_value(said, "measured",
                          "Distance | frompoint 0 at (3, 0, 0) | topoint 100 at (1.0283, -3.4761, 2.5) | "
                          "distance4.713902 | dx-1.9717 | dy-3.4761 | dz2.5");
    assert_reported_value(said, "clicked", "true");
    assert_reported_value(said, "no point", "There is no point: click a point to measure.");
    assert_reported_value(said, "after Esc", "true");
    assert_reported_value(said, "asked", "[0,1,2] [] [0]");
    free(said);
}

static void damaged_page_says_so(void **state)
{
    const temp_folder *folder = *state;
    const place page = place_in(folder, "cloud.html"), damaged = place_in(folder, "damaged.html");
    free(drive_cloud(folder, "x y z red green blue", ""));
    size_t size;
    char *text = file_read(page.path, &size), *points = strstr(text, "id=\"points\"");
    assert_non_null(points);
    points[5000] = points[5000] == '0' ? '1' : '0';
    file_write(damaged.path, text, size);
    char *shown = browser_open(folder, damaged.path, "");
    assert_non_null(strstr(shown, "the points in this page are cut off or damaged; copy the page or make it again"));
    free(shown);
    file_write(damaged.path, text, (size_t)(points - text) + 9000);
    shown = browser_open(folder, damaged.path, "");
    assert_non_null(strstr(shown, "If this sentence stays, the page is cut off or damaged"));
    free(shown);
    free(text);
}

static void page_overwrites_no_foreign_file(void **state)
{
    const temp_folder *folder = *state;
    const place cloud = place_in(folder, "cloud.txt"), page = place_in(folder, "mine.html");
    file_write_text(cloud.path, "1 2 3\n4 5 6\n");
    file_write_text(page.path, "<p>mine</p>");
    command_result refused = run_octreel(NULL, "inspect %s -o %s", cloud.path, page.path);
    assert_trouble(&refused, "exists and is not a page made by octreel");
    command_result useless = run_octreel(NULL, "inspect %s -o %s --fill gl", cloud.path, page.path);
    assert_trouble(&useless, "--fill changes how a PNG is drawn, but");
    skip_without_module();
    for (int i = 0; i < 2; i++) {
        command_result forced =
            run_octreel(NULL, "inspect --quiet %s -o %s %s", cloud.path, page.path, i ? "" : "--force");
        assert_done(&forced);
        command_release(&forced);
    }
}

static void play_and_record_of_a_cloud_name_inspect(void **state)
{
    static const char *const commands[] = {"play", "record"};
    const place cloud = place_in(*state, "cloud.txt");
    file_write_text(cloud.path, "1 2 3\n4 5 6\n");
    for (int i = 0; i < 2; i++) {
        command_result refused = run_octreel(NULL, "%s %s", commands[i], cloud.path);
        assert_trouble(&refused, "octreel inspect draws it, and with -o FILE.html makes a page of it");
    }
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(page_draws_the_picture_of_inspect),
        IN_FOLDER(page_measures_asks_and_hides_the_parts_of_a_game),
        IN_FOLDER(damaged_page_says_so),
        IN_FOLDER(page_overwrites_no_foreign_file),
        IN_FOLDER(play_and_record_of_a_cloud_name_inspect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
