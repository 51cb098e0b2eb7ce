/* same_bytes.h - whether two files hold the same bytes. */
#ifndef DIFF_SAME_BYTES_H
#define DIFF_SAME_BYTES_H

#include <stdbool.h>

/* True when both are regular files that can be read and hold the same bytes. */
bool same_bytes(const char *a, const char *b);

#endif
