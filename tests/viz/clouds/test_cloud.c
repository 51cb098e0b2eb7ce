/* SPDX-License-Identifier: MIT */
/* test_cloud.c - opening point-cloud files, and points as text. */
#include "clouds.h"
#include "temp_folder.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* ---- Text --------------------------------------------------------------------------------------------------- */

static void text_is_read_with_any_separator_and_line_end(void **state)
{
    static const char *const texts[] = {
        "1 2 3\n-4.5 5e10 0.1\n",
        "1 2 3\r\n-4.5 5e10 0.1\r\n",
        "1 2 3\r-4.5 5e10 0.1\r",
        "1 2 3\n-4.5 5e10 0.1",
        "\t1\t2\t 3 \n   -4.5 +5.E10 .1 \n",
        "1,2,3\n-4.5,5e10,0.1\n",
        "1, 2, 3\n-4.5 , 5e10 , 0.1\n",
        "1;2;3\n-4.5;5e10;0.1\n",
        "1,2,3,\n-4.5 5e10 0.1\n",
        "1 2 3 255 0 name\n-4.5,5e10,0.1,,7\n",
        "# a comment\n\n1 2 3 # here\n//another\n  \n-4.5 5e10 0.1//there\n#end",
        "\xef\xbb\xbfx,y,z\n1,2,3\n-4.5,5e10,0.1\n",
        "x y z\n1 2 3\n-4.5 5e10 0.1\n",
        "# points\n\n\"X\";\"Y\";\"Z\";\"red\"\n1;2;3\n-4.5;5e10;0.1\n",
        "X [m], Y [m], Z [m]\n1,2,3\n-4.5,5e10,0.1\n",
        "2\n1 2 3\n-4.5 5e10 0.1\n",
        "2 \r\n1 2 3 -1024 10 20 30\r\n-4.5 5e10 0.1 2047 1 2 3\r\n",
        "# X Y Z\n1 # at least\n1 2 3\n-4.5 5e10 0.1\n",
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_reads("a.xyz", texts[i], strlen(texts[i]), two_points, 2, 0);
}

static void text_keeps_doubles(void **state)
{
    static const char text[] = "500000.123456789 5400000.987654321 1e-300\n";
    static const double expected[][3] = {{500000.123456789, 5400000.987654321, 1e-300}};
    (void)state;
    assert_reads("utm.txt", text, strlen(text), expected, 1, 0);
}

/* They have a row, as in the formats of scanners. */
static void text_skips_points_without_finite_coordinates(void **state)
{
    static const char *const texts[] = {
        "1 2 3\nnan nan nan\n-4.5 5e10 0.1\n",
        "1,2,3\n1,-inf,2\n-4.5,5e10,0.1\n",
        "x;y;z\n1;2;3\n NaN ; Infinity;-nan(ind)\n-4.5;5e10;0.1\n",
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_reads("a.xyz", texts[i], strlen(texts[i]), two_points, 2, 1);
}

static void text_that_is_not_a_cloud_is_refused_with_its_line(void **state)
{
    static const refusal rows[] = {
        {"", "a.xyz: holds no points"},
        {"\n\n# nothing\n", "a.xyz: holds no points"},
        {"x y z\n", "a.xyz: holds no points"},
        {"1", "a.xyz:1: says that 1 points follow, but 0 do: the file is truncated"},
        {"# scan\n3\n1 2 3\n4 5 6\n", "a.xyz:2: says that 3 points follow, but 2 do: the file is truncated"},
        {"1 2 3\n7\n4 5 6\n", "a.xyz:2: has only 1 of the three coordinates x y z"},
        {"2\n2\n1 2 3\n4 5 6\n", "a.xyz:2: has only 1 of the three coordinates x y z"},
        {"x y z\n2\n1 2 3\n4 5 6\n", "a.xyz:2: has only 1 of the three coordinates x y z"},
        {"-2\n1 2 3\n", "a.xyz:1: has only 1 of the three coordinates x y z"},
        {"1 2 3\n4 5\n", "a.xyz:2: has only 2 of the three coordinates x y z"},
        {"1 2 3\n4 # 5 6\n", "a.xyz:2: has only 1 of the three coordinates x y z"},
        {"1 2 3\n\n4 five 6\n", "a.xyz:3: 'five' is not a number"},
        {"1 2 3\nx y z\n", "a.xyz:2: 'x' is not a number"},
        {"1 2 3x\n", "a.xyz:1: '3x' is not a number"},
        {"1 0x10 3\n", "a.xyz:1: '0x10' is not a number"},
        {"1 nan 3\n", "a.xyz: holds no points that can be read: all 1 are without finite coordinates"},
        {"inf inf inf\n-nan nan(ind) 2\n",
         "a.xyz: holds no points that can be read: all 2 are without finite coordinates"},
        {"1 nano 3\n", "a.xyz:1: 'nano' is not a number"},
        {"nan 2\n", "a.xyz:1: has only 2 of the three coordinates x y z"},
        {"1 2 3\nnan,5;2\n", "a.xyz:2: mixes blanks, commas and semicolons between its columns; use only one of them"},
        {"1 2 -1e309\n", "a.xyz:1: '-1e309' is beyond the largest double"},
        {"1,,3\n", "a.xyz:1: column 2 is empty"},
        {",1,2,3\n", "a.xyz:1: column 1 is empty"},
        {"1,2,\n", "a.xyz:1: has only 2 of the three coordinates x y z"},
        {"1 2 3\n4 5 6\r7 8 9\n", "a.xyz:2: '6\\x0d7' is not a number"},
        {"1 2 \xff\n", "a.xyz:1: '\\xff' is not a number"},
        {"/\n", "a.xyz:1: '/' is not a number"},
        {"/ 1 2 3\n", "a.xyz:1: '/' is not a number"},
        {"\"\" y z\n1 2 3\n", "a.xyz:1: '\"\"' is not a number"},
        {"nan inf x\n1 2 3\n", "a.xyz:1: 'x' is not a number"},
        {"12345678901234567890123456789012345678901234567890a 2 3\n",
         "a.xyz:1: '123456789012345678901234567890123456789...' is not a number"},
    };
    (void)state;
    assert_refuses_each("a.xyz", rows, sizeof rows / sizeof *rows);
}

static void text_with_decimal_commas_is_refused(void **state)
{
    static const refusal rows[] = {
        {"1,5;2,5;3,5\n", "a.csv:1: mixes blanks, commas and semicolons between its columns; use only one of them"},
        {"1,5 2,5 3,5\n", "a.csv:1: mixes blanks, commas and semicolons between its columns; use only one of them"},
        {"1 2 3,5\n", "a.csv:1: mixes blanks, commas and semicolons between its columns; use only one of them"},
        {"1;2;3,5\n", "a.csv:1: mixes blanks, commas and semicolons between its columns; use only one of them"},
    };
    (void)state;
    assert_refuses_each("a.csv", rows, sizeof rows / sizeof *rows);
}

static void text_whose_header_names_other_columns_is_refused(void **state)
{
    static const refusal rows[] = {
        {"id,x,y,z\n7,1,2,3\n", "a.csv:1: names column 2 x; the first three columns must be x y z"},
        {"Y X Z\n1 2 3\n", "a.csv:1: names column 1 y; the first three columns must be x y z"},
    };
    (void)state;
    assert_refuses_each("a.csv", rows, sizeof rows / sizeof *rows);
}

static void text_with_a_nul_byte_is_refused(void **state)
{
    static const char text[] = "1 2 3\n4 5\0 6\n";
    (void)state;
    assert_refuses("a", text, sizeof text - 1,
                   "a:2: holds a NUL byte and is not text; supported formats are x y z text, LAS, LAZ, PCD, PLY");
}

static void long_name_keeps_its_end_and_the_reason(void **state)
{
    char name[1000];
    cloud cloud;
    octreel_error error;
    (void)state;
    memset(name, 'd', sizeof name);
    memcpy(name + sizeof name - 7, "/a.xyz", 7);
    assert_false(cloud_parse(name, (const unsigned char *)"1 2\n", 4, &cloud, &error));
    assert_non_null(strstr(error.text, "d/a.xyz:1: has only 2 of the three coordinates x y z"));
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static void assert_file_is_refused(const char *path, const char *reason)
{
    cloud cloud;
    octreel_error error;
    char sentence[256];
    assert_false(cloud_read(path, NULL, &cloud, &error));
    snprintf(sentence, sizeof sentence, "%s: %s", path, reason);
    assert_string_equal(error.text, sentence);
    assert_null(cloud.positions);
}

static void write_file(const char *path, const char *text)
{
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_true(fputs(text, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
}

static void file_is_read(void **state)
{
    const char *path = temp_file(*state, "cloud.xyz");
    cloud cloud;
    octreel_error error;
    write_file(path, "1 2 3\n-4.5 5e10 0.1\n");
    assert_true(cloud_read(path, NULL, &cloud, &error));
    assert_int_equal(cloud.count, 2);
    assert_memory_equal(cloud.positions, two_points, sizeof two_points);
    cloud_release(&cloud);
}

static void file_that_is_missing_empty_or_no_file_is_refused(void **state)
{
    temp_folder *folder = *state;
    assert_file_is_refused(temp_file(folder, "missing"), "cannot be opened: No such file or directory");
    assert_file_is_refused(folder->name, "is not a regular file");
    assert_file_is_refused("/dev/zero", "is not a regular file");
    const char *path = temp_file(folder, "empty");
    write_file(path, "");
    assert_file_is_refused(path, "holds no points");
}

static void pipe_is_refused_without_waiting(void **state)
{
    const char *path = temp_file(*state, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_file_is_refused(path, "is not a regular file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read_with_any_separator_and_line_end),
        cmocka_unit_test(text_keeps_doubles),
        cmocka_unit_test(text_skips_points_without_finite_coordinates),
        cmocka_unit_test(text_that_is_not_a_cloud_is_refused_with_its_line),
        cmocka_unit_test(text_with_decimal_commas_is_refused),
        cmocka_unit_test(text_whose_header_names_other_columns_is_refused),
        cmocka_unit_test(text_with_a_nul_byte_is_refused),
        cmocka_unit_test(long_name_keeps_its_end_and_the_reason),
        cmocka_unit_test_setup_teardown(file_is_read, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(file_that_is_missing_empty_or_no_file_is_refused, temp_folder_make,
                                        temp_folder_remove),
        cmocka_unit_test_setup_teardown(pipe_is_refused_without_waiting, temp_folder_make, temp_folder_remove),
    };
    return cmocka_run_group_tests_name("cloud", tests, NULL, NULL);
}
