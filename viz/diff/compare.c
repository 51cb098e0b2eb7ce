/* compare_pair.c - see compare_pair.h. */
#include "compare_pair.h"
#include "digest_file.h"
#include "row_reader.h"
#include "same_bytes.h"

#include <string.h>

bool compare_bytes(diff_pair *pair)
{
    octreel_error error;
    bool ends;
    frame_digest about = {0};
    if (!pair->a->path || !pair->b->path || !same_bytes(pair->a->path, pair->b->path) ||
        !image_read_png_ends(pair->a->path, &about.width, &about.height, &ends, &error) || !ends)
        return false; /* two equal halves of a picture are no picture: its reader shall tell */
    pair->about[0] = pair->about[1] = about;
    pair->finding = FOUND_SAME_BYTES;
    return true;
}

static void find_unreadable(diff_pair *pair, const octreel_error *error)
{
    pair->finding = FOUND_UNREADABLE;
    pair->trouble = strdup(error->text); /* without memory there is no sentence: reports can do without */
}

/* Both pictures, and what is counted in them. */
typedef struct both {
    row_reader readers[2];
    const image *about[2]; /* null: it cannot be read */
    image_tolerance tolerance;
    image_difference difference;
} both;

/* Both are read to their ends, compared or not: only then are they known to be pictures. Of two troubles the first
 * side's is told; where it has one, the other side does not matter any more. */
static void compare_rows(both *b)
{
    image of[2];
    bool more[2] = {true, true};
    for (int i = 0; i < 2; i++)
        b->about[i] = row_reader_about(&b->readers[i]);
    const bool opened = b->about[0] && b->about[1];
    image_comparison c = {0};
    if (opened)
        c = image_comparison_begin(b->about[0], b->about[1], &b->tolerance);
    while (!row_reader_trouble(&b->readers[0]) && (more[0] || more[1])) {
        for (int i = 0; i < 2; i++)
            more[i] = row_reader_next(&b->readers[i], &of[i]);
        if (opened && c.difference.same_size && more[0] && more[1])
            image_comparison_add(&c, &of[0], &of[1]);
    }
    b->difference = image_comparison_end(&c);
}

static void judge(diff_pair *pair, const both *b)
{
    pair->difference = b->difference;
    pair->transparent = b->about[0]->transparent || b->about[1]->transparent;
    for (int i = 0; i < 2; i++)
        pair->about[i] = (frame_digest){.width = b->about[i]->width, .height = b->about[i]->height};
    if (!pair->difference.same_size)
        pair->finding = FOUND_SIZE;
    else if (image_same(&pair->difference))
        pair->finding = FOUND_SAME_PIXELS;
    else if (image_forgiven(&pair->difference, &b->tolerance))
        pair->finding = FOUND_WITHIN;
    else
        pair->finding = FOUND_PIXELS;
}

/* What anti-aliasing explains is seen in the rows above and below: then both pictures are held whole. */
static void compare_pictures(diff_pair *pair, const diff_options *options)
{
    both b = {.tolerance = options->tolerance};
    b.tolerance.ignored = pair->ignored;
    b.tolerance.ignored_count = pair->ignored_count;
    row_reader_start(&b.readers[1], pair->b->path, options->background, b.tolerance.antialias, true);
    row_reader_start(&b.readers[0], pair->a->path, options->background, b.tolerance.antialias, false);
    compare_rows(&b);
    const octreel_error *trouble = row_reader_trouble(&b.readers[0]);
    trouble = trouble ? trouble : row_reader_trouble(&b.readers[1]);
    if (trouble)
        find_unreadable(pair, trouble);
    else
        judge(pair, &b);
    row_reader_stop(&b.readers[0]);
    row_reader_stop(&b.readers[1]);
}

static void compare_digests(diff_pair *pair, const diff_options *options)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    octreel_error error;
    for (int i = 0; i < 2; i++) {
        pair->about[i] = frames[i]->digest;
        if (frames[i]->path && !digest_frame(frames[i]->path, options->background, &pair->about[i], &error)) {
            find_unreadable(pair, &error);
            return;
        }
    }
    const frame_digest *a = &pair->about[0], *b = &pair->about[1];
    if (a->width != b->width || a->height != b->height)
        pair->finding = FOUND_SIZE;
    else
        pair->finding = a->pixels == b->pixels ? FOUND_SAME_PIXELS : FOUND_DIGEST;
}

void compare_pixels(diff_pair *pair, const diff_options *options)
{
    if (pair->a->path && pair->b->path)
        compare_pictures(pair, options);
    else
        compare_digests(pair, options);
}
