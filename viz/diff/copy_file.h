/* copy_file.h - a file's bytes under another name. */
#ifndef DIFF_COPY_FILE_H
#define DIFF_COPY_FILE_H

#include "folder.h"

/* Copy a regular file, a block at a time, by way of "<to>.part" and a rename. */
bool copy_file(const char *from, const char *to, record_error *error);

#endif
