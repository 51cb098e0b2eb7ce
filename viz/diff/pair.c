/* SPDX-License-Identifier: MIT */
/* pair.c - compares two frames: first the bytes of their files, then their pixels or digests. */
#include "pair.h"
#include "file.h"
#include "flip.h"
#include "png_chunks.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    diff_verdict verdict;
} findings[] = {
#define FINDING_ENTRY(name, text, verdict) {text, verdict},
    DIFF_FINDING_MAP(FINDING_ENTRY)
#undef FINDING_ENTRY
};

const char *diff_finding_name(diff_finding finding)
{
    return findings[finding].name;
}

diff_verdict diff_finding_verdict(diff_finding finding)
{
    return findings[finding].verdict;
}

diff_options diff_options_default(void)
{
    return (diff_options){.background = IMAGE_WHITE, .tolerance.pixels_per_degree = FLIP_PIXELS_PER_DEGREE};
}

const char *diff_pair_name(const diff_pair *pair)
{
    return pair->b ? pair->b->name : pair->a->name;
}

bool diff_is_exact(const diff_options *options)
{
    return tolerance_is_exact(&options->tolerance) && !options->ignored_layers;
}

static bool is_rule_applied(const diff_pair *pair)
{
    return pair->effect == RULE_FORGAVE || pair->effect == RULE_EXCEEDED;
}

bool pair_is_exact(const diff_pair *pair, const diff_options *options)
{
    return diff_is_exact(options) && !pair->rule;
}

bool pair_tolerance(const diff_pair *pair, const diff_options *options, image_tolerance *tolerance)
{
    *tolerance = options->tolerance;
    if (is_rule_applied(pair))
        tolerance_widen(tolerance, &pair->rule->tolerance);
    tolerance->ignored_mask = mask_unpack(&pair->mask);
    return tolerance->ignored_mask || !pair->mask.runs;
}

void pair_tolerance_release(image_tolerance *tolerance)
{
    free((void *)tolerance->ignored_mask);
}

bool compare_bytes(diff_pair *pair)
{
    frame_digest about = {0};
    if (!pair->a->path || !pair->b->path || !have_same_bytes(pair->a->path, pair->b->path) ||
        !image_read_png_size(pair->a->path, &about.width, &about.height))
        return false; /* the files differ, so pixels or digests decide */
    pair->about[0] = pair->about[1] = about;
    pair->finding = FOUND_SAME_BYTES;
    return true;
}

bool has_picture(const diff_frame *frame)
{
    return frame->pixels || frame->path;
}

void set_unreadable(diff_pair *pair, const octreel_error *error)
{
    octreel_error ignored;
    pair->lacks_resources = !check_system_resources(&ignored);
    pair->finding = FOUND_UNREADABLE;
    pair->trouble = strdup(error->text); /* if strdup() fails, reports print "out of memory" */
}

/* ---- Pictures, a band of rows at a time ---------------------------------------------------------------------- */

/* A picture that is read one band of rows at a time, from a file or from memory. */
typedef struct reading {
    image_source *source; /* null if the picture is in memory or cannot be read */
    const image *about;   /* the picture's description; null if the picture cannot be read */
    bool in_memory;       /* true: `about` has the pixels */
    int rows;             /* the number of rows of a band */
    int next_y;           /* for a picture in memory, the first row of the next band */
    octreel_error error;
} reading;

/* Open a picture. With --antialias or --flip the band is the whole picture, because recognizing anti-aliasing and
 * measuring FLIP need the rows above and below each row. */
static void open_reading(reading *r, const diff_frame *frame, const image_tolerance *tolerance, image_color background)
{
    const bool whole = tolerance->antialias || tolerance->flip;
    r->about = frame->pixels;
    r->in_memory = frame->pixels;
    if (!r->in_memory)
        r->source = image_source_open(frame->path, background, whole, &r->error);
    if (r->source)
        r->about = image_source_description(r->source);
    if (r->about)
        r->rows = whole ? r->about->height : image_find_band_height(r->about);
}

static bool has_failed(const reading *r)
{
    return !r->about || (r->source && image_source_has_failed(r->source));
}

static void fail_reading(reading *r)
{
    error_no_memory(&r->error);
    image_source_close(r->source);
    r->source = NULL;
    r->about = NULL;
}

static bool read_next_rows(reading *r, image *band)
{
    if (!r->in_memory)
        return r->source && image_source_read_band(r->source, r->rows, band);
    const int left = r->about->height - r->next_y;
    *band = *r->about;
    band->height = left < r->rows ? left : r->rows;
    band->pixels += (size_t)r->next_y * (size_t)band->width * image_pixel_size(band);
    r->next_y += band->height;
    return left > 0;
}

/* Add a band of both pictures. With --flip the band is the whole picture. Return false if memory runs out. */
static bool compare_band(image_comparison *c, const image bands[2])
{
    image_difference *d = &c->difference;
    image_compare_band(c, &bands[0], &bands[1]);
    d->has_flip = c->tolerance->flip && d->unlike.pixels > 0;
    return !d->has_flip || image_measure_flip(&bands[0], &bands[1], c->tolerance, NULL, &d->flip);
}

/* Compare two pictures. Both pictures are read to the end even if their sizes differ, because a later part of a file
 * may be damaged. An error in the first picture ends the loop and is reported. */
static image_difference compare_rows(reading of[2], const image_tolerance *tolerance)
{
    const bool opened = of[0].about && of[1].about;
    image_comparison c = {0};
    image bands[2];
    bool more[2] = {true, true};
    if (opened)
        c = image_begin_comparison(of[0].about, of[1].about, tolerance);
    while (!has_failed(&of[0]) && (more[0] || more[1])) {
        for (int i = 0; i < 2; i++)
            more[i] = read_next_rows(&of[i], &bands[i]);
        if (opened && c.difference.same_size && more[0] && more[1] && !compare_band(&c, bands))
            fail_reading(&of[0]);
    }
    return image_end_comparison(&c);
}

static void set_finding(diff_pair *pair, const reading of[2], const image_tolerance *tolerance)
{
    for (int i = 0; i < 2; i++) {
        const image *about = of[i].about;
        pair->about[i] = (frame_digest){.width = about->width, .height = about->height};
        pair->transparent = pair->transparent || about->transparent;
    }
    pair->other_color_space = of[0].about->color_space != of[1].about->color_space;
    if (!pair->difference.same_size)
        pair->finding = FOUND_SIZE;
    else if (image_has_no_difference(&pair->difference))
        pair->finding = FOUND_SAME_PIXELS;
    else if (image_is_within_tolerance(&pair->difference, tolerance))
        pair->finding = FOUND_WITHIN;
    else
        pair->finding = FOUND_PIXELS;
}

static void compare_pictures(diff_pair *pair, const diff_options *options)
{
    reading of[2] = {{0}, {0}};
    image_tolerance tolerance;
    const bool ok = pair_tolerance(pair, options, &tolerance);
    for (int i = 0; i < 2; i++)
        open_reading(&of[i], i ? pair->b : pair->a, &tolerance, options->background);
    if (!ok) {
        error_no_memory(&of[0].error);
        set_unreadable(pair, &of[0].error);
    } else {
        pair->difference = compare_rows(of, &tolerance);
        if (has_failed(&of[0]) || has_failed(&of[1]))
            set_unreadable(pair, &of[has_failed(&of[0]) ? 0 : 1].error);
        else
            set_finding(pair, of, &tolerance);
    }
    pair_tolerance_release(&tolerance);
    image_source_close(of[0].source);
    image_source_close(of[1].source);
}

/* ---- Digests ------------------------------------------------------------------------------------------------- */

/* The digests of one frame. A picture has one digest; a frame of a baseline has all its variants. */
typedef struct known_digests {
    frame_digest newest; /* the digest of the picture, or the newest variant of the requested kind */
    const frame_digest *list;
    size_t count;
} known_digests;

static bool digest_frame(const diff_frame *frame, image_color background, frame_digest *digest, octreel_error *error)
{
    const image *pixels = frame->pixels;
    if (!pixels)
        return digest_picture(frame->path, background, digest, error);
    *digest = (frame_digest){.pixels = image_digest_with(digest->kind, pixels),
                             .width = pixels->width,
                             .height = pixels->height,
                             .kind = digest->kind};
    return true;
}

/* Collect the digests of a frame. Return false with an error if the picture cannot be read. Return false without an
 * error if the frame has no digest of this kind. */
static bool collect_digests(const diff_frame *frame, image_digest_kind kind, image_color background, known_digests *k,
                            octreel_error *error)
{
    *k = (known_digests){.newest = {.kind = kind}};
    error->text[0] = 0;
    if (has_picture(frame)) {
        k->list = &k->newest;
        k->count = 1;
        return digest_frame(frame, background, &k->newest, error);
    }
    k->list = frame->variants;
    k->count = frame->variant_count;
    k->newest = frame->digest;
    for (size_t i = k->count; i > 0 && k->newest.kind != kind; i--)
        k->newest = k->list[i - 1];
    return k->newest.kind == kind;
}

/* Compare two frames by digests of one kind. The frames are equal if any digest of the first frame equals any digest
 * of the second frame; the sizes must be equal, too. Return false if a frame has no digest of this kind. */
static bool compare_digests_of_kind(diff_pair *pair, image_digest_kind kind, image_color background,
                                    octreel_error *error)
{
    known_digests a, b;
    if (!collect_digests(pair->a, kind, background, &a, error) ||
        !collect_digests(pair->b, kind, background, &b, error))
        return false;
    pair->about[0] = a.newest;
    pair->about[1] = b.newest;
    for (size_t n = 0; n < a.count * b.count; n++) {
        const frame_digest *x = &a.list[n / b.count], *y = &b.list[n % b.count];
        if (x->kind == kind && y->kind == kind && x->pixels == y->pixels && x->width == y->width &&
            x->height == y->height) {
            pair->about[0] = pair->about[1] = *x;
            pair->finding = FOUND_SAME_PIXELS;
            break;
        }
    }
    return true;
}

static void compare_digests(diff_pair *pair, const diff_options *options)
{
    octreel_error error = {"the digests of the two sides are of different kinds and cannot be compared: accept the "
                           "frames of one side again"};
    bool any = false;
    for (int kind = 0; kind < IMAGE_DIGEST_KINDS && !(any && pair->finding == FOUND_SAME_PIXELS); kind++) {
        octreel_error trouble;
        if (compare_digests_of_kind(pair, (image_digest_kind)kind, options->background, &trouble)) {
            any = true;
        } else if (trouble.text[0]) {
            set_unreadable(pair, &trouble);
            return;
        }
    }
    if (!any)
        set_unreadable(pair, &error);
    else if (pair->finding != FOUND_SAME_PIXELS)
        pair->finding = pair->about[0].width != pair->about[1].width || pair->about[0].height != pair->about[1].height
                            ? FOUND_SIZE
                            : FOUND_DIGEST;
}

void compare_pixels(diff_pair *pair, const diff_options *options)
{
    if (has_picture(pair->a) && has_picture(pair->b))
        compare_pictures(pair, options);
    else
        compare_digests(pair, options);
}
