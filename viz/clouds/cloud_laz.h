/* SPDX-License-Identifier: MIT */
/* cloud_laz.h - reads the records of compressed LAS files through liblaszip; cloud_las.c reads their headers. Private
 * to cloud*.c.
 */
#ifndef CLOUDS_CLOUD_LAZ_H
#define CLOUDS_CLOUD_LAZ_H

#include "laz_child.h"

/* The byte offset of the colour (3 * 16 bits) in a record, by point format; 0: none. Defined in cloud_las.c. */
extern const unsigned las_colors_at[];

/* Pass each record of a compressed file to `add`. Returns false and sets the error if the data is damaged, and false if
 * `add` returns false. liblaszip opens files by name, so the bytes are copied to a temporary file. */
bool laz_read_records(const cloud_file *file, unsigned format, uint64_t count, laz_record_reader *add, void *context);

#endif
