/* SPDX-License-Identifier: MIT */
/* lettering.c - chooses a face (bitmap font) for the height of a picture; see lettering.h. */
#include "lettering.h"

#include <stddef.h>

/* One row for each range of picture heights, as view_height_at_16_9() returns them. Larger faces have more space
 * between lines. */
static const struct lettering_row {
    int from; /* the least picture height of the row's range */
    text_face text;
    int leading;
    text_face title;
    int title_multiple;
} rows[] = {
    {0, FACE_5X8, 1, FACE_8X16, 1},      {300, FACE_6X12, 1, FACE_12X24, 1},   {600, FACE_8X16, 3, FACE_16X32, 1},
    {900, FACE_12X24, 4, FACE_12X24, 2}, {1280, FACE_16X32, 6, FACE_16X32, 2},
};

/* At a picture height of MULTIPLIED pixels or more, face 12x24 is used. It is enlarged by the factor height /
 * LINES_A_MULTIPLE, rounded to the nearest integer. */
enum { MULTIPLIED = 1700, LINES_A_MULTIPLE = 1080, MULTIPLE_LEADING = 4 };

static lettering make_lettering(text_face face, int multiple, int leading)
{
#define FACE_SIZE(width, height) {width, height},
    static const int sizes[FACE_COUNT][2] = {FACE_MAP(FACE_SIZE)};
#undef FACE_SIZE
    const int width = sizes[face][0] * multiple, height = sizes[face][1] * multiple;
    return (lettering){face, multiple, width, height, height + leading * multiple};
}

lettering lettering_choose(const view *v, bool title)
{
    const int height = view_height_at_16_9(v);
    size_t row = sizeof rows / sizeof rows[0] - 1;
    if (height >= MULTIPLIED) {
        const int multiple = (height + LINES_A_MULTIPLE / 2) / LINES_A_MULTIPLE;
        return make_lettering(FACE_12X24, title ? 2 * multiple : multiple, MULTIPLE_LEADING);
    }
    while (height < rows[row].from)
        row--;
    return title ? make_lettering(rows[row].title, rows[row].title_multiple, 0)
                 : make_lettering(rows[row].text, 1, rows[row].leading);
}
