/* SPDX-License-Identifier: MIT */
/* animation_frames.c - finds the pictures of a folder, and checks that all have one size, as a film needs. */
#include "animation_frames.h"
#include "array.h"
#include "file.h"
#include "frame_file.h"
#include "png_chunks.h"
#include "png_read.h"

#include <inttypes.h>
#include <stdlib.h>

void animation_frames_release(animation_frames *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->frames[i].path);
    free(list->frames);
    *list = (animation_frames){0};
}

static bool has_frame_names(char *const *names)
{
    uint64_t tick;
    for (size_t i = 0; names[i]; i++)
        if (frame_parse_name(names[i], &tick))
            return true;
    return false;
}

/* Add all pictures of the folder to the list, which has room for all names. */
static bool add_pictures(const char *folder, char *const *names, animation_frames *list, octreel_error *error)
{
    for (size_t i = 0; names[i]; i++) {
        listed_frame *f = &list->frames[list->count];
        f->number = list->count;
        if (list->are_ticks ? !frame_parse_name(names[i], &f->number) : !file_has_ending(names[i], ".png"))
            continue;
        f->path = path_join(folder, names[i]);
        if (!f->path)
            return error_no_memory(error);
        list->count++;
    }
    return true;
}

static bool list_pictures(const char *folder, animation_frames *list, octreel_error *error)
{
    size_t count = 1;
    char **names = folder_names(folder, error);
    if (!names)
        return false;
    while (names[count - 1])
        count++;
    list->are_ticks = has_frame_names(names);
    list->frames = calloc(count, sizeof *list->frames);
    const bool ok = list->frames ? add_pictures(folder, names, list, error) : error_no_memory(error);
    free(names);
    if (ok && list->count == 0 && folder_contains(folder, "recording.json"))
        return error_set(error, "%s: this recording has no frames: record it without --no-frames", folder);
    /* Names are in the order of strcmp(), in which tick 1000000 precedes tick 999999. */
    qsort(list->frames, list->count, sizeof *list->frames, compare_uint64);
    return ok && (list->count > 0 || error_set(error, "%s: contains no PNG files", folder));
}

/* Of the pictures with the numbers `first` to `last` - 1, keep every n-th, where n is `every`. */
static void keep_frames(animation_frames *list, uint64_t first, uint64_t last, uint64_t every)
{
    size_t kept = 0;
    uint64_t seen = 0;
    for (size_t i = 0; i < list->count; i++) {
        const listed_frame f = list->frames[i];
        if (f.number < first || f.number >= last || seen++ % every != 0)
            free(f.path);
        else
            list->frames[kept++] = f;
    }
    list->count = kept;
}

static void count_missing_frames(animation_frames *list)
{
    uint64_t step = UINT64_MAX;
    for (size_t i = 1; i < list->count; i++) {
        const uint64_t next = list->frames[i].number - list->frames[i - 1].number;
        step = next < step ? next : step;
    }
    for (size_t i = 1; i < list->count; i++) {
        const uint64_t missing = (list->frames[i].number - list->frames[i - 1].number) / step - 1;
        if (list->missing == 0)
            list->missing_after = list->frames[i - 1].number;
        list->missing += missing;
    }
}

/* Remove the pictures that are not chosen. Missing frames are counted before `every` is applied, because frames that
 * --every leaves out are not missing. */
static bool choose_frames(const char *folder, const frame_choice *choice, animation_frames *list, octreel_error *error)
{
    const uint64_t first = list->frames[0].number, last = list->frames[list->count - 1].number;
    keep_frames(list, choice->first, choice->last ? choice->last : UINT64_MAX, 1);
    if (list->count == 0)
        return error_set(error, "%s: none of its %s, %" PRIu64 " to %" PRIu64 ", is in the range of --ticks", folder,
                         list->are_ticks ? "ticks with frames" : "pictures", first, last);
    count_missing_frames(list);
    keep_frames(list, 0, UINT64_MAX, choice->every ? choice->every : 1);
    return true;
}

/* Read the size of a picture from its header. If this fails, decode the whole file, which reports what is wrong with
 * it. */
static bool read_size(const char *path, int *width, int *height, octreel_error *error)
{
    image whole;
    if (image_read_png_size(path, width, height))
        return true;
    if (!image_read_png(path, &whole, error))
        return false;
    *width = whole.width;
    *height = whole.height;
    image_release(&whole);
    return true;
}

static bool check_sizes(animation_frames *list, octreel_error *error)
{
    for (size_t i = 0; i < list->count; i++) {
        int width, height;
        if (!read_size(list->frames[i].path, &width, &height, error))
            return false;
        if (i == 0) {
            list->width = width;
            list->height = height;
        }
        if (width != list->width || height != list->height)
            return error_set(error,
                             "%s: has %d x %d pixels, but %s has %d x %d; a film needs frames of one size: choose a "
                             "range with --ticks",
                             list->frames[i].path, width, height, list->frames[0].path, list->width, list->height);
    }
    return true;
}

bool animation_frames_read(const char *folder, const frame_choice *choice, animation_frames *list, octreel_error *error)
{
    *list = (animation_frames){0};
    if (list_pictures(folder, list, error) && choose_frames(folder, choice, list, error) && check_sizes(list, error))
        return true;
    animation_frames_release(list);
    return false;
}
