/* SPDX-License-Identifier: MIT */
/* file.h - files and their names: read whole, written whole or not at all, copied, compared. */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>

/* Returns "folder/name", or the name alone where the folder is "", which is the current folder. The caller frees it.
 * Returns null when out of memory. */
char *path_join(const char *folder, const char *name);

/* Whether the folder contains a file or folder of this name. "" is the current folder. */
bool folder_has(const char *folder, const char *name);

/* Lock a file that is open, for as long as it is; false where somebody has, this process included. A file system
 * without locks never has it locked. And whether a file is so locked. */
bool file_lock(int file);
bool file_is_locked(const char *path);

/* Lock the folder in which a path lies, and wait for whoever has it: what is read, changed and renamed in it by all who
 * do so is lost to nobody. Released by close(); -1 where the folder or its file system has no locks. */
int file_lock_parent_folder(const char *path);

/* "-" stands for standard input where a file is read, and for standard output where one is written: in each function
 * below, and so in every command. ./- is a file of that name. */
bool file_is_standard(const char *path);

/* What a path is called in a sentence: itself, or "standard input" and "standard output". */
#define FILE_STANDARD_INPUT "standard input"
const char *file_title(const char *path);
const char *file_output_title(const char *path);

#define FILE_REASON 160

/* Open a regular file, or standard input, which is kept in memory from then on, so that it can be opened and read
 * again. Null with the reason, such as "cannot be opened: No such file or directory", for what is missing, unreadable,
 * a folder, a pipe or a device. *size, which may be null, is set to its bytes. */
FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON]);

/* Called after each block of what is read, with the bytes so far and those that there are in all; 0: nobody knows. */
typedef void file_progress(uint64_t done, uint64_t total, void *context);

/* Read such a file into *bytes, which the caller frees; `progress` may be null. There is room for a zero after them.
 * Standard input is read to its end, and not kept: the next who reads it is refused. False with the reason. */
bool file_read_watched(const char *path, file_progress *progress, void *context, char **bytes, size_t *size,
                       char reason[FILE_REASON]);

/* The same, unwatched. */
bool file_read_whole(const char *path, char **bytes, size_t *size, char reason[FILE_REASON]);

/* A file that is written by way of "<path>.part" and a rename: there whole, or not at all. Standard output is neither
 * closed nor flushed: who ends the program tells what could not be written. */
typedef struct file_writer {
    FILE *stream;
    const char *path;
    char *temp;   /* where the stream goes; null: standard output */
    bool lasting; /* to be set after it is opened: a power cut, too, leaves the old file or the new one, whole */
} file_writer;

/* What is there and is not a regular file, such as a pipe, is written directly. */
bool file_writer_open(file_writer *file, const char *path, octreel_error *error);

/* The same of a file in a folder that others may have made: nothing is written to a pipe, a device or a link that is
 * there, since the one would wait for a reader and the others lie elsewhere; it is replaced. */
bool file_writer_open_replacing(file_writer *file, const char *path, octreel_error *error);

/* The same by way of a file that nobody else writes at the same time. */
bool file_writer_open_unique(file_writer *file, const char *path, octreel_error *error);
bool file_writer_close(file_writer *file, octreel_error *error);

/* The same in two steps, for files that take their places together: all is on the disk beside the path, and then there
 * is but a rename to do. */
bool file_writer_finish(file_writer *file, octreel_error *error);
bool file_writer_place(file_writer *file, octreel_error *error);

/* Leave the path as it was before; always false, so that a caller can return it. */
bool file_writer_abandon(file_writer *file);

/* Copy a regular file, a block at a time, by way of "<to>.part" and a rename, whatever was there. */
bool file_copy_to(const char *from, const char *to, octreel_error *error);

/* The same of what shall last (`lasting`), up to file_writer_finish(); `to` must outlive the writer. */
bool file_copy_prepare(file_writer *file, const char *from, const char *to, octreel_error *error);

/* The same of what shall last, by way of a file that nobody else writes at the same time. */
bool file_copy_unique(const char *from, const char *to, octreel_error *error);

/* A file that a command line names as an output: none may take the place of what is read, nor of another one. */
typedef struct output_file {
    const char *option; /* as it is typed: "-o" */
    const char *path;   /* null: not written */
} output_file;

/* False, with a sentence, where an output is this file that is read: the same device and inode, however they are named.
 * A path that is not a regular file, such as a pipe, may be both, and so may "-". */
bool check_output_is_not_input(const output_file *output, const char *input, octreel_error *error);

/* False, with a sentence, where two outputs are one file, be it there already or not; two may not be "-". */
bool check_outputs_differ(const output_file *outputs, size_t count, octreel_error *error);

/* Whether both are regular files with the same bytes; standard input is none. */
bool have_same_bytes(const char *a, const char *b);

/* Whether both are one file; and the folder in which a path lies. */
bool is_same_file(const struct stat *a, const struct stat *b);
bool stat_parent(const char *path, struct stat *status);

#endif
