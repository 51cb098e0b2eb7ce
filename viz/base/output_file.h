/* output_file.h - the files that a command line names as its outputs: none may take the place of what is read, nor of
 * another one. */
#ifndef RECORD_OUTPUT_FILE_H
#define RECORD_OUTPUT_FILE_H

#include "folder.h"

#include <sys/stat.h>

typedef struct output_file {
    const char *option; /* as it is typed: "-o" */
    const char *path;   /* null: there is none */
} output_file;

/* False, with a sentence, where an output is this file that is read: the same device and inode, however they are named.
 * What is no regular file, a pipe say, may be both. */
bool output_spares(const output_file *output, const char *input, record_error *error);

/* False, with a sentence, where two outputs are one file, be it there already or not. */
bool outputs_apart(const output_file *outputs, size_t count, record_error *error);

/* Whether both are one file; and the folder in which a path lies. */
bool same_file(const struct stat *a, const struct stat *b);
bool stat_parent(const char *path, struct stat *status);

#endif
