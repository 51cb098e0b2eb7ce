/* read_pair.c - see read_pair.h. */
#include "read_pair.h"
#include "parallel.h"

/* Both frames of a pair while they are read. */
typedef struct reading {
    const diff_frame *frames[2];
    image_color background;
    image *images;
    octreel_error errors[2];
    bool read[2];
} reading;

static void read_one(size_t i, void *context)
{
    reading *r = context;
    r->read[i] = image_read_png_over(r->frames[i]->path, r->background, &r->images[i], &r->errors[i]);
}

bool read_pair(const diff_pair *pair, image_color background, image images[2], octreel_error *error)
{
    reading r = {.frames = {pair->a, pair->b}, .background = background, .images = images};
    parallel_for(2, 2, read_one, &r);
    if (r.read[0] && r.read[1])
        return true;
    *error = r.errors[r.read[0] ? 1 : 0];
    for (int i = 0; i < 2; i++)
        image_release(&images[i]); /* what was not read is zeroed */
    return false;
}
