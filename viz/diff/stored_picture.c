/* SPDX-License-Identifier: MIT */
/* stored_picture.c - compares frames with stored pictures, first under the options alone, then under a rule, so that
 * reports name a rule only where it was needed. */
#include "stored_picture.h"
#include "error.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

char *stored_picture_path(const char *store, const frame_digest *digest)
{
    const char *kind = image_digest_kind_name(digest->kind);
    const size_t size = strlen(store) + strlen(kind) + sizeof "//01/0123456789abcdef.png";
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s/%02x/%016" PRIx64 ".png", store, kind, (unsigned)(digest->pixels >> 56),
                 digest->pixels);
    return path;
}

bool stored_picture_check(const char *path, const frame_digest *digest, image_color background, octreel_error *error)
{
    frame_digest found = {.kind = digest->kind};
    if (!digest_picture(path, background, &found, error))
        return false;
    return found.pixels == digest->pixels ||
           error_set(error, "%s: the pixels do not match the file name: their digest is %016" PRIx64, path,
                     found.pixels);
}

/* Return the path of the picture with a digest. The caller frees the path. Return null with an error if the store
 * lacks the picture, the picture is damaged, or memory runs out. */
static char *find_picture(const diff_options *options, const frame_digest *digest, octreel_error *error)
{
    char *path = stored_picture_path(options->store, digest);
    if (path ? stored_picture_check(path, digest, options->background, error) : error_no_memory(error))
        return path;
    free(path);
    return NULL;
}

/* ---- The pictures of a frame --------------------------------------------------------------------------------- */

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
    if (pair->b && has_picture(pair->b))
        compare_pixels(pair, options);
    if (pair->finding == FOUND_WITHIN || (!first && diff_finding_verdict(pair->finding) == DIFF_DIFFERENT)) {
        free(first);
        return;
    }
    if (!pair->lacks_resources || pair_is_exact(pair, options)) {
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
static void compare_picture_of_digest(diff_pair *pair, diff_frame *frame, const frame_digest *digest,
                                      const diff_options *options, octreel_error *error)
{
    octreel_error ignored;
    errno = 0;
    char *picture = find_picture(options, digest, error);
    if (picture)
        compare_variant(pair, frame, picture, options);
    else if (pair->b && !pair_is_exact(pair, options) && !check_system_resources(&ignored))
        set_unreadable(pair, error);
}

static void compare_variants(diff_pair *pair, diff_frame *frame, const diff_options *options, octreel_error *why)
{
    const bool tries_all = pair->b && !pair_is_exact(pair, options);
    octreel_error ignored;
    for (size_t n = 0; n <= frame->variant_count && !pair->lacks_resources &&
                       (!frame->path || (tries_all && pair->finding != FOUND_WITHIN));
         n++) {
        const frame_digest *digest = n ? &frame->variants[frame->variant_count - n] : &frame->digest;
        if (n == 0 || !is_same_picture(digest, &frame->digest))
            compare_picture_of_digest(pair, frame, digest, options, n ? &ignored : why);
    }
}

void stored_picture_compare(diff_pair *pair, diff_frame *frame, const diff_options *options)
{
    octreel_error why = {""};
    if (!options->store || frame->path ||
        (pair->finding != FOUND_DIGEST && pair->finding != FOUND_SIZE && pair->finding != FOUND_NO_FRAME))
        return;
    compare_variants(pair, frame, options, &why);
    if (!frame->path && !pair->lacks_resources)
        pair->no_picture = strdup(why.text);
}

/* ---- Rules --------------------------------------------------------------------------------------------------- */

void stored_picture_choose_rule(diff_pair *pair, const diff_options *options, bool is_recording)
{
    const baseline_rule *rule = pair->rule;
    if (!rule || !pair->b || diff_finding_verdict(pair->finding) != DIFF_DIFFERENT)
        return;
    if (rule_has_expired(rule, options->today))
        pair->effect = RULE_EXPIRED;
    else if (!options->store)
        pair->effect = RULE_LACKS_STORE;
    else if (!pair->a->path)
        pair->effect = RULE_LACKS_PICTURE;
    else if (rule->layers && !is_recording)
        pair->effect = RULE_LACKS_RECORDING;
    else
        pair->effect = RULE_EXCEEDED;
}

void stored_picture_apply_rule(diff_pair *pair, diff_frame *frame, const diff_options *options)
{
    octreel_error error = {""};
    char *const before = frame->path;
    if (pair->effect != RULE_EXCEEDED)
        return;
    errno = 0;
    if (!rule_add_mask(pair->rule, pair->about[1].width, pair->about[1].height, &pair->mask, &error)) {
        set_unreadable(pair, &error);
        return;
    }
    frame->path = NULL; /* the newest picture is compared again, so that reports count its pixels under the rule */
    compare_variants(pair, frame, options, &error);
    if (frame->path)
        free(before);
    else
        frame->path = before;
    if (pair->finding == FOUND_WITHIN)
        pair->effect = RULE_FORGAVE;
}
