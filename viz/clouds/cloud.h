/* SPDX-License-Identifier: MIT */
/* cloud.h - the points of a file: `x y z` text, PLY, PCD and LAS, in double precision.
 *
 * Text: one point a line, its first three columns; columns are separated by blanks and tabs, by commas or by
 *   semicolons, the same throughout a line. Blank lines and comments (# and //) are skipped. A first line of column
 *   names, which may be a comment, says which further columns have values; where there is none, x y z r g b and
 *   x y z intensity r g b are known by their numbers: whole ones to 255 in every line, the largest above 127, or
 *   fractions from 0 to 1, the largest from 0.5 on, that are not all as long as normals.
 * PLY: ascii, binary_little_endian and binary_big_endian; x, y and z of the element "vertex", of any scalar type.
 * PCD: 0.5 to 0.7; ascii, binary and binary_compressed; the fields x, y and z, of any type.
 * LAS: 1.0 to 1.5, all point formats; coordinates are record * scale + offset in doubles, the bits that laspy computes.
 *   Records that are withheld, which is deleted, are skipped. LAZ and COPC, which are compressed LAS, are read where
 * this was built with liblaszip: cloud_reads_laz(). The same points are the same bits.
 *
 * Values beside the coordinates go by their names, in any case: red green blue or r g b, diffuse_red ..., of PCD rgb
 * and rgba, which are packed; intensity; class, classification or label. CloudCompare's "scalar_" before a name is
 * passed over. Colours are kept in 8 bits a channel; what a full one is in the file, 1, 255 or 65535, its numbers say:
 * LAS and PLY have 16 bits, and many files have 8-bit colours in them. Alpha is passed over. An intensity that is no
 * finite float, a class that is no whole number to 65535 and a colour beyond 0 to 65535 are none. In LAS a value that
 * is zero in every point is one that the file has not.
 *
 * The contents decide which of them a file is, and the ending .ply, .pcd or .las where the contents do not. A file that
 * is cut off is an error: no point is lost in silence. What follows the last point and does not fit the header, such as
 * a newline after a compressed block, is not needed: it is passed over with a note.
 */
#ifndef CLOUDS_CLOUD_H
#define CLOUDS_CLOUD_H

#include "error.h"
#include "point_values.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cloud {
    double (*positions)[3];  /* `count` rows of x, y, z, in the file's order and units; all finite; owned */
    size_t count;            /* at least 1 in a cloud that was read */
    size_t skipped;          /* points of the file that are left out */
    const char *why_skipped; /* what they are: "without finite coordinates", the sign of many files for "no return", or
                              * "marked as withheld", LAS's for deleted; null when none are; a constant */
    size_t *rows;            /* `count`: which point of the file, skipped ones counted, each is; null: all are; owned */
    point_values values;     /* colours, intensities and classes by cloud_row(); of skipped points nothing; owned */
    unsigned color_full; /* what a full channel of a colour is in the file: 1, 255 or 65535; where there are colours */
    const char *decided; /* a sentence on columns that nothing names in the file; null for nothing; a constant */
    size_t beyond[POINT_VALUE_KINDS]; /* values of the file that are none, since they are out of range: see above */
    char note[512]; /* a sentence about what follows the last point and does not belong there; "" for nothing */
} cloud;

/* The place of a point among all of its file, those that were skipped included; from 0 on. */
size_t cloud_row(const cloud *c, size_t index);

/* Who follows a long reading: first the bytes come into memory, of which `total` may be 0, for nobody knows; then
 * points are taken from them. */
typedef struct cloud_watch {
    void (*read)(uint64_t done, uint64_t total, void *context); /* after each block; may be null */
    void (*step)(double part, void *context);                   /* now and then, from 0 to 1 of the bytes */
    void *context;
} cloud_watch;

/* Read a regular file, or "-", standard input, into *out; `watch` may be null. False with the reason in *error; *out is
 * then empty. A file without any point is an error. Cost: O(size) in time and memory: at most 12 bytes for each of the
 * file's, itself included, and 1 MB. Of compressed files it is 800 for each byte of a PCD's, whose coding makes at most
 * 88 of one, and 22000 for each of a LAZ's: more than 256 points a byte are refused. */
bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error);

/* The same for a file that is in memory already. `name` is its name: for errors, and for its ending. */
bool cloud_parse(const char *name, const unsigned char *bytes, size_t size, cloud *out, octreel_error *error);

/* Whether LAZ and COPC are read, too. */
bool cloud_reads_laz(void);

/* Whether these are the first bytes of a cloud: the header of one of the formats, or a text whose first line is a
 * point.
 */
bool cloud_begins(const unsigned char *bytes, size_t size);

/* "2 colours beyond 0 to 65535 are left out", of cloud.beyond; "" where there are none. Returns `text`. */
#define CLOUD_BEYOND 200
const char *cloud_beyond_text(const size_t beyond[POINT_VALUE_KINDS], char text[CLOUD_BEYOND]);

/* The names of the formats, as in "PLY and PCD". Returns `text`. */
#define CLOUD_FORMAT_NAMES 128
char *cloud_format_names(char text[CLOUD_FORMAT_NAMES]);

/* Free all arrays and empty the cloud; a zeroed cloud is allowed. */
void cloud_release(cloud *cloud);

#endif
