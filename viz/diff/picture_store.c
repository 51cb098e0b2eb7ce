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
static char *make_picture_path(const char *store, const frame_digest *digest)
{
    const char *kind = image_digest_kind_name(digest->kind);
    const size_t size = strlen(store) + strlen(kind) + sizeof "//01/0123456789abcdef.png";
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s/%02x/%016" PRIx64 ".png", store, kind, (unsigned)(digest->pixels >> 56),
                 digest->pixels);
    return path;
}

/* Return whether a file is a picture with this digest. If the file is not such a picture, the error says why. */
static bool is_picture_with_digest(const char *path, const frame_digest *digest, image_color background,
                                   octreel_error *error)
{
    frame_digest found = {.kind = digest->kind};
    if (!digest_picture(path, background, &found, error))
        return false;
    return found.pixels == digest->pixels ||
           error_set(error, "%s: the pixels do not match the file name: their digest is %016" PRIx64, path,
                     found.pixels);
}

bool picture_store_add(const char *store, const char *picture, const frame_digest *digest, image_color background,
                       octreel_error *error)
{
    octreel_error ignored;
    char *path = make_picture_path(store, digest);
    if (!path)
        return error_no_memory(error);
    bool ok = access(path, F_OK) == 0 && is_picture_with_digest(path, digest, background, &ignored);
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
    char *path = make_picture_path(store, digest);
    if (path ? is_picture_with_digest(path, digest, background, error) : error_no_memory(error))
        return path;
    free(path);
    return NULL;
}

/* ---- For a comparison ---------------------------------------------------------------------------------------- */

typedef struct fetching {
    diff_side *reference;
    diff_result *result;
} fetching;

/* Compare the frame of a pair with the picture of an accepted variant. The picture is kept as frame->path if it is the
 * first picture or if the frame is within the tolerance of the picture. Else the pair stays unchanged: its frames
 * differ by digest, even if another process replaces the picture meanwhile. If the system lacks resources, the
 * pictures cannot be compared, and the pair becomes unreadable. */
static void compare_variant(diff_pair *pair, diff_frame *frame, char *picture, const diff_options *options)
{
    const diff_pair before = *pair;
    char *const first = frame->path;
    frame->path = picture;
    errno = 0;
    if (pair->b && pair->b->path)
        compare_pixels(pair, options);
    if (pair->finding == FOUND_WITHIN || (!first && diff_finding_verdict(pair->finding) == DIFF_DIFFERENT)) {
        free(first);
        return;
    }
    if (!pair->lacks_resources || diff_is_exact(options)) {
        free(pair->trouble);
        *pair = before;
    }
    frame->path = first ? first : picture;
    if (first)
        free(picture);
}

static bool is_same_picture(const frame_digest *a, const frame_digest *b)
{
    return a->kind == b->kind && a->pixels == b->pixels;
}

/* Fetch the picture of a digest and compare the frame with it. If the store does not have the picture, the error
 * says why. */
static void compare_picture_of_digest(const fetching *f, diff_pair *pair, diff_frame *frame, const frame_digest *digest,
                                      octreel_error *error)
{
    const diff_options *options = &f->result->options;
    octreel_error ignored;
    errno = 0;
    char *picture = picture_store_find(options->store, digest, f->reference->background, error);
    if (picture)
        compare_variant(pair, frame, picture, options);
    else if (pair->b && !diff_is_exact(options) && !check_system_resources(&ignored))
        set_unreadable(pair, error);
}

/* Compare a frame with the picture of its newest variant. If the store does not have this picture, or the frame
 * differs from it beyond the tolerance, try the pictures of the other variants. If the store has none of these
 * pictures, pair->no_picture says why the newest is missing. */
static void fetch_picture(size_t i, void *context)
{
    const fetching *f = context;
    diff_pair *pair = &f->result->pairs[i];
    if (!pair->a || pair->a->path ||
        (pair->finding != FOUND_DIGEST && pair->finding != FOUND_SIZE && pair->finding != FOUND_NO_FRAME))
        return;
    diff_frame *frame = &f->reference->frames[pair->a - f->reference->frames];
    const bool tries_all = pair->b && !diff_is_exact(&f->result->options);
    octreel_error why = {""}, ignored;
    for (size_t n = 0; n <= frame->variant_count && !pair->lacks_resources &&
                       (!frame->path || (tries_all && pair->finding != FOUND_WITHIN));
         n++) {
        const frame_digest *digest = n ? &frame->variants[frame->variant_count - n] : &frame->digest;
        if (n == 0 || !is_same_picture(digest, &frame->digest))
            compare_picture_of_digest(f, pair, frame, digest, n ? &ignored : &why);
    }
    if (!frame->path && !pair->lacks_resources)
        pair->no_picture = strdup(why.text);
}

void picture_store_fetch(diff_side *reference, diff_result *result)
{
    fetching f = {reference, result};
    if (!result->options.store)
        return;
    parallel_for(result->count, fetch_picture, &f);
    result->verdict = DIFF_SAME;
    diff_count_findings(result);
}
