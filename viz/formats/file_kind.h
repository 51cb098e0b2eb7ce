/* SPDX-License-Identifier: MIT */
/* file_kind.h - detects what kind of file or folder a path names, from its content and never from its name; and which
 * format the name of an output file asks for. */
#ifndef FORMATS_FILE_KIND_H
#define FORMATS_FILE_KIND_H

#include <stdbool.h>

/* The columns: the kind, its name in messages, a command of octreel that reads it (may be null), and what the command
 * does or other advice. */
#define FILE_KIND_MAP(X)                                                                                               \
    X(UNKNOWN, NULL, NULL, NULL)                                                                                       \
    X(MISSING, NULL, NULL, NULL)                                                                                       \
    X(RECORDING, "a recording", "verify", "replays it, and its session.json is a session")                             \
    X(FOLDER, "a folder without a recording", "diff", "compares folders of PNGs")                                      \
    X(SESSION, "a session", "record", "films it")                                                                      \
    X(PNG, "a PNG", "diff", "compares pictures, and octreel pick names the elements at a pixel of a frame")            \
    X(BASELINE, "a baseline", "diff", "compares frames with it")                                                       \
    X(CLOUD, "a point cloud", "inspect", "draws it")                                                                   \
    X(PAGE, "a page made by octreel", NULL, "open it in a browser")                                                    \
    X(PART, "a file of a recording", NULL, "give the folder that contains it")                                         \
    X(OTHER_PICTURE, "a picture in another format than PNG", NULL, "convert it to PNG first")                          \
    X(PACKED, "a compressed file", NULL, "unpack it first")

typedef enum file_kind {
#define FILE_KIND_ENUM(kind, ...) KIND_##kind,
    FILE_KIND_MAP(FILE_KIND_ENUM)
#undef FILE_KIND_ENUM
} file_kind;

/* A set of kinds. Every set includes UNKNOWN: for unknown files the reader of the file reports the error. */
typedef unsigned file_kinds;
#define FILE_KIND(kind) (1u << KIND_##kind)

/* Find the kind of a path. UNKNOWN if it cannot be opened, and for anything but regular files and folders: pipes and
 * standard input, "-", are not read. */
file_kind file_kind_of(const char *path);

/* Find the kind of a file that will be read in any case. This also reads from pipes and from standard input, "-", and
 * keeps the bytes for the next reader. */
file_kind file_kind_read(const char *path);

typedef struct file_kind_row {
    const char *name, *command, *use; /* the columns of FILE_KIND_MAP */
} file_kind_row;

extern const file_kind_row file_kind_rows[];

/* The kind of output that the suffix of a file name asks for. OPEN: the suffix is missing or unknown. */
typedef enum name_kind { NAME_OPEN, NAME_PNG, NAME_PICTURE, NAME_FILM, NAME_FILE } name_kind;
name_kind name_kind_of(const char *path);

/* The first bytes of every baseline. */
#define DIGEST_FILE_BEGINNING "octreel-digests "

#endif
