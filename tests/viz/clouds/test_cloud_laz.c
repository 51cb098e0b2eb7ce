/* SPDX-License-Identifier: MIT */
/* test_cloud_laz.c - compressed LAS gives the bits of uncompressed LAS. The library's writer makes the files. */
#include "commands.h"
#include "las_files.h"
#include "temp_folder.h"

#include <laszip/laszip_api.h>
#include <stdio.h>
#include <string.h>

enum { SOME = 50 };

static void check(laszip_POINTER laszip, laszip_I32 failed)
{
    laszip_CHAR *why = NULL;
    if (failed && laszip_get_error(laszip, &why) == 0)
        fail_msg("%s", why);
    assert_int_equal(failed, 0);
}

/* Compress the points of one file into another. */
static void compress(const char *from, const char *to)
{
    laszip_POINTER reader, writer;
    laszip_header_struct *header;
    laszip_point_struct *point;
    laszip_BOOL compressed;
    assert_int_equal(laszip_create(&reader), 0);
    assert_int_equal(laszip_create(&writer), 0);
    check(reader, laszip_open_reader(reader, from, &compressed));
    assert_false(compressed);
    check(reader, laszip_get_header_pointer(reader, &header));
    check(reader, laszip_get_point_pointer(reader, &point));
    check(writer, laszip_set_header(writer, header));
    if (header->point_data_format >= 6)
        check(writer, laszip_request_native_extension(writer, 1));
    check(writer, laszip_open_writer(writer, to, 1));
    for (int i = 0; i < SOME; i++) {
        check(reader, laszip_read_point(reader));
        check(writer, laszip_set_point(writer, point));
        check(writer, laszip_write_point(writer));
    }
    check(writer, laszip_close_writer(writer));
    check(reader, laszip_close_reader(reader));
    check(writer, laszip_destroy(writer));
    check(reader, laszip_destroy(reader));
}

/* A file whose records have all sorts of bytes, some of them withheld. */
static bytes make_some(unsigned minor, unsigned format)
{
    las l = two_points_of_format(minor, format);
    bytes file = {.size = 0};
    uint32_t random = 1;
    l.count = SOME;
    put_header(&file, &l);
    for (unsigned i = 0; i < SOME * las_record_sizes[format]; i++) {
        random = random * 1664525 + 1013904223;
        put_bits(&file, random >> 24, 1, false);
    }
    return file;
}

/* Write such a file and compress it. The names are a.las and a.laz. */
static void make_files(temp_folder *folder, const bytes *file, char las_path[256], char laz_path[256])
{
    snprintf(las_path, 256, "%s", temp_file(folder, "a.las"));
    snprintf(laz_path, 256, "%s", temp_file(folder, "a.laz"));
    FILE *stream = fopen(las_path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(file->data, 1, file->size, stream), file->size);
    assert_int_equal(fclose(stream), 0);
    compress(las_path, laz_path);
}

static cloud read_cloud(const char *path)
{
    cloud c;
    octreel_error error;
    if (!cloud_read(path, NULL, &c, &error))
        fail_msg("%s", error.text);
    return c;
}

static void assert_same_clouds(const cloud *a, const cloud *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->skipped, b->skipped);
    assert_memory_equal(a->positions, b->positions, a->count * sizeof *a->positions);
    assert_int_equal(a->color_full, b->color_full);
    for (size_t i = 0; i < a->count; i++) {
        const point_value x = point_values_get(&a->values, cloud_row_number(a, i)),
                          y = point_values_get(&b->values, cloud_row_number(b, i));
        assert_true(cloud_row_number(a, i) == cloud_row_number(b, i) && point_value_equals(&x, &y));
    }
}

static void laz_of_every_point_format_equals_las(void **state)
{
    for (unsigned format = 0; format < LAS_FORMATS; format++) {
        const bytes file = make_some(format < 4 ? 2 : format < 6 ? 3 : 4, format);
        char las_path[256], laz_path[256];
        make_files(*state, &file, las_path, laz_path);
        cloud plain = read_cloud(las_path), packed = read_cloud(laz_path);
        assert_same_clouds(&plain, &packed);
        cloud_release(&plain);
        cloud_release(&packed);
    }
}

/* Each is refused in one sentence, or gives points where what is missing is not needed. */
static void truncated_laz_is_refused(void **state)
{
    const bytes file = make_some(4, 7);
    char las_path[256], laz_path[256];
    static unsigned char data[8192];
    make_files(*state, &file, las_path, laz_path);
    FILE *stream = fopen(laz_path, "rb");
    assert_non_null(stream);
    const size_t size = fread(data, 1, sizeof data, stream);
    assert_int_equal(fclose(stream), 0);
    for (size_t cut = 1; cut < size - 200; cut += 61) {
        cloud c;
        octreel_error error = {""};
        assert_false(cloud_parse("a.laz", data, cut, &c, &error));
        assert_true(strlen(error.text) > 10 && !strchr(error.text, '\n'));
    }
}

/* COPC 1.0: seven nodes, each a chunk of as many points as it has, and the hierarchy behind them; and a LAS file of the
 * same points. */
static void copc_equals_las(void **state)
{
    (void)state;
    cloud plain = read_cloud(OCTREEL_CLOUDS "/small.las"), packed = read_cloud(OCTREEL_CLOUDS "/small.copc.laz");
    assert_int_equal(plain.count + plain.skipped, 24);
    assert_same_clouds(&plain, &packed);
    cloud_release(&plain);
    cloud_release(&packed);
}

static void laz_is_read_from_a_pipe(void **state)
{
    (void)state;
    command_result file = run_octreel(NULL, "inspect %s --json", OCTREEL_CLOUDS "/small.copc.laz");
    command_result pipe = run_script("cat %s | %s inspect - --json | sed 's/standard input/small.copc.laz/'",
                                     OCTREEL_CLOUDS "/small.copc.laz", octreel_program());
    assert_done(&file);
    assert_done(&pipe);
    assert_string_equal(pipe.out, file.out);
    command_release(&file);
    command_release(&pipe);
}

/* Nothing is decompressed: the file says that it is 1e9 points. */
static void more_points_than_the_file_can_hold_are_refused(void **state)
{
    char path[2][256], sentence[256];
    octreel_error error = {""};
    cloud c;
    static unsigned char data[8192];
    const bytes file = make_some(2, 0);
    make_files(*state, &file, path[0], path[1]);
    FILE *stream = fopen(path[1], "rb");
    assert_non_null(stream);
    const size_t size = fread(data, 1, sizeof data, stream);
    assert_int_equal(fclose(stream), 0);
    memcpy(data + 107, (unsigned char[]){0x00, 0xca, 0x9a, 0x3b}, 4);
    snprintf(sentence, sizeof sentence,
             "a.laz:byte 107: 1000000000 compressed points should follow, but the file is too short: each of its %zu "
             "bytes holds at most 256",
             size);
    assert_false(cloud_parse("a.laz", data, size, &c, &error));
    assert_string_equal(error.text, sentence);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(laz_of_every_point_format_equals_las, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(truncated_laz_is_refused, temp_folder_make, temp_folder_remove),
        cmocka_unit_test(copc_equals_las),
        cmocka_unit_test(laz_is_read_from_a_pipe),
        cmocka_unit_test_setup_teardown(more_points_than_the_file_can_hold_are_refused, temp_folder_make,
                                        temp_folder_remove),
    };
    return cmocka_run_group_tests_name("cloud_laz", tests, NULL, NULL);
}
