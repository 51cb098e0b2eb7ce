/* SPDX-License-Identifier: MIT */
/* side_frames.c - the list of a side's frames: appends, sorts and frees them. */
#include "array.h"
#include "file.h"
#include "rule.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool diff_side_add_frame(diff_side *side, const char *name, frame_digest digest, octreel_error *error)
{
    const bool has_path = side->kind != DIFF_BASELINE;
    const bool grown = array_grow(&side->frames, side->count + 1, &side->room, sizeof *side->frames);
    diff_frame frame = {.name = grown ? strdup(name) : NULL, .digest = digest};
    if (frame.name && has_path)
        frame.path = side->kind == DIFF_PICTURE ? strdup(side->source) : path_join(side->path, name);
    if (frame.name && (frame.path || !has_path)) {
        side->frames[side->count++] = frame;
        return true;
    }
    free(frame.name);
    return error_no_memory(error);
}

bool digest_picture(const char *path, image_color background, frame_digest *digest, octreel_error *error)
{
    image about;
    uint64_t pixels;
    if (!image_digest_png(digest->kind, path, background, &about, &pixels, error))
        return false;
    *digest = (frame_digest){pixels, about.width, about.height, digest->kind, 0};
    return true;
}

size_t diff_stem_length(const char *name)
{
    const size_t length = strlen(name);
    return length > 4 && strcasecmp(name + length - 4, ".png") == 0 ? length - 4 : length;
}

static int compare_by_name(const void *a, const void *b)
{
    return strcmp(((const diff_frame *)a)->name, ((const diff_frame *)b)->name);
}

void diff_side_sort_frames(diff_side *side)
{
    if (side->count > 0)
        qsort(side->frames, side->count, sizeof *side->frames, compare_by_name);
}

const diff_frame *diff_side_find_frame(const diff_side *side, const char *name)
{
    const diff_frame key = {.name = (char *)name}; /* only compared */
    return side->count > 0 ? bsearch(&key, side->frames, side->count, sizeof key, compare_by_name) : NULL;
}

void diff_side_release(diff_side *side)
{
    for (size_t i = 0; i < side->count; i++) {
        free(side->frames[i].name);
        free(side->frames[i].path);
        free(side->frames[i].variants);
    }
    for (size_t i = 0; i < side->acceptance_count; i++)
        free(side->acceptances[i].reason);
    rules_release(side);
    free(side->acceptances);
    free(side->frames);
    *side = (diff_side){0};
}
