/* SPDX-License-Identifier: MIT */
/* table.c - see table.h. */
#include "table.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measuring.h"
#include "program.h"

void table_add(table *t, const char *scene, const char *variant, const double *values)
{
    if (t->count == t->room) {
        t->room = t->room ? 2 * t->room : 64;
        t->rows = resize_memory(t->rows, t->room * sizeof *t->rows);
    }
    row *r = &t->rows[t->count++];
    snprintf(r->scene, sizeof r->scene, "%s", scene);
    snprintf(r->variant, sizeof r->variant, "%s", variant);
    memcpy(r->values, values, t->column_count * sizeof *values);
}

void table_free(table *t)
{
    free(t->rows);
    json_decref(t->notes);
    json_decref(t->pictures);
    *t = (table){0};
}

static bool has_text(const json_t *note, const char *member, const char *text)
{
    return strcmp(json_string_value(json_object_get(note, member)), text) == 0;
}

static json_t *find_note(const table *t, const char *scene, const char *text)
{
    for (size_t i = 0; i < json_array_size(t->notes); i++) {
        json_t *note = json_array_get(t->notes, i);
        if (has_text(note, "scene", scene) && has_text(note, "text", text))
            return note;
    }
    return NULL;
}

void table_note(table *t, const char *scene, const char *variant, const char *text)
{
    if (!t->notes)
        t->notes = json_array();
    json_t *note = find_note(t, scene, text);
    if (!note) {
        note = json_pack("{s:s, s:[], s:s}", "scene", scene, "variants", "text", text);
        json_array_append_new(t->notes, note);
    }
    if (json_array_append_new(json_object_get(note, "variants"), json_string(variant)) != 0)
        stop_with_error("out of memory");
}

static size_t index_of(const table *t, const char *name)
{
    size_t i = 0;
    while (i < t->column_count && strcmp(t->columns[i].name, name) != 0)
        i++;
    if (i == t->column_count)
        stop_with_error("there is no column \"%s\"", name);
    return i;
}

double table_value(const table *t, const row *r, const char *column)
{
    return r->values[index_of(t, column)];
}

static bool is_picked(const row *r, pick p)
{
    return (!p.scene || strcmp(p.scene, r->scene) == 0) && (!p.variant || strcmp(p.variant, r->variant) == 0) &&
           (isnan(p.setting) || p.setting == r->values[0]);
}

size_t table_count(const table *t, pick p)
{
    size_t count = 0;
    for (size_t i = 0; i < t->count; i++)
        count += is_picked(&t->rows[i], p);
    return count;
}

double table_most(const table *t, pick p, const char *column)
{
    const size_t at = index_of(t, column);
    double most = 0;
    for (size_t i = 0; i < t->count; i++)
        if (is_picked(&t->rows[i], p))
            most = fmax(most, t->rows[i].values[at]);
    return most;
}

double table_sum(const table *t, pick p, const char *column)
{
    const size_t at = index_of(t, column);
    double sum = 0;
    for (size_t i = 0; i < t->count; i++)
        if (is_picked(&t->rows[i], p) && !isnan(t->rows[i].values[at]))
            sum += t->rows[i].values[at];
    return sum;
}

static const row *find_row(const table *t, pick p)
{
    for (size_t i = 0; i < t->count; i++)
        if (is_picked(&t->rows[i], p))
            return &t->rows[i];
    return NULL;
}

ratio table_ratios(const table *t, pick a, pick b, const char *column)
{
    const size_t at = index_of(t, column);
    double *all = resize_memory(NULL, t->count * sizeof *all);
    size_t count = 0;
    ratio found = {.median = NAN, .most = NAN};
    for (size_t i = 0; i < t->count; i++) {
        if (!is_picked(&t->rows[i], a))
            continue;
        pick same = b;
        same.scene = t->rows[i].scene;
        const row *other = find_row(t, same);
        const double value = other ? t->rows[i].values[at] / other->values[at] : NAN;
        if (!isfinite(value))
            continue;
        all[count++] = value;
        if (!(value <= found.most)) {
            found.most = value;
            found.scene = t->rows[i].scene;
        }
    }
    if (count > 0)
        found.median = median(all, count);
    free(all);
    return found;
}

double table_ratio(const table *t, pick a, pick b, const char *column)
{
    return table_ratios(t, a, b, column).median;
}

/* The text of a number in a CSV file. */
static void print_number(double value, char text[32])
{
    snprintf(text, 32, isnan(value) ? "nan" : "%.5g", value);
}

static void write_number(double value, FILE *out)
{
    char text[32];
    print_number(value, text);
    fputs(text, out);
}

void table_round(table *t)
{
    char text[32];
    for (size_t i = 0; i < t->count; i++)
        for (size_t c = 0; c < t->column_count; c++) {
            print_number(t->rows[i].values[c], text);
            t->rows[i].values[c] = strtod(text, NULL);
        }
}

/* The name of row i in one of the two first columns, or nothing if it may be omitted. */
static const char *name_in_csv(const table *t, size_t i, bool variant, bool compact)
{
    const char *name = variant ? t->rows[i].variant : t->rows[i].scene;
    const char *before = i == 0 ? "" : variant ? t->rows[i - 1].variant : t->rows[i - 1].scene;
    return compact && strcmp(name, before) == 0 ? "" : name;
}

void table_write_csv(const table *t, bool compact, FILE *out)
{
    fputs("scene,variant", out);
    for (size_t c = 0; c < t->column_count; c++)
        fprintf(out, ",%s", t->columns[c].name);
    fputc('\n', out);
    for (size_t i = 0; i < t->count; i++) {
        fprintf(out, "%s,%s", name_in_csv(t, i, false, compact), name_in_csv(t, i, true, compact));
        for (size_t c = 0; c < t->column_count; c++) {
            fputc(',', out);
            write_number(t->rows[i].values[c], out);
        }
        fputc('\n', out);
    }
}

/* Copy the text before the next comma or end of line. Returns what follows the comma, or the end of the line. */
static const char *read_field(const char *text, char field[TABLE_NAME])
{
    const size_t size = strcspn(text, ",\n");
    snprintf(field, TABLE_NAME, "%.*s", (int)(size < TABLE_NAME ? size : TABLE_NAME - 1), text);
    return text + size + (text[size] == ',');
}

/* Read a name; an empty field keeps the name of the row before. */
static const char *read_name(const char *text, char name[TABLE_NAME])
{
    return *text == ',' ? text + 1 : read_field(text, name);
}

static bool read_head(const table *t, const char **text)
{
    char field[TABLE_NAME];
    *text = read_field(read_field(*text, field), field); /* scene and variant */
    for (size_t i = 0; i < t->column_count; i++) {
        *text = read_field(*text, field);
        if (strcmp(field, t->columns[i].name) != 0)
            return false;
    }
    return *(*text)++ == '\n';
}

bool table_read_csv(table *t, const char *text)
{
    char scene[TABLE_NAME] = "", variant[TABLE_NAME] = "", field[TABLE_NAME], *end;
    double values[TABLE_COLUMNS_AT_MOST];
    if (!read_head(t, &text))
        return false;
    while (*text && *text != '<') {
        text = read_name(read_name(text, scene), variant);
        for (size_t i = 0; i < t->column_count; i++) {
            text = read_field(text, field);
            values[i] = strtod(field, &end);
            if (end == field || *end)
                return false;
        }
        if (*text++ != '\n')
            return false;
        table_add(t, scene, variant, values);
    }
    return true;
}

void table_write_json(const table *t, const char *knob, FILE *out)
{
    for (size_t i = 0; i < t->count; i++) {
        fprintf(out, "{\"knob\":\"%s\",\"scene\":\"%s\",\"variant\":\"%s\"", knob, t->rows[i].scene,
                t->rows[i].variant);
        for (size_t c = 0; c < t->column_count; c++) {
            const double value = t->rows[i].values[c];
            fprintf(out, ",\"%s\":", t->columns[c].name);
            if (isfinite(value))
                write_number(value, out);
            else
                fputs("null", out);
        }
        fputs("}\n", out);
    }
    fflush(out);
}

/* NaN when the column has no bound there. */
static double bound_of(const table *t, const row *r, const column *c)
{
    if (!c->bound)
        return NAN;
    return strcmp(c->bound, "0") == 0 ? 0 : table_value(t, r, c->bound);
}

size_t table_judge(const table *t, const char *knob, double tighten, FILE *out)
{
    size_t beyond = 0;
    for (size_t i = 0; i < t->count; i++)
        for (size_t c = 0; c < t->column_count; c++) {
            const row *r = &t->rows[i];
            const double bound = bound_of(t, r, &t->columns[c]) * tighten;
            if (!(r->values[c] > bound)) /* NaN is beyond nothing */
                continue;
            beyond++;
            fprintf(out, "octree-tradeoff: %s, %s, %s at %.10g: %s is %.17g, and the proven bound %.17g\n", knob,
                    r->scene, r->variant, r->values[0], t->columns[c].name, r->values[c], bound);
        }
    return beyond;
}
