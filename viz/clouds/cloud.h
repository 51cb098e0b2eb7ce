/* SPDX-License-Identifier: MIT */
/* cloud.h - reads point-cloud files in double precision: `x y z` text, PLY, PCD, LAS and LAZ.
 *
 * Text: one point per line, the coordinates in the first three columns. Blanks and tabs, commas or semicolons separate
 * columns, the same within a line. Blank lines and comments (# and //) are skipped. A first line of column names, which
 * may be a comment, names the values in further columns. Without names, the columns x y z r g b and x y z intensity
 * r g b are recognised by their numbers: in every line either integers from 0 to 255, the largest above 127, or
 * fractions from 0 to 1, the largest at least 0.5, that are not all unit normals.
 *
 * PLY: ascii, binary_little_endian and binary_big_endian; x, y and z of the element "vertex", of any scalar type.
 *
 * PCD: versions 0.5 to 0.7; ascii, binary and binary_compressed; the fields x, y and z, of any type.
 *
 * LAS: versions 1.0 to 1.5, all point formats. Coordinates are record * scale + offset in doubles, the same bits as
 * laspy computes. Withheld (deleted) records are skipped. LAZ and COPC, which are compressed LAS, are read with the
 * same bits if this was built with liblaszip (see cloud_can_read_laz()).
 *
 * Values are found by their names, in upper or lower case: red green blue, r g b or diffuse_red ...; PCD's packed rgb
 * and rgba; intensity; class, classification or label. CloudCompare's prefix "scalar_" is ignored. Colours are kept
 * with 8 bits a channel. The largest channel in the file decides whether its full scale is 1, 255 or 65535, because
 * files of 16 bits often hold 8-bit colours. Alpha is ignored. A value is missing if an intensity is not a finite
 * float, a class is not an integer from 0 to 65535, or a colour is outside 0 to 65535. LAS has room for all values in
 * every record: a value that is zero in all points is missing from the file.
 *
 * The contents decide the format of a file, and its ending where the contents do not. A truncated file is an error: no
 * point is lost silently. Data after the last point that the header does not announce, such as a newline after a
 * compressed block, is ignored with a note.
 */
#ifndef CLOUDS_CLOUD_H
#define CLOUDS_CLOUD_H

#include "error.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One row per format, in the order in which they are tried: its identifier, its names for people, and the endings of
 * its files' names. A file that no row recognises is read as text.
 *
 * To add a format NAME: a row here, a file cloud_NAME.c that defines `const cloud_format cloud_NAME` (see
 * cloud_format.h), its test tests/viz/clouds/test_cloud_NAME.c, and a word in viz/formats/session.txt. */
#define CLOUD_FORMAT_MAP(X)                                                                                            \
    X(las, "LAS, LAZ", ".las.laz")                                                                                     \
    X(pcd, "PCD", ".pcd")                                                                                              \
    X(ply, "PLY", ".ply")

/* "x y z text, LAS, LAZ, PCD, PLY": a string literal with the names of all formats. */
#define CLOUD_NAMES_ROW(id, names, endings) ", " names
#define CLOUD_NAMES "x y z text" CLOUD_FORMAT_MAP(CLOUD_NAMES_ROW)

/* ".xyz.txt.csv.pts.las.laz.pcd.ply": a string literal with all endings of file names. */
#define CLOUD_ENDINGS_ROW(id, names, endings) endings
#define CLOUD_ENDINGS ".xyz.txt.csv.pts" CLOUD_FORMAT_MAP(CLOUD_ENDINGS_ROW)

typedef struct cloud {
    double (*positions)[3];  /* `count` rows of x, y, z in the file's order and units; all finite; owned */
    size_t count;            /* at least 1 after a successful read */
    size_t skipped;          /* points of the file that are not in `positions` */
    const char *why_skipped; /* "without finite coordinates", or "marked as withheld" (LAS: deleted); null if none is
                                skipped; static storage */
    size_t *rows; /* the file's row number of each point, counting skipped rows; null if none are skipped; owned */
    point_values values;     /* colours, intensities and classes, by cloud_row_number(); owned */
    unsigned color_full;     /* the full scale of a colour channel in the file: 1, 255 or 65535; 0 without colours */
    const char *column_note; /* a sentence about columns that the file does not name; null for none; static storage */
    size_t out_of_range[POINT_VALUE_KINDS]; /* values that were dropped because they are out of range */
    char note[512];                         /* a sentence about unexpected data after the last point; "" for none */
} cloud;

/* Returns the row of a point in its file, from 0, counting skipped rows. */
size_t cloud_row_number(const cloud *c, size_t index);

/* Callbacks that report the progress of a long read: first the file's bytes are loaded, then its points are parsed. */
typedef struct cloud_watch {
    void (*read)(uint64_t done, uint64_t total, void *context); /* after each block; total 0: unknown; may be null */
    void (*step)(double part, void *context); /* called every 65536 points with the parsed part, 0 to 1 */
    void *context;
} cloud_watch;

/* Read a regular file, or standard input if `path` is "-", into *out. `watch` may be null. Returns false, sets *error
 * and empties *out on failure; a file without points is a failure.
 * Cost: O(size) time. Memory: 1 MB and at most 12 bytes per byte of the file, itself included; 800 per byte of a
 * compressed PCD, whose coding expands at most 88 times; 22000 per byte of a LAZ file, which may hold at most 256
 * points per byte. */
bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error);

/* Parse a file in memory. `name` is its file name, for errors and for its ending. */
bool cloud_parse(const char *name, const unsigned char *bytes, size_t size, cloud *out, octreel_error *error);

/* True if this build can read LAZ and COPC. */
bool cloud_can_read_laz(void);

/* True if a file that begins with these bytes is a cloud: they contain the header of a format, or a text whose first
 * line is a point. */
bool cloud_is_recognised(const unsigned char *bytes, size_t size);

/* Describe cloud.out_of_range: "2 colours beyond 0 to 65535 are left out"; "" if there are none. Returns `text`. */
#define CLOUD_OUT_OF_RANGE_TEXT 200
const char *cloud_describe_out_of_range(const size_t count[POINT_VALUE_KINDS], char text[CLOUD_OUT_OF_RANGE_TEXT]);

/* Free all arrays and zero the cloud; a zeroed cloud is allowed. */
void cloud_release(cloud *cloud);

#endif
