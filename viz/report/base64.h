/* base64.h - bytes as text, for addresses that hold their data (RFC 4648). */
#ifndef DIFF_BASE64_H
#define DIFF_BASE64_H

#include <stdio.h>

/* All that is left of `in`. Errors stay with the streams. */
void base64_copy(FILE *in, FILE *out);

#endif
