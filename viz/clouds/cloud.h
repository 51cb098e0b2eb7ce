/* SPDX-License-Identifier: MIT */
/* cloud.h - reads point-cloud files in double precision: `x y z` text, PLY, PCD, LAS and LAZ.
 *
 * Text: each line holds one point. The first three columns are the point's coordinates. Columns are separated by blanks
 * and tabs, by commas, or by semicolons; a line uses one kind of separator only. Blank lines and comments (# and //)
 * are skipped. The first line, which may be a comment, may hold the names of the columns.
 *
 * Text without column names: the ending of the file's name may declare further columns. In .xyzrgb the further columns
 * are r g b, in .xyzn they are a normal. In .pts, if the first line is the number of points, they are one of:
 * intensity; r g b; intensity r g b. In other files, the columns x y z r g b and x y z intensity r g b are recognised
 * by their numbers. The colour channels of all lines must be of one of two kinds: integers from 0 to 255 with a largest
 * value above 127, or fractions from 0 to 1 with a largest value of at least 0.5. If all colours are fractions and,
 * taken as vectors, have length 1, the columns are treated as normals and not as colours.
 *
 * PLY: ascii, binary_little_endian and binary_big_endian; x, y and z of the element "vertex", of any scalar type.
 *
 * PCD: versions 0.5 to 0.7; ascii, binary and binary_compressed; the fields x, y and z, of any type.
 *
 * LAS: versions 1.0 to 1.5, all point formats. A coordinate is integer * scale + offset in doubles, with the same bits
 * that laspy computes. Withheld (deleted) records are skipped. LAZ and COPC are compressed LAS. A build with liblaszip
 * reads both, with the same bits (see cloud_can_read_laz()).
 *
 * Names of values: values of points are found by their names, in upper or lower case. Colours are red green blue, r g
 * b, diffuse_red and so on, or PCD's packed rgb and rgba. Other names are intensity, and class, classification or
 * label. The prefix "scalar_" of CloudCompare is ignored. Alpha is ignored.
 *
 * Colours are stored with 8 bits a channel. The largest channel in the file decides whether the full scale is 1, 255 or
 * 65535, because files with 16-bit channels often hold 8-bit colours.
 *
 * Missing values: an intensity that is not a finite float, a class that is not an integer from 0 to 65535, and a colour
 * outside 0 to 65535 are treated as missing. If all intensities or all colours in a LAS file are zero, these values are
 * treated as missing, with a note: LAS records have room for such values, and writers that lack them store zeros. Class
 * 0 is not missing: it means "never classified". Other values, such as normals, are ignored with a note.
 *
 * The format of a file is chosen by its contents. If the contents do not decide, the ending of the file's name does. A
 * truncated file is an error, so no point is lost silently. Unexpected data after the last point, such as a newline
 * after a compressed block, is ignored with a note. */
#ifndef CLOUDS_CLOUD_H
#define CLOUDS_CLOUD_H

#include "error.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One row for each format: its identifier, the format names that messages show, and the endings of file names. The
 * formats are tried in the order of the rows. A file that no format recognises is read as text.
 *
 * To add a format NAME, add a row here; a file cloud_NAME.c that defines `const cloud_format cloud_NAME` (see
 * cloud_format.h); its test tests/viz/clouds/test_cloud_NAME.c; and a word in viz/formats/session.txt. */
#define CLOUD_FORMAT_MAP(X)                                                                                            \
    X(las, "LAS, LAZ", ".las.laz")                                                                                     \
    X(pcd, "PCD", ".pcd")                                                                                              \
    X(ply, "PLY", ".ply")

/* The names of all formats as a string literal: "x y z text, LAS, LAZ, PCD, PLY". */
#define CLOUD_NAMES_ROW(id, names, endings) ", " names
#define CLOUD_NAMES "x y z text" CLOUD_FORMAT_MAP(CLOUD_NAMES_ROW)

/* All endings of file names as a string literal: ".xyz.xyzrgb.xyzn.txt.csv.pts.las.laz.pcd.ply". */
#define CLOUD_ENDINGS_ROW(id, names, endings) endings
#define CLOUD_ENDINGS ".xyz.xyzrgb.xyzn.txt.csv.pts" CLOUD_FORMAT_MAP(CLOUD_ENDINGS_ROW)

#define CLOUD_COLUMN_NOTE 256 /* the size of cloud.column_note, in bytes */

typedef struct cloud {
    /* `count` rows of x, y and z, in the order and the units of the file; all numbers are finite; owned */
    double (*positions)[3];
    size_t count;   /* the number of points; at least 1 after a file was read */
    size_t skipped; /* the number of points that the file contains but `positions` does not */
    /* The reason for which points were skipped: "without finite coordinates" or, in LAS, "marked as withheld"
     * (deleted). Null if no point was skipped. Not owned: the text has static storage. */
    const char *why_skipped;
    /* for each point, its row in the file, counted with the skipped rows; null if no row was skipped; owned */
    size_t *rows;
    point_values values; /* colours, intensities and classes, indexed by cloud_row_number(); owned */
    /* the full scale of colour channels in the file: 1, 255 or 65535; 0: the file has no colours */
    unsigned color_full;
    /* a sentence about values that were ignored, or about columns without names; "" if there is nothing to report */
    char column_note[CLOUD_COLUMN_NOTE];
    /* for each kind of value, the number of values that were out of range and therefore discarded */
    size_t out_of_range[POINT_VALUE_KINDS];
    /* a sentence about unexpected data after the last point; "" if there is none */
    char note[672];
} cloud;

/* Returns the row of a point in its file. Rows are counted from 0 and include skipped rows. */
size_t cloud_row_number(const cloud *c, size_t index);

/* Callbacks that report the progress of a long read. First the bytes of the file are loaded, then the points are
 * parsed. */
typedef struct cloud_watch {
    /* called after each loaded block of the file; `total` is 0 if the size is unknown; may be null */
    void (*read)(uint64_t done, uint64_t total, void *context);
    /* called after every 65536 points with the parsed share of the file, from 0 to 1; may be null */
    void (*step)(double part, void *context);
    void *context;
} cloud_watch;

/* Reads a regular file into *out. The path "-" is standard input. `watch` may be null. On failure returns false, sets
 * *error and empties *out. A file without points is an error. Cost: O(size) time. Memory: 1 MB, and for each byte of
 * the file at most 12 bytes, which include the file itself. A compressed PCD file expands at most 88 times and takes at
 * most 800 bytes of memory for each byte of the file. A LAZ file may hold at most 256 points for each byte and takes at
 * most 22000 bytes of memory for each byte. */
bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error);

/* Parses the contents of a file in memory. `name` is the name of the file. Errors contain the name, and the ending of
 * the name may decide the format. */
bool cloud_parse(const char *name, const unsigned char *bytes, size_t size, cloud *out, octreel_error *error);

/* Returns whether this build can read LAZ and COPC. */
bool cloud_can_read_laz(void);

/* Returns whether a file is a point cloud, by its first bytes. The bytes must contain the header of a format, or
 * they must be text whose first line is a point. */
bool cloud_is_recognised(const unsigned char *bytes, size_t size);

/* Prints the counts in cloud.out_of_range into `text`, such as "2 colours beyond 0 to 65535 are left out". If all
 * counts are 0, prints "". Returns `text`. */
#define CLOUD_OUT_OF_RANGE_TEXT 200
const char *cloud_describe_out_of_range(const size_t count[POINT_VALUE_KINDS], char text[CLOUD_OUT_OF_RANGE_TEXT]);

/* Frees all arrays and zeroes the cloud. The cloud may be zeroed already. */
void cloud_release(cloud *cloud);

#endif
