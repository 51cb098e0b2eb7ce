/* SPDX-License-Identifier: MIT */
/* audit_print.c - prints an audit as text for people and as JSON. */
#include "audit_print.h"
#include "json_write.h"
#include "number.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- Words -------------------------------------------------------------------------------------------------- */

const char *audit_ratio_text(double ratio, char text[AUDIT_RATIO_TEXT])
{
    char number[NUMBER_TEXT];
    snprintf(text, AUDIT_RATIO_TEXT, "%s", isinf(ratio) ? "infinite" : number_format(ratio, 6, number));
    return text;
}

/* Print a share, a number from 0 to 1, with six digits. A share just below 1 is printed with as many digits as
 * distinguish it from 1. */
static const char *format_share(double share, char text[NUMBER_TEXT])
{
    int digits = 6;
    while (number_format(share, digits, text)[0] == '1' && share < 1)
        digits++;
    return text;
}

/* Returns why an answer is wrong. With `pairs`, the answer is a list of pairs. */
static const char *reason_words(octree_wrong_kind kind, bool pairs)
{
    static const char *const of_pairs[OCTREE_WRONG_KINDS] = {
        [OCTREE_WRONG_UNKNOWN] = "names an id that no body has",
        [OCTREE_WRONG_DUPLICATE] = "names a pair twice",
        [OCTREE_WRONG_MISSING] = "pairs are missing",
        [OCTREE_WRONG_EXTRA] = "pairs that do not overlap",
    };
    static const char *const words[OCTREE_WRONG_KINDS] = {
        [OCTREE_WRONG_NONE] = "right",
        [OCTREE_WRONG_UNKNOWN] = "names an id that no point has",
        [OCTREE_WRONG_DUPLICATE] = "names a point twice",
        [OCTREE_WRONG_SKIPPED] = "names a point that the query excludes",
        [OCTREE_WRONG_COUNT] = "a wrong number of neighbours",
        [OCTREE_WRONG_FARTHER] = "a neighbour too far away",
        [OCTREE_WRONG_MISSING] = "points are missing",
        [OCTREE_WRONG_EXTRA] = "points outside the query",
    };
    return pairs && of_pairs[kind] ? of_pairs[kind] : words[kind];
}

/* Print a list of points: "; missing 3 at (1, 2, 3), 4 at (5, 6, 7) and 2 more". `what` is the first word, here
 * "missing". */
static void print_points(FILE *out, const char *what, const octree_point *points, size_t count)
{
    const size_t printed = count < AUDIT_POINTS ? count : AUDIT_POINTS;
    char texts[3][NUMBER_TEXT];
    for (size_t i = 0; i < printed; i++) {
        for (int axis = 0; axis < 3; axis++)
            number_format(points[i].position[axis], 9, texts[axis]);
        fprintf(out, "%s%s%" PRIu64 " at (%s, %s, %s)", i ? ", " : what, i ? "" : " ", points[i].id, texts[0], texts[1],
                texts[2]);
    }
    if (count > printed)
        fprintf(out, " and %zu more", count - printed);
}

/* If all missing points, or all extra points, lie on the boundary of the query's region, print this fact and the member
 * of the query that makes the index's treatment of the boundary correct. */
static void print_boundary(FILE *out, const octree_judgement *made, const char *region)
{
    static const char *const habits[OCTREE_BOUNDS_KINDS] = {
        [OCTREE_BOUNDS_CLOSED] = "includes it",
        [OCTREE_BOUNDS_OPEN] = "excludes it",
        [OCTREE_BOUNDS_EITHER] = "includes only a part of the boundary",
    };
    const bool missing = made->on_boundary == OCTREE_WRONG_MISSING;
    const size_t count = missing ? made->missing_count : made->extra_count;
    if (!made->on_boundary)
        return;
    if (count == 1)
        fprintf(out, "; the %s point lies", octree_wrong_name(made->on_boundary));
    else
        fprintf(out, "; all %zu %s points lie", count, octree_wrong_name(made->on_boundary));
    fprintf(out, " on the boundary of the %s; if the index %s, ask with \"%s\": \"%s\"", region,
            habits[made->accepting], octree_query_member_at(OCTREE_QUERY_MEMBER_BOUNDS)->key,
            octree_bounds_name(made->accepting));
}

/* Returns the values whose ratio the judge computes: the distances of neighbours, or t of the hits of a cast. */
static const char *measures_of(const octree_query_traits *about)
{
    return strcmp(about->measure, "distance") == 0 ? "distances" : about->measure;
}

void audit_print_wrong_answer(FILE *out, const audit_case *c, const octree_query_traits *about)
{
    char text[AUDIT_RATIO_TEXT];
    if (c->place == SIZE_MAX) {
        fprintf(out, "foreign_pairs: %s; %zu missing, %zu extra", reason_words(c->made.wrong, true),
                c->made.missing_count, c->made.extra_count);
        return;
    }
    fprintf(out, "answers[%zu]: %s", c->place, reason_words(c->made.wrong, false));
    if (c->made.wrong <= OCTREE_WRONG_SKIPPED)
        fprintf(out, " (%" PRIu64 ")", c->made.wrong_id);
    if (c->made.wrong == OCTREE_WRONG_COUNT)
        fprintf(out, " (%zu named, %zu expected)", c->made.given_count, c->made.expected);
    if (c->made.rank)
        fprintf(out, "; wrong from rank %zu on", c->made.rank);
    if (about->neighbors)
        fprintf(out, "; ratio of %s %s", measures_of(about), audit_ratio_text(c->made.ratio, text));
    fprintf(out, "; %zu missing, %zu extra", c->made.missing_count, c->made.extra_count);
    print_points(out, "; missing", c->missing, c->made.missing_count);
    print_points(out, "; extra", c->extra, c->made.extra_count);
    print_boundary(out, &c->made, about->region);
}

static bool has_limits(const audit_limits *limits)
{
    return limits->by_ratio || limits->by_recall;
}

void audit_print_limits(FILE *out, const char *before, const audit_limits *limits, const char *after)
{
    char text[NUMBER_TEXT];
    if (!has_limits(limits))
        return;
    fputs(before, out);
    number_print(limits->ratio, text);
    if (limits->by_ratio)
        fprintf(out, "ratio of distances up to %s", text);
    number_print(limits->recall, text);
    if (limits->by_recall)
        fprintf(out, "%srecall of at least %s", limits->by_ratio ? ", " : "", text);
    fputs(after, out);
}

/* Print whether the audit of this kind of query is within its limits. If no limits are set, print nothing. */
static void print_whether_within_limits(FILE *out, const audit_limits *limits, bool passes)
{
    if (has_limits(limits))
        fprintf(out, ", %s the allowed limits", passes ? "within" : "beyond");
}

void audit_print_summary(FILE *out, const audit_verdict *v)
{
    const audit_report *report = v->report;
    fprintf(out, "%" PRIu64 " answer%s in %" PRIu64 " tick%s", report->asked, plural_ending(report->asked),
            report->ticks, plural_ending(report->ticks));
    if (report->wrong)
        fprintf(out, ", %" PRIu64 " wrong", report->wrong);
    else if (report->asked)
        fputs(", all right", out);
    if (report->nodes.wrong)
        fprintf(out, ", %" PRIu64 " wrong node%s", report->nodes.wrong, plural_ending(report->nodes.wrong));
    print_whether_within_limits(out, &v->report->limits, audit_passes(report));
    if (report->nodes.wrong && has_limits(&report->limits))
        fputs("; wrong nodes are never allowed", out);
}

void audit_print_kind(FILE *out, const audit_verdict *v, int of)
{
    const audit_kind *kind = &v->report->kinds[of];
    const octree_query_traits *about = audit_kind_about(of);
    char recall[NUMBER_TEXT], ratios[2][AUDIT_RATIO_TEXT];
    fprintf(out, "%s: %" PRIu64 " asked, %" PRIu64 " wrong, recall %s", about->name, kind->asked, kind->wrong,
            format_share(audit_recall(kind), recall));
    if (about->neighbors)
        fprintf(out, ", ratio of %s %s at worst, 99th percentile %s", measures_of(about),
                audit_ratio_text(audit_ratio_percentile(kind, 1), ratios[0]),
                audit_ratio_text(audit_ratio_percentile(kind, 0.99), ratios[1]));
    else
        fprintf(out, ", %" PRIu64 " missing, %" PRIu64 " extra", kind->missing, kind->extra);
    if (kind->wrong)
        fprintf(out, "; first wrong at tick %" PRIu64, kind->first_wrong);
    print_whether_within_limits(out, &v->report->limits, audit_kind_passes(kind, &v->report->limits));
    for (int i = OCTREE_WRONG_NONE + 1; i < OCTREE_WRONG_KINDS; i++)
        if (kind->wrong_by_kind[i])
            fprintf(out, "; %" PRIu64 " time%s: %s", kind->wrong_by_kind[i], plural_ending(kind->wrong_by_kind[i]),
                    reason_words((octree_wrong_kind)i, of == AUDIT_PAIRS));
    if (kind->on_boundary)
        fprintf(out, "; %" PRIu64 " time%s: wrong only on the boundary of the %s", kind->on_boundary,
                plural_ending(kind->on_boundary), about->region);
}

void audit_print_nodes_head(FILE *out, const audit_nodes *nodes)
{
    fprintf(out, "nodes: %" PRIu64 " wrong", nodes->wrong);
    if (nodes->wrong)
        fprintf(out, " in %" PRIu64 " tick%s, first at tick %" PRIu64, nodes->ticks, plural_ending(nodes->ticks),
                nodes->first_wrong);
}

void audit_print_wrong_nodes(FILE *out, const audit_nodes *nodes, octree_wrong_node_kind kind)
{
    const octree_wrong_node *wrong = &nodes->first[kind].node;
    fprintf(out, "%" PRIu64 " time%s: %s", nodes->wrong_by_kind[kind], plural_ending(nodes->wrong_by_kind[kind]),
            octree_wrong_node_words(kind));
    if (!nodes->first[kind].known)
        return;
    fprintf(out, " (tick %" PRIu64, nodes->first[kind].tick);
    if (kind != OCTREE_NODE_LOST_POINT)
        fprintf(out, ", node %" PRIu64, wrong->node);
    if (kind != OCTREE_NODE_OUTSIDE_PARENT && kind != OCTREE_NODE_UNKNOWN_NODE)
        fprintf(out, ", point %" PRIu64, wrong->point);
    fputc(')', out);
}

void audit_print_nodes(FILE *out, const audit_nodes *nodes)
{
    audit_print_nodes_head(out, nodes);
    for (int i = 0; i < OCTREE_WRONG_NODE_KINDS; i++)
        if (nodes->wrong_by_kind[i]) {
            fputs("; ", out);
            audit_print_wrong_nodes(out, nodes, (octree_wrong_node_kind)i);
        }
}

/* ---- For people --------------------------------------------------------------------------------------------- */

void audit_print_text(FILE *out, const audit_verdict *v)
{
    write_escaped(out, v->path, escape_nothing);
    fputs(": ", out);
    audit_print_summary(out, v);
    putc('\n', out);
    for (int i = 0; i < AUDIT_KINDS; i++) {
        const audit_kind *kind = &v->report->kinds[i];
        if (!kind->asked)
            continue;
        audit_print_kind(out, v, i);
        putc('\n', out);
        for (size_t j = 0; j < kind->worst_count; j++) {
            const audit_case *c = &kind->worst[j];
            fprintf(out, "  tick %" PRIu64 ", ", c->tick);
            audit_print_wrong_answer(out, c, audit_kind_about(i));
            fprintf(out, "\n    %s\n", c->answer);
        }
    }
    if (v->report->nodes.given) {
        audit_print_nodes(out, &v->report->nodes);
        putc('\n', out);
    }
    audit_print_limits(out, "allowed: ", &v->report->limits, "\n");
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_points(json_writer *w, const char *key, const octree_point *points, size_t count)
{
    if (count == 0)
        return;
    json_begin_array_member(w, key);
    for (size_t i = 0; i < count && i < AUDIT_POINTS; i++) {
        json_write_begin_object(w);
        json_write_integer_member(w, "id", points[i].id);
        json_write_vector_member(w, "position", points[i].position);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* Write a wrong answer as a JSON object. c->answer is already JSON text, so it is copied. */
static void write_case(json_writer *w, const audit_case *c, bool neighbors)
{
    json_write_begin_object(w);
    json_write_integer_member(w, "tick", c->tick);
    if (c->place != SIZE_MAX)
        json_write_integer_member(w, "place", c->place);
    json_write_text_member(w, "wrong", octree_wrong_name(c->made.wrong));
    if (c->made.rank)
        json_write_integer_member(w, "rank", c->made.rank);
    if (neighbors)
        json_write_number_member(w, "ratio", c->made.ratio);
    json_write_integer_member(w, "missing", c->made.missing_count);
    json_write_integer_member(w, "extra", c->made.extra_count);
    write_points(w, "missing_points", c->missing, c->place == SIZE_MAX ? 0 : c->made.missing_count);
    write_points(w, "extra_points", c->extra, c->place == SIZE_MAX ? 0 : c->made.extra_count);
    if (c->made.on_boundary) {
        json_write_text_member(w, "on_boundary", octree_wrong_name(c->made.on_boundary));
        json_write_text_member(w, "accepting_bounds", octree_bounds_name(c->made.accepting));
    }
    json_write_key(w, "answer");
    fputs(c->answer, w->out);
    w->comma = true;
    json_write_end_object(w);
}

static void write_kind(json_writer *w, const audit_verdict *v, int of)
{
    const audit_kind *kind = &v->report->kinds[of];
    const octree_query_traits *about = audit_kind_about(of);
    json_begin_object_member(w, about->name);
    json_write_integer_member(w, "asked", kind->asked);
    json_write_integer_member(w, "wrong", kind->wrong);
    json_write_bool_member(w, "passes", audit_kind_passes(kind, &v->report->limits));
    json_write_number_member(w, "recall", audit_recall(kind));
    json_write_integer_member(w, "missing", kind->missing);
    json_write_integer_member(w, "extra", kind->extra);
    if (about->neighbors) {
        json_write_number_member(w, "worst_ratio", audit_ratio_percentile(kind, 1));
        json_write_number_member(w, "ratio_99", audit_ratio_percentile(kind, 0.99));
    }
    if (kind->wrong)
        json_write_integer_member(w, "first_wrong_tick", kind->first_wrong);
    if (kind->on_boundary)
        json_write_integer_member(w, "on_boundary", kind->on_boundary);
    json_begin_object_member(w, "faults");
    for (int i = OCTREE_WRONG_NONE + 1; i < OCTREE_WRONG_KINDS; i++)
        if (kind->wrong_by_kind[i])
            json_write_integer_member(w, octree_wrong_name((octree_wrong_kind)i), kind->wrong_by_kind[i]);
    json_write_end_object(w);
    json_begin_array_member(w, "worst");
    for (size_t i = 0; i < kind->worst_count; i++)
        write_case(w, &kind->worst[i], about->neighbors);
    json_write_end_array(w);
    json_write_end_object(w);
}

static void write_nodes(json_writer *w, const audit_nodes *nodes)
{
    if (!nodes->given)
        return;
    json_begin_object_member(w, "nodes");
    json_write_integer_member(w, "faults", nodes->wrong);
    if (nodes->wrong)
        json_write_integer_member(w, "first_wrong_tick", nodes->first_wrong);
    for (int i = 0; i < OCTREE_WRONG_NODE_KINDS; i++)
        if (nodes->wrong_by_kind[i])
            json_write_integer_member(w, octree_wrong_node_name((octree_wrong_node_kind)i), nodes->wrong_by_kind[i]);
    json_write_end_object(w);
}

static void write_limits(json_writer *w, const audit_limits *limits)
{
    if (!has_limits(limits))
        return;
    json_begin_object_member(w, "allowed");
    if (limits->by_ratio)
        json_write_number_member(w, "ratio", limits->ratio);
    if (limits->by_recall)
        json_write_number_member(w, "recall", limits->recall);
    json_write_end_object(w);
}

void audit_print_json(FILE *out, const audit_verdict *v)
{
    json_writer writer = {.out = out}, *w = &writer;
    const audit_report *report = v->report;
    json_write_begin_object(w);
    json_write_text_member(w, "path", v->path);
    json_write_bool_member(w, "right", report->wrong == 0 && report->nodes.wrong == 0);
    json_write_bool_member(w, "passes", audit_passes(report));
    write_limits(w, &v->report->limits);
    json_write_integer_member(w, "ticks", report->ticks);
    json_write_integer_member(w, "asked", report->asked);
    json_write_integer_member(w, "wrong", report->wrong);
    json_begin_object_member(w, "kinds");
    for (int i = 0; i < AUDIT_KINDS; i++)
        if (report->kinds[i].asked)
            write_kind(w, v, i);
    json_write_end_object(w);
    write_nodes(w, &report->nodes);
    json_write_end_object(w);
    json_write_end_line(w);
}
