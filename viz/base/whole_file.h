/* whole_file.h - a regular file read into memory. */
#ifndef RECORD_WHOLE_FILE_H
#define RECORD_WHOLE_FILE_H

#include <stdbool.h>
#include <stddef.h>

#define WHOLE_FILE_REASON 160

/* Read a regular file into *bytes, which the caller frees. False with the reason, such as "cannot be opened: No such
 * file or directory", for what is missing, unreadable, a folder, a pipe or a device. */
bool whole_file_read(const char *path, char **bytes, size_t *size, char reason[WHOLE_FILE_REASON]);

#endif
