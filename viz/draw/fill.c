/* fill.c - see fill.h. */
#include "fill.h"

#include <string.h>

#define CENTRE (QUAD_SUBPIXELS / 2)

static bool is_rectangle(const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    return (x[0] == x[3] && x[1] == x[2] && y[0] == y[1] && y[2] == y[3]) ||
           (x[0] == x[1] && x[2] == x[3] && y[1] == y[2] && y[3] == y[0]);
}

/* The sides 0-3 and 1-2 lie along `across`: one is the other, moved. */
static bool is_strip(const int32_t along[4], const int32_t across[4])
{
    const int32_t width = across[3] - across[0];
    return along[0] == along[3] && along[1] == along[2] && width == across[2] - across[1] && width > 0 &&
           width % QUAD_SUBPIXELS == 0;
}

static bool is_inside(const fill_target *to, const quad *q)
{
    const int32_t right = to->width * QUAD_SUBPIXELS, bottom = to->height * QUAD_SUBPIXELS;
    bool inside = true;
    for (int i = 0; i < 4; i++)
        inside &= q->x[i] >= 0 && q->y[i] >= 0 && q->x[i] <= right && q->y[i] <= bottom;
    return inside;
}

bool fill_takes(const fill_target *to, const quad *q)
{
    return is_rectangle(q) || (is_inside(to, q) && (is_strip(q->x, q->y) || is_strip(q->y, q->x)));
}

/* The first pixel whose centre is not before a coordinate: 0 to `size`. */
static int first_pixel(int32_t at, int size)
{
    if (at <= CENTRE)
        return 0;
    const int32_t pixel = (at - CENTRE + QUAD_SUBPIXELS - 1) / QUAD_SUBPIXELS;
    return pixel < size ? pixel : size;
}

static void fill_rectangle(const fill_target *to, const quad *q)
{
    const int32_t *x = q->x, *y = q->y;
    const int left = first_pixel(x[0] < x[2] ? x[0] : x[2], to->width);
    const int right = first_pixel(x[0] < x[2] ? x[2] : x[0], to->width);
    const int top = first_pixel(y[0] < y[2] ? y[0] : y[2], to->height);
    const int bottom = first_pixel(y[0] < y[2] ? y[2] : y[0], to->height);
    uint8_t *row = to->indices + (size_t)top * (size_t)to->width + left;
    for (int i = top; i < bottom && left < right; i++, row += to->width)
        memset(row, q->color, (size_t)(right - left));
}

/* An axis of the picture: its pixels, and the bytes from one to the next. */
typedef struct fill_axis {
    int size;
    ptrdiff_t step;
} fill_axis;

/* Quotient and remainder, rounded down. */
static int64_t divide(int64_t a, int64_t b, int64_t *rest)
{
    int64_t quotient = a / b;
    *rest = a % b;
    if (*rest < 0) {
        *rest += b;
        quotient--;
    }
    return quotient;
}

/* Step by step along one axis, a run of `width` pixels across. The lower edge runs from (a0, b0) to (a1, b1), a0 < a1;
 * at the centre of step i it is at P / Q pixels from the centre of pixel 0 across, with Q = 256 (a1 - a0). */
static void fill_strip(uint8_t *indices, uint8_t color, fill_axis along, fill_axis across, const int32_t a[2],
                       const int32_t b[2], int width, bool lower_is_in)
{
    const int64_t length = a[1] - a[0], rise = b[1] - b[0], whole = QUAD_SUBPIXELS * length;
    const int begin = first_pixel(a[0], along.size), end = first_pixel(a[1], along.size);
    const int64_t centre = (int64_t)begin * QUAD_SUBPIXELS + CENTRE;
    int64_t rest, more;
    int64_t at = divide((b[0] - CENTRE) * length + rise * (centre - a[0]), whole, &rest);
    const int64_t turn = divide(rise * QUAD_SUBPIXELS, whole, &more);
    uint8_t *step = indices + begin * along.step;
    for (int i = begin; i < end; i++, step += along.step) {
        const int64_t first = at + (rest > 0 || !lower_is_in);
        for (int64_t j = first < 0 ? 0 : first; j < first + width && j < across.size; j++)
            step[j * across.step] = color;
        at += turn;
        rest += more;
        if (rest >= whole) {
            rest -= whole;
            at++;
        }
    }
}

/* An edge that goes down to the right has what is below it on its left side: there its centres are not in. */
void fill_quad(const fill_target *to, const quad *q)
{
    const bool flat = is_strip(q->x, q->y);
    if (is_rectangle(q)) {
        fill_rectangle(to, q);
        return;
    }
    const int32_t *along = flat ? q->x : q->y, *across = flat ? q->y : q->x;
    const int first = along[0] > along[1], last = 1 - first;
    const int32_t a[2] = {along[first], along[last]}, b[2] = {across[first], across[last]};
    const fill_axis x = {to->width, 1}, y = {to->height, to->width};
    fill_strip(to->indices, q->color, flat ? x : y, flat ? y : x, a, b, (across[3] - across[0]) / QUAD_SUBPIXELS,
               !flat || b[1] <= b[0]);
}
