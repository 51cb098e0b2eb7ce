/* SPDX-License-Identifier: MIT */
#include "las_files.h"

#include <string.h>

const unsigned las_header_sizes[LAS_VERSIONS] = {227, 227, 227, 235, 375, 393};
const unsigned las_record_sizes[LAS_FORMATS] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

const las two = {.scale = {0.5, 1e10, 0.1}, .offset = {1.5, 2, 0}, .points = {{-1, 0, 30}, {-12, 5, 1}}};

las two_points_of_format(unsigned minor, unsigned format)
{
    las l = two;
    l.minor = minor;
    l.format = format;
    return l;
}

void put_zeros(bytes *file, size_t count)
{
    while (count-- > 0)
        put_bytes(file, "", 1);
}

void pad_to_size(bytes *file, size_t end)
{
    assert_true(end >= file->size);
    put_zeros(file, end - file->size);
}

void put_header(bytes *file, const las *l)
{
    const unsigned size = las_header_sizes[l->minor];
    const uint64_t count = l->count ? l->count : 2, points = size + l->records_before;
    const bool wide_alone = l->format >= 6;
    put_text(file, "LASF");
    put_bits(file, 0x0000beef, 4, false); /* file source, global encoding */
    put_text(file, "0123456789abcdef");   /* project */
    put_bits(file, 1, 1, false);
    put_bits(file, l->minor, 1, false);
    put_text(file, "system identifier, of 32 bytes..generating software, 32 bytes...");
    put_bits(file, 2026 << 16 | 326, 4, false); /* day and year */
    put_bits(file, size, 2, false);
    put_bits(file, points, 4, false);
    put_bits(file, 0, 4, false); /* variable length records */
    put_bits(file, l->format, 1, false);
    put_bits(file, las_record_sizes[l->format] + l->extra, 2, false);
    put_bits(file, l->minor >= 4 && wide_alone ? 0 : count, 4, false);
    for (int i = 0; i < 5; i++)
        put_bits(file, 0x01010101, 4, false); /* by return */
    for (int axis = 0; axis < 3; axis++)
        put_double(file, l->scale[axis], false);
    for (int axis = 0; axis < 3; axis++)
        put_double(file, l->offset[axis], false);
    for (int i = 0; i < 6; i++)
        put_double(file, -7e77, false); /* bounds */
    assert_int_equal(file->size, 227);
    if (l->minor >= 3)
        put_bits(file, 0, 8, false); /* waveforms */
    if (l->minor >= 4) {
        put_zeros(file, 12); /* extended variable length records: start and number */
        put_bits(file, count, 8, false);
        for (int i = 0; i < 15; i++)
            put_bits(file, 0x01010101, 8, false); /* by return */
    }
    pad_to_size(file, size);
    for (unsigned i = 0; i < l->records_before; i++)
        put_bytes(file, "V", 1);
}

void put_record(bytes *file, const las *l, const int32_t point[3])
{
    for (int axis = 0; axis < 3; axis++)
        put_bits(file, (uint32_t)point[axis], 4, false);
    put_bits(file, 0xffff, 2, false); /* intensity */
    put_bits(file, 0xff, 1, false);   /* returns */
    put_bits(file, l->minor == 0 ? 0xff : l->format < 6 ? 0x7f : 0xfb, 1, false);
    for (unsigned i = 16; i < las_record_sizes[l->format] + l->extra; i++)
        put_bits(file, 0xff, 1, false);
}

bytes make_las_file(const las *l)
{
    bytes file = {.size = 0};
    put_header(&file, l);
    for (int i = 0; i < 2; i++)
        put_record(&file, l, l->points[i]);
    return file;
}

void set_bits(bytes *file, size_t at, uint64_t bits, unsigned size)
{
    bytes field = {.size = 0};
    put_bits(&field, bits, size, false);
    memcpy(file->data + at, field.data, size);
}

void set_double(bytes *file, size_t at, double value)
{
    bytes field = {.size = 0};
    put_double(&field, value, false);
    memcpy(file->data + at, field.data, 8);
}
