/* SPDX-License-Identifier: MIT */
/* png_chunks.c - walks the chunks in the first 4096 bytes of a PNG file. */
#include "png_chunks.h"
#include "file.h"
#include "image.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* NAME, DATA: offsets in a chunk; CRC_SIZE: the size of its CRC. A chunk consists of 4 bytes with the size of its data,
 * 4 bytes with its name, the data, and a CRC-32 of the name and the data. */
enum { NAME = 4, DATA = 8, CRC_SIZE = 4 };

/* The first bytes of a file. They contain the chunks that this file reads, which precede the pixels. */
typedef struct page {
    uint8_t bytes[4096];
    size_t size;
} page;

typedef struct chunk {
    uint8_t *at;
    uint32_t size; /* number of bytes of the chunk's data */
} chunk;

static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

static uint32_t load_big_endian(const uint8_t *from)
{
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

static void store_big_endian(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* CRC-32, bit by bit. A chunk of a page is so short that zlib's tables would save nothing, and liboctreel-compare does
 * not link zlib. */
static uint32_t compute_crc(const chunk *c)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = NAME; i < DATA + c->size; i++) {
        crc ^= c->at[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? UINT32_C(0xedb88320) : 0);
    }
    return ~crc;
}

static bool has_name(const chunk *c, const char *name)
{
    return memcmp(c->at + NAME, name, DATA - NAME) == 0;
}

/* Read the chunk at an offset in the page. Returns false if the page ends inside the chunk, or if the chunk's CRC is
 * wrong. */
static bool read_chunk(page *p, size_t offset, chunk *c)
{
    if (offset + DATA + CRC_SIZE > p->size)
        return false;
    *c = (chunk){p->bytes + offset, load_big_endian(p->bytes + offset)};
    return c->size <= p->size - offset - DATA - CRC_SIZE && load_big_endian(c->at + DATA + c->size) == compute_crc(c);
}

/* Read the first page of a file, and return the file. If the file is not a PNG, closes the file and returns null.
 * `file` may be null. */
static FILE *open_at_first_page(FILE *file, page *p)
{
    p->size = file ? fread(p->bytes, 1, sizeof p->bytes, file) : 0;
    if (p->size >= sizeof signature && memcmp(p->bytes, signature, sizeof signature) == 0)
        return file;
    if (file)
        fclose(file);
    return NULL;
}

static FILE *open_png(const char *path, page *p)
{
    char ignored[FILE_REASON];
    return open_at_first_page(file_open(path, NULL, ignored), p);
}

/* Only regular files are opened: opening a pipe would block. */
static FILE *open_png_for_writing(const char *path, page *p)
{
    struct stat status;
    return open_at_first_page(stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "r+b") : NULL, p);
}

/* ---- Size ---------------------------------------------------------------------------------------------------- */

static bool has_png_end(FILE *file)
{
    static const uint8_t end[DATA + CRC_SIZE] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    uint8_t last[sizeof end];
    return fseek(file, -(long)sizeof last, SEEK_END) == 0 && fread(last, sizeof last, 1, file) == 1 &&
           memcmp(last, end, sizeof end) == 0;
}

static bool is_side(int length)
{
    return length >= 1 && length <= IMAGE_MAX_SIDE;
}

bool image_read_png_size(const char *path, int *width, int *height)
{
    page p;
    chunk c;
    FILE *file = open_png(path, &p);
    if (!file)
        return false;
    const bool found = read_chunk(&p, sizeof signature, &c) && has_name(&c, "IHDR") && c.size == 13;
    if (found) {
        *width = (int)load_big_endian(c.at + DATA);
        *height = (int)load_big_endian(c.at + DATA + 4);
    }
    const bool whole = found && is_side(*width) && is_side(*height) && has_png_end(file);
    fclose(file);
    return whole;
}

/* ---- Texts --------------------------------------------------------------------------------------------------- */

/* Find the text with this keyword; *c receives its chunk. Returns null if there is no such text. */
static uint8_t *find_text_chunk(page *p, const char *keyword, chunk *c)
{
    /* length of the keyword, including the zero byte that ends the keyword in the file */
    const size_t key = strlen(keyword) + 1;
    for (size_t at = sizeof signature; read_chunk(p, at, c) && !has_name(c, "IDAT"); at += DATA + c->size + CRC_SIZE)
        if (has_name(c, "tEXt") && key <= c->size && memcmp(c->at + DATA, keyword, key) == 0)
            return c->at + DATA + key;
    return NULL;
}

bool image_read_text(const char *path, const char *keyword, char *text, size_t size)
{
    page p;
    chunk c;
    FILE *file = open_png(path, &p);
    const uint8_t *found = file ? find_text_chunk(&p, keyword, &c) : NULL;
    if (found)
        snprintf(text, size, "%.*s", (int)(c.at + DATA + c.size - found), (const char *)found);
    if (file)
        fclose(file);
    return found;
}

/* The text and the chunk's CRC are adjacent and lie in one page of 4096 bytes, so that one write replaces both
 * atomically. */
static bool replace_text_in_page(FILE *file, page *p, const char *keyword, const char *text)
{
    chunk c;
    const size_t length = strlen(text);
    uint8_t *found = find_text_chunk(p, keyword, &c);
    if (!found || found + length != c.at + DATA + c.size)
        return false;
    memcpy(found, text, length);
    store_big_endian(found + length, compute_crc(&c));
    return fseek(file, (long)(found - p->bytes), SEEK_SET) == 0 &&
           fwrite(found, 1, length + CRC_SIZE, file) == length + CRC_SIZE;
}

bool image_replace_text(const char *path, const char *keyword, const char *text)
{
    page p;
    FILE *file = open_png_for_writing(path, &p);
    const bool replaced = file && replace_text_in_page(file, &p, keyword, text);
    return file && fclose(file) == 0 && replaced;
}
