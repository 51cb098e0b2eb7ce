/* compare_pair.c - see compare_pair.h. */
#include "compare_pair.h"
#include "digest_file.h"
#include "read_pair.h"
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

static void find_unreadable(diff_pair *pair, const image_error *error)
{
    pair->finding = FOUND_UNREADABLE;
    pair->trouble = strdup(error->text); /* without memory there is no sentence: reports can do without */
}

static void judge(diff_pair *pair, const diff_options *options, const image images[2])
{
    image_tolerance tolerance = options->tolerance;
    tolerance.ignored = pair->ignored;
    tolerance.ignored_count = pair->ignored_count;
    pair->difference = image_compare_within(&images[0], &images[1], &tolerance);
    pair->transparent = images[0].transparent || images[1].transparent;
    for (int i = 0; i < 2; i++)
        pair->about[i] = (frame_digest){.width = images[i].width, .height = images[i].height};
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
    image images[2];
    image_error error;
    if (!read_pair(pair, options->background, images, &error)) {
        find_unreadable(pair, &error);
        return;
    }
    judge(pair, options, images);
    image_release(&images[0]);
    image_release(&images[1]);
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
