/* SPDX-License-Identifier: MIT */
/* query_options.c - one table of the options that are queries; their numbers are read by what each kind of query takes.
 */
#include "query_options.h"
#include "number.h"

#include <math.h>
#include <string.h>

#define MOST_NUMBERS 16

/* The numbers of an option are the members of its kind of query: a box, a target, a radius, a count. */
static const struct {
    octree_query_kind kind;
    octree_query_kind with_count; /* the kind where a count follows; the same: none may */
    const char *value, *help;     /* in --help */
    const char *takes;            /* in the sentence about what does not fit */
} rows[] = {
    {OCTREE_QUERY_NEAREST, OCTREE_QUERY_KNEAREST, "X,Y,Z[,K]",
     "print and draw the point nearest to a place, or the K nearest",
     "a place, and how many neighbours, where that is not 1, as in 1,2,3 or 1,2,3,8"},
    {OCTREE_QUERY_RADIUS, OCTREE_QUERY_RADIUS, "X,Y,Z,R", "print and draw the points within R of a place",
     "a centre and a radius as in 1,2,3,10"},
    {OCTREE_QUERY_RANGE, OCTREE_QUERY_RANGE, "X0,Y0,Z0,X1,Y1,Z1",
     "print and draw the points in a box; queries can be given several times",
     "two corners as in -10,-10,-10,10,10,10"},
};

static size_t numbers_of(octree_query_kind kind)
{
    const unsigned members = octree_query_about(kind)->members;
    return (members & OCTREE_QUERY_HAS_BOX ? 6u : 0u) + (members & OCTREE_QUERY_HAS_TARGET ? 3u : 0u) +
           (members & OCTREE_QUERY_HAS_RADIUS ? 1u : 0u) + (members & OCTREE_QUERY_HAS_K ? 1u : 0u);
}

/* Fill the members that the query's kind reads; false where k is not a count. */
static bool set_members(octree_query *query, const double *at)
{
    const unsigned members = octree_query_about(query->kind)->members;
    if (members & OCTREE_QUERY_HAS_BOX) {
        memcpy(query->box.min, at, sizeof query->box.min);
        memcpy(query->box.max, at + 3, sizeof query->box.max);
        at += 6;
    }
    if (members & OCTREE_QUERY_HAS_TARGET) {
        memcpy(query->target, at, sizeof query->target);
        at += 3;
    }
    if (members & OCTREE_QUERY_HAS_RADIUS)
        query->radius = *at++;
    if (!(members & OCTREE_QUERY_HAS_K))
        return true;
    const bool fits = *at >= 1 && *at < 0x1p53 && *at == floor(*at);
    query->k = fits ? (size_t)*at : 0;
    return fits;
}

static bool read_query(const command_option *option, const char *text, void *into)
{
    query_options *queries = into;
    const size_t row = option->min; /* of the table */
    const char *name = option->name;
    octree_query query = {.kind = rows[row].kind};
    double values[MOST_NUMBERS];
    if (queries->count == MOST_QUERIES)
        return refuse("at most %d queries can be given", MOST_QUERIES);
    if (!numbers_parse(text, values, numbers_of(query.kind))) {
        query.kind = rows[row].with_count;
        if (!numbers_parse(text, values, numbers_of(query.kind)))
            return refuse("--%s takes %s, not \"%s\"", name, rows[row].takes, text);
    }
    if (!set_members(&query, values))
        return refuse("--%s: the number of neighbours is whole, from 1 to %.0f, not so in \"%s\"", name, 0x1p53 - 1,
                      text);
    const octree_status status = octree_query_check(&query);
    if (status != OCTREE_OK)
        return refuse("--%s: %s in \"%s\"", name, octree_status_text(status), text);
    queries->items[queries->count++] = query;
    return true;
}

bool query_option_row(size_t n, command_option *option)
{
    if (n >= sizeof rows / sizeof rows[0])
        return false;
    *option =
        (command_option){octree_query_name(rows[n].kind), rows[n].value, rows[n].help, .read = read_query, .min = n};
    return true;
}
