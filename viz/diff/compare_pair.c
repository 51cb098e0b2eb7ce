/* compare_pair.c - see compare_pair.h. */
#include "compare_pair.h"
#include "digest_file.h"
#include "parallel.h"
#include "same_bytes.h"

#include <string.h>

bool compare_bytes(diff_pair *pair)
{
    image_error error;
    bool ends;
    frame_digest about = {0};
    if (!pair->a->path || !pair->b->path || !same_bytes(pair->a->path, pair->b->path) ||
        !image_read_png_ends(pair->a->path, &about.width, &about.height, &ends, &error) || !ends)
        return false; /* two equal halves of a picture are no picture: its reader shall tell */
    pair->about[0] = pair->about[1] = about;
    pair->finding = FOUND_SAME_BYTES;
    return true;
}

/* Both frames of a pair while they are read. */
typedef struct reading {
    const diff_frame *frames[2];
    image_color background;
    image images[2];
    image_error errors[2];
    bool read[2];
} reading;

static void read_one(size_t i, void *context)
{
    reading *r = context;
    r->read[i] = image_read_png_over(r->frames[i]->path, r->background, &r->images[i], &r->errors[i]);
}

static void find_unreadable(diff_pair *pair, const image_error *error)
{
    pair->finding = FOUND_UNREADABLE;
    pair->trouble = strdup(error->text); /* without memory there is no sentence: reports can do without */
}

static void judge(diff_pair *pair, const diff_options *options, const reading *r)
{
    image_tolerance tolerance = options->tolerance;
    tolerance.ignored = pair->ignored;
    tolerance.ignored_count = pair->ignored_count;
    pair->difference = image_compare_within(&r->images[0], &r->images[1], &tolerance);
    pair->transparent = r->images[0].transparent || r->images[1].transparent;
    for (int i = 0; i < 2; i++)
        pair->about[i] = (frame_digest){.width = r->images[i].width, .height = r->images[i].height};
    if (!pair->difference.same_size)
        pair->finding = FOUND_SIZE;
    else if (image_same(&pair->difference))
        pair->finding = FOUND_SAME_PIXELS;
    else if (image_forgiven(&pair->difference, &tolerance))
        pair->finding = FOUND_WITHIN;
    else
        pair->finding = FOUND_PIXELS;
}

static void compare_pictures(diff_pair *pair, const diff_options *options)
{
    reading r = {.frames = {pair->a, pair->b}, .background = options->background};
    parallel_for(2, 2, read_one, &r);
    if (r.read[0] && r.read[1])
        judge(pair, options, &r);
    else
        find_unreadable(pair, &r.errors[r.read[0] ? 1 : 0]);
    image_release(&r.images[0]);
    image_release(&r.images[1]);
}

static void compare_digests(diff_pair *pair, const diff_options *options)
{
    const diff_frame *const frames[2] = {pair->a, pair->b};
    image_error error;
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
