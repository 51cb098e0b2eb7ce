/* SPDX-License-Identifier: MIT */
/* verify_line.c - reads ticks.jsonl line by line, and finds the first difference between a line and the expected line.
 */
#include "verify_line.h"
#include "array.h"
#include "file.h"
#include "json_read.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* ---- Lines -------------------------------------------------------------------------------------------------- */

bool line_reader_open(line_reader *reader, const char *folder, octreel_error *error)
{
    char reason[FILE_REASON], *path = path_join(folder, "ticks.jsonl");
    *reader = (line_reader){0};
    if (!path)
        return error_no_memory(error);
    reader->stream = file_open(path, NULL, reason);
    if (!reader->stream)
        error_set(error, "%s: %s%s", path, reason,
                  folder_contains(folder, "ticks.jsonl") ? "" : "; if the folder holds chunks, octreel join writes it");
    free(path);
    return reader->stream;
}

void line_reader_close(line_reader *reader)
{
    if (reader->stream)
        fclose(reader->stream);
    free(reader->line);
    *reader = (line_reader){0};
}

void line_reader_skip(line_reader *reader, uint64_t count)
{
    for (int c; count > 0 && (c = getc(reader->stream)) != EOF;)
        count -= c == '\n';
}

line_state line_reader_next(line_reader *reader, size_t limit)
{
    reader->size = 0;
    for (int c; (c = getc(reader->stream)) != EOF;) {
        if (reader->size == limit)
            return LINE_LONG;
        if (!array_grow(&reader->line, reader->size + 1, &reader->room, 1))
            return LINE_TROUBLE;
        reader->line[reader->size++] = (char)c;
        if (c == '\n')
            return LINE_WHOLE;
    }
    if (ferror(reader->stream))
        return LINE_TROUBLE;
    return reader->size ? LINE_TORN : LINE_NONE;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

#define VALUE_TEXT 96

/* Format a JSON value in ASCII. A long text is shortened. */
static const char *format_value(const json_t *value, char text[VALUE_TEXT])
{
    char *whole = value ? json_dumps(value, JSON_COMPACT | JSON_ENCODE_ANY | JSON_ENSURE_ASCII) : NULL;
    if (!whole)
        return value ? "something else" : "missing";
    const bool fits = strlen(whole) < VALUE_TEXT;
    snprintf(text, VALUE_TEXT, "%.*s%s", fits ? VALUE_TEXT : VALUE_TEXT - 4, whole, fits ? "" : "...");
    free(whole);
    return text;
}

/* Report that the found value differs from the expected value. */
static void report_different_values(const json_place *at, const json_t *found, const json_t *expected,
                                    verify_finding *finding)
{
    char place[128], texts[2][VALUE_TEXT];
    json_place_format(at, place, sizeof place);
    const bool scene = strcmp(place, "scene") == 0;
    snprintf(finding->text, sizeof finding->text, "%s is %s in ticks.jsonl, but %s when the tick is played again%s",
             scene ? "the digest of its scene" : place, format_value(found, texts[0]), format_value(expected, texts[1]),
             scene ? " (or another version of octreel wrote the line)" : "");
}

static bool find_difference(const json_place *at, const json_t *found, const json_t *expected, verify_finding *finding);

static bool find_array_difference(const json_place *at, const json_t *found, const json_t *expected,
                                  verify_finding *finding)
{
    const size_t a = json_array_size(found), b = json_array_size(expected);
    for (size_t i = 0; i < a || i < b; i++) {
        const json_place inside = {at, NULL, i};
        if (find_difference(&inside, json_array_get(found, i), json_array_get(expected, i), finding))
            return true;
    }
    return false;
}

/* Report the first difference between two objects. Returns false if they are equal. The members of the expected object
 * are compared first, in their order, and then the members that only the found object has. */
static bool find_object_difference(const json_place *at, const json_t *found, const json_t *expected,
                                   verify_finding *finding)
{
    const json_t *const both[] = {expected, found};
    for (int i = 0; i < 2; i++) {
        /* the casts are safe: jansson's iterators take no const object, but do not change it */
        for (void *member = json_object_iter((json_t *)both[i]); member;
             member = json_object_iter_next((json_t *)both[i], member)) {
            const char *key = json_object_iter_key(member);
            const json_place inside = {at, key, 0};
            if (find_difference(&inside, json_object_get(found, key), json_object_get(expected, key), finding)) {
                if (!at)
                    snprintf(finding->fact, sizeof finding->fact, "%s", key);
                return true;
            }
        }
    }
    return false;
}

/* Report the first difference between two values. Returns false if they are equal. */
static bool find_difference(const json_place *at, const json_t *found, const json_t *expected, verify_finding *finding)
{
    if (json_equal(found, expected))
        return false;
    if (json_is_object(found) && json_is_object(expected))
        return find_object_difference(at, found, expected, finding);
    if (json_is_array(found) && json_is_array(expected))
        return find_array_difference(at, found, expected, finding);
    report_different_values(at, found, expected, finding);
    return true;
}

/* ---- Comparing lines ---------------------------------------------------------------------------------------- */

static void report_line_difference(verify_finding *finding, const char *what)
{
    finding->kind = VERIFY_LINES;
    snprintf(finding->text, sizeof finding->text, "%s", what);
}

/* Report a line that belongs to another tick: lines were lost, repeated or exchanged. Returns false if the line belongs
 * to this tick. */
static bool report_other_tick(const json_t *found, uint64_t tick, verify_finding *finding)
{
    const json_t *number = json_object_get(found, "tick");
    if (!json_is_integer(number) || json_integer_value(number) < 0 || (uint64_t)json_integer_value(number) == tick)
        return false;
    finding->kind = VERIFY_LINES;
    snprintf(finding->text, sizeof finding->text,
             "ticks.jsonl has the line of tick %" JSON_INTEGER_FORMAT " where the line of tick %" PRIu64 " belongs",
             json_integer_value(number), tick);
    return true;
}

static void compare_lines(const json_t *found, const json_t *expected, uint64_t tick, verify_finding *finding)
{
    if (!json_is_object(found)) {
        report_line_difference(finding, "its line in ticks.jsonl is not a JSON object");
    } else if (!report_other_tick(found, tick, finding)) {
        finding->kind = VERIFY_FACTS;
        if (!find_object_difference(NULL, found, expected, finding))
            report_line_difference(
                finding,
                "its line in ticks.jsonl has the same values, but is formatted differently than octreel formats it");
        else if (strcmp(finding->fact, "scene") == 0)
            finding->kind = VERIFY_SCENE;
    }
}

static bool line_equals(const line_reader *found, const char *text, size_t size)
{
    return found->size == size && memcmp(found->line, text, size) == 0;
}

/* The limit of the length of a line in bytes: LINE_FACTOR times the expected length plus LINE_SLACK. More is not
 * read. */
#define LINE_FACTOR 16
#define LINE_SLACK 65536

size_t line_size_limit(const expected_line *expected)
{
    const octree_tick *tick = expected->tick;
    return LINE_FACTOR * expected->size + LINE_SLACK + (tick->split_count + tick->merge_count) * OCTREE_ADDRESS_TEXT;
}

/* Returns true if the line is exactly what earlier versions of octreel wrote for this tick: those versions listed all
 * nodes that split or merged. */
static bool is_earlier_line(const line_reader *found, const expected_line *expected)
{
    tick_extras extras = *expected->extras;
    text_stream s;
    char *text;
    if (expected->tick->split_count <= TICK_LISTED && expected->tick->merge_count <= TICK_LISTED)
        return false;
    extras.whole = true;
    if (text_stream_begin(&s))
        tick_write(s.stream, expected->tick, &extras);
    if (!text_stream_end(&s, &text))
        return false;
    const bool same = line_equals(found, text, s.size);
    free(text);
    return same;
}

bool line_matches(const line_reader *found, const expected_line *expected, verify_finding *finding)
{
    if (line_equals(found, expected->text, expected->size) || is_earlier_line(found, expected))
        return true;
    const size_t flags = JSON_REJECT_DUPLICATES;
    json_error_t why;
    json_t *a = json_parse(found->line, found->size, flags, &why),
           *b = json_parse(expected->text, expected->size, flags, &(json_error_t){0});
    if (a)
        compare_lines(a, b, expected->tick->number, finding);
    else
        report_line_difference(finding, "its line in ticks.jsonl is not JSON");
    json_decref(a);
    json_decref(b);
    return false;
}
