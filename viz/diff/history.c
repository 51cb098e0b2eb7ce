/* SPDX-License-Identifier: MIT */
/* history.c - reads and writes the earlier digests of a baseline, and finds flaky frames: see history.h. */
#include "history.h"
#include "array.h"
#include "baseline.h"
#include "file.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define BEGINNING "octreel-history 1"

static char *history_path(const char *baseline)
{
    char *path = malloc(strlen(baseline) + sizeof HISTORY_ENDING);
    if (path)
        sprintf(path, "%s%s", baseline, HISTORY_ENDING);
    return path;
}

void history_release(history *h)
{
    for (size_t i = 0; i < h->count; i++)
        free(h->lines[i].name);
    free(h->lines);
    *h = (history){0};
}

static bool add_line(history *h, const history_line *line, octreel_error *error)
{
    if (!array_grow(&h->lines, h->count + 1, &h->room, sizeof *h->lines))
        return error_no_memory(error);
    h->lines[h->count] = *line;
    h->lines[h->count].index = h->count;
    h->lines[h->count].name = strdup(line->name);
    return h->lines[h->count++].name || error_no_memory(error);
}

static int compare_lines(const void *a, const void *b)
{
    const history_line *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    order = order ? order : strcmp(x->date, y->date);
    return order ? order : (x->index > y->index) - (x->index < y->index);
}

static bool is_same_digest(const history_line *a, const history_line *b)
{
    return a->kind == b->kind && a->pixels == b->pixels;
}

/* Sort the lines. Remove repeated lines, which a union merge by git can cause. */
static void sort_lines(history *h)
{
    size_t kept = 0;
    if (h->count > 0)
        qsort(h->lines, h->count, sizeof *h->lines, compare_lines);
    for (size_t i = 0; i < h->count; i++) {
        const history_line *last = kept ? &h->lines[kept - 1] : NULL;
        if (last && is_same_digest(last, &h->lines[i]) && strcmp(last->date, h->lines[i].date) == 0 &&
            strcmp(last->name, h->lines[i].name) == 0)
            free(h->lines[i].name);
        else
            h->lines[kept++] = h->lines[i];
    }
    h->count = kept;
}

/* ---- Reading ------------------------------------------------------------------------------------------------- */

static bool read_line(history *h, const char *path, char *text, size_t number, octreel_error *error)
{
    history_line line = {.date = ""};
    char kind[16] = "", written[64];
    sscanf(text, "%10s %15s %16" SCNx64, line.date, kind, &line.pixels);
    line.kind = image_find_digest_kind(kind, strlen(kind));
    const int length = snprintf(written, sizeof written, "%s %s %016" PRIx64 " ", line.date, kind, line.pixels);
    if (!baseline_is_date(line.date) || line.kind == IMAGE_DIGEST_KINDS ||
        strncmp(text, written, (size_t)length) != 0 || !text[length])
        return error_set(error,
                         "%s:%zu: expected a date, the kind of digest, a digest and the name of a frame, as in "
                         "\"2026-11-22 runs 0123456789abcdef menu/1.png\"",
                         path, number);
    line.name = text + length;
    return add_line(h, &line, error);
}

static bool parse(history *h, const char *path, char *text, octreel_error *error)
{
    size_t number = 0;
    for (char *line; (line = text_next_line(&text));)
        if (++number == 1 ? strcmp(line, BEGINNING) != 0 && !error_set(error, "%s:1: expected \"" BEGINNING "\"", path)
                          : !read_line(h, path, line, number, error))
            return false;
    sort_lines(h);
    return true;
}

bool history_read(history *h, const char *baseline, octreel_error *error)
{
    char *path = history_path(baseline), *bytes = NULL;
    size_t size;
    *h = (history){0};
    bool ok = path || error_no_memory(error);
    if (ok && (access(path, F_OK) == 0 || errno != ENOENT)) {
        ok = file_read_whole(path, &bytes, &size, error);
        if (ok) {
            bytes[size] = 0;
            ok = strlen(bytes) < size ? error_set(error, "%s: contains a zero byte, so it is not a text file", path)
                                      : parse(h, path, bytes, error);
        }
    }
    free(bytes);
    free(path);
    if (!ok)
        history_release(h);
    return ok;
}

/* ---- Writing ------------------------------------------------------------------------------------------------- */

static bool is_accepted(const diff_frame *frame, const frame_digest *digest)
{
    for (size_t i = 0; i < frame->variant_count; i++)
        if (frame->variants[i].pixels == digest->pixels && frame->variants[i].kind == digest->kind)
            return true;
    return false;
}

static history_line line_of_variant(const diff_side *side, const diff_frame *frame, const frame_digest *variant)
{
    history_line line = {.kind = variant->kind, .pixels = variant->pixels, .name = frame->name};
    memcpy(line.date, side->acceptances[variant->acceptance].date, sizeof line.date);
    return line;
}

bool history_add_frame(history *h, const diff_side *now, const diff_frame *before, octreel_error *error)
{
    const diff_frame *frame = diff_side_find_frame(now, before->name);
    bool ok = true;
    for (size_t i = 0; ok && frame && i < before->variant_count; i++) {
        const history_line line = line_of_variant(now, before, &before->variants[i]);
        if (!is_accepted(frame, &before->variants[i]))
            ok = add_line(h, &line, error);
    }
    return ok;
}

/* Return the index after the last line of the frame that line `first` names. */
static size_t end_of_frame(const history *h, size_t first)
{
    size_t end = first;
    while (end < h->count && strcmp(h->lines[end].name, h->lines[first].name) == 0)
        end++;
    return end;
}

static void write_lines(FILE *out, const history *h, const diff_side *now)
{
    fputs(BEGINNING "\n", out);
    for (size_t i = 0, end; i < h->count; i = end) {
        end = end_of_frame(h, i);
        if (!diff_side_find_frame(now, h->lines[i].name))
            continue;
        for (size_t at = end - i > HISTORY_DIGESTS ? end - HISTORY_DIGESTS : i; at < end; at++)
            fprintf(out, "%s %s %016" PRIx64 " %s\n", h->lines[at].date, image_digest_kind_name(h->lines[at].kind),
                    h->lines[at].pixels, h->lines[at].name);
    }
}

bool history_write(history *h, const diff_side *now, octreel_error *error)
{
    file_writer file;
    if (h->count == 0)
        return true;
    char *path = history_path(now->path);
    bool ok = path ? file_writer_open_replacing(&file, path, error) : error_no_memory(error);
    if (ok) {
        file.lasting = true;
        sort_lines(h);
        write_lines(file.stream, h, now);
        ok = file_writer_close(&file, error);
    }
    free(path);
    return ok;
}

/* ---- Flaky frames -------------------------------------------------------------------------------------------- */

/* Find the newest lines of a frame, at most HISTORY_DIGESTS: from *first to *end - 1. */
static void find_lines(const history *h, const char *name, size_t *first, size_t *end)
{
    size_t low = 0, high = h->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const bool before = strcmp(h->lines[middle].name, name) < 0;
        *(before ? &low : &high) = before ? middle + 1 : middle;
    }
    *first = *end = low;
    if (low < h->count && strcmp(h->lines[low].name, name) == 0)
        *end = end_of_frame(h, low);
    if (*end - *first > HISTORY_DIGESTS)
        *first = *end - HISTORY_DIGESTS;
}

/* Print the letter of a digest: A is the digest that was accepted first. Frames that flip together thus have the same
 * sentence. There are at most 2 * HISTORY_DIGESTS + 1 digests. */
static void print_letter(FILE *out, const history *all, size_t i)
{
    int letter = -1;
    for (size_t j = 0; j <= i; j++) {
        size_t same = 0;
        while (!is_same_digest(&all->lines[same], &all->lines[j]))
            same++;
        letter += same == j;
        if (is_same_digest(&all->lines[j], &all->lines[i]))
            break;
    }
    fputc('A' + letter, out);
}

/* Print the sentence. The last line of `all` is the digest of the new frame. */
static void print_flaky(FILE *out, const history *all)
{
    fputs("flaky: the digest was accepted earlier and has come back: ", out);
    for (size_t i = 0; i + 1 < all->count; i++) {
        print_letter(out, all, i);
        fprintf(out, " (%s), ", all->lines[i].date);
    }
    fputs("now ", out);
    print_letter(out, all, all->count - 1);
    fputs("; accept it with --variant to allow both", out);
}

/* Append all digests of a pair to the empty history `all`: those in the history, those in the baseline, the new one. */
static bool collect_digests(history *all, const history *h, size_t first, size_t end, const diff_side *reference,
                            const diff_pair *pair, octreel_error *error)
{
    const size_t variants = pair->a->variant_count;
    bool ok = true;
    for (size_t i = first; ok && i < end; i++)
        ok = add_line(all, &h->lines[i], error);
    for (size_t i = variants > HISTORY_DIGESTS ? variants - HISTORY_DIGESTS : 0; ok && i < variants; i++) {
        const history_line line = line_of_variant(reference, pair->a, &pair->a->variants[i]);
        ok = add_line(all, &line, error);
    }
    if (ok)
        sort_lines(all);
    const history_line now = {.kind = pair->about[1].kind, .pixels = pair->about[1].pixels, .name = pair->a->name};
    return ok && add_line(all, &now, error);
}

static bool find_flaky_pair(const history *h, const diff_side *reference, diff_pair *pair, octreel_error *error)
{
    const history_line now = {.kind = pair->about[1].kind, .pixels = pair->about[1].pixels};
    size_t first, end;
    bool known = false;
    find_lines(h, pair->a->name, &first, &end);
    for (size_t i = first; i < end; i++)
        known = known || is_same_digest(&h->lines[i], &now);
    if (!known)
        return true;
    history all = {0};
    text_stream s;
    bool ok = collect_digests(&all, h, first, end, reference, pair, error);
    if (ok) {
        if (text_stream_begin(&s))
            print_flaky(s.stream, &all);
        ok = text_stream_end(&s, &pair->flaky) || error_no_memory(error);
    }
    history_release(&all);
    return ok;
}

bool history_find_flaky(const diff_side *reference, diff_result *result, octreel_error *error)
{
    history h;
    if (reference->kind != DIFF_BASELINE || file_is_standard_stream(reference->source))
        return true;
    bool ok = history_read(&h, reference->path, error);
    for (size_t i = 0; ok && h.count > 0 && i < result->count; i++) {
        diff_pair *pair = &result->pairs[i];
        if (pair->a && pair->b && diff_finding_verdict(pair->finding) == DIFF_DIFFERENT)
            ok = find_flaky_pair(&h, reference, pair, error);
    }
    history_release(&h);
    return ok;
}
