/* SPDX-License-Identifier: MIT */
/* picture_store.c - stores pictures under their digests and fetches them. */
#include "picture_store.h"
#include "file.h"
#include "folder.h"
#include "parallel.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Return the path of the picture with a digest: DIR/runs/01/0123456789abcdef.png. The caller frees the path. */
static char *path_of(const char *store, const frame_digest *digest)
{
    const char *kind = image_digest_kind_name(digest->kind);
    const size_t size = strlen(store) + strlen(kind) + sizeof "//01/0123456789abcdef.png";
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s/%02x/%016" PRIx64 ".png", store, kind, (unsigned)(digest->pixels >> 56),
                 digest->pixels);
    return path;
}

/* Return whether a file is a picture with this digest. If it is not, the error says why. */
static bool is_picture(const char *path, const frame_digest *digest, image_color background, octreel_error *error)
{
    frame_digest found = {.kind = digest->kind};
    if (!digest_picture(path, background, &found, error))
        return false;
    return found.pixels == digest->pixels ||
           error_set(error, "%s: does not hold the picture of its name: its pixels have the digest %016" PRIx64, path,
                     found.pixels);
}

bool picture_store_add(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error)
{
    octreel_error ignored;
    char *path = path_of(store, digest);
    if (!path)
        return error_no_memory(error);
    bool ok = access(path, F_OK) == 0 && is_picture(path, digest, background, &ignored);
    if (!ok) {
        char *slash = strrchr(path, '/');
        *slash = 0;
        ok = folder_create(path, error);
        *slash = '/';
        ok = ok && file_copy_unique(picture, path, error);
    }
    free(path);
    return ok;
}

char *picture_store_find(const char *store, const frame_digest *digest, image_color background, octreel_error *error)
{
    char *path = path_of(store, digest);
    if (path ? is_picture(path, digest, background, error) : error_no_memory(error))
        return path;
    free(path);
    return NULL;
}

/* ---- For a comparison ---------------------------------------------------------------------------------------- */

typedef struct fetching {
    const char *store;
    diff_side *reference;
    diff_result *result;
} fetching;

/* Return the path of the newest variant's picture or, if the store lacks it, of any other variant's picture. If the
 * store has no picture, the error is about the newest variant. */
static char *find_variant_picture(const fetching *f, diff_frame *frame, frame_digest *found, octreel_error *why)
{
    octreel_error ignored;
    *found = frame->digest;
    char *path = picture_store_find(f->store, found, f->reference->background, why);
    for (size_t i = frame->variant_count; !path && i > 0; i--) {
        *found = frame->variants[i - 1];
        path = picture_store_find(f->store, found, f->reference->background, &ignored);
    }
    return path;
}

/* Compare the pixels of a pair with a fetched picture. A pair that differs by digest stays different, even if
 * another process replaces the picture meanwhile. */
static void compare_fetched(diff_pair *pair, const diff_options *options)
{
    const diff_finding before = pair->finding;
    compare_pixels(pair, options);
    if (diff_finding_verdict(pair->finding) != DIFF_DIFFERENT)
        pair->finding = before;
}

static void fetch_picture(size_t i, void *context)
{
    const fetching *f = context;
    diff_pair *pair = &f->result->pairs[i];
    const bool unlike = pair->finding == FOUND_DIGEST || pair->finding == FOUND_SIZE;
    if (!pair->a || pair->a->path || !(unlike || pair->finding == FOUND_NO_FRAME))
        return;
    diff_frame *frame = &f->reference->frames[pair->a - f->reference->frames];
    octreel_error why = {""};
    frame_digest found;
    frame->path = find_variant_picture(f, frame, &found, &why);
    if (!frame->path)
        pair->no_picture = strdup(why.text);
    else if (unlike && pair->b->path)
        compare_fetched(pair, &f->result->options);
}

bool picture_store_fetch(const char *store, diff_side *reference, diff_result *result, octreel_error *error)
{
    fetching f = {store, reference, result};
    if (reference->kind != DIFF_BASELINE)
        return error_set(error, "--store works with a baseline only, and %s is a %s", reference->path,
                         diff_kind_name(reference->kind));
    parallel_for(result->count, fetch_picture, &f);
    diff_count(result);
    return true;
}
