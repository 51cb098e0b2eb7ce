/* SPDX-License-Identifier: MIT */
/* contact_sheet.c - draws small copies of the pictures of evidence into contact.png.
 *
 * Each cell shows a picture as large as it fits. A pixel of the cell covers a rectangle of the picture. For expected
 * and actual pictures, the pixel has the mean color of the rectangle. For the difference, it has the color of the
 * brightest pixel: with the mean, one differing pixel of a large picture would fade to black. Decoding the PNG files
 * takes most of the time, so the pictures of a row are read and drawn on different cores. At most these are in memory.
 */
#include "contact_sheet.h"
#include "file.h"
#include "glyphs.h"
#include "lettering.h"
#include "parallel.h"
#include "png_read.h"
#include "png_write.h"

#include <stdlib.h>
#include <string.h>

enum {
    CELL_WIDTH = 320,
    CELL_HEIGHT = 180,
    GAP = 12,
    LINE = 18, /* height of a line of text, in pixels */
    HEAD = GAP + LINE + GAP / 2 + LINE,
    ROW = 2 * LINE + CELL_HEIGHT + 2 * GAP,
    COLUMNS = EVIDENCE_DIFFERENCE + 1, /* expected, actual and difference */
    WIDTH = COLUMNS * (CELL_WIDTH + GAP) + GAP,
    LETTERS = (WIDTH - 2 * GAP) / 8, /* number of characters that fit in a line of text */
};

static const image_color ground = {24, 29, 39}, cell_ground = {14, 17, 24}, text_color = {230, 234, 241},
                         faint_color = {152, 164, 184}, warm_color = {255, 178, 102};

/* ---- Drawing ------------------------------------------------------------------------------------------------- */

static void fill_rectangle(image *sheet, int x, int y, int width, int height, image_color color)
{
    for (int row = y; row < y + height; row++)
        for (int column = x; column < x + width; column++)
            memcpy(sheet->pixels + 3 * ((size_t)row * (size_t)sheet->width + (size_t)column),
                   (uint8_t[]){color.r, color.g, color.b}, 3);
}

/* Draw a text. A text of more than `most` characters is cut to this length and ends in dots. */
static void draw_text(image *sheet, int x, int y, size_t most, const char *text, image_color color)
{
    const glyph_set *face = &glyph_sets[FACE_8X16];
    const size_t length = strlen(text);
    for (size_t i = 0; i < length && i < most; i++) {
        const char letter = length > most && i + 3 >= most ? '.' : text[i];
        const unsigned at = (unsigned char)letter - (unsigned)GLYPH_FIRST;
        const unsigned n = at < GLYPH_COUNT ? at : '?' - GLYPH_FIRST;
        for (const glyph_part *part = face->parts + face->first[n]; part < face->parts + face->first[n + 1]; part++)
            fill_rectangle(sheet, x + (int)i * face->width + part->x, y + part->y, part->width, part->height, color);
    }
}

/* ---- Small pictures ------------------------------------------------------------------------------------------ */

/* What one pixel of a cell shows: a rectangle of the picture's pixels. */
typedef struct reduced_pixel {
    uint64_t sum[3], count; /* the sum of the rectangle's colors, and the number of its pixels, for the mean */
    image_color brightest;  /* for the difference */
} reduced_pixel;

/* Return the color of one pixel of a cell. With `brightest`, it is the color of the brightest pixel in the rectangle
 * of the picture; else it is the mean color of the rectangle, rounded to nearest. */
static image_color color_of_cell_pixel(const reduced_pixel *p, bool brightest)
{
    const uint64_t half = p->count / 2;
    return brightest ? p->brightest
                     : (image_color){(uint8_t)((p->sum[0] + half) / p->count), (uint8_t)((p->sum[1] + half) / p->count),
                                     (uint8_t)((p->sum[2] + half) / p->count)};
}

static void add_to_mean(reduced_pixel *p, const image_color *colors, int count)
{
    uint32_t r = 0, g = 0, b = 0;
    for (int i = 0; i < count; i++) {
        r += colors[i].r;
        g += colors[i].g;
        b += colors[i].b;
    }
    p->sum[0] += r;
    p->sum[1] += g;
    p->sum[2] += b;
    p->count += (uint64_t)count;
}

static void find_brightest(reduced_pixel *p, const image_color *colors, int count)
{
    int most = p->brightest.r + p->brightest.g + p->brightest.b;
    for (int i = 0; i < count; i++) {
        const int sum = colors[i].r + colors[i].g + colors[i].b;
        if (sum > most) {
            most = sum;
            p->brightest = colors[i];
        }
    }
}

/* A cell shows a reduced picture. Along one axis, `length` pixels of the picture are reduced to `across` pixels of
 * the cell. Find the pixels [*first, *end) of the picture that pixel `at` of the cell covers: at least one pixel. */
static void find_source_span(int at, int across, int length, int *first, int *end)
{
    *first = (int)((int64_t)at * length / across);
    *end = (int)((int64_t)(at + 1) * length / across);
    *end += *end == *first;
}

/* Reduce the rows `first` to `end` - 1 of a picture to `width` pixels of a cell: to their means, or their brightest
 * pixels. `colors` has room for a row. */
static void reduce_rows(const image *picture, int first, int end, bool brightest, image_color *colors,
                        reduced_pixel *reduced, int width)
{
    memset(reduced, 0, (size_t)width * sizeof *reduced);
    for (int y = first; y < end; y++) {
        image_read_row(picture, y, colors);
        for (int x = 0, from, to; x < width; x++) {
            find_source_span(x, width, picture->width, &from, &to);
            (brightest ? find_brightest : add_to_mean)(&reduced[x], colors + from, to - from);
        }
    }
}

/* Draw a picture, centered in its cell and as large as it fits. Return false if memory runs out. */
static bool draw_picture(image *sheet, int left, int top, const image *picture, evidence_picture kind)
{
    int width = CELL_WIDTH, height = (int)((int64_t)CELL_WIDTH * picture->height / picture->width);
    if (height > CELL_HEIGHT) {
        width = (int)((int64_t)CELL_HEIGHT * picture->width / picture->height);
        height = CELL_HEIGHT;
    }
    width += width == 0;
    height += height == 0;
    left += (CELL_WIDTH - width) / 2;
    top += (CELL_HEIGHT - height) / 2;
    image_color *colors = malloc((size_t)picture->width * sizeof *colors);
    if (!colors)
        return false;
    for (int y = 0, first, end; y < height; y++) {
        reduced_pixel reduced[CELL_WIDTH];
        find_source_span(y, height, picture->height, &first, &end);
        reduce_rows(picture, first, end, kind == EVIDENCE_DIFFERENCE, colors, reduced, width);
        for (int x = 0; x < width; x++)
            fill_rectangle(sheet, left + x, top + y, 1, 1,
                           color_of_cell_pixel(&reduced[x], kind == EVIDENCE_DIFFERENCE));
    }
    free(colors);
    return true;
}

/* ---- Rows ---------------------------------------------------------------------------------------------------- */

/* A row of the sheet: the pictures of the first frame of a group. */
typedef struct sheet_row {
    image *sheet;
    const diff_report *report;
    const frame_group *group;
    int top;
} sheet_row;

/* Draw one picture of a row. If the picture cannot be read, its cell stays empty; the other reports print the error.
 * The cells of a row are drawn in parallel. */
static void draw_cell(size_t kind, void *context)
{
    const sheet_row *row = context;
    const diff_report *report = row->report;
    const int left = GAP + (int)kind * (CELL_WIDTH + GAP), top = row->top + 2 * LINE;
    octreel_error ignored;
    image picture = {.width = 0};
    char *path = evidence_path(report->evidence, report->result, row->group->first, (evidence_picture)kind);
    fill_rectangle(row->sheet, left, top, CELL_WIDTH, CELL_HEIGHT, cell_ground);
    if (!path || !image_read_png(path, &picture, &ignored) ||
        !draw_picture(row->sheet, left, top, &picture, (evidence_picture)kind))
        draw_text(row->sheet, left + GAP, top + GAP, CELL_WIDTH / 8, "no picture", faint_color);
    image_release(&picture);
    free(path);
}

static void draw_row(image *sheet, const diff_report *report, const frame_group *group, int top)
{
    sheet_row row = {sheet, report, group, top};
    parallel_for(COLUMNS, draw_cell, &row);
    draw_text(sheet, GAP, top, LETTERS, group->frames, warm_color);
    draw_text(sheet, GAP, top + LINE, LETTERS, group->cause ? group->cause : group->difference, text_color);
}

static void draw_sheet(image *sheet, const diff_report *report, size_t failing)
{
    const char *headline = report->why->headline;
    /* one character more than a line shows, so that draw_text() notices a text that must be cut */
    char line[LETTERS + 2];
    size_t row = 0;
    snprintf(line, sizeof line, "%s%s%s", report->groups->verdict, headline ? ": " : "", headline ? headline : "");
    draw_text(sheet, GAP, GAP, LETTERS, line, text_color);
    for (int i = 0; i < COLUMNS; i++)
        draw_text(sheet, GAP + i * (CELL_WIDTH + GAP), GAP + LINE + GAP / 2, 40,
                  evidence_picture_name((evidence_picture)i), faint_color);
    for (size_t i = 0; i < report->groups->count && row < CONTACT_SHEET_ROWS; i++)
        if (frame_group_fails(&report->groups->groups[i], report->result))
            draw_row(sheet, report, &report->groups->groups[i], HEAD + GAP + (int)row++ * ROW);
    snprintf(line, sizeof line, "and %zu more", failing - row);
    if (failing > row)
        draw_text(sheet, GAP, HEAD + GAP + (int)row * ROW, LETTERS, line, faint_color);
}

bool contact_sheet_write(const diff_report *report, octreel_error *error)
{
    const size_t failing = frame_groups_count_failing(report->groups, report->result);
    const size_t rows = failing < CONTACT_SHEET_ROWS ? failing : CONTACT_SHEET_ROWS;
    image sheet;
    if (failing == 0)
        return true;
    if (!image_create(&sheet, WIDTH, HEAD + GAP + (int)rows * ROW + (failing > rows ? LINE + GAP : 0), 3))
        return error_no_memory(error);
    fill_rectangle(&sheet, 0, 0, sheet.width, sheet.height, ground);
    draw_sheet(&sheet, report, failing);
    char *path = path_join(report->evidence->folder, CONTACT_SHEET);
    const bool ok = path ? image_write_png(&sheet, path, NULL, 0, error) : error_no_memory(error);
    image_release(&sheet);
    free(path);
    return ok;
}
