/* SPDX-License-Identifier: MIT */
/* rule.c - reads rules, finds the rule for a frame, and makes its mask; rule.h describes them. */
#include "rule.h"
#include "array.h"
#include "baseline.h"
#include "error.h"
#include "file.h"
#include "flip.h"
#include "number.h"
#include "png_read.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Names ---------------------------------------------------------------------------------------------------
 *
 * A pattern is matched with two cursors. A star first stands for no characters. On a mismatch the star before takes one
 * character more. Only the last star has to be tried again, so the cost is at most the product of both lengths.
 */

static bool matches_characters(const char *pattern, const char *name, size_t length)
{
    const char *at = pattern, *end = name + length, *star = NULL, *taken = NULL;
    while (name < end) {
        const bool literal = *at == '\\' && at[1];
        if (*at == '*') {
            star = at++;
            taken = name;
        } else if (*at && (literal ? at[1] == *name : *at == '?' || *at == *name)) {
            at += 1 + literal;
            name++;
        } else if (star) {
            at = star + 1;
            name = ++taken;
        } else {
            return false;
        }
    }
    while (*at == '*')
        at++;
    return !*at;
}

/* A pattern is compared with the name of a frame with and without its ending ".png". */
static bool matches(const baseline_rule *rule, const char *frame)
{
    return matches_characters(rule->pattern, frame, strlen(frame)) ||
           matches_characters(rule->pattern, frame, diff_stem_length(frame));
}

/* Return the number of characters besides * and ?, or SIZE_MAX for a name without these two. */
static size_t find_specificity(const char *pattern)
{
    size_t count = 0;
    bool exact = true;
    for (const char *at = pattern; *at; at++) {
        const bool wild = *at == '*' || *at == '?';
        at += *at == '\\' && at[1];
        count += !wild;
        exact = exact && !wild;
    }
    return exact ? SIZE_MAX : count;
}

static bool is_more_specific(const baseline_rule *a, const baseline_rule *b)
{
    const size_t x = find_specificity(a->pattern), y = find_specificity(b->pattern);
    return x > y || (x == y && a->line > b->line);
}

baseline_rule *rule_find(const diff_side *side, const char *frame)
{
    baseline_rule *found = NULL;
    for (size_t i = 0; i < side->rule_count; i++)
        if (matches(&side->rules[i], frame) && (!found || is_more_specific(&side->rules[i], found)))
            found = &side->rules[i];
    return found;
}

/* ---- Reading ------------------------------------------------------------------------------------------------- */

/* The beginning of an error: "baseline.txt:12: ". */
typedef struct rule_place {
    char text[256];
} rule_place;

static rule_place print_place(const baseline_rule *rule)
{
    rule_place place;
    snprintf(place.text, sizeof place.text, "%.220s:%zu: ", rule->file, rule->line);
    return place;
}

static bool is_not_empty(const char *text)
{
    return *text != 0;
}

/* The keys whose value is a text. The other keys are the tolerances of tolerance.c. */
static const struct {
    const char *name, *takes;
    size_t offset;
    bool (*is_valid)(const char *text);
} text_keys[] = {
#define TEXT_KEY(name, member, is_valid, takes)                                                                        \
    {                                                                                                                  \
        name, takes, offsetof(baseline_rule, member), is_valid                                                         \
    }
    TEXT_KEY("ignore-layer", layers, is_not_empty, "names of layers, such as nodes,points"),
    TEXT_KEY("ignore-mask", mask, baseline_is_path, "the path of a PNG below the folder of the baseline"),
    TEXT_KEY("date", date, baseline_is_date, "an existing date such as 2026-11-22"),
    TEXT_KEY("expires", expires, baseline_is_date, "an existing date such as 2026-11-22"),
    TEXT_KEY("reason", reason, baseline_is_reason, "a text that neither begins nor ends with a space"),
#undef TEXT_KEY
};
enum { TEXT_KEYS = sizeof text_keys / sizeof text_keys[0] };

static bool report_unknown_key(const baseline_rule *rule, const char *key, octreel_error *error)
{
    char names[256] = "";
    for (int i = 0; tolerance_name(i); i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s, ", tolerance_name(i));
    for (int i = 0; i < TEXT_KEYS; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), i < TEXT_KEYS - 1 ? "%s, " : "%s",
                 text_keys[i].name);
    return error_set(error, "%sunknown key \"%.40s\"; the keys of a rule are %s", print_place(rule).text, key, names);
}

static bool read_text_key(baseline_rule *rule, int i, const char *value, octreel_error *error)
{
    const char **member = (const char **)((char *)rule + text_keys[i].offset);
    if (*member)
        return error_set(error, "%s%s is given twice", print_place(rule).text, text_keys[i].name);
    *member = value;
    return (value && text_keys[i].is_valid(value)) ||
           error_set(error, "%s%s takes %s, not \"%.80s\"", print_place(rule).text, text_keys[i].name,
                     text_keys[i].takes, value ? value : "");
}

/* Read one word of a rule: KEY or KEY=VALUE. */
static bool read_key(baseline_rule *rule, unsigned *seen, char *word, octreel_error *error)
{
    char *equals = strchr(word, '=');
    const char *value = equals ? equals + 1 : NULL;
    if (equals)
        *equals = 0;
    for (int i = 0; i < TEXT_KEYS; i++)
        if (strcmp(word, text_keys[i].name) == 0)
            return read_text_key(rule, i, value, error);
    const int i = tolerance_find(word);
    if (i < 0)
        return report_unknown_key(rule, word, error);
    const bool repeats = strcmp(word, "ignore") == 0;
    if (!repeats && *seen & 1u << i)
        return error_set(error, "%s%s is given twice", print_place(rule).text, word);
    if (repeats && rule->tolerance.ignored_count == RULE_RECTANGLES_MOST)
        return error_set(error, "%sa rule has at most %d rectangles; use ignore-mask", print_place(rule).text,
                         RULE_RECTANGLES_MOST);
    *seen |= 1u << i;
    return tolerance_read(i, value, print_place(rule).text, &rule->tolerance, error);
}

/* Return the next word at *at, up to a blank that has no backslash before it, and move *at past it. Return null if no
 * word is left. */
static char *next_word(char **at)
{
    char *word = *at + strspn(*at, " "), *end = word;
    while (*end && *end != ' ')
        end += *end == '\\' && end[1] ? 2 : 1;
    *at = *end ? end + 1 : end;
    *end = 0;
    return *word ? word : NULL;
}

/* Remove the backslashes that protect blanks in the value of a key. */
static void remove_backslashes(char *word)
{
    char *to = word;
    for (const char *at = word; *at; at++) {
        at += *at == '\\' && at[1];
        *to++ = *at;
    }
    *to = 0;
}

static bool read_words(baseline_rule *rule, octreel_error *error)
{
    static const char reason[] = "reason=";
    char *at = rule->text, *word = NULL;
    unsigned seen = 0;
    bool ok = true;
    rule->pattern = next_word(&at);
    while (ok && !rule->reason) {
        at += strspn(at, " ");
        const bool last = strncmp(at, reason, sizeof reason - 1) == 0; /* the reason is the rest of the line */
        word = last ? at : next_word(&at);
        if (!word)
            return true;
        if (!last)
            remove_backslashes(word);
        ok = read_key(rule, &seen, word, error);
    }
    return ok;
}

static bool check_rule(const baseline_rule *rule, octreel_error *error)
{
    const rule_place printed = print_place(rule);
    const char *place = printed.text;
    if (!rule->pattern || !rule->reason)
        return error_set(error,
                         "%sexpected a rule with a reason, as in \"rule menu/* max-delta=0.02 expires=2027-01-31 "
                         "reason=the clock shows the time\"",
                         place);
    if (strlen(rule->pattern) > RULE_PATTERN_LONGEST)
        return error_set(error, "%sthe pattern is longer than %d characters", place, RULE_PATTERN_LONGEST);
    if (tolerance_is_exact(&rule->tolerance) && !rule->layers && !rule->mask)
        return error_set(error, "%sthe rule forgives nothing; add a tolerance such as max-delta=0.02, or a mask",
                         place);
    if (tolerance_has_idle_resolution(&rule->tolerance))
        return error_set(error, "%spixels-per-degree has no effect without flip: add flip=X", place);
    return !rule->date || !rule->expires || strcmp(rule->date, rule->expires) <= 0 ||
           error_set(error, "%sthe rule expires on %s, before its date %s", place, rule->expires, rule->date);
}

bool rule_read(diff_side *side, const char *line, size_t number, octreel_error *error)
{
    if (side->rule_count == RULES_MOST)
        return error_set(error, "%s:%zu: a baseline has at most %d rules; join rules by a pattern such as menu/*",
                         side->path, number, RULES_MOST);
    if (!array_grow(&side->rules, side->rule_count + 1, &side->rule_room, sizeof *side->rules))
        return error_no_memory(error);
    baseline_rule *rule = &side->rules[side->rule_count];
    *rule = (baseline_rule){.file = side->path,
                            .base = side->source,
                            .line = number,
                            .text = strdup(line),
                            .tolerance.pixels_per_degree = FLIP_PIXELS_PER_DEGREE};
    if (!rule->text)
        return error_no_memory(error);
    side->rule_count++;
    return read_words(rule, error) && check_rule(rule, error);
}

void rules_release(diff_side *side)
{
    for (size_t i = 0; i < side->rule_count; i++) {
        tolerance_release(&side->rules[i].tolerance);
        free(side->rules[i].text);
    }
    free(side->rules);
    free(side->notes);
}

/* ---- Masks --------------------------------------------------------------------------------------------------- */

/* Return the path of the mask picture. The caller frees it. */
static char *make_mask_path(const baseline_rule *rule)
{
    if (!rule->base || file_is_standard_stream(rule->base))
        return strdup(rule->mask);
    char *folder = path_parent_folder(rule->base), *path = folder ? path_join(folder, rule->mask) : NULL;
    free(folder);
    return path;
}

static bool report_bad_mask(const baseline_rule *rule, const octreel_error *why, octreel_error *error)
{
    return error_set(error, "%sthe mask cannot be used: %s", print_place(rule).text, why->text);
}

static bool add_mask_picture(const baseline_rule *rule, int width, int height, uint8_t *bytes, octreel_error *error)
{
    octreel_error why;
    image picture;
    char *path = make_mask_path(rule);
    if (!path)
        return error_no_memory(error);
    const bool ok = image_read_png_over(path, (image_color){0, 0, 0}, &picture, &why);
    free(path);
    if (!ok)
        return report_bad_mask(rule, &why, error);
    const bool fits = picture.width == width && picture.height == height; /* if not, the frame differs by its size */
    for (int y = 0; fits && y < height; y++)
        for (int x = 0; x < width; x++) {
            const image_color c = image_color_at(&picture, x, y);
            bytes[(size_t)y * (size_t)width + (size_t)x] |= c.r || c.g || c.b;
        }
    image_release(&picture);
    return true;
}

static void add_rectangle(const image_rectangle *r, int width, int height, uint8_t *bytes)
{
    for (int y = r->y; y < height && y - r->y < r->height; y++)
        for (int x = r->x; x < width && x - r->x < r->width; x++)
            bytes[(size_t)y * (size_t)width + (size_t)x] = 1;
}

bool rule_add_mask(const baseline_rule *rule, int width, int height, pixel_mask *mask, octreel_error *error)
{
    if (!rule->mask && rule->tolerance.ignored_count == 0)
        return true;
    uint8_t *bytes = calloc((size_t)width, (size_t)height);
    bool ok = bytes || error_no_memory(error);
    for (size_t i = 0; ok && i < rule->tolerance.ignored_count; i++)
        add_rectangle(&rule->tolerance.ignored[i], width, height, bytes);
    ok = ok && (!rule->mask || add_mask_picture(rule, width, height, bytes, error)) &&
         (mask_add(mask, bytes, width, height) || error_no_memory(error));
    free(bytes);
    return ok;
}

/* ---- Checking a baseline ------------------------------------------------------------------------------------- */

/* Check that each rectangle of a rule overlaps a frame that the rule matches. A rule without frames is no error. */
static bool check_rectangles(const diff_side *side, const baseline_rule *rule, octreel_error *error)
{
    for (size_t n = 0; n < rule->tolerance.ignored_count; n++) {
        const image_rectangle *r = &rule->tolerance.ignored[n];
        const diff_frame *outside = NULL;
        for (size_t i = 0; i < side->count; i++) {
            const diff_frame *frame = &side->frames[i];
            if (!matches(rule, frame->name))
                continue;
            outside = frame;
            if (r->x < frame->digest.width && r->y < frame->digest.height) {
                outside = NULL;
                break;
            }
        }
        if (outside)
            return error_set(error, "%sthe rectangle %d,%d,%d,%d lies outside of the frame %s of %dx%d pixels",
                             print_place(rule).text, r->x, r->y, r->width, r->height, outside->name,
                             outside->digest.width, outside->digest.height);
    }
    return true;
}

static bool check_mask_size(const baseline_rule *rule, const image *mask, const diff_frame *frame, octreel_error *error)
{
    const frame_digest *newest = &frame->digest;
    return !matches(rule, frame->name) || (mask->width == newest->width && mask->height == newest->height) ||
           error_set(error, "%sthe mask %s has %dx%d pixels, but the frame %s has %dx%d", print_place(rule).text,
                     rule->mask, mask->width, mask->height, frame->name, newest->width, newest->height);
}

static bool check_mask_picture(const diff_side *side, const baseline_rule *rule, octreel_error *error)
{
    octreel_error why;
    char *path = make_mask_path(rule);
    image_source *source = path ? image_source_open(path, IMAGE_WHITE, false, &why) : NULL;
    bool ok = source || (path ? report_bad_mask(rule, &why, error) : error_no_memory(error));
    for (size_t i = 0; ok && i < side->count; i++)
        ok = check_mask_size(rule, image_source_description(source), &side->frames[i], error);
    image_source_close(source);
    free(path);
    return ok;
}

bool rules_check(const diff_side *side, bool files, octreel_error *error)
{
    for (size_t i = 0; i < side->rule_count; i++) {
        const baseline_rule *rule = &side->rules[i];
        if (!check_rectangles(side, rule, error) || (files && rule->mask && !check_mask_picture(side, rule, error)))
            return false;
    }
    return true;
}

/* ---- Expiry -------------------------------------------------------------------------------------------------- */

bool rule_has_expired(const baseline_rule *rule, const char *today)
{
    return rule->expires && strcmp(today, rule->expires) > 0;
}

bool rule_today(char today[11], octreel_error *error)
{
    static const uint64_t last = 253402300799; /* of the year 9999 */
    const char *epoch = getenv("SOURCE_DATE_EPOCH"), *at = epoch;
    uint64_t seconds = 0;
    struct tm date;
    if (epoch && (!whole_number_parse(&at, last, &seconds) || *at))
        return error_set(error, "SOURCE_DATE_EPOCH is \"%.40s\"; expected the seconds since 1970-01-01", epoch);
    const time_t now = epoch ? (time_t)seconds : time(NULL);
    const bool ok = epoch ? gmtime_r(&now, &date) : localtime_r(&now, &date);
    if (!ok || strftime(today, 11, "%Y-%m-%d", &date) == 0)
        snprintf(today, 11, "1970-01-01");
    return true;
}
