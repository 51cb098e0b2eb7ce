/* SPDX-License-Identifier: MIT */
/* packer.c - see packer.h. image/deflate.h compresses only rows of pictures, so this file uses zlib, which libpng needs
 * anyway. */
#include "packer.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>

enum { LEVEL = 6, GZIP = 16, FIRST_ROOM = 1 << 14 };

void packer_begin(packer *p)
{
    *p = (packer){.failed = false};
    p->begun = deflateInit2(&p->z, LEVEL, Z_DEFLATED, MAX_WBITS + GZIP, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) == Z_OK;
    p->failed = !p->begun;
}

/* Make room for at least one more packed byte. */
static void grow(packer *p)
{
    const size_t used = p->z.total_out, room = p->room ? 2 * p->room : FIRST_ROOM;
    unsigned char *bytes = room - used <= UINT_MAX ? realloc(p->bytes, room) : NULL;
    p->failed = !bytes;
    if (!bytes)
        return;
    p->bytes = bytes;
    p->room = room;
    p->z.next_out = bytes + used;
    p->z.avail_out = (unsigned)(room - used);
}

/* Pack what is in p->z. deflate() is done when it leaves room. */
static void run(packer *p, int flush)
{
    do {
        if (p->z.avail_out == 0)
            grow(p);
        if (!p->failed)
            deflate(&p->z, flush);
    } while (!p->failed && p->z.avail_out == 0);
}

void packer_add(packer *p, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    while (size > 0 && !p->failed) {
        const size_t piece = size < UINT_MAX ? size : UINT_MAX;
        p->z.next_in = (unsigned char *)at; /* zlib does not change the bytes */
        p->z.avail_in = (unsigned)piece;
        run(p, Z_NO_FLUSH);
        at += piece;
        size -= piece;
    }
}

unsigned char *packer_end(packer *p, size_t *size)
{
    unsigned char *bytes = NULL;
    if (!p->failed)
        run(p, Z_FINISH);
    if (!p->failed) {
        bytes = p->bytes;
        *size = p->z.total_out;
        p->bytes = NULL;
    }
    packer_release(p);
    return bytes;
}

void packer_release(packer *p)
{
    if (p->begun)
        deflateEnd(&p->z);
    free(p->bytes);
    *p = (packer){.failed = true};
}

void write_letters(FILE *page, const unsigned char *bytes, size_t size)
{
    static const char digits[] =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?,_>()[]{}~%$#";
    putc((int)('0' + (4 - size % 4) % 4), page);
    for (size_t at = 0; at < size; at += 4) {
        uint32_t word = 0;
        char letters[5];
        for (size_t i = at; i < at + 4; i++)
            word = word << 8 | (i < size ? bytes[i] : 0u);
        for (int i = 4; i >= 0; i--, word /= 85)
            letters[i] = digits[word % 85];
        fwrite(letters, 1, sizeof letters, page);
    }
}
