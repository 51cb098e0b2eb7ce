/* SPDX-License-Identifier: MIT */
/* baseline.c - reads, merges and writes baselines; baseline.h describes the format. */
#include "baseline.h"
#include "array.h"
#include "file.h"
#include "file_kind.h"
#include "octree/digest.h"
#include "rule.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char id_letters[] = "0123456789abcdefghijklmnopqrstuvwxyz";
#define ID_LETTERS (sizeof id_letters - 1)
#define IDS (ID_LETTERS * ID_LETTERS)

/* ---- Dates, reasons and names -------------------------------------------------------------------------------- */

static int parse_digits(const char *text, int count)
{
    int value = 0;
    for (; count > 0; count--, text++)
        value = value * 10 + (*text - '0');
    return value;
}

bool baseline_is_date(const char *text)
{
    static const int days[] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    static const char form[] = "0000-00-00";
    for (size_t i = 0; i < sizeof form - 1; i++)
        if (form[i] == '-' ? text[i] != '-' : text[i] < '0' || text[i] > '9')
            return false;
    const int year = parse_digits(text, 4), month = parse_digits(text + 5, 2), day = parse_digits(text + 8, 2);
    const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return !text[sizeof form - 1] && month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1] &&
           (month != 2 || day < 29 || leap);
}

/* Return whether a text contains a control character, such as a newline. A name or a reason must not contain one,
 * because it must fit on one line. */
static bool has_control_character(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            return true;
    return false;
}

bool baseline_is_reason(const char *text)
{
    const size_t length = strlen(text);
    return length > 0 && text[0] != ' ' && text[length - 1] != ' ' && !has_control_character(text);
}

/* Return the length of a frame's name as a baseline contains it: without ".png". If the rest would end with ".png"
 * or a blank, the whole name is written, because read_name() could not restore it. */
static size_t length_of_written_name(const char *name)
{
    const size_t length = strlen(name), stem = length > 4 ? length - 4 : 0;
    const bool plain = stem > 0 && strcmp(name + stem, ".png") == 0 && name[stem - 1] != ' ' &&
                       !(stem >= 4 && strncasecmp(name + stem - 4, ".png", 4) == 0);
    return plain ? stem : length;
}

/* Return the name of a frame for the name that a baseline contains, or null if memory runs out. The caller frees the
 * name. */
static char *read_name(const char *written)
{
    const size_t length = strlen(written);
    const bool whole = length >= 4 && strcasecmp(written + length - 4, ".png") == 0;
    char *name = malloc(length + sizeof ".png");
    if (name)
        snprintf(name, length + sizeof ".png", "%s%s", written, whole ? "" : ".png");
    return name;
}

/* ---- Acceptances --------------------------------------------------------------------------------------------- */

static bool is_acceptance_id(const char *text)
{
    return text[0] && strchr(id_letters, text[0]) && text[1] && strchr(id_letters, text[1]);
}

static const acceptance *find_acceptance_by_id(const diff_side *side, const char *id)
{
    for (size_t i = 0; i < side->acceptance_count; i++)
        if (memcmp(side->acceptances[i].id, id, 2) == 0)
            return &side->acceptances[i];
    return NULL;
}

static bool is_same_acceptance(const acceptance *a, const acceptance *b)
{
    return strcmp(a->date, b->date) == 0 && a->width == b->width && a->height == b->height && a->kind == b->kind &&
           strcmp(a->reason, b->reason) == 0;
}

/* Append a copy of an acceptance. The copy owns a copy of the reason. */
static bool append_acceptance(diff_side *side, const acceptance *from, octreel_error *error)
{
    if (!array_grow(&side->acceptances, side->acceptance_count + 1, &side->acceptance_room, sizeof *side->acceptances))
        return error_no_memory(error);
    side->acceptances[side->acceptance_count] = *from;
    side->acceptances[side->acceptance_count].reason = strdup(from->reason);
    if (!side->acceptances[side->acceptance_count].reason)
        return error_no_memory(error);
    side->acceptance_count++;
    return true;
}

/* Set a->id to an id that no acceptance of the side uses. The search starts at the hash of the acceptance and tries
 * the following ids in order. Return false if all ids are in use. */
static bool choose_acceptance_id(const diff_side *side, acceptance *a)
{
    uint64_t digest = octree_digest_bytes(OCTREE_DIGEST_START, a->date, strlen(a->date));
    digest = octree_digest_word(octree_digest_word(digest, (uint64_t)a->width), (uint64_t)a->height);
    digest = octree_digest_bytes(octree_digest_word(digest, (uint64_t)a->kind), a->reason, strlen(a->reason));
    for (size_t tried = 0; tried < IDS; tried++, digest++) {
        const size_t n = (size_t)(digest % IDS);
        memcpy(a->id, (char[]){id_letters[n / ID_LETTERS], id_letters[n % ID_LETTERS], 0}, 3);
        if (!find_acceptance_by_id(side, a->id))
            return true;
    }
    return false;
}

bool baseline_add_acceptance(diff_side *side, const acceptance_note *note, frame_digest *digest, octreel_error *error)
{
    acceptance wanted = {.width = digest->width, .height = digest->height, .kind = digest->kind};
    snprintf(wanted.date, sizeof wanted.date, "%s", note->date);
    wanted.reason = (char *)note->reason;
    for (size_t i = side->acceptance_count; i > 0; i--)
        if (is_same_acceptance(&side->acceptances[i - 1], &wanted)) {
            digest->acceptance = i - 1;
            return true;
        }
    if (!choose_acceptance_id(side, &wanted))
        return error_set(error, "%s: the baseline is full: all %zu ids of acceptances are in use; start a new baseline",
                         side->path, IDS);
    digest->acceptance = side->acceptance_count;
    return append_acceptance(side, &wanted, error);
}

/* ---- Reading -------------------------------------------------------------------------------------------------
 *
 * The values of a line are read with sscanf() and printed again. The line is valid only if it begins with the printed
 * text, which is the text that baseline_write() writes. Additional blanks, additional zeros, signs and capital letters
 * are therefore refused.
 */

static bool report_bad_line(const diff_side *side, size_t number, octreel_error *error)
{
    return error_set(error,
                     "%s:%zu: expected an acceptance, as in \"accepted 7f 2026-11-22 1280x720 runs the reason\", or "
                     "its id, a digest and a frame, as in \"7f %016d frame_000000\"",
                     side->path, number, 0);
}

static bool is_image_side(int length)
{
    return length > 0 && length <= IMAGE_MAX_SIDE;
}

/* Read an acceptance from its line in a baseline. `line` begins after the word "accepted ". */
static bool read_acceptance(diff_side *side, char *line, size_t number, octreel_error *error)
{
    acceptance a = {.id = ""};
    char written[64];
    if (sscanf(line, "%2s %10s %5dx%5d", a.id, a.date, &a.width, &a.height) != 4)
        return report_bad_line(side, number, error);
    const size_t size = (size_t)snprintf(written, sizeof written, "%s %s %dx%d ", a.id, a.date, a.width, a.height);
    if (strncmp(line, written, size) != 0 || !is_acceptance_id(a.id) || !baseline_is_date(a.date) ||
        !is_image_side(a.width) || !is_image_side(a.height))
        return report_bad_line(side, number, error);
    char *at = line + size;
    const size_t kind = strcspn(at, " ");
    a.kind = image_find_digest_kind(at, kind);
    if (a.kind == IMAGE_DIGEST_KINDS)
        return error_set(error, "%s:%zu: unknown kind of digest \"%.*s\"; a newer octreel may have written it",
                         side->path, number, kind < 40 ? (int)kind : 40, at);
    a.reason = at + kind + (at[kind] == ' ');
    if (!baseline_is_reason(a.reason))
        return report_bad_line(side, number, error);
    const acceptance *other = find_acceptance_by_id(side, a.id);
    if (!other)
        return append_acceptance(side, &a, error);
    return is_same_acceptance(other, &a) ||
           error_set(error,
                     "%s:%zu: the id %s is already used by another acceptance; give one of the two, and its digests, a "
                     "new id",
                     side->path, number, a.id);
}

bool baseline_is_path(const char *name)
{
    for (const char *at = name;; at++) {
        const size_t length = strcspn(at, "/");
        if (length == 0 || (at[0] == '.' && (length == 1 || (length == 2 && at[1] == '.'))))
            return false;
        at += length;
        if (!*at)
            return true;
    }
}

static bool add_written_frame(diff_side *side, const char *written, frame_digest digest, size_t number,
                              octreel_error *error)
{
    char *name = read_name(written);
    bool ok = name || error_no_memory(error);
    if (ok && !baseline_is_path(name))
        ok = error_set(error, "%s:%zu: expected a path relative to the compared folder, such as \"menu/1\", not \"%s\"",
                       side->path, number, written);
    ok = ok && diff_side_add_frame(side, name, digest, error);
    free(name);
    return ok;
}

static bool read_digest(diff_side *side, const char *line, size_t number, octreel_error *error)
{
    frame_digest digest = {0};
    char written[sizeof "7f 0123456789abcdef "], id[3] = "";
    sscanf(line, "%2s %16" SCNx64, id, &digest.pixels);
    snprintf(written, sizeof written, "%s %016" PRIx64 " ", id, digest.pixels);
    if (strncmp(line, written, sizeof written - 1) != 0 || !is_acceptance_id(id))
        return report_bad_line(side, number, error);
    const char *at = line + sizeof written - 1;
    if (!*at || has_control_character(at))
        return report_bad_line(side, number, error);
    const acceptance *by = find_acceptance_by_id(side, line);
    if (!by)
        return error_set(error,
                         "%s:%zu: no line before this one defines the id %.2s, as in \"accepted %.2s 2026-11-22 ...\"",
                         side->path, number, line, line);
    digest.width = by->width;
    digest.height = by->height;
    digest.kind = by->kind;
    digest.acceptance = (size_t)(by - side->acceptances);
    return add_written_frame(side, at, digest, number, error);
}

static bool read_version(const diff_side *side, const char *line, octreel_error *error)
{
    return strcmp(line, DIGEST_FILE_BEGINNING "2") == 0 ||
           error_set(error,
                     "%s:1: expected \"%s2\"; version 1, which octreel digest wrote, is no longer read: use octreel "
                     "accept BASELINE FRAMES --reason TEXT",
                     side->path, DIGEST_FILE_BEGINNING);
}

static bool read_background(diff_side *side, const char *line, octreel_error *error)
{
    char written[sizeof "background ffffff"];
    unsigned value = 0;
    sscanf(line, "background %6x", &value);
    snprintf(written, sizeof written, "background %06x", value);
    if (strcmp(line, written) != 0)
        return error_set(error, "%s:2: expected a background, as in \"background ffffff\"", side->path);
    side->background = (image_color){(uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value};
    return true;
}

/* Return whether a line is a conflict marker of git: it begins with seven equal characters, as in "<<<<<<< ours". */
static bool is_conflict_marker(const char *line)
{
    return strlen(line) >= 7 && strchr("<=>|", line[0]) && strspn(line, (char[]){line[0], 0}) == 7 &&
           (line[7] == 0 || line[7] == ' ');
}

/* Keep a line that baseline_write() writes as it is. */
static bool keep_line(diff_side *side, const char *line, octreel_error *error)
{
    const size_t length = strlen(line);
    if (!array_grow(&side->notes, side->notes_size + length + 1, &side->notes_room, 1))
        return error_no_memory(error);
    memcpy(side->notes + side->notes_size, line, length);
    side->notes_size += length + 1;
    side->notes[side->notes_size - 1] = '\n';
    return true;
}

/* Read a line. `whole` is false if the line does not end with a newline. Octreel ends its lines with a newline, so a
 * line without one may be the beginning of a longer line. Rules and comments are accepted without a newline, because
 * people write them. */
static bool read_line(diff_side *side, char *line, size_t number, bool whole, octreel_error *error)
{
    static const char accepted[] = "accepted ", rule[] = "rule ";
    if (is_conflict_marker(line))
        return error_set(error,
                         "%s:%zu: unresolved merge conflict; keep the lines that are right and delete git's markers",
                         side->path, number);
    if (number == 1)
        return read_version(side, line, error);
    if (!whole && line[0] != '#' && strncmp(line, rule, sizeof rule - 1) != 0)
        return error_set(error,
                         "%s:%zu: the line does not end with a newline, so the file may be cut off; restore it, or end "
                         "the line",
                         side->path, number);
    if (number == 2)
        return read_background(side, line, error);
    if (strncmp(line, accepted, sizeof accepted - 1) == 0)
        return read_acceptance(side, line + sizeof accepted - 1, number, error);
    if (strncmp(line, rule, sizeof rule - 1) == 0)
        return rule_read(side, line + sizeof rule - 1, number, error) && keep_line(side, line, error);
    if (line[0] == '#')
        return keep_line(side, line, error);
    return read_digest(side, line, number, error);
}

bool baseline_parse(diff_side *side, char *text, size_t size, octreel_error *error)
{
    const bool ends_line = size > 0 && text[size - 1] == '\n';
    size_t number = 0;
    side->kind = DIFF_BASELINE;
    if (memchr(text, 0, size))
        return error_set(error, "%s: contains a zero byte, so it is not a text file", side->path);
    for (char *line; (line = text_next_line(&text));)
        if (!read_line(side, line, ++number, ends_line || *text, error))
            return false;
    if (number < 2)
        return error_set(error, "%s: the file ends before its second line", side->path);
    return baseline_merge_frames(side, error) && rules_check(side, side->source, error);
}

bool baseline_read(diff_side *side, octreel_error *error)
{
    char *bytes;
    size_t size;
    if (!file_read_whole(side->source, &bytes, &size, error))
        return false;
    bytes[size] = 0;
    const bool ok = baseline_parse(side, bytes, size, error);
    free(bytes);
    return ok;
}

/* ---- Frames and their variants ------------------------------------------------------------------------------- */

/* A union merge by git may repeat the line of a variant. If the frame already has this variant, nothing is added. */
bool baseline_add_variant(diff_frame *frame, const frame_digest *digest)
{
    for (size_t i = 0; i < frame->variant_count; i++)
        if (frame->variants[i].acceptance == digest->acceptance && frame->variants[i].pixels == digest->pixels)
            return true;
    frame_digest *grown = realloc(frame->variants, (frame->variant_count + 1) * sizeof *grown);
    if (!grown)
        return false;
    grown[frame->variant_count++] = *digest;
    frame->variants = grown;
    return true;
}

/* Set frame->digest to the newest variant: the variant that was accepted last. */
static void set_digest_to_newest_variant(const diff_side *side, diff_frame *frame)
{
    frame->digest = frame->variants[0];
    for (size_t i = 1; i < frame->variant_count; i++)
        if (strcmp(side->acceptances[frame->variants[i].acceptance].date,
                   side->acceptances[frame->digest.acceptance].date) >= 0)
            frame->digest = frame->variants[i];
}

bool baseline_merge_frames(diff_side *side, octreel_error *error)
{
    size_t kept = 0;
    bool ok = true;
    diff_side_sort_frames(side);
    for (size_t i = 0; i < side->count; i++) {
        diff_frame frame = side->frames[i];
        if (kept > 0 && strcmp(side->frames[kept - 1].name, frame.name) == 0) {
            ok = ok && baseline_add_variant(&side->frames[kept - 1], &frame.digest);
            free(frame.name);
        } else {
            ok = ok && (frame.variants || baseline_add_variant(&frame, &frame.digest));
            side->frames[kept++] = frame;
        }
    }
    side->count = kept;
    for (size_t i = 0; ok && i < kept; i++)
        set_digest_to_newest_variant(side, &side->frames[i]);
    return ok || error_no_memory(error);
}

bool baseline_add_frame(diff_side *side, const char *name, const frame_digest *variants, size_t count,
                        octreel_error *error)
{
    bool ok = diff_side_add_frame(side, name, variants[0], error);
    for (size_t i = 0; ok && i < count; i++)
        ok = baseline_add_variant(&side->frames[side->count - 1], &variants[i]) || error_no_memory(error);
    return ok;
}

/* ---- Writing ------------------------------------------------------------------------------------------------- */

static int compare_by_id(const void *a, const void *b)
{
    return strcmp((*(const acceptance *const *)a)->id, (*(const acceptance *const *)b)->id);
}

static bool is_acceptance_used(const diff_side *side, size_t acceptance)
{
    for (size_t i = 0; i < side->count; i++)
        for (size_t j = 0; j < side->frames[i].variant_count; j++)
            if (side->frames[i].variants[j].acceptance == acceptance)
                return true;
    return false;
}

static bool write_acceptances(FILE *out, const diff_side *side)
{
    const acceptance **used = malloc((side->acceptance_count + 1) * sizeof *used);
    size_t count = 0;
    if (!used)
        return false;
    for (size_t i = 0; i < side->acceptance_count; i++)
        if (is_acceptance_used(side, i))
            used[count++] = &side->acceptances[i];
    qsort(used, count, sizeof(const acceptance *), compare_by_id);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "accepted %s %s %dx%d %s %s\n", used[i]->id, used[i]->date, used[i]->width, used[i]->height,
                image_digest_kind_name(used[i]->kind), used[i]->reason);
    free(used);
    return true;
}

/* Return the variant that follows `last` in the order of ids, then digests. With `last` null, return the first
 * variant. After the last variant, return null. */
static const frame_digest *find_next_variant(const diff_side *side, const diff_frame *frame, const frame_digest *last)
{
    const frame_digest *next = NULL;
    for (size_t i = 0; i < frame->variant_count; i++) {
        const frame_digest *at = &frame->variants[i];
        const char *id = side->acceptances[at->acceptance].id;
        const int after = last ? strcmp(id, side->acceptances[last->acceptance].id) : 1;
        const int before = next ? strcmp(id, side->acceptances[next->acceptance].id) : -1;
        if ((after > 0 || (after == 0 && at->pixels > last->pixels)) &&
            (before < 0 || (before == 0 && at->pixels < next->pixels)))
            next = at;
    }
    return next;
}

static bool report_bad_name(const diff_side *side, const char *name, octreel_error *error)
{
    char *shown = strdup(name);
    error_set(error, "%s: the frame name \"%s\" contains a control character; rename the file", side->path,
              shown ? make_printable(shown) : "");
    free(shown);
    return false;
}

bool baseline_write(FILE *out, const diff_side *side, octreel_error *error)
{
    const image_color ground = side->background;
    for (size_t i = 0; i < side->count; i++)
        if (has_control_character(side->frames[i].name))
            return report_bad_name(side, side->frames[i].name, error);
    fprintf(out, "%s2\nbackground %02x%02x%02x\n", DIGEST_FILE_BEGINNING, ground.r, ground.g, ground.b);
    if (side->notes_size > 0)
        fwrite(side->notes, 1, side->notes_size, out);
    if (!write_acceptances(out, side))
        return error_no_memory(error);
    for (size_t i = 0; i < side->count; i++) {
        const diff_frame *frame = &side->frames[i];
        for (const frame_digest *at = NULL; (at = find_next_variant(side, frame, at));)
            fprintf(out, "%s %016" PRIx64 " %.*s\n", side->acceptances[at->acceptance].id, at->pixels,
                    (int)length_of_written_name(frame->name), frame->name);
    }
    return true;
}
