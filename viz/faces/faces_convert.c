/* SPDX-License-Identifier: MIT */
/* faces_convert.c - writes the glyphs of console fonts as C source; the build runs it. Usage: faces_convert GLYPHS_C
 * FONT...
 *
 * The fonts are PSF files, version 1 or 2, compressed or not, in the order of FACE_MAP. The program writes the glyphs
 * of their ASCII characters as rectangles. */
#include "glyphs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MOST_FACES = 16, MOST_WIDTH = 16, MOST_HEIGHT = 32, MOST_BYTES = 1 << 20, PSF2_HEADER = 32 };

/* The bytes of a font file, and the offset of its glyphs in the file. Each row of a glyph takes a whole number of
 * bytes. The highest bit of a row's first byte is the leftmost pixel. */
typedef struct font {
    unsigned char bytes[MOST_BYTES];
    unsigned size, at, count, each, width, height;
} font;

typedef struct bitmap {
    unsigned char set[MOST_HEIGHT][MOST_WIDTH];
    int width, height;
} bitmap;

static void stop_with_error(const char *path, const char *what)
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
        stop_with_error(path, "is not a console font (PSF)");
    }
}

/* Replaces some letters of 12 x 24 pixels by our own drawings. Release 2.2 of the font Spleen moved these letters to
 * the left, so they differ between releases. */
static void replace_letters(font *f)
{
    static const struct {
        unsigned letter;
        unsigned char rows[48];
    } own[] = {{'<', {0,    0, 0,   0, 0, 0, 0, 0, 0, 0x60, 0, 0xc0, 1, 0x80, 3, 0, 6, 0, 0xc, 0, 0x18, 0, 0x30, 0,
                      0x18, 0, 0xc, 0, 6, 0, 3, 0, 1, 0x80, 0, 0xc0, 0, 0x60, 0, 0, 0, 0, 0,   0, 0,    0, 0,    0}},
               {'}', {0, 0,    0x3c, 0,    6, 0, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 1,    0x80, 0, 0xe0,
                      0, 0xe0, 1,    0x80, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 3, 0, 6, 0, 0x3c, 0,    0, 0}}};
    for (size_t i = 0; f->width == 12 && f->height == 24 && i < sizeof own / sizeof *own; i++)
        memcpy(f->bytes + f->at + own[i].letter * f->each, own[i].rows, sizeof own[i].rows);
}

/* Stops the program if the font is Spleen and its letters differ from the letters of earlier frames. With other
 * letters, the pixels of all frames would change. */
static void check_letters(const font *f, const char *path)
{
    static const struct {
        unsigned width, height;
        unsigned long digest; /* the CRC-32 of the rows of the letters */
    } faces[] = {
        {5, 8, 0x9a1c850}, {6, 12, 0xd90cbb7}, {8, 16, 0x15c4e5c3}, {12, 24, 0xd3b4d4a5}, {16, 32, 0x80deb6f3}};
    const unsigned long digest = crc32(0, f->bytes + f->at + GLYPH_FIRST * f->each, GLYPH_COUNT * f->each);
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++)
        if (faces[i].width == f->width && faces[i].height == f->height && faces[i].digest != digest)
            stop_with_error(path,
                            "has glyphs that differ from those in Octreel's frames; download Spleen 2.1.0 from "
                            "https://github.com/fcambus/spleen/releases and configure with -DOCTREEL_FONTS=FOLDER");
}

static void read_font(font *f, const char *path)
{
    gzFile in = gzopen(path, "rb");
    const int size = in ? gzread(in, f->bytes, MOST_BYTES) : -1;
    if (in)
        gzclose(in);
    if (size < 0)
        stop_with_error(path, "cannot be read");
    f->size = (unsigned)size;
    read_header(f, path);
    if (f->width > MOST_WIDTH || f->height > MOST_HEIGHT || f->each == 0 || f->each != (f->width + 7) / 8 * f->height)
        stop_with_error(path, "has letters larger than 16 x 32 pixels or of a wrong size");
    if (f->count < GLYPH_FIRST + GLYPH_COUNT || f->at > f->size || (f->size - f->at) / f->each < f->count)
        stop_with_error(path, "is truncated, or has too few glyphs");
    replace_letters(f);
    check_letters(f, path);
}

static bitmap find_glyph(const font *f, unsigned letter)
{
    bitmap b = {.width = (int)f->width, .height = (int)f->height};
    const unsigned row_bytes = (f->width + 7) / 8;
    for (unsigned y = 0; y < f->height; y++)
        for (unsigned x = 0; x < f->width; x++)
            b.set[y][x] = f->bytes[f->at + letter * f->each + y * row_bytes + x / 8] >> (7 - x % 8) & 1;
    return b;
}

/* Returns the number of successive set pixels that begin at (x, y) and go to the right. The result is at most
 * `most`. */
static int find_run_length(const bitmap *b, int x, int y, int most)
{
    int run = 0;
    while (run < most && x + run < b->width && b->set[y][x + run])
        run++;
    return run;
}

/* Returns the largest rectangle of set pixels whose top left corner is (x, y). */
static glyph_part find_largest_rectangle_at(const bitmap *b, int x, int y)
{
    glyph_part best = {0};
    int width = b->width;
    for (int bottom = y; bottom < b->height; bottom++) {
        width = find_run_length(b, x, bottom, width);
        const int height = bottom - y + 1;
        if (width * height > best.width * best.height)
            best = (glyph_part){(uint8_t)x, (uint8_t)y, (uint8_t)width, (uint8_t)height};
    }
    return best;
}

/* Find the largest rectangle of set pixels, clear its pixels and return the rectangle. If no pixel is set, the
 * rectangle has the width 0. */
static glyph_part remove_largest_rectangle(bitmap *b)
{
    glyph_part best = {0};
    for (int y = 0; y < b->height; y++)
        for (int x = 0; x < b->width; x++) {
            const glyph_part part = find_largest_rectangle_at(b, x, y);
            if (part.width * part.height > best.width * best.height)
                best = part;
        }
    for (int y = best.y; y < best.y + best.height; y++)
        memset(&b->set[y][best.x], 0, best.width);
    return best;
}

/* A face: the size of its glyph cells in pixels, and for each glyph the index of its first rectangle. The last entry
 * of `first` is the number of all rectangles. */
typedef struct face {
    unsigned width, height, first[GLYPH_COUNT + 1];
} face;

/* Write the rectangles of all glyphs of a font. */
static face write_parts(FILE *out, const font *f, int number)
{
    face made = {.width = f->width, .height = f->height};
    unsigned count = 0;
    fprintf(out, "static const glyph_part parts_%d[] = {\n", number);
    for (unsigned i = 0; i < GLYPH_COUNT; i++) {
        bitmap b = find_glyph(f, GLYPH_FIRST + i);
        made.first[i] = count;
        for (glyph_part p = remove_largest_rectangle(&b); p.width; p = remove_largest_rectangle(&b), count++)
            fprintf(out, "{%d, %d, %d, %d},\n", p.x, p.y, p.width, p.height);
    }
    made.first[GLYPH_COUNT] = count;
    fprintf(out, "};\n");
    return made;
}

int main(int argc, char **argv)
{
    static font f;
    static face faces[MOST_FACES];
    if (argc < 3 || argc - 2 > MOST_FACES)
        stop_with_error("arguments:", "expected an output file and 1 to 16 fonts");
    FILE *out = fopen(argv[1], "w");
    if (!out)
        stop_with_error(argv[1], "cannot be written");
    fprintf(out, "/* Made by faces_convert of the fonts of Spleen; see viz/THIRD-PARTY. */\n#include \"glyphs.h\"\n\n");
    for (int i = 0; i < argc - 2; i++) {
        read_font(&f, argv[i + 2]);
        faces[i] = write_parts(out, &f, i);
    }
    fprintf(out, "const glyph_set glyph_sets[] = {\n");
    for (int i = 0; i < argc - 2; i++) {
        fprintf(out, "{%u, %u, parts_%d, {", faces[i].width, faces[i].height, i);
        for (int j = 0; j <= GLYPH_COUNT; j++)
            fprintf(out, "%u,%s", faces[i].first[j], j % 16 == 15 ? "\n" : " ");
        fprintf(out, "}},\n");
    }
    fprintf(out, "};\n");
    if (ferror(out) || fclose(out) != 0)
        stop_with_error(argv[1], "cannot be written");
    return 0;
}
