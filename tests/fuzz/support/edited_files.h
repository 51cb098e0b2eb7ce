/* SPDX-License-Identifier: MIT */
/* edited_files.h - the files of a folder, changed by edits that any bytes name, for fuzzers: each edit is of values,
 * members and lines as they stand, so that most of what it leaves is still read. An input is a few edits, not the
 * files, and stays as good when what is written changes.
 */
#ifndef EDITED_FILES_H
#define EDITED_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { EDITED_MOST = 16, EDITED_NAME = 48, EDITED_LARGEST = 1 << 19 };

typedef enum edited_kind { EDITED_FILE, EDITED_NONE, EDITED_FOLDER, EDITED_LINK, EDITED_PIPE } edited_kind;

typedef struct edited_file {
    char name[EDITED_NAME];
    edited_kind kind; /* what has this name: a file, nothing, an empty folder, a link to another file, or a pipe */
    size_t other;     /* index of the file to which a link leads */
    uint8_t *bytes;   /* at most EDITED_LARGEST bytes; owned */
    size_t size;
    bool repaired; /* PNG: its checksums are corrected */
} edited_file;

typedef struct edited_files {
    edited_file files[EDITED_MOST]; /* sorted by name */
    size_t count;
} edited_files;

/* Read all files of a folder; copy files. All functions here abort on failure. */
void edited_files_read(edited_files *files, const char *folder);
void edited_files_copy(edited_files *files, const edited_files *from);
void edited_files_release(edited_files *files);

/* The file that was read under this name. */
const edited_file *edited_files_find(const edited_files *files, const char *name);

/* Apply the edits that these bytes describe: each edit is 7 bytes and a text, whose length is the last of them. */
void edited_files_apply(edited_files *files, const uint8_t *data, size_t size);

/* Write a folder with exactly these files: its former contents are removed. */
void edited_files_write(const edited_files *files, const char *folder);

/* Remove a folder with all its contents; it may be missing. */
void remove_folder(const char *folder);

#endif
