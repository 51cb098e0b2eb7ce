/* SPDX-License-Identifier: MIT */
/* clouds.c - point-cloud files for tests. */
#include "clouds.h"

#include <stdlib.h>
#include <string.h>

void put_bytes(bytes *file, const void *data, size_t size)
{
    assert_true(size <= sizeof file->data - file->size);
    if (size > 0)
        memcpy(file->data + file->size, data, size);
    file->size += size;
}

void put_text(bytes *file, const char *text)
{
    put_bytes(file, text, strlen(text));
}

void put_bits(bytes *file, uint64_t bits, unsigned size, bool big_endian)
{
    for (unsigned i = 0; i < size; i++) {
        unsigned char byte = (unsigned char)(bits >> (8 * (big_endian ? size - 1 - i : i)));
        put_bytes(file, &byte, 1);
    }
}

void put_float(bytes *file, float value, bool big_endian)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bits(file, bits, 4, big_endian);
}

void put_double(bytes *file, double value, bool big_endian)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bits(file, bits, 8, big_endian);
}

/* Parse a copy of exactly its size, so that a sanitizer sees any look beyond. */
static bool parse(const char *name, const void *data, size_t size, cloud *out, octreel_error *error)
{
    unsigned char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    if (size > 0)
        memcpy(copy, data, size);
    memset(error, 0, sizeof *error);
    bool parsed = cloud_parse(name, copy, size, out, error);
    free(copy);
    return parsed;
}

void assert_reads(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                  size_t skipped)
{
    assert_reads_and_notes(name, data, size, positions, count, skipped, "");
}

void assert_reads_and_notes(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                            size_t skipped, const char *note)
{
    cloud cloud;
    octreel_error error;
    if (!parse(name, data, size, &cloud, &error))
        fail_msg("%s", error.text);
    assert_int_equal(cloud.count, count);
    assert_int_equal(cloud.skipped, skipped);
    assert_string_equal(cloud.note, note);
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            assert_true(cloud.positions[i][axis] == positions[i][axis]);
    cloud_release(&cloud);
    assert_null(cloud.positions);
}

void assert_refuses(const char *name, const void *data, size_t size, const char *sentence)
{
    cloud cloud;
    octreel_error error;
    assert_false(parse(name, data, size, &cloud, &error));
    assert_string_equal(error.text, sentence);
    assert_null(cloud.positions);
    assert_int_equal(cloud.count, 0);
}

void assert_refuses_each(const char *name, const refusal *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_refuses(name, rows[i].text, strlen(rows[i].text), rows[i].sentence);
}

void assert_refuses_every_beginning(const char *name, const bytes *file)
{
    for (size_t size = 0; size < file->size; size++) {
        cloud cloud;
        octreel_error error;
        assert_false(parse(name, file->data, size, &cloud, &error));
        assert_true(strncmp(error.text, name, strlen(name)) == 0);
    }
}

const double two_points[2][3] = {{1, 2, 3}, {-4.5, 5e10, 0.1}};
