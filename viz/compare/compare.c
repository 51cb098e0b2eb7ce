/* SPDX-License-Identifier: MIT */
/* compare.c - octreel/compare.h: makes a pair of the two pictures, lets diff/pair.c compare it, and copies the result.
 */
#include "octreel/compare.h"
#include "baseline.h"
#include "compare_pixels.h"
#include "diff_words.h"
#include "file.h"
#include "file_kind.h"
#include "flip.h"
#include "stored_picture.h"
#include "text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A picture of the caller: pixels or a file. */
typedef struct input {
    const char *which; /* "the picture" or "the reference", in sentences */
    bool is_file;
    const octreel_pixels *pixels; /* the pixels, unless it is a file */
    const char *path;             /* the path of the file */
    image image;                  /* the pixels, if they are given */
    uint8_t *owned;               /* the converted pixels; null: the image has those of the caller */
    diff_frame frame;
} input;

typedef struct comparing {
    const octreel_compare_def *def;
    input reference, actual;
    bool has_baseline;  /* true: the reference is a baseline */
    diff_side baseline; /* the baseline */
    diff_options options;
    diff_pair pair;
} comparing;

octreel_pixels octreel_make_pixels(const void *data, int width, int height, octreel_pixel_format format)
{
    return (octreel_pixels){.data = data, .width = width, .height = height, .format = format};
}

octreel_compare_def octreel_compare_def_default(void)
{
    return (octreel_compare_def){.background = 0xffffff, .pixels_per_degree = FLIP_PIXELS_PER_DEGREE};
}

/* ---- The definition ------------------------------------------------------------------------------------------ */

static bool check_rectangle(const octreel_rectangle *r, size_t i, octreel_error *error)
{
    return (r->x >= 0 && r->y >= 0 && r->width >= 1 && r->height >= 1) ||
           error_set(error,
                     "ignored[%zu] is the rectangle (%d,%d) %dx%d; x and y must be at least 0, width and height at "
                     "least 1",
                     i, r->x, r->y, r->width, r->height);
}

static bool check_definition(const octreel_compare_def *def, octreel_error *error)
{
    if (!(def->max_delta >= 0 && def->max_delta <= 1)) /* a NaN is refused, too */
        return error_set(error, "max_delta is %g; it must be from 0 to 1", def->max_delta);
    if (!(def->max_share >= 0 && def->max_share <= 1))
        return error_set(error, "max_share is %g; it must be from 0 to 1", def->max_share);
    if (def->max_channel < 0 || def->max_channel > UINT16_MAX)
        return error_set(error, "max_channel is %d; it must be from 0 to 65535", def->max_channel);
    if (def->flip && !(def->max_flip >= 0 && def->max_flip <= 1))
        return error_set(error, "max_flip is %g; it must be from 0 to 1", def->max_flip);
    if (def->flip && !(def->pixels_per_degree >= FLIP_LEAST_PIXELS_PER_DEGREE &&
                       def->pixels_per_degree <= FLIP_MOST_PIXELS_PER_DEGREE))
        return error_set(error, "pixels_per_degree is %g; it must be from %d to %d", def->pixels_per_degree,
                         FLIP_LEAST_PIXELS_PER_DEGREE, FLIP_MOST_PIXELS_PER_DEGREE);
    if (def->background > 0xffffff)
        return error_set(error, "background is 0x%08x; it must be 0xRRGGBB", (unsigned)def->background);
    if (def->ignored_count > 0 && !def->ignored)
        return error_set(error, "ignored is null, but ignored_count is %zu", def->ignored_count);
    if (def->today && !baseline_is_date(def->today))
        return error_set(error, "today is \"%s\"; it must be an existing date such as 2026-11-22, or null", def->today);
    for (size_t i = 0; i < def->ignored_count; i++)
        if (!check_rectangle(&def->ignored[i], i, error))
            return false;
    return true;
}

static void set_options(comparing *c)
{
    const octreel_compare_def *def = c->def;
    c->options = diff_options_default();
    c->options.tolerance = (image_tolerance){.max_pixels = def->max_pixels,
                                             .max_share = def->max_share,
                                             .max_delta = def->max_delta,
                                             .max_channel = def->max_channel,
                                             .antialias = def->antialias,
                                             .flip = def->flip,
                                             .max_flip = def->max_flip,
                                             .pixels_per_degree = def->pixels_per_degree,
                                             .ignored = def->ignored,
                                             .ignored_count = def->ignored_count};
    c->options.store = def->store;
    c->options.background =
        (image_color){(uint8_t)(def->background >> 16), (uint8_t)(def->background >> 8), (uint8_t)def->background};
}

/* ---- Opening the pictures ------------------------------------------------------------------------------------ */

static bool open_input(const comparing *c, input *in, octreel_error *error)
{
    if (in->is_file) {
        in->frame.path = (char *)in->path; /* only read */
        return true;
    }
    in->frame.pixels = &in->image;
    return pixels_to_image(in->pixels, in->which, c->options.background, &in->image, &in->owned, error);
}

static bool check_path(const input *in, octreel_error *error)
{
    return !in->is_file || in->path || error_set(error, "%s: the path is null; pass the path of a file", in->which);
}

/* Check that the reference exists and is no folder, because the reader's sentence could not say what to do. */
static bool check_reference_file(const char *path, octreel_error *error)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return error_set(error, "%s: no reference: %s; look at the new picture and, if it is right, save it there",
                         path, strerror(errno));
    return !S_ISDIR(status.st_mode) ||
           error_set(error, "%s: the reference is a folder; name a PNG file or a baseline in it", path);
}

static bool begins_like_baseline(const char *path)
{
    static const char beginning[] = DIGEST_FILE_BEGINNING;
    char text[sizeof beginning - 1], reason[FILE_REASON];
    FILE *file = file_open(path, NULL, reason);
    if (!file)
        return false;
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    return size == sizeof text && memcmp(text, beginning, sizeof text) == 0;
}

/* Return whether `name` is the name of a frame, with or without its ending ".png". */
static bool is_frame_named(const diff_frame *frame, const char *name)
{
    const size_t stem = diff_stem_length(frame->name);
    return strcmp(frame->name, name) == 0 || (strlen(name) == stem && memcmp(frame->name, name, stem) == 0);
}

static bool find_frame(comparing *c, octreel_error *error)
{
    const diff_side *side = &c->baseline;
    const char *name = c->def->frame;
    if (!name && c->actual.is_file)
        name = path_base_name(c->actual.path);
    if (!name && side->count != 1)
        return error_set(error, "%s: has %zu frames; set `frame` to the name of the one to compare with", side->path,
                         side->count);
    for (size_t i = 0; i < side->count; i++)
        if (!name || is_frame_named(&side->frames[i], name)) {
            c->pair.a = &side->frames[i];
            return true;
        }
    return error_set(error,
                     "%s: no frame \"%s\"; look at the new picture and, if it is right, add it with octreel accept",
                     side->path, name);
}

static bool open_baseline(comparing *c, octreel_error *error)
{
    if (!diff_is_exact(&c->options) && !c->options.store)
        return error_set(error,
                         "%s: a baseline holds digests, which allow no tolerance; set `store` to the folder of octreel "
                         "accept --store, compare with a PNG file, or forgive and ignore nothing",
                         c->reference.path);
    c->has_baseline = true;
    c->baseline = (diff_side){.path = c->reference.path, .source = c->reference.path};
    if (!baseline_read(&c->baseline, error))
        return false;
    c->options.background = c->baseline.background;
    if (c->def->today)
        memcpy(c->options.today, c->def->today, sizeof c->options.today);
    return find_frame(c, error) &&
           (c->def->today || c->baseline.rule_count == 0 || rule_today(c->options.today, error));
}

/* Open the reference first: a baseline decides the background with which the pixels are blended. */
static bool open_pair(comparing *c, octreel_error *error)
{
    c->pair = (diff_pair){.a = &c->reference.frame, .b = &c->actual.frame, .finding = FOUND_UNREADABLE};
    const input *reference = &c->reference;
    if (!check_path(reference, error) || !check_path(&c->actual, error) ||
        (reference->is_file && !check_reference_file(reference->path, error)))
        return false;
    const bool has_baseline = reference->is_file && begins_like_baseline(reference->path);
    return (has_baseline ? open_baseline(c, error) : open_input(c, &c->reference, error)) &&
           open_input(c, &c->actual, error);
}

static void close_pair(comparing *c)
{
    if (c->has_baseline)
        diff_side_release(&c->baseline);
    mask_release(&c->pair.mask);
    free(c->pair.no_picture);
    free(c->pair.trouble);
    free(c->reference.owned);
    free(c->actual.owned);
}

/* ---- The result ---------------------------------------------------------------------------------------------- */

static void copy_sizes(octreel_comparison *result, const diff_pair *pair)
{
    result->reference_width = pair->about[0].width;
    result->reference_height = pair->about[0].height;
    result->width = pair->about[1].width;
    result->height = pair->about[1].height;
}

static void copy_difference(octreel_comparison *result, const image_difference *d)
{
    const image_tally *tally = d->counted.pixels ? &d->counted : &d->unlike;
    result->different = d->unlike.pixels;
    result->counted = d->counted.pixels;
    result->close = d->close;
    result->antialiased = d->antialiased;
    result->ignored = d->ignored;
    result->worst_delta = tally->worst_delta;
    result->mean_flip = d->has_flip ? d->flip.mean : 0;
    result->worst_flip = d->has_flip ? d->flip.worst : 0;
    result->worst_x = tally->worst_x;
    result->worst_y = tally->worst_y;
    result->largest_channel = tally->largest_channel;
    result->channel_range = d->channel_range;
    result->min_x = tally->min_x;
    result->min_y = tally->min_y;
    result->max_x = tally->max_x;
    result->max_y = tally->max_y;
}

static const char *input_name(const input *in)
{
    return in->path ? in->path : in->which;
}

static bool describe_difference(const comparing *c, octreel_error *sentence)
{
    text_stream s;
    char *text = NULL;
    bool ok = text_stream_begin(&s);
    if (ok)
        diff_print_difference(s.stream, &c->pair);
    ok = ok && text_stream_end(&s, &text) && text;
    if (ok)
        error_set(sentence, "%s, compared with %s: %s", input_name(&c->actual), input_name(&c->reference), text);
    free(text);
    return ok || error_no_memory(sentence);
}

/* If the digest differs, compare with the stored pictures, under the definition and then under the rule. */
static void compare_stored(comparing *c)
{
    diff_frame *frame = &c->baseline.frames[c->pair.a - c->baseline.frames];
    c->pair.rule = rule_find(&c->baseline, frame->name);
    stored_picture_compare(&c->pair, frame, &c->options);
    stored_picture_choose_rule(&c->pair, &c->options, false);
    stored_picture_apply_rule(&c->pair, frame, &c->options);
}

static bool compare_pair(comparing *c, octreel_comparison *result, octreel_error *sentence)
{
    if (!check_definition(c->def, sentence))
        return false;
    set_options(c);
    if (!open_pair(c, sentence))
        return false;
    errno = 0; /* set_unreadable() reads it */
    if (!compare_bytes(&c->pair))
        compare_pixels(&c->pair, &c->options);
    if (c->has_baseline)
        compare_stored(c);
    if (c->pair.finding == FOUND_UNREADABLE)
        return c->pair.trouble ? error_set(sentence, "%s", c->pair.trouble) : error_no_memory(sentence);
    if (!describe_difference(c, sentence))
        return false;
    copy_sizes(result, &c->pair);
    if (c->pair.difference.same_size)
        copy_difference(result, &c->pair.difference);
    result->verdict = (octreel_verdict)diff_finding_verdict(c->pair.finding);
    return true;
}

_Static_assert((int)OCTREEL_VERDICT_SAME == (int)DIFF_SAME && (int)OCTREEL_VERDICT_DIFFERENT == (int)DIFF_DIFFERENT &&
                   (int)OCTREEL_VERDICT_TROUBLE == (int)DIFF_TROUBLE,
               "the verdicts have the same values");

static octreel_verdict compare(input actual, input reference, const octreel_compare_def *def,
                               octreel_comparison *result)
{
    const octreel_compare_def standard = octreel_compare_def_default();
    comparing c = {.def = def ? def : &standard, .reference = reference, .actual = actual};
    octreel_comparison found = {.verdict = OCTREEL_VERDICT_TROUBLE,
                                .worst_x = -1,
                                .worst_y = -1,
                                .min_x = -1,
                                .min_y = -1,
                                .max_x = -1,
                                .max_y = -1};
    octreel_error sentence = {""};
    compare_pair(&c, &found, &sentence);
    close_pair(&c);
    _Static_assert(sizeof found.sentence == sizeof sentence.text, "a sentence has the length of an error");
    memcpy(found.sentence, sentence.text, sizeof sentence.text);
    if (result)
        *result = found;
    return found.verdict;
}

static input make_pixels_input(const octreel_pixels *pixels, const char *which)
{
    return (input){.which = which, .pixels = pixels};
}

/* The functions of base/file.h read standard input for "-", and keep its bytes for all callers. Here "-" is an ordinary
 * name. */
static input make_file_input(const char *path, const char *which)
{
    return (input){.which = which, .is_file = true, .path = path && file_is_standard_stream(path) ? "./-" : path};
}

static const char picture[] = "the picture", reference_picture[] = "the reference";

octreel_verdict octreel_compare_pixels(const octreel_pixels *actual, const octreel_pixels *reference,
                                       const octreel_compare_def *def, octreel_comparison *result)
{
    return compare(make_pixels_input(actual, picture), make_pixels_input(reference, reference_picture), def, result);
}

octreel_verdict octreel_compare_pixels_to_file(const octreel_pixels *actual, const char *reference,
                                               const octreel_compare_def *def, octreel_comparison *result)
{
    return compare(make_pixels_input(actual, picture), make_file_input(reference, reference_picture), def, result);
}

octreel_verdict octreel_compare_files(const char *actual, const char *reference, const octreel_compare_def *def,
                                      octreel_comparison *result)
{
    return compare(make_file_input(actual, picture), make_file_input(reference, reference_picture), def, result);
}
