/* SPDX-License-Identifier: MIT */
/* query_options.c - the options that ask queries: --frustum, --ray, --nearest, --radius and --range. A kind of query
 * has an option if its row in query_looks.h has a text for the option's value, such as X,Y,Z. The numbers in the value
 * are the members of the query, in the order of OCTREE_QUERY_MEMBER_MAP; optional members may be missing at the end. */
#include "query_options.h"
#include "inspect_answers.h"
#include "number.h"
#include "octree/octree.h"
#include "query_looks.h"

#include <math.h>
#include <string.h>

#define MOST_NUMBERS (4 * OCTREE_FRUSTUM_HALF_SPACES)

static const struct {
    octree_query_kind kind;
    /* The placeholder of the option's value in --help; null: no option asks this kind of query. */
    const char *value;
    octree_query_kind with_more; /* the kind of query that is asked if the value has too many numbers for `kind` */
    const char *help;            /* the option's description in --help */
    const char *takes;           /* words for a valid value, used in errors */
} rows[] = {
#define QUERY_OPTION(X, kind, name, words, layer_help, role, value, with_more, help, takes)                            \
    {OCTREE_QUERY_##kind, value, OCTREE_QUERY_##with_more, help, takes},
    QUERY_LOOKS(QUERY_OPTION, )
#undef QUERY_OPTION
};

/* Returns the number of numbers of a member; of a frustum, that of one half-space. */
static size_t count_numbers_of_type(octree_member_type type)
{
    static const size_t numbers[] = {
        [OCTREE_MEMBER_BOX] = 6,       [OCTREE_MEMBER_POSITION] = 3,
        [OCTREE_MEMBER_DIRECTION] = 3, [OCTREE_MEMBER_COUNT] = 1,
        [OCTREE_MEMBER_LENGTH] = 1,    [OCTREE_MEMBER_BOUNDS] = 0, /* no number: bounds are always closed */
        [OCTREE_MEMBER_FRUSTUM] = 4,   [OCTREE_MEMBER_EXTENTS] = 3};
    return numbers[type];
}

/* Returns the number of numbers of a kind of query, with or without its optional members. */
static size_t count_numbers_of_kind(octree_query_kind kind, bool with_optional)
{
    const octree_query_traits *about = octree_query_about(kind);
    size_t count = 0;
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        if (about->members & member->bit && (with_optional || !member->optional || member->bit == about->named_by))
            count += count_numbers_of_type(member->type);
    }
    return count;
}

/* Parses the numbers of a kind of query. Returns how many there are, or 0 if the text is not valid. */
static size_t parse_query_numbers(const char *text, octree_query_kind kind, double numbers[MOST_NUMBERS])
{
    const bool repeats = octree_query_about(kind)->members & OCTREE_QUERY_HAS_FRUSTUM;
    const size_t least = count_numbers_of_kind(kind, false), step = repeats ? least : 1;
    const size_t most = repeats ? MOST_NUMBERS : count_numbers_of_kind(kind, true);
    for (size_t count = least; count <= most; count += step)
        if (numbers_parse(text, numbers, count))
            return count;
    return 0;
}

/* Sets the members of a query from numbers. Returns false if a count is not a whole number in its range. */
static bool set_query_members(octree_query *query, const double *numbers, size_t count)
{
    const double *end = numbers + count;
    for (size_t i = 0; numbers < end && i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        char *value = (char *)query + member->in_query;
        if (!(octree_query_about(query->kind)->members & member->bit))
            continue;
        if (member->type == OCTREE_MEMBER_FRUSTUM) {
            memcpy(value, numbers, count * sizeof *numbers);
            query->frustum.count = count / 4;
            return true;
        }
        if (member->type != OCTREE_MEMBER_COUNT)
            memcpy(value, numbers, count_numbers_of_type(member->type) * sizeof *numbers);
        else if (*numbers >= 1 && *numbers < 0x1p53 && *numbers == floor(*numbers))
            *(size_t *)value = (size_t)*numbers;
        else
            return false;
        numbers += count_numbers_of_type(member->type);
    }
    return true;
}

static bool read_query(const command_option *option, const char *text, void *into)
{
    query_options *queries = into;
    const size_t row = option->min; /* the index of the option's row in `rows`; query_option_row() stored it in `min` */
    const char *name = option->name;
    octree_query query = {.kind = rows[row].kind, .k = 1, .thickness = INSPECT_ANY_THICKNESS};
    double values[MOST_NUMBERS];
    if (queries->count == MOST_QUERIES)
        return print_refusal("at most %d queries can be given", MOST_QUERIES);
    size_t count = parse_query_numbers(text, query.kind, values);
    if (count == 0) {
        query.kind = rows[row].with_more;
        count = parse_query_numbers(text, query.kind, values);
    }
    if (count == 0)
        return refuse_value(option, rows[row].takes, text);
    if (!set_query_members(&query, values, count))
        return print_refusal(
            "--%s: the number of neighbours or hits must be a whole number from 1 to %.0f; found \"%s\"", name,
            0x1p53 - 1, text);
    octree_query checked = query;
    if (isnan(query.thickness))
        checked.thickness = 0;
    const octree_status status = octree_query_check(&checked);
    if (status != OCTREE_OK)
        return print_refusal("--%s: %s in \"%s\"", name, octree_status_text(status), text);
    queries->items[queries->count++] = query;
    return true;
}

/* Fills in the n-th option. The options are in the reverse order of `rows`. */
bool query_option_row(size_t n, command_option *option)
{
    for (size_t i = sizeof rows / sizeof rows[0]; i-- > 0;) {
        if (!rows[i].value || n-- > 0)
            continue;
        *option = (command_option){octree_query_name(rows[i].kind), rows[i].value, rows[i].help, .read = read_query,
                                   .min = i};
        return true;
    }
    return false;
}
