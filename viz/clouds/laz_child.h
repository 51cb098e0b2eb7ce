/* SPDX-License-Identifier: MIT */
/* laz_child.h - runs a decompressor in a child process. If the decompressor crashes, hangs or returns too little,
 * the parent process survives and reports an error. Private to cloud*.c. */
#ifndef CLOUDS_LAZ_CHILD_H
#define CLOUDS_LAZ_CHILD_H

#include "cloud_format.h"

#include <stdio.h>

/* Byte offsets in a LAS record, the same in all point formats. The coordinates come first. Since point format 6 the
 * class has a byte of its own; in lower formats, the class is the lowest five bits of the flags. Only the first
 * LAS_RECORD_READ bytes of a record are read. */
enum { LAS_AT_INTENSITY = 12, LAS_AT_FLAGS = 15, LAS_AT_CLASS = 16, LAS_RECORD_READ = 36 };

/* A callback that receives the first LAS_RECORD_READ bytes of an uncompressed record. Returns false to stop the
 * reading. */
typedef bool laz_record_reader(void *context, const unsigned char *record);

/* A callback that runs in the child process. The callback writes LAS_RECORD_READ bytes for each record to `records`. On
 * failure the callback writes one line to `why` and returns false. */
typedef bool laz_produce(void *context, FILE *records, FILE *why);

typedef struct laz_child {
    laz_produce *produce;
    void *context;
    unsigned seconds; /* the processor time in seconds after which the child is killed */
} laz_child;

/* Starts the child, passes `count` records to `add`, and waits until the child ends. Returns false with an error if
 * fewer records arrive. Also returns false if `add` returns false. */
bool laz_child_read_records(const laz_child *child, const cloud_file *file, uint64_t count, laz_record_reader *add,
                            void *context);

#endif
