/* SPDX-License-Identifier: MIT */
/* clouds.h - point-cloud files for tests: putting them together, and what must come of them. */
#ifndef CLOUDS_H
#define CLOUDS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "cloud.h"

/* A file that a test puts together, in a buffer of its own. */
typedef struct bytes {
    unsigned char data[8192];
    size_t size;
} bytes;

void put(bytes *file, const void *data, size_t size);
void put_text(bytes *file, const char *text);

/* Put the low `size` bytes of an integer, in either byte order. */
void put_bits(bytes *file, uint64_t bits, unsigned size, bool big_endian);
void put_float(bytes *file, float value, bool big_endian);
void put_double(bytes *file, double value, bool big_endian);

/* The file becomes these points and no others. */
void assert_reads(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                  size_t skipped);

/* The same, with this note about what follows them; "" where nothing does that does not belong there. */
void assert_reads_and_notes(const char *name, const void *data, size_t size, const double (*positions)[3], size_t count,
                            size_t skipped, const char *note);

/* The file is refused with exactly this sentence. */
void assert_refuses(const char *name, const void *data, size_t size, const char *sentence);

/* A text and the sentence that refuses it. */
typedef struct refusal {
    const char *text, *sentence;
} refusal;

void assert_refuses_each(const char *name, const refusal *rows, size_t count);

/* No beginning of the file passes for the whole. */
void assert_refuses_every_beginning(const char *name, const bytes *file);

/* The points that most of these files hold. */
extern const double two_points[2][3];

#endif
