/* SPDX-License-Identifier: MIT */
/* laz_child.h - the points of a compressed LAS file from a process of its own, which may crash, hang or lie. Private to
 * cloud*.c.
 */
#ifndef FORMATS_LAZ_CHILD_H
#define FORMATS_LAZ_CHILD_H

#include "cloud_format.h"

#include <stdio.h>

/* Where a record of a LAS file has what is read of it, in all point formats; coordinates come first. The class has a
 * byte of its own from format 6 on; before, it is five bits of the flags. */
enum { LAS_AT_INTENSITY = 12, LAS_AT_FLAGS = 15, LAS_AT_CLASS = 16, LAS_RECORD_READ = 36 };

/* Take a point: the first LAS_RECORD_READ bytes of its record as they would be in an uncompressed file. */
typedef bool laz_add(void *context, const unsigned char *record);

/* What the process does: put such records, and where it fails say why, in one line. */
typedef bool laz_put(void *context, FILE *records, FILE *why);

typedef struct laz_child {
    laz_put *put;
    void *context;
    unsigned seconds; /* of processor time, after which it is killed */
} laz_child;

/* Take `count` records, and end the process. False with an error where they are fewer, and where `add` is. */
bool laz_child_take(const laz_child *child, const cloud_file *file, uint64_t count, laz_add *add, void *context);

#endif
