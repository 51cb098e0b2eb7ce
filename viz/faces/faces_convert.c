/* SPDX-License-Identifier: MIT */
/* faces_convert.c - run by the build: reads console fonts (PSF, version 1 or 2, compressed or not), in the order of
 * FACE_MAP, and writes their ASCII letters as rectangles.
 *   faces_convert GLYPHS_C FONT... */
#include "glyphs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MOST_WIDTH = 16, MOST_HEIGHT = 32, MOST_BYTES = 1 << 20, PSF2_HEADER = 32 };

/* A font's file, and where its glyphs lie in it: rows of whole bytes, the highest bit at the left. */
typedef struct font {
    unsigned char bytes[MOST_BYTES];
    unsigned size, at, count, each, width, height;
} font;

typedef struct bitmap {
    unsigned char set[MOST_HEIGHT][MOST_WIDTH];
    int width, height;
} bitmap;

static void stop(const char *path, const char *what)
{
    fprintf(stderr, "faces_convert: %s %s\n", path, what);
    exit(2);
}

static unsigned little_endian(const unsigned char *bytes)
{
    return bytes[0] | (unsigned)bytes[1] << 8 | (unsigned)bytes[2] << 16 | (unsigned)bytes[3] << 24;
}

static void read_header(font *f, const char *path)
{
    const unsigned char *b = f->bytes;
    if (f->size >= PSF2_HEADER && memcmp(b, "\x72\xb5\x4a\x86", 4) == 0) {
        f->at = little_endian(b + 8);
        f->count = little_endian(b + 16);
        f->each = little_endian(b + 20);
        f->height = little_endian(b + 24);
        f->width = little_endian(b + 28);
    } else if (f->size >= 4 && memcmp(b, "\x36\x04", 2) == 0) {
        f->at = 4;
        f->count = b[2] & 1 ? 512 : 256;
        f->each = f->height = b[3];
        f->width = 8;
    } else {
        stop(path, "is no console font (PSF)");
    }
}

static void read_font(font *f, const char *path)
{
    gzFile in = gzopen(path, "rb");
    const int size = in ? gzread(in, f->bytes, MOST_BYTES) : -1;
    if (in)
        gzclose(in);
    if (size < 0)
        stop(path, "cannot be read");
    f->size = (unsigned)size;
    read_header(f, path);
    if (f->width > MOST_WIDTH || f->height > MOST_HEIGHT || f->each == 0 || f->each != (f->width + 7) / 8 * f->height)
        stop(path, "has letters of a size that there is no room for");
    if (f->count < GLYPH_FIRST + GLYPH_COUNT || f->at > f->size || (f->size - f->at) / f->each < f->count)
        stop(path, "ends too early");
}

static bitmap glyph_of(const font *f, unsigned letter)
{
    bitmap b = {.width = (int)f->width, .height = (int)f->height};
    const unsigned row_bytes = (f->width + 7) / 8;
    for (unsigned y = 0; y < f->height; y++)
        for (unsigned x = 0; x < f->width; x++)
            b.set[y][x] = f->bytes[f->at + letter * f->each + y * row_bytes + x / 8] >> (7 - x % 8) & 1;
    return b;
}

/* How many pixels are set to the right of one, `most` at most. */
static int run_of(const bitmap *b, int x, int y, int most)
{
    int run = 0;
    while (run < most && x + run < b->width && b->set[y][x + run])
        run++;
    return run;
}

/* The largest rectangle of set pixels whose top left corner is here. */
static glyph_part largest_at(const bitmap *b, int x, int y)
{
    glyph_part best = {0};
    int width = b->width;
    for (int bottom = y; bottom < b->height; bottom++) {
        width = run_of(b, x, bottom, width);
        const int height = bottom - y + 1;
        if (width * height > best.width * best.height)
            best = (glyph_part){(uint8_t)x, (uint8_t)y, (uint8_t)width, (uint8_t)height};
    }
    return best;
}

/* Take the largest rectangle out of a glyph; one of width 0 when nothing is set. */
static glyph_part take_largest(bitmap *b)
{
    glyph_part best = {0};
    for (int y = 0; y < b->height; y++)
        for (int x = 0; x < b->width; x++) {
            const glyph_part part = largest_at(b, x, y);
            if (part.width * part.height > best.width * best.height)
                best = part;
        }
    for (int y = best.y; y < best.y + best.height; y++)
        memset(&b->set[y][best.x], 0, best.width);
    return best;
}

/* Write the parts of a face, and note where each letter's begin. */
static void write_parts(FILE *out, const font *f, unsigned face, unsigned first[GLYPH_COUNT + 1])
{
    unsigned count = 0;
    fprintf(out, "static const glyph_part parts_%u[] = {\n", face);
    for (unsigned i = 0; i < GLYPH_COUNT; i++) {
        bitmap b = glyph_of(f, GLYPH_FIRST + i);
        first[i] = count;
        for (glyph_part p = take_largest(&b); p.width; p = take_largest(&b), count++)
            fprintf(out, "{%d, %d, %d, %d},\n", p.x, p.y, p.width, p.height);
    }
    first[GLYPH_COUNT] = count;
    fprintf(out, "};\n");
}

static void write_set(FILE *out, const char *path, unsigned face, char *sets, size_t room)
{
    static font f;
    unsigned first[GLYPH_COUNT + 1];
    size_t used = strlen(sets);
    read_font(&f, path);
    write_parts(out, &f, face, first);
    used += (size_t)snprintf(sets + used, room - used, "{%u, %u, parts_%u, {", f.width, f.height, face);
    for (int i = 0; i <= GLYPH_COUNT; i++)
        used += (size_t)snprintf(sets + used, room - used, "%u,%s", first[i], i % 16 == 15 ? "\n" : " ");
    snprintf(sets + used, room - used, "}},\n");
}

int main(int argc, char **argv)
{
    static char sets[1 << 16];
    FILE *out = argc > 2 ? fopen(argv[1], "w") : NULL;
    if (!out)
        stop(argc > 1 ? argv[1] : "", "cannot be written");
    fprintf(out, "/* Made by faces_convert of the fonts of Spleen; see viz/THIRD-PARTY. */\n#include \"glyphs.h\"\n\n");
    for (int i = 2; i < argc; i++)
        write_set(out, argv[i], (unsigned)i - 2, sets, sizeof sets);
    fprintf(out, "const glyph_set glyph_sets[] = {\n%s};\n", sets);
    if (ferror(out) || fclose(out) != 0)
        stop(argv[1], "cannot be written");
    return 0;
}
