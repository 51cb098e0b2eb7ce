/* SPDX-License-Identifier: MIT */
/* clouds.h - builds point-cloud files for tests, and checks how they are read. */
#ifndef CLOUDS_H
#define CLOUDS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cloud.h"

/* A file that a test builds in memory. */
typedef struct bytes {
    unsigned char data[8192];
    size_t size;
} bytes;

void put_bytes(bytes *file, const void *data, size_t size);
void put_text(bytes *file, const char *text);

/* Put the low `size` bytes of an integer, in either byte order. */
void put_bits(bytes *file, uint64_t bits, unsigned size, bool big_endian);
void put_float(bytes *file, float value, bool big_endian);
void put_double(bytes *file, double value, bool big_endian);

/* The test fails unless the file is read as exactly these points. */
void assert_reads(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                  size_t skipped);

/* assert_reads(), with the expected note about data after the points; "" if there is none. */
void assert_reads_and_notes(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                            size_t skipped, const char *note);

/* The test fails unless the file is refused with exactly this sentence. */
void assert_refuses(const char *name, const void *data, size_t size, const char *sentence);

/* An invalid text and its expected error. */
typedef struct refusal {
    const char *text, *sentence;
} refusal;

void assert_refuses_each(const char *name, const refusal *rows, size_t count);

/* The test fails unless every truncation of the file is refused. */
void assert_refuses_every_beginning(const char *name, const bytes *file);

/* The points in most of these files. */
extern const double two_points[2][3];

#endif
