/* SPDX-License-Identifier: MIT */
/* cloud_laz.h - the points of compressed LAS files, by liblaszip; cloud_las.c reads everything else of them. Private to
 * cloud*.c.
 */
#ifndef CLOUDS_CLOUD_LAZ_H
#define CLOUDS_CLOUD_LAZ_H

#include "cloud_format.h"

/* Where a record of a LAS file has what is read of it, in all point formats; coordinates come first. The class has a
 * byte of its own from format 6 on; before, it is five bits of the flags. */
enum { LAS_AT_INTENSITY = 12, LAS_AT_FLAGS = 15, LAS_AT_CLASS = 16, LAS_RECORD_READ = 36 };

/* Where a point format has its colour, three times 16 bits; 0: nowhere. */
unsigned las_color_at(unsigned format);

/* Whether this was built with liblaszip. */
bool laz_is_read(void);

/* Take a point: the first LAS_RECORD_READ bytes of its record as they would be in an uncompressed file. */
typedef bool laz_add(void *context, const unsigned char *record);

/* Give each point of a compressed file. False with an error where the data is damaged, and where `add` is. The library
 * opens files by name, so the bytes are copied to a temporary one. */
bool laz_read(const cloud_file *file, unsigned format, uint64_t count, laz_add *add, void *context);

#endif
