/* SPDX-License-Identifier: MIT */
/* file_kind.h - detects the kind of a file or folder from its content, never from its name. Also finds the format that
 * the name of an output file requests. */
#ifndef FORMATS_FILE_KIND_H
#define FORMATS_FILE_KIND_H

#include <stdbool.h>

/* Each row: the kind; its name in messages; a command of octreel that reads files of this kind, or null; what this
 * command does. If the command is null, the last column is a hint for the user. */
#define FILE_KIND_MAP(X)                                                                                               \
    X(UNKNOWN, NULL, NULL, NULL)                                                                                       \
    X(MISSING, NULL, NULL, NULL)                                                                                       \
    X(RECORDING, "a recording", "verify", "replays it, and its session.json is a session")                             \
    X(FOLDER, "a folder without a recording", "diff", "compares folders of PNGs")                                      \
    X(SESSION, "a session", "record", "films it")                                                                      \
    X(PNG, "a PNG", "diff", "compares pictures, and octreel pick names the elements at a pixel of a frame")            \
    X(BASELINE, "a baseline", "diff", "compares frames with it")                                                       \
    X(CLOUD, "a point cloud", "inspect", "draws it, and with -o FILE.html makes a page of it")                         \
    X(PAGE, "a page made by octreel", NULL, "open it in a browser")                                                    \
    X(PART, "a file of a recording", NULL, "give the folder that contains it")                                         \
    X(OTHER_PICTURE, "a picture in another format than PNG", NULL, "convert it to PNG first")                          \
    X(PACKED, "a compressed file", NULL, "unpack it first")

typedef enum file_kind {
#define FILE_KIND_ENUM(kind, ...) KIND_##kind,
    FILE_KIND_MAP(FILE_KIND_ENUM)
#undef FILE_KIND_ENUM
} file_kind;

/* A set of kinds of files, one bit for each kind. Every set contains UNKNOWN, because the reader of a file of
 * unknown kind reports the error. */
typedef unsigned file_kinds;
#define FILE_KIND(kind) (1u << KIND_##kind)

/* Returns the kind of the file or folder at a path. Returns UNKNOWN if the path cannot be opened or is not a regular
 * file or a folder. Pipes and standard input ("-") are not read. */
file_kind file_kind_of(const char *path);

/* Returns the kind of a file that will be read afterwards. Unlike file_kind_of(), this function also reads pipes and
 * standard input ("-"), and keeps the bytes for the next reader. */
file_kind file_kind_of_input(const char *path);

typedef struct file_kind_row {
    const char *name, *command, *use; /* the last three columns of the kind's row in FILE_KIND_MAP */
} file_kind_row;

extern const file_kind_row file_kind_rows[];

/* The format that the ending of an output file's name requests. NAME_OPEN: the ending is missing or unknown. */
typedef enum output_kind { NAME_OPEN, NAME_PNG, NAME_PICTURE, NAME_FILM, NAME_FILE } output_kind;
output_kind output_kind_of_name(const char *path);

/* Every baseline begins with these bytes. */
#define DIGEST_FILE_BEGINNING "octreel-digests "

#endif
