/* SPDX-License-Identifier: MIT */
/* cloud_laz.h - reads the records of compressed LAS files with liblaszip; cloud_las.c reads the headers. Private to
 * cloud*.c. */
#ifndef CLOUDS_CLOUD_LAZ_H
#define CLOUDS_CLOUD_LAZ_H

#include "laz_child.h"

/* The byte offset of the colour (three 16-bit channels) in a record, by point format; 0: no colour. Defined in
 * cloud_las.c. */
extern const unsigned las_colors_at[];

/* Passes each record of a compressed file to `add`. If the data is damaged, returns false and sets the error. If
 * `add` returns false, returns false. liblaszip opens files by name, so the bytes are copied to a temporary file. */
bool laz_read_records(const cloud_file *file, unsigned format, uint64_t count, laz_record_reader *add, void *context);

#endif
