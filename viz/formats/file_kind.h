/* SPDX-License-Identifier: MIT */
/* file_kind.h - detects the kind of a file or folder from its content, never from its name; and finds the format that
 * the name of an output file requests. */
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

/* A set of kinds. Every set includes UNKNOWN: the reader of an unknown file reports the error. */
typedef unsigned file_kinds;
#define FILE_KIND(kind) (1u << KIND_##kind)

/* Find the kind of a path. UNKNOWN if it cannot be opened, and for anything but regular files and folders: pipes and
 * standard input, "-", are not read. */
file_kind file_kind_of(const char *path);

/* Find the kind of a file that will be read. Unlike file_kind_of(), this also reads pipes and standard input ("-"), and
 * keeps the bytes for the next reader. */
file_kind file_kind_of_input(const char *path);

typedef struct file_kind_row {
    const char *name, *command, *use; /* the columns of FILE_KIND_MAP */
} file_kind_row;

extern const file_kind_row file_kind_rows[];

/* The format requested by the suffix of an output file's name. OPEN: the suffix is missing or unknown. */
typedef enum output_kind { NAME_OPEN, NAME_PNG, NAME_PICTURE, NAME_FILM, NAME_FILE } output_kind;
output_kind output_kind_of_name(const char *path);

/* The first bytes of every baseline. */
#define DIGEST_FILE_BEGINNING "octreel-digests "

#endif
