/* SPDX-License-Identifier: MIT */
/* file.h - files and their names: read whole, written whole or not at all, copied, compared. */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "error.h"

#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>

/* "folder/name"; owned by the caller, null when there is no memory. */
char *path_join(const char *folder, const char *name);

/* Whether the folder has anything of this name. */
bool folder_has(const char *folder, const char *name);

/* "-" stands for standard input where a file is read, and for standard output where one is written: here, and so
 * for every command. ./- is a file of that name. */
bool file_is_standard(const char *path);

/* What a path that is read is called in a sentence: itself, or "standard input". */
#define FILE_STANDARD_INPUT "standard input"
const char *file_title(const char *path);

#define FILE_REASON 160

/* Read a regular file into *bytes, which the caller frees. False with the reason, such as "cannot be opened: No such
 * file or directory", for what is missing, unreadable, a folder, a pipe or a device. */
bool file_read_whole(const char *path, char **bytes, size_t *size, char reason[FILE_REASON]);

/* A file that is written by way of "<path>.part" and a rename: there whole, or not at all. An
 * existing path that is not a regular file, such as a pipe, is written directly. */
typedef struct file_writer {
    FILE *stream;
    const char *path;
    char *temp; /* where the stream goes */
} file_writer;

bool file_writer_open(file_writer *file, const char *path, octreel_error *error);
bool file_writer_close(file_writer *file, octreel_error *error);

/* Leave the path as it was before; always false, so that a caller can return it. */
bool file_writer_abandon(file_writer *file);

/* Copy a regular file, a block at a time, by way of "<to>.part" and a rename. */
bool file_copy_to(const char *from, const char *to, octreel_error *error);

/* A file that a command line names as an output: none may take the place of what is read, nor of another one. */
typedef struct output_file {
    const char *option; /* as it is typed: "-o" */
    const char *path;   /* null: not written */
} output_file;

/* False, with a sentence, where an output is this file that is read: the same device and inode, however they are named.
 * A path that is not a regular file, such as a pipe, may be both. */
bool output_spares(const output_file *output, const char *input, octreel_error *error);

/* False, with a sentence, where two outputs are one file, be it there already or not. */
bool outputs_apart(const output_file *outputs, size_t count, octreel_error *error);

/* Whether both are regular files with the same bytes. */
bool same_bytes(const char *a, const char *b);

/* Whether both are one file; and the folder in which a path lies. */
bool same_file(const struct stat *a, const struct stat *b);
bool stat_parent(const char *path, struct stat *status);

#endif
