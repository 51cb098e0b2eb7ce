/* utf8.h - text of others that should be UTF-8, and may not be. */
#ifndef RECORD_UTF8_H
#define RECORD_UTF8_H

#include <stddef.h>

/* U+FFFD, which stands for what is none. */
#define UTF8_REPLACEMENT "\xef\xbf\xbd"

/* The bytes of the character beyond ASCII at `at`, 0 when there is none. The final zero ends every character. */
size_t utf8_length(const unsigned char *at);

#endif
