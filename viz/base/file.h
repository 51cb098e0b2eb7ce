/* SPDX-License-Identifier: MIT */
/* file.h - reads whole files, writes files so that a file is either complete or unchanged, and copies and compares
 * files. */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "error.h"

#include <limits.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>

/* Returns "folder/name". For the folder "", which is the current folder, returns only the name. The caller frees the
 * path. Returns null if memory runs out. */
char *path_join(const char *folder, const char *name);

/* Writes "folder/name", as path_join() returns it, into the buffer `path`. Returns false if the path has PATH_MAX or
 * more bytes, which the system would refuse. */
bool path_print(const char *folder, const char *name, char path[PATH_MAX]);

/* Returns the folder that contains a path: "a" for "a/b" and "a/b/", "." for "b". The caller frees the result. Returns
 * null if memory runs out. */
char *path_parent_folder(const char *path);

/* Returns the part of a path after its last slash. */
const char *path_base_name(const char *path);

/* Returns whether a file name ends with one of `endings`, a list such as ".las.laz". Case is ignored. */
bool file_has_ending(const char *name, const char *endings);

/* Returns whether the folder contains a file or folder with this name. The folder "" is the current folder. */
bool folder_contains(const char *folder, const char *name);

/* Returns an array of the names in a folder, without "." and "..", sorted by strcmp(). Null follows the last name. The
 * caller frees the array; its block of memory also holds the names. If the folder cannot be read or memory runs out,
 * returns null with an error, and errno is the reason. The caller may remove files of the folder while it uses the
 * array. */
char **folder_names(const char *folder, octreel_error *error);

/* file_lock() locks an open file until the file is closed. It returns false if the file is already locked, by another
 * process or through another open() of this process. On a file system without locks it always succeeds.
 * file_is_locked() returns whether a file is locked. */
bool file_lock(int file);
bool file_is_locked(const char *path);

/* Locks the folder that contains a path. If another process holds the lock, waits until the lock is released. Processes
 * that read, change and rename files under this lock never overwrite each other's changes. Returns a file descriptor;
 * close() releases the lock. Returns -1 if the folder does not exist or its file system has no locks. */
int file_lock_parent_folder(const char *path);

/* Returns whether a path is "-". For this path, the functions below that read a file read standard input, and the
 * functions that write a file write standard output. A file with the name "-" is given as "./-". */
bool file_is_standard_stream(const char *path);

/* Returns whether an output path names standard output: "-", /dev/stdout or /dev/fd/1. */
bool file_is_standard_output(const char *path);

/* Return the name of a file for messages: its path or, for "-", "standard input". file_output_display_name() returns
 * "standard output" instead. */
#define FILE_STANDARD_INPUT "standard input"
const char *file_display_name(const char *path);
const char *file_output_display_name(const char *path);

#define FILE_REASON 160

/* Opens a regular file or standard input. The bytes of standard input are read into memory and kept there, so that
 * standard input can be opened several times. *size receives the number of bytes; `size` may be null. Returns null with
 * a reason, such as "cannot be opened: No such file or directory", if the file is missing, unreadable, a folder, a pipe
 * or a device. */
FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON]);

/* A function that is called after each block that was read from a file. `done` is the number of bytes read so far,
 * `total` the size of the file, or 0 if the size is unknown. */
typedef void file_progress(uint64_t done, uint64_t total, void *context);

/* Reads a whole file into *bytes. The caller frees *bytes, which has room for one more byte, such as a final zero.
 * `progress` may be null. The bytes of standard input are not kept, so standard input can be read only once in this
 * way. On failure, *bytes is null. */
bool file_read_with_progress(const char *path, file_progress *progress, void *context, char **bytes, size_t *size,
                             octreel_error *error);

/* Reads a whole file without reporting progress. */
bool file_read_whole(const char *path, char **bytes, size_t *size, octreel_error *error);

/* A file that is written as "<path>.part" and then renamed to the path, so that the path never holds an incomplete
 * file. If the path is "-", the writer writes to standard output; main() flushes standard output and reports errors. */
typedef struct file_writer {
    FILE *stream;
    const char *path;
    /* the path of the open file: the temporary file, or `path` if it is written directly; owned; null: standard
     * output */
    char *temp;
    /* set by the caller after opening; true: the file is synced before it is renamed, so that a power failure leaves
     * either the old or the new file */
    bool lasting;
} file_writer;

/* Opens a writer. A pipe, a device or an open file such as /dev/stdout is written directly. A pipe that no process
 * reads is refused. */
bool file_writer_open(file_writer *file, const char *path, octreel_error *error);

/* Opens a writer in a folder whose contents are not trusted. If the path is a pipe, a device or a link, the new file
 * replaces it. Writing to a pipe would block; writing to a link or device would change a file outside the folder. */
bool file_writer_open_replacing(file_writer *file, const char *path, octreel_error *error);

/* Opens a writer as file_writer_open_replacing() does. In addition the temporary file has a unique name, so that
 * several processes can write the same path. */
bool file_writer_open_unique(file_writer *file, const char *path, octreel_error *error);

/* Completes the file: writes all buffered data, and renames the temporary file to the path. On failure, removes the
 * temporary file. */
bool file_writer_close(file_writer *file, octreel_error *error);

/* The two steps of file_writer_close(), for several files that change together. file_writer_finish() writes all
 * buffered data to the temporary file and closes it; file_writer_rename() only renames it. */
bool file_writer_finish(file_writer *file, octreel_error *error);
bool file_writer_rename(file_writer *file, octreel_error *error);

/* Removes the temporary file and leaves the path unchanged. Always returns false, so that the caller can write `return
 * file_writer_discard(...)`. */
bool file_writer_discard(file_writer *file);

/* Copies a regular file to "<to>.part" and renames the copy to `to`. If the file `to` exists, it is replaced. */
bool file_copy_to(const char *from, const char *to, octreel_error *error);

/* Copies a file to a temporary file and syncs the temporary file. file_writer_rename() completes the copy. `to` must
 * outlive the writer. */
bool file_copy_prepare(file_writer *file, const char *from, const char *to, octreel_error *error);

/* Copies a file and syncs the copy. The temporary file has a unique name, so that several processes can write the same
 * path. */
bool file_copy_unique(const char *from, const char *to, octreel_error *error);

/* have_same_bytes() returns whether both paths are regular files with the same bytes; it returns false for "-".
 * have_same_file() compares the files of one name in two folders; if memory runs out, it returns false and sets errno
 * to ENOMEM. */
bool have_same_bytes(const char *a, const char *b);
bool have_same_file(const char *folder_a, const char *folder_b, const char *name);

/* is_same_file() returns whether two results of stat() describe the same file. stat_parent_folder() calls stat() for
 * the folder that contains a path; it returns false on failure. */
bool is_same_file(const struct stat *a, const struct stat *b);
bool stat_parent_folder(const char *path, struct stat *status);

#endif
