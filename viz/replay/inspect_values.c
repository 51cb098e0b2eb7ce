/* SPDX-License-Identifier: MIT */
/* inspect_values.c - prints a summary of the colours, intensities and classes of the points of a cloud. */
#include "inspect.h"
#include "number.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>

enum { CLASSES = UINT16_MAX + 1, CLASSES_LISTED = 16 };

/* The summary of the values of all points. */
typedef struct value_summary {
    /* For each kind of value: counts[k] is the number of points that have a value of kind k (colour, intensity or
     * class). */
    size_t counts[POINT_VALUE_KINDS];
    float least, most; /* the smallest and the largest intensity of all points */
} value_summary;

static void widen_intensity_range(value_summary *s, float intensity)
{
    const bool first = s->counts[POINT_INTENSITY] == 1;
    if (first || intensity < s->least)
        s->least = intensity;
    if (first || intensity > s->most)
        s->most = intensity;
}

static value_summary summarize_values(const point_values *v)
{
    value_summary s = {0};
    for (size_t row = 0; row < v->count; row++) {
        for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
            s.counts[kind] += v->rows[row].has[kind];
        if (v->rows[row].has[POINT_INTENSITY])
            widen_intensity_range(&s, v->rows[row].intensity);
    }
    return s;
}

bool inspect_count_classes(inspection *i)
{
    const point_values *v = &i->values;
    const bool any = v->kinds >> POINT_CLASS & 1;
    i->classes = any ? calloc(CLASSES, sizeof *i->classes) : NULL;
    for (size_t row = 0; i->classes && row < v->count; row++)
        if (v->rows[row].has[POINT_CLASS])
            i->classes[v->rows[row].class]++;
    return i->classes || !any;
}

static void print_classes(const size_t *classes, FILE *out)
{
    size_t listed = 0, all = 0;
    for (int i = 0; i < CLASSES; i++)
        all += classes[i] > 0;
    fputs(all == 1 ? "class" : "classes", out);
    for (int i = 0; i < CLASSES && listed < CLASSES_LISTED; i++)
        if (classes[i] > 0)
            fprintf(out, "%s %d", listed++ ? "," : "", i);
    if (all > listed)
        fprintf(out, " and %zu more", all - listed);
}

static void print_kind(const inspection *i, const value_summary *s, point_value_kind kind, FILE *out)
{
    char least[NUMBER_TEXT], most[NUMBER_TEXT];
    if (kind == POINT_COLOR)
        fprintf(out, "color 0-%u", i->color_full);
    else if (kind == POINT_INTENSITY)
        fprintf(out, "intensity %s to %s", number_format((double)s->least, 6, least),
                number_format((double)s->most, 6, most));
    else
        print_classes(i->classes, out);
    if (s->counts[kind] < i->points)
        fprintf(out, " of %zu point%s", s->counts[kind], plural_ending(s->counts[kind]));
}

void inspect_print_values(const inspection *i, FILE *out)
{
    const value_summary s = summarize_values(&i->values);
    const char *before = "  values    ";
    char beyond[CLOUD_OUT_OF_RANGE_TEXT];
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++) {
        if (s.counts[kind] == 0)
            continue;
        fputs(before, out);
        print_kind(i, &s, (point_value_kind)kind, out);
        before = "; ";
    }
    if (point_values_kinds(&i->values))
        fputc('\n', out);
    if (*i->column_note)
        fprintf(out, "  columns   %s\n", i->column_note);
    if (*cloud_describe_out_of_range(i->out_of_range, beyond))
        fprintf(out, "  but       %s\n", beyond);
}

static void write_class_counts(const size_t *classes, json_writer *w)
{
    json_begin_array_member(w, "classes");
    for (int i = 0; i < CLASSES; i++) {
        if (classes[i] == 0)
            continue;
        json_write_begin_object(w);
        json_write_integer_member(w, "class", (uint64_t)i);
        json_write_integer_member(w, "points", classes[i]);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* Write a JSON member such as "values": {"color": {"points": 3, "full": 255}, "intensity": {...}, "class": {...}}. */
void inspect_write_values(const inspection *i, json_writer *w)
{
    const value_summary s = summarize_values(&i->values);
    char beyond[CLOUD_OUT_OF_RANGE_TEXT];
    if (point_values_kinds(&i->values) == 0 && !*i->column_note &&
        !*cloud_describe_out_of_range(i->out_of_range, beyond))
        return;
    json_begin_object_member(w, "values");
    if (s.counts[POINT_COLOR]) {
        json_begin_object_member(w, "color");
        json_write_integer_member(w, "points", s.counts[POINT_COLOR]);
        json_write_integer_member(w, "full", i->color_full);
        json_write_end_object(w);
    }
    if (s.counts[POINT_INTENSITY]) {
        json_begin_object_member(w, "intensity");
        json_write_integer_member(w, "points", s.counts[POINT_INTENSITY]);
        json_write_number_member(w, "min", (double)s.least);
        json_write_number_member(w, "max", (double)s.most);
        json_write_end_object(w);
    }
    if (s.counts[POINT_CLASS]) {
        json_begin_object_member(w, "class");
        json_write_integer_member(w, "points", s.counts[POINT_CLASS]);
        write_class_counts(i->classes, w);
        json_write_end_object(w);
    }
    if (*i->column_note)
        json_write_text_member(w, "columns", i->column_note);
    if (*cloud_describe_out_of_range(i->out_of_range, beyond))
        json_write_text_member(w, "left_out", beyond);
    json_write_end_object(w);
}
