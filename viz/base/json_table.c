/* SPDX-License-Identifier: MIT */
/* json_table.c - reads and writes structures as JSON objects from one table of members.
 *
 * The problem: a reader and a writer that are written by hand drift apart, and every format repeats the same checks.
 * The idea: a row of a table gives the name of a member, the offset of its value in the structure, limits, conditions,
 * checks, and a codec: the two functions that read and write its type.
 *
 * Reading first looks up each row's name in the object. Then it looks up every name of the object in the table, so that
 * a misspelt member is never ignored: it is an error with a suggestion. The version is read first. So a file of another
 * version gets an error about its version, not about its new members. Writing walks the same rows, so members have a
 * fixed order and equal structures give equal bytes. Cost of reading: members times rows; both are few.
 */
#include "json_table.h"
#include "hint.h"
#include "octree/types.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Members ------------------------------------------------------------------------------------------------ */

static bool has_member(const json_member *table, const char *name)
{
    while (table->name && strcmp(table->name, name) != 0)
        table++;
    return table->name;
}

/* Reports an unknown member. The error message names the line of the member and the place of the object that has it. */
static bool fail_unknown_member(json_reader *r, const json_place *at, const json_member *table, const char *name)
{
    char known[200] = "", text[HINT_TEXT];
    hint h = hint_create(name, strlen(name));
    for (size_t length = 0; table->name && length < sizeof known; table++) {
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", length ? ", " : "", table->name);
        hint_add_candidate(&h, table->name);
    }
    return json_fail_line(r, json_find_line(r, &(json_place){at, name, 0}), at, "unknown member \"%.40s\"%sknown: %s",
                          name, hint_format(&h, "", text), known);
}

static bool read_member(json_reader *r, json_t *object, const json_place *at, const json_member *row, void *into)
{
    json_t *value = json_object_get(object, row->name);
    if (!value)
        return !row->required || json_fail(r, at, "the member \"%s\" is missing", row->name);
    if (row->nullable && json_is_null(value))
        return true;
    const json_place place = {at, row->name, 0};
    r->row = row;
    if (!row->codec->read(r, value, &place, (char *)into + row->offset))
        return false;
    if (row->given)
        *(bool *)((char *)into + row->given) = true;
    return !row->check || row->check(r, &place, into);
}

/* Returns the row after the row of the version. If the table has no version, returns the first row. */
static const json_member *find_row_after_version(const json_member *table)
{
    const json_member *row = table;
    while (row->name && row->codec != &json_version)
        row++;
    return row->name ? row + 1 : table;
}

/* The version is checked before unknown members, so that a file of a newer version gets an error about its version. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into)
{
    const char *name;
    json_t *value;
    const json_member *row = table, *rest = find_row_after_version(table);
    if (!json_is_object(object))
        return json_fail_expected(r, object, at, "an object");
    for (; row < rest; row++)
        if (!read_member(r, object, at, row, into))
            return false;
    json_object_foreach(object, name, value) if (!has_member(table, name)) return fail_unknown_member(r, at, table,
                                                                                                      name);
    for (; row->name; row++)
        if (!read_member(r, object, at, row, into))
            return false;
    return true;
}

bool json_has_nonzero_byte(const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (((const unsigned char *)bytes)[i])
            return true;
    return false;
}

static bool meets_conditions(const json_member *row, const void *structure)
{
    const char *from = structure;
    return (!row->given || *(const bool *)(from + row->given)) && (!row->is_set || row->is_set(structure)) &&
           (row->nonzero_size == 0 || json_has_nonzero_byte(from + row->nonzero, row->nonzero_size));
}

void json_write_members(json_writer *w, const json_member *table, const void *from)
{
    for (; table->name; table++) {
        const bool set = meets_conditions(table, from);
        if (!table->codec->write || !(set || table->nullable))
            continue;
        if (table->line)
            json_start_new_line(w);
        json_write_key(w, table->name);
        w->row = table;
        if (set)
            table->codec->write(w, (const char *)from + table->offset);
        else
            json_write_null(w);
    }
}

void json_write_object(json_writer *w, const json_member *table, const void *from)
{
    json_write_begin_object(w);
    json_write_members(w, table, from);
    json_write_end_object(w);
}

static bool read_object(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return json_read_members(r, value, at, r->row->members, into);
}

static void write_object(json_writer *w, const void *from)
{
    json_write_object(w, w->row->members, from);
}

const json_codec json_structure = {read_object, write_object};

bool json_read_elements(json_reader *r, json_t *list, const json_place *at, const char *expected, json_read_value *read,
                        void *into)
{
    if (!json_is_array(list))
        return json_fail_expected(r, list, at, expected);
    const size_t count = json_array_size(list);
    for (size_t i = 0; i < count; i++)
        if (!read(r, json_array_get(list, i), &(json_place){at, NULL, i}, into))
            return false;
    return true;
}

json_counted_array json_get_counted_array(const void *from)
{
    json_counted_array list;
    memcpy(&list, from, sizeof list);
    return list;
}

static void write_structures(json_writer *w, const void *from)
{
    const json_member *row = w->row;
    const json_counted_array list = json_get_counted_array(from);
    json_write_begin_array(w);
    for (size_t i = 0; i < list.count; i++)
        json_write_object(w, row->members, (const char *)list.items + i * row->size);
    json_write_end_array(w);
}

const json_codec json_structures = {NULL, write_structures};

/* ---- Kinds and choices -------------------------------------------------------------------------------------- */

/* Lists the forms that an object may have, for an error message: {"range": ...}, {"nearest": ...} or {"radius":
 * ...}. */
static const char *format_kinds(json_name *kinds, char *text, size_t size)
{
    size_t length = 0;
    for (int i = 0; kinds(i) && length < size; i++) {
        const char *before = i == 0 ? "" : kinds(i + 1) ? ", " : " or ";
        length += (size_t)snprintf(text + length, size - length, "%s{\"%s\": ...}", before, kinds(i));
    }
    return text;
}

int json_read_kind(json_reader *r, json_t *object, const json_place *at, json_name *kinds)
{
    char forms[200];
    int found = -1;
    for (int kind = 0; kinds(kind); kind++) {
        if (!json_object_get(object, kinds(kind)))
            continue;
        if (found >= 0) {
            json_fail(r, at, "expected one of %s, found \"%s\" and \"%s\" together",
                      format_kinds(kinds, forms, sizeof forms), kinds(found), kinds(kind));
            return -1;
        }
        found = kind;
    }
    if (found < 0)
        json_fail(r, at, "expected %s", format_kinds(kinds, forms, sizeof forms));
    return found;
}

int json_find_name(json_name *names, const char *name)
{
    for (int i = 0; name && names(i); i++)
        if (strcmp(name, names(i)) == 0)
            return i;
    return -1;
}

const char *json_list_names(json_name *names, char *text, size_t size)
{
    size_t length = 0;
    for (int i = 0; names(i) && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", names(i));
    return text;
}

bool json_read_choice(json_reader *r, json_t *value, const json_place *at, void *into)
{
    json_name *names = r->row->names;
    const int found = json_find_name(names, json_string_value(value));
    char known[200], what[sizeof known + 8];
    if (found >= 0) {
        *(int *)into = found;
        return true;
    }
    snprintf(what, sizeof what, "one of %s", json_list_names(names, known, sizeof known));
    return json_fail_expected(r, value, at, what);
}

static void write_choice(json_writer *w, const void *from)
{
    json_write_string(w, w->row->names(*(const int *)from));
}

const json_codec json_choice = {json_read_choice, write_choice};

static bool read_set_element(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const int found = json_find_name(r->row->names, json_string_value(value));
    if (found >= 0)
        *(unsigned *)into |= 1U << found;
    return found >= 0 || json_fail_expected(r, value, at, r->row->advice);
}

static bool read_set(json_reader *r, json_t *value, const json_place *at, void *into)
{
    *(unsigned *)into = 0;
    return json_read_elements(r, value, at, r->row->about, read_set_element, into);
}

static void write_set(json_writer *w, const void *from)
{
    json_name *names = w->row->names;
    json_write_begin_array(w);
    for (int i = 0; names(i); i++)
        if (*(const unsigned *)from >> i & 1)
            json_write_string(w, names(i));
    json_write_end_array(w);
}

const json_codec json_set = {read_set, write_set};

/* ---- Texts and booleans ------------------------------------------------------------------------------------- */

static bool read_constant(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const char *text = json_string_value(value);
    char what[80];
    (void)into;
    snprintf(what, sizeof what, "\"%s\"", (const char *)r->row->about);
    return (text && strcmp(text, r->row->about) == 0) || json_fail_expected(r, value, at, what);
}

static void write_constant(json_writer *w, const void *from)
{
    (void)from;
    json_write_string(w, w->row->about);
}

const json_codec json_constant = {read_constant, write_constant};

static bool read_label(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const char *text = json_string_value(value), *what = r->row->about;
    const size_t length = text ? strlen(text) : 0, most = r->row->size - 1;
    if (!text)
        return json_fail_expected(r, value, at, "a text");
    for (size_t i = 0; i < length; i++)
        if (text[i] < ' ' || text[i] > '~')
            return json_fail(r, at, "%s must be printable ASCII, but byte %zu is not", what, i + 1);
    if (length > most)
        return json_fail(r, at, "%s may have at most %zu characters, but has %zu", what, most, length);
    memcpy(into, text, length + 1);
    return true;
}

static void write_label(json_writer *w, const void *from)
{
    json_write_string(w, from);
}

const json_codec json_label = {read_label, write_label};

void json_write_text(json_writer *w, const void *from)
{
    json_write_string(w, *(const char *const *)from);
}

static bool read_bool(json_reader *r, json_t *value, const json_place *at, void *into)
{
    *(bool *)into = json_is_true(value);
    return json_is_boolean(value) || json_fail_expected(r, value, at, "true or false");
}

static void write_bool(json_writer *w, const void *from)
{
    json_write_bool(w, *(const bool *)from);
}

const json_codec json_bool = {read_bool, write_bool};

/* ---- Numbers ------------------------------------------------------------------------------------------------ */

bool json_read_whole_number(json_reader *r, const json_t *value, const json_place *at, double min, double max,
                            uint64_t *into)
{
    char what[80];
    const double number = json_real_value(value);
    if (json_is_real(value) && number >= min && number <= max && (double)(uint64_t)number == number) {
        *into = (uint64_t)number;
        return true;
    }
    snprintf(what, sizeof what, "a whole number from %.0f to %.0f", min, max);
    return json_fail_expected(r, value, at, what);
}

static bool read_version(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const uint64_t own = (uint64_t)r->row->max;
    uint64_t version = 0;
    (void)into;
    if (!json_read_whole_number(r, value, at, 1, JSON_LARGEST_WHOLE, &version))
        return false;
    if (version > own)
        return json_fail(r, at,
                         "%s version %" PRIu64 " is newer than version %" PRIu64
                         ", the newest that this Octreel reads; use a newer Octreel",
                         (const char *)r->row->about, version, own);
    const char *advice = r->row->advice ? r->row->advice : "record it again with this Octreel";
    return version == own || json_fail(r, at, "%s version %" PRIu64 " is not supported; %s",
                                       (const char *)r->row->about, version, advice);
}

static void write_version(json_writer *w, const void *from)
{
    (void)from;
    json_write_integer(w, (uint64_t)w->row->max);
}

const json_codec json_version = {read_version, write_version};

/* Returns whether the codec stores its whole number in 64 bits. Otherwise the number has 32 bits. */
static bool is_64_bit(const json_codec *codec)
{
    return codec == &json_uint64 || (codec == &json_size && sizeof(size_t) == sizeof(uint64_t));
}

static bool read_whole_number(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const json_member *row = r->row;
    uint64_t number = 0;
    if (!json_read_whole_number(r, value, at, row->min, row->max, &number))
        return false;
    if (is_64_bit(row->codec))
        memcpy(into, &number, sizeof number);
    else
        memcpy(into, &(uint32_t){(uint32_t)number}, sizeof(uint32_t));
    return true;
}

/* Writes a whole number. A number above row->max is written as row->max, so that it can be read again. In rows that
 * are never read, max is 0 and means no limit. */
static void write_whole_number(json_writer *w, const void *from)
{
    const uint64_t max = (uint64_t)w->row->max;
    uint64_t number;
    uint32_t narrow;
    memcpy(&narrow, from, sizeof narrow);
    number = narrow;
    if (is_64_bit(w->row->codec))
        memcpy(&number, from, sizeof number);
    json_write_integer(w, max == 0 || number < max ? number : max);
}

const json_codec json_uint64 = {read_whole_number, write_whole_number};
const json_codec json_size = {read_whole_number, write_whole_number};
const json_codec json_int = {read_whole_number, write_whole_number};

static bool read_int_element(json_reader *r, json_t *value, const json_place *at, void *into)
{
    uint64_t number = 0;
    if (!json_read_whole_number(r, value, at, r->row->min, r->row->max, &number))
        return false;
    ((int *)into)[at->index] = (int)number;
    return true;
}

static bool read_int_array(json_reader *r, json_t *list, const json_place *at, void *into)
{
    return json_array_size(list) == r->row->size
               ? json_read_elements(r, list, at, r->row->about, read_int_element, into)
               : json_fail_expected(r, list, at, r->row->about);
}

static void write_int_array(json_writer *w, const void *from)
{
    json_write_begin_array(w);
    for (size_t i = 0; i < w->row->size; i++)
        json_write_number(w, ((const int *)from)[i]);
    json_write_end_array(w);
}

const json_codec json_ints = {read_int_array, write_int_array};

bool json_read_id(json_reader *r, const json_t *list, const json_place *at, size_t i, uint64_t *id)
{
    return json_read_whole_number(r, json_array_get(list, i), &(json_place){at, NULL, i}, 0, JSON_LARGEST_WHOLE, id);
}

static bool read_id_array(json_reader *r, json_t *list, const json_place *at, void *into)
{
    const size_t count = json_array_size(list);
    json_counted_array found = json_get_counted_array(into);
    if (!json_is_array(list))
        return json_fail_expected(r, list, at, "a list of ids");
    uint64_t *ids = found.items ? (uint64_t *)found.items : malloc((count > 0 ? count : 1) * sizeof *ids);
    if (!ids)
        return json_fail(r, at, "out of memory for %zu ids", count);
    found = (json_counted_array){ids, count};
    memcpy(into, &found, sizeof found);
    for (size_t i = 0; i < count; i++)
        if (!json_read_id(r, list, at, i, &ids[i]))
            return false;
    return true;
}

static void write_id_array(json_writer *w, const void *from)
{
    const json_counted_array list = json_get_counted_array(from);
    json_write_begin_array(w);
    for (size_t i = 0; i < list.count; i++)
        json_write_integer(w, ((const uint64_t *)list.items)[i]);
    json_write_end_array(w);
}

const json_codec json_ids = {read_id_array, write_id_array};

/* Reads a number. If row->max is greater than row->min, the number must lie between row->min and row->max. */
static bool read_number(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const json_member *row = r->row;
    const double number = *(double *)into = json_real_value(value);
    char what[80] = "a number";
    if (row->min < row->max)
        snprintf(what, sizeof what, "a number from %g to %g", row->min, row->max);
    return (json_is_real(value) && (row->min == row->max || (number >= row->min && number <= row->max))) ||
           json_fail_expected(r, value, at, what);
}

static bool read_nonnegative(json_reader *r, json_t *value, const json_place *at, void *into)
{
    *(double *)into = json_real_value(value);
    return (json_is_real(value) && *(double *)into >= 0) ||
           json_fail_expected(r, value, at, "a number that is not negative");
}

static void write_number(json_writer *w, const void *from)
{
    json_write_number(w, *(const double *)from);
}

const json_codec json_number = {read_number, write_number};
const json_codec json_nonnegative = {read_nonnegative, write_number};

/* ---- Vectors ------------------------------------------------------------------------------------------------ */

bool json_read_numbers(json_reader *r, const json_t *list, const json_place *at, size_t first, size_t count,
                       double *into)
{
    for (size_t i = first; i < first + count; i++, into++) {
        const json_t *value = json_array_get(list, i);
        *into = json_real_value(value);
        if (!json_is_real(value))
            return json_fail_expected(r, value, &(json_place){at, NULL, i}, "a number");
    }
    return true;
}

static bool read_number_array(json_reader *r, json_t *value, const json_place *at, void *into)
{
    if (json_array_size(value) != r->row->size)
        return json_fail_expected(r, value, at, r->row->about);
    return json_read_numbers(r, value, at, 0, r->row->size, into);
}

static void write_number_array(json_writer *w, const void *from)
{
    json_write_numbers(w, from, w->row->size);
}

bool json_read_vector(json_reader *r, json_t *value, const json_place *at, void *into)
{
    if (json_array_size(value) != 3)
        return json_fail_expected(r, value, at, "three numbers [x, y, z]");
    return json_read_numbers(r, value, at, 0, 3, into);
}

static void write_vector(json_writer *w, const void *from)
{
    json_write_numbers(w, from, 3);
}

const json_codec json_numbers = {read_number_array, write_number_array};
const json_codec json_vector = {json_read_vector, write_vector};

static const json_member corners[] = {
    {"min", &json_vector, offsetof(octree_box, min), .required = true},
    {"max", &json_vector, offsetof(octree_box, max), .required = true},
    {0},
};

static bool read_box(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const octree_box *box = into;
    if (!json_read_members(r, value, at, corners, into))
        return false;
    for (int i = 0; i < 3; i++)
        if (box->min[i] > box->max[i])
            return json_fail(r, at, "min is above max on axis %c", "xyz"[i]);
    return true;
}

static void write_box(json_writer *w, const void *from)
{
    json_write_object(w, corners, from);
}

const json_codec json_box = {read_box, write_box};
