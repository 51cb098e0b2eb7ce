/* SPDX-License-Identifier: MIT */
/* cloud_laz.h - the points of compressed LAS files, by liblaszip; cloud_las.c reads everything else of them. Private to
 * cloud*.c.
 */
#ifndef CLOUDS_CLOUD_LAZ_H
#define CLOUDS_CLOUD_LAZ_H

#include "laz_child.h"

/* Where a point format has its colour, three times 16 bits; 0: nowhere. */
unsigned las_color_at(unsigned format);

/* Whether this was built with liblaszip. */
bool laz_is_read(void);

/* Give each point of a compressed file. False with an error where the data is damaged, and where `add` is. The library
 * opens files by name, so the bytes are copied to a temporary one. */
bool laz_read(const cloud_file *file, unsigned format, uint64_t count, laz_add *add, void *context);

#endif
