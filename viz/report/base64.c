/* base64.c - see base64.h. */
#include "base64.h"

enum { GROUPS = 4096 };

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/* `count` of three bytes; those that are missing are zero. */
static void put_group(const unsigned char *from, size_t count, char *to)
{
    const unsigned bits =
        (unsigned)from[0] << 16 | (count > 1 ? (unsigned)from[1] << 8 : 0) | (count > 2 ? from[2] : 0);
    for (unsigned i = 0; i < 4; i++)
        to[i] = i <= count ? digits[bits >> (18 - 6 * i) & 63] : '=';
}

void base64_copy(FILE *in, FILE *out)
{
    unsigned char bytes[3 * GROUPS];
    char text[4 * GROUPS];
    for (size_t size; (size = fread(bytes, 1, sizeof bytes, in)) > 0;) {
        size_t length = 0;
        for (size_t at = 0; at < size; at += 3, length += 4)
            put_group(bytes + at, size - at, text + length);
        fwrite(text, 1, length, out);
    }
}
