/* SPDX-License-Identifier: MIT */
/* las_files.h - LAS files for tests, built from the tables of the specification: LAS 1.0 to 1.5, point formats 0 to
 * 10. */
#ifndef LAS_FILES_H
#define LAS_FILES_H

#include "clouds.h"

enum { LAS_VERSIONS = 6, LAS_FORMATS = 11 };

extern const unsigned las_header_sizes[LAS_VERSIONS], las_record_sizes[LAS_FORMATS];

/* The header values of a file with two records. Zeroed: LAS 1.0, point format 0, and no optional part. */
typedef struct las {
    unsigned minor, format;
    unsigned records_before; /* bytes between the header and the points */
    unsigned extra;          /* number of bytes that each record has in addition to its format */
    double scale[3], offset[3];
    int32_t points[2][3];
    uint64_t count; /* number of points in the header; 0: the two points */
} las;

/* A file of two_points. Not every coordinate is a multiple of 0.01, so the scales of the header matter. */
extern const las two;
las two_points_of_format(unsigned minor, unsigned format);

/* The fields of the table "Public Header Block" in their order. Fields that positions do not need have a pattern that
 * would be noticed if a reader used it. */
void put_header(bytes *file, const las *l);

/* A record. All bits of its other fields are ones, except the flags. */
void put_record(bytes *file, const las *l, const int32_t point[3]);

/* The whole file. */
bytes make_las_file(const las *l);

/* Change fields of a file. */
void set_bits(bytes *file, size_t at, uint64_t bits, unsigned size);
void set_double(bytes *file, size_t at, double value);

void put_zeros(bytes *file, size_t count);
void pad_to_size(bytes *file, size_t end);

#endif
