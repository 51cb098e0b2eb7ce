/* SPDX-License-Identifier: MIT */
/* file_kind.h - what a path stands for, told by what is there and by its first bytes, never by its name; and what the
 * name of an output promises. */
#ifndef FORMATS_FILE_KIND_H
#define FORMATS_FILE_KIND_H

#include <stdbool.h>

/* Each kind, what it is called, and what may be done with it: a command of octreel's and what that does, or advice. */
#define FILE_KIND_MAP(X)                                                                                               \
    X(UNKNOWN, NULL, NULL, NULL)                                                                                       \
    X(MISSING, NULL, NULL, NULL)                                                                                       \
    X(RECORDING, "a recording", "verify", "plays it again, and its session.json is a session")                         \
    X(FOLDER, "a folder without a recording", "diff", "compares folders of PNGs")                                      \
    X(SESSION, "a session", "record", "films it")                                                                      \
    X(PNG, "a PNG", "diff", "compares pictures, and pick tells what a recorded frame shows")                           \
    X(BASELINE, "a baseline", "diff", "compares frames with it")                                                       \
    X(CLOUD, "a point cloud", "inspect", "draws it")                                                                   \
    X(PAGE, "a page of octreel's", NULL, "a browser opens it")                                                         \
    X(PART, "a part of a recording", NULL, "the recording is the folder that it is in")                                \
    X(OTHER_PICTURE, "a picture, but no PNG", NULL, "convert it first")                                                \
    X(PACKED, "a compressed file", NULL, "unpack it first")

typedef enum file_kind {
#define FILE_KIND_ENUM(kind, ...) KIND_##kind,
    FILE_KIND_MAP(FILE_KIND_ENUM)
#undef FILE_KIND_ENUM
} file_kind;

/* A set of kinds. UNKNOWN is in each: the reader says what does not fit. */
typedef unsigned file_kinds;
#define FILE_KIND(kind) (1u << KIND_##kind)

/* UNKNOWN for what cannot be opened, and for what is neither a regular file nor a folder: a pipe is not read, nor is
 * "-", standard input. */
file_kind file_kind_of(const char *path);

/* The same of a file that is to be read in any case: "-" is, too, and is kept for who reads it. */
file_kind file_kind_read(const char *path);

typedef struct file_kind_row {
    const char *words, *command, *use;
} file_kind_row;

extern const file_kind_row file_kind_rows[];

/* What the ending of a name says of what is written under it; OPEN: nothing. */
typedef enum name_kind { NAME_OPEN, NAME_PNG, NAME_PICTURE, NAME_FILM, NAME_FILE } name_kind;
name_kind name_kind_of(const char *path);

/* The beginning of every baseline. */
#define DIGEST_FILE_BEGINNING "octreel-digests "

#endif
