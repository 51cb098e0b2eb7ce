/* compare.c - one pair of frames. */
#include "compare.h"
#include "digest_file.h"
#include "file.h"
#include "png_chunks.h"
#include "png_read.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool compare_bytes(diff_pair *pair)
{
    frame_digest about = {0};
    if (!pair->a->path || !pair->b->path || !same_bytes(pair->a->path, pair->b->path) ||
        !image_png_size(pair->a->path, &about.width, &about.height))
        return false; /* equal, and cut short: let the PNG reader say what is wrong */
    pair->about[0] = pair->about[1] = about;
    pair->finding = FOUND_SAME_BYTES;
    return true;
}

static void find_unreadable(diff_pair *pair, const octreel_error *error)
{
    pair->finding = FOUND_UNREADABLE;
    pair->trouble = strdup(error->text); /* null without memory: reports say so */
}

/* ---- Pictures, a band of rows at a time ---------------------------------------------------------------------- */

/* A picture while it is read in bands of rows. */
typedef struct reading {
    image_source *source; /* null: it cannot be read */
    int rows;             /* of a band */
    octreel_error error;
} reading;

/* Judging anti-aliasing looks at the rows above and below, so the picture is then held whole. */
static void open_reading(reading *r, const char *path, const diff_options *options)
{
    r->source = image_source_open(path, options->background, options->tolerance.antialias, &r->error);
    if (!r->source)
        return;
    const image *about = image_source_about(r->source);
    r->rows = options->tolerance.antialias ? about->height : image_band_rows(about);
}

static void close_reading(reading *r)
{
    image_source_close(r->source);
}

static bool failed(const reading *r)
{
    return !r->source || image_source_failed(r->source);
}

static bool next_rows(reading *r, image *band)
{
    return r->source && image_source_next(r->source, r->rows, band);
}

/* Both are read to their ends even when they are not compared, since an error may come late. An error of the first is
 * the one that is reported, so it ends the loop. */
static image_difference compare_rows(reading of[2], const image_tolerance *tolerance)
{
    const bool opened = of[0].source && of[1].source;
    image_comparison c = {0};
    image bands[2];
    bool more[2] = {true, true};
    if (opened)
        c = image_comparison_begin(image_source_about(of[0].source), image_source_about(of[1].source), tolerance);
    while (!failed(&of[0]) && (more[0] || more[1])) {
        for (int i = 0; i < 2; i++)
            more[i] = next_rows(&of[i], &bands[i]);
        if (opened && c.difference.same_size && more[0] && more[1])
            image_comparison_add(&c, &bands[0], &bands[1]);
    }
    return image_comparison_end(&c);
}

static void judge(diff_pair *pair, const reading of[2], const image_tolerance *tolerance)
{
    for (int i = 0; i < 2; i++) {
        const image *about = image_source_about(of[i].source);
        pair->about[i] = (frame_digest){.width = about->width, .height = about->height};
        pair->transparent = pair->transparent || about->transparent;
    }
    if (!pair->difference.same_size)
        pair->finding = FOUND_SIZE;
    else if (image_same(&pair->difference))
        pair->finding = FOUND_SAME_PIXELS;
    else if (image_forgiven(&pair->difference, tolerance))
        pair->finding = FOUND_WITHIN;
    else
        pair->finding = FOUND_PIXELS;
}

static void compare_pictures(diff_pair *pair, const diff_options *options)
{
    reading of[2] = {{0}, {0}};
    image_tolerance tolerance;
    for (int i = 0; i < 2; i++)
        open_reading(&of[i], i ? pair->b->path : pair->a->path, options);
    if (!pair_tolerance(pair, options, &tolerance)) {
        error_no_memory(&of[0].error);
        find_unreadable(pair, &of[0].error);
    } else {
        pair->difference = compare_rows(of, &tolerance);
        if (failed(&of[0]) || failed(&of[1]))
            find_unreadable(pair, &of[failed(&of[0]) ? 0 : 1].error);
        else
            judge(pair, of, &tolerance);
    }
    pair_tolerance_release(&tolerance);
    close_reading(&of[0]);
    close_reading(&of[1]);
}

/* ---- Digests ------------------------------------------------------------------------------------------------- */

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
