/* SPDX-License-Identifier: MIT */
/* file.h - files: reads them whole, writes them whole or not at all, copies and compares them. */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>

/* Returns "folder/name", or only the name if the folder is "", the current folder. The caller frees it. Returns null
 * when out of memory. */
char *path_join(const char *folder, const char *name);

/* Returns the folder in which a path lies: "a" for "a/b" and "a/b/", "." for "b". The caller frees it. Returns null
 * when out of memory. */
char *path_parent_folder(const char *path);

/* Returns the part of a path after its last slash. */
const char *path_base_name(const char *path);

/* True if a file name ends in one of the endings of a list such as ".las.laz", in upper or lower case. */
bool file_has_ending(const char *name, const char *endings);

/* True if the folder contains a file or folder of this name. "" is the current folder. */
bool folder_contains(const char *folder, const char *name);

/* Returns the names in a folder, without "." and "..", in the order of strcmp(), with a null behind the last. The
 * caller frees the array, which holds the names, too. Returns null with an error if the folder cannot be read or memory
 * runs out; errno is then the reason. Files may be removed while the list is walked. */
char **folder_names(const char *folder, octreel_error *error);

/* Lock an open file until it is closed. False: another open file, of this process or another, holds the lock. On a file
 * system without locks this always succeeds. file_is_locked() returns whether a file is locked. */
bool file_lock(int file);
bool file_is_locked(const char *path);

/* Lock the folder in which a path lies, and wait if another process holds the lock. Processes that read, change and
 * rename files under this lock never overwrite each other's changes. Returns a descriptor; close() releases the lock.
 * Returns -1 if there is no folder or its file system has no locks. */
int file_lock_parent_folder(const char *path);

/* True for "-". In all functions below "-" is standard input when reading and standard output when writing; a file
 * named "-" is written as "./-". */
bool file_is_standard_stream(const char *path);

/* The name of a file in messages: its path, or "standard input" or "standard output" for "-". */
#define FILE_STANDARD_INPUT "standard input"
const char *file_display_name(const char *path);
const char *file_output_display_name(const char *path);

#define FILE_REASON 160

/* Open a regular file or standard input. Standard input is read into memory and kept, so that it can be opened several
 * times. `size` may be null; it receives the number of bytes. Returns null with a reason, such as "cannot be opened: No
 * such file or directory", if the file is missing, unreadable, a folder, a pipe or a device. */
FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON]);

/* Called after each block that is read, with the bytes read so far and in total; total 0 means unknown. */
typedef void file_progress(uint64_t done, uint64_t total, void *context);

/* Read a whole file into *bytes, which the caller frees and which has room for one more byte. `progress` may be null.
 * Standard input is not kept: a second read of it fails. On failure *bytes is null. */
bool file_read_with_progress(const char *path, file_progress *progress, void *context, char **bytes, size_t *size,
                             octreel_error *error);

/* Read a whole file without reporting progress. */
bool file_read_whole(const char *path, char **bytes, size_t *size, octreel_error *error);

/* A file that is written as "<path>.part" and then renamed, so that the path never holds a part of it. Standard output
 * is neither closed nor flushed; main() reports its errors. */
typedef struct file_writer {
    FILE *stream;
    const char *path;
    char *temp;   /* the path of the stream, owned; null: standard output */
    bool lasting; /* set it after opening to sync the file, so that a power cut leaves the whole old or new file */
} file_writer;

/* An existing path that is no regular file, such as a pipe or a device, is written directly. */
bool file_writer_open(file_writer *file, const char *path, octreel_error *error);

/* For a folder whose contents others may have prepared: a pipe, device or link at the path is replaced and never
 * written to. Writing to a pipe would block; a link or device would lead out of the folder. */
bool file_writer_open_replacing(file_writer *file, const char *path, octreel_error *error);

/* The same with a unique name for the temporary file, so that several processes can write the same path. */
bool file_writer_open_unique(file_writer *file, const char *path, octreel_error *error);
bool file_writer_close(file_writer *file, octreel_error *error);

/* file_writer_close() in two steps, for several files that change together: finish() writes everything to the temporary
 * file, rename() only renames it. */
bool file_writer_finish(file_writer *file, octreel_error *error);
bool file_writer_rename(file_writer *file, octreel_error *error);

/* Remove the temporary file and leave the path unchanged. Always returns false, so that a caller can return it. */
bool file_writer_discard(file_writer *file);

/* Copy a regular file to "<to>.part" and rename it. Replaces an existing file. */
bool file_copy_to(const char *from, const char *to, octreel_error *error);

/* Copy a file to a temporary file and sync it; file_writer_rename() completes the copy. `to` must outlive the writer.
 * */
bool file_copy_prepare(file_writer *file, const char *from, const char *to, octreel_error *error);

/* Copy a file and sync it, with a unique name for the temporary file. */
bool file_copy_unique(const char *from, const char *to, octreel_error *error);

/* An output file of a command line. It must not overwrite an input or another output. */
typedef struct output_file {
    const char *option; /* the option as typed, such as "-o" */
    const char *path;   /* null: the option was not given */
} output_file;

/* Returns false, with an error, if the output is the input file: the same device and inode, even if the paths differ.
 * "-" and files that are not regular, such as pipes, may be both input and output. */
bool check_output_is_not_input(const output_file *output, const char *input, octreel_error *error);

/* Returns false, with an error, if two outputs are the same file, which may not exist yet, or if both are "-". */
bool check_outputs_differ(const output_file *outputs, size_t count, octreel_error *error);

/* True if both are regular files with the same bytes; false for "-". have_same_file() compares the files of one name in
 * two folders; false with errno ENOMEM if memory runs out. */
bool have_same_bytes(const char *a, const char *b);
bool have_same_file(const char *folder_a, const char *folder_b, const char *name);

/* True if both describe the same file. stat_parent() describes the folder in which a path lies; false on failure. */
bool is_same_file(const struct stat *a, const struct stat *b);
bool stat_parent(const char *path, struct stat *status);

#endif
