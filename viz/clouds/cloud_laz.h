/* SPDX-License-Identifier: MIT */
/* cloud_laz.h - reads the records of compressed LAS files with liblaszip; cloud_las.c reads the headers. Private to
 * cloud*.c. */
#ifndef CLOUDS_CLOUD_LAZ_H
#define CLOUDS_CLOUD_LAZ_H

#include "laz_child.h"

/* For each point format, the byte offset of the colour in a record. The colour has three 16-bit channels. Offset 0:
 * the records have no colour. Defined in cloud_las.c. */
extern const unsigned las_colors_at[];

/* Passes each record of a compressed file to `add`. Returns false with an error if the data is damaged. Also returns
 * false if `add` does. The bytes of the file are copied to a temporary file, because liblaszip opens files by name. */
bool laz_read_records(const cloud_file *file, unsigned format, uint64_t count, laz_record_reader *add, void *context);

#endif
