/* SPDX-License-Identifier: MIT */
/* cause_compare.c - compares two JSON objects member by member and reports each difference once, in the user's terms.
 *
 * The problem: two sessions or ticks differ in their JSON, and the user should read "edit 17 was added", not "element 3
 * of the list differs, and so do all that follow". A textual diff reports the latter: one inserted element shifts the
 * rest of its list.
 *
 * The idea: objects are compared member by member, and lists as sets of elements that have an identity. Elements with a
 * key (points by id, edits by action and id, events by word) are sorted by key and merged, in O(n log n); the n-th
 * element of a key is compared with the n-th of the same key. Queries, shapes and answers have no key, so cause_pairs.h
 * pairs those that are most alike. Elements without a partner are reported as additional or missing. If all elements
 * are equal but their order differs, that is one fact. A value that is no object, such as a box or a position, is one
 * fact.
 */
#include "cause_compare.h"
#include "cause_pairs.h"

#include <stdlib.h>
#include <string.h>

static void compare_values(const cause_place *place, const char *where, json_t *a, json_t *b);

static void add(const cause_place *place, const char *where, cause_change change, uint64_t id, json_t *a, json_t *b)
{
    cause_add(place->facts, where, place->query, change, (cause_fact){place->tick, id, a, b});
}

bool cause_same(const json_t *a, const json_t *b, bool exact)
{
    if (!a || !b || !exact)
        return a && b ? json_equal(a, b) : a == b;
    char *const texts[2] = {json_dumps(a, JSON_ENCODE_ANY | JSON_REAL_PRECISION(17)),
                            json_dumps(b, JSON_ENCODE_ANY | JSON_REAL_PRECISION(17))};
    const bool same = texts[0] && texts[1] && strcmp(texts[0], texts[1]) == 0;
    free(texts[0]);
    free(texts[1]);
    return same;
}

static bool is_same(const cause_place *place, const json_t *a, const json_t *b)
{
    return cause_same(a, b, place->exact);
}

/* ---- Lists whose elements have a key ------------------------------------------------------------------------- */

typedef struct keyed {
    const char *word; /* the element itself if it is a text, or the name of its only member, as "insert"; else "" */
    uint64_t id;      /* CAUSE_NO_ID if the element has none */
    size_t place;     /* the index in the list */
    json_t *element;
} keyed;

static uint64_t id_of(json_t *element)
{
    const json_t *id = json_is_object(element) ? json_object_get(element, "id") : element;
    return json_is_real(id) ? (uint64_t)json_real_value(id) : CAUSE_NO_ID;
}

static keyed key_of(json_t *list, size_t i)
{
    json_t *element = json_array_get(list, i);
    keyed key = {.word = "", .id = id_of(element), .place = i, .element = element};
    if (json_is_string(element)) {
        key.word = json_string_value(element);
    } else if (key.id == CAUSE_NO_ID && json_object_size(element) == 1) {
        void *member = json_object_iter(element);
        key.word = json_object_iter_key(member);
        key.id = id_of(json_object_iter_value(member));
    }
    return key;
}

static int by_key(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    if (x->id != y->id)
        return x->id < y->id ? -1 : 1;
    return strcmp(x->word, y->word);
}

static int by_key_and_place(const void *a, const void *b)
{
    const int order = by_key(a, b);
    return order ? order : (((const keyed *)a)->place > ((const keyed *)b)->place ? 1 : -1);
}

static keyed *sort_list(json_t *list, size_t count)
{
    keyed *sorted = malloc((count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < count; i++)
        sorted[i] = key_of(list, i);
    if (sorted)
        qsort(sorted, count, sizeof *sorted, by_key_and_place);
    return sorted;
}

/* Compare two lists by merging them in the order of their keys. */
static void compare_keyed(const cause_place *place, const char *where, json_t *a, json_t *b)
{
    const size_t a_count = json_array_size(a), b_count = json_array_size(b);
    keyed *as = sort_list(a, a_count), *bs = sort_list(b, b_count);
    bool same = true, same_order = true;
    place->facts->out_of_memory |= !as || !bs;
    for (size_t i = 0, j = 0; as && bs && (i < a_count || j < b_count);) {
        const int order = i == a_count ? 1 : j == b_count ? -1 : by_key(&as[i], &bs[j]);
        json_t *x = order <= 0 ? as[i].element : NULL, *y = order >= 0 ? bs[j].element : NULL;
        if (!is_same(place, x, y)) {
            add(place, where, !x ? CAUSE_MORE : !y ? CAUSE_LESS : CAUSE_OTHER, order <= 0 ? as[i].id : bs[j].id, x, y);
            same = false;
        }
        same_order = same_order && order == 0 && as[i].place == bs[j].place;
        i += order <= 0;
        j += order >= 0;
    }
    if (same && !same_order)
        add(place, where, CAUSE_ORDER, CAUSE_NO_ID, NULL, NULL);
    free(as);
    free(bs);
}

/* ---- Lists whose elements are paired by similarity ------------------------------------------------------------ */

/* Whether a member of an answer is a result, not a parameter of the query. */
static bool is_result(const char *key)
{
    static const char *const names[] = {"ids", "id", "position", "distance", "neighbors", "cost"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(key, names[i]) == 0)
            return true;
    return false;
}

/* The query of an answer: its kind and its parameters. The caller releases it. */
static json_t *query_of(json_t *answer)
{
    const char *kind = cause_kind_of(answer), *key;
    json_t *value, *asked = json_object();
    json_object_foreach(json_object_get(answer, kind), key, value) if (!is_result(key))
        json_object_set(asked, key, value);
    return json_pack("{so}", kind, asked);
}

/* A session's query without the answer and the visited nodes of the foreign index. The caller releases it. */
static json_t *query_without_answer(json_t *query)
{
    json_t *asked = json_copy(query);
    json_object_del(asked, "answer");
    for (int met = 0; met < OCTREE_NODE_VISITS; met++)
        json_object_del(asked, octree_node_visit_name((octree_node_visit)met));
    return asked;
}

/* The list by which the elements of a list are paired: for answers their queries, for queries their parameters. */
static json_t *list_pairing_keys(const char *where, json_t *list)
{
    const bool answers = strcmp(where, "answers") == 0;
    json_t *asked = json_array(), *element;
    size_t i;
    if (!answers && strcmp(where, "queries") != 0) {
        json_decref(asked);
        return list ? json_incref(list) : json_array();
    }
    json_array_foreach(list, i, element)
        json_array_append_new(asked, answers ? query_of(element) : query_without_answer(element));
    return asked;
}

/* Compare the answers of the foreign index. Of visited nodes only the counts are reported, and only if they differ. */
static void compare_foreign_answers(const cause_place *place, json_t *a, json_t *b)
{
    json_t *counts[2] = {json_object(), json_object()};
    bool other = false, counted = false;
    for (int met = 0; met < OCTREE_NODE_VISITS; met++) {
        const char *name = octree_node_visit_name((octree_node_visit)met);
        json_t *const lists[2] = {json_object_get(a, name), json_object_get(b, name)};
        if (is_same(place, lists[0], lists[1]))
            continue;
        other = true;
        counted = counted || json_array_size(lists[0]) != json_array_size(lists[1]);
        for (int i = 0; i < 2; i++)
            json_object_set_new(counts[i], name, json_integer((json_int_t)json_array_size(lists[i])));
    }
    if (other)
        add(place, "queries.visits", CAUSE_OTHER, CAUSE_NO_ID, counted ? counts[0] : NULL, counted ? counts[1] : NULL);
    json_decref(counts[0]);
    json_decref(counts[1]);
    json_t *const answers[2] = {json_object_get(a, "answer"), json_object_get(b, "answer")};
    if (!is_same(place, answers[0], answers[1]))
        add(place, "queries.answer", CAUSE_OTHER, CAUSE_NO_ID, answers[0], answers[1]);
}

static void compare_queries(const cause_place *place, json_t *a, json_t *b)
{
    json_t *const asked[2] = {query_without_answer(a), query_without_answer(b)};
    if (!asked[0] || !asked[1])
        place->facts->out_of_memory = true;
    else if (is_same(place, asked[0], asked[1]))
        compare_foreign_answers(place, a, b);
    else
        add(place, "queries", CAUSE_OTHER, CAUSE_NO_ID, a, b);
    json_decref(asked[0]);
    json_decref(asked[1]);
}

static void compare_pair(const cause_place *place, const char *where, json_t *a, json_t *b)
{
    if (strcmp(where, "answers") == 0)
        compare_values(place, where, a, b);
    else if (strcmp(where, "queries") == 0)
        compare_queries(place, a, b);
    else if (!is_same(place, a, b))
        add(place, where, CAUSE_OTHER, CAUSE_NO_ID, a, b);
}

/* Write "the range query" or, if the list has several of that kind, "query 3 (range)", counted from 1. */
static void name_query(json_t *list, size_t i, bool of_reference, char text[CAUSE_QUERY])
{
    const char *kind = cause_kind_of(json_array_get(list, i));
    size_t of_kind = 0;
    for (size_t j = 0; j < json_array_size(list); j++)
        of_kind += strcmp(cause_kind_of(json_array_get(list, j)), kind) == 0;
    if (of_kind == 1)
        snprintf(text, CAUSE_QUERY, "the %s query", kind);
    else
        snprintf(text, CAUSE_QUERY, "query %zu (%s)%s", i + 1, kind, of_reference ? " of the reference" : "");
}

/* A copy of `place`; for answers with the name of the query, written to `text`. */
static cause_place place_with_query(const cause_place *place, const char *where, json_t *list, size_t i,
                                    bool of_reference, char text[CAUSE_QUERY])
{
    cause_place named = *place;
    if (strcmp(where, "answers") == 0) {
        name_query(list, i, of_reference, text);
        named.query = text;
    }
    return named;
}

static bool in_order(const size_t *mates, size_t count)
{
    size_t last = 0;
    for (size_t j = 0; j < count; j++) {
        if (mates[j] == CAUSE_ALONE)
            continue;
        if (mates[j] < last)
            return false;
        last = mates[j];
    }
    return true;
}

/* Report the differences within pairs, then the elements of only one list. met[i] is set for each element of `a` that
 * has a partner; it must be false for all before. */
static void compare_paired(const cause_place *place, const char *where, json_t *a, json_t *b, const size_t *mates,
                           bool *met)
{
    const size_t count = json_array_size(b);
    char text[CAUSE_QUERY];
    for (size_t j = 0; j < count; j++) {
        if (mates[j] == CAUSE_ALONE)
            continue;
        const cause_place named = place_with_query(place, where, b, j, false, text);
        compare_pair(&named, where, json_array_get(a, mates[j]), json_array_get(b, j));
        met[mates[j]] = true;
    }
    for (size_t i = 0; i < json_array_size(a); i++) {
        if (met[i])
            continue;
        const cause_place named = place_with_query(place, where, a, i, true, text);
        add(&named, where, CAUSE_LESS, CAUSE_NO_ID, json_array_get(a, i), NULL);
    }
    for (size_t j = 0; j < count; j++) {
        if (mates[j] != CAUSE_ALONE)
            continue;
        const cause_place named = place_with_query(place, where, b, j, false, text);
        add(&named, where, CAUSE_MORE, CAUSE_NO_ID, NULL, json_array_get(b, j));
    }
    if (!in_order(mates, count))
        add(place, where, CAUSE_ORDER, CAUSE_NO_ID, NULL, NULL);
}

static void compare_by_similarity(const cause_place *place, const char *where, json_t *a, json_t *b)
{
    json_t *const asked[2] = {list_pairing_keys(where, a), list_pairing_keys(where, b)};
    size_t *mates = malloc((json_array_size(b) + 1) * sizeof *mates);
    bool *met = calloc(json_array_size(a) + 1, sizeof *met);
    const bool whole =
        json_array_size(asked[0]) == json_array_size(a) && json_array_size(asked[1]) == json_array_size(b);
    if (whole && mates && met && cause_pair(asked[0], asked[1], mates))
        compare_paired(place, where, a, b, mates, met);
    else
        place->facts->out_of_memory = true;
    free(mates);
    free(met);
    json_decref(asked[0]);
    json_decref(asked[1]);
}

/* ---- Values -------------------------------------------------------------------------------------------------- */

/* Whether an object is compared as one value: boxes and costs are. */
static bool is_value(const char *where, const json_t *value)
{
    const size_t length = strlen(where);
    return json_object_get(value, "min") || strcmp(where, "visits") == 0 ||
           (length >= 4 && strcmp(where + length - 4, "cost") == 0);
}

/* Whether a list of numbers holds ids; other lists of numbers are positions or ranges. */
static bool lists_ids(const char *where)
{
    return strcmp(where, "hits") == 0 || strcmp(where, "answers.ids") == 0;
}

static bool has_keys(const char *where, const json_t *list)
{
    const json_t *first = json_array_get(list, 0);
    return lists_ids(where) || json_is_string(first) || json_object_get(first, "id") || strcmp(where, "edits") == 0;
}

static void compare_lists(const cause_place *place, const char *where, json_t *a, json_t *b)
{
    json_t *some = json_array_size(a) ? a : b;
    if (!lists_ids(where) && json_is_number(json_array_get(some, 0)))
        add(place, where, CAUSE_OTHER, CAUSE_NO_ID, a, b);
    else if (has_keys(where, some))
        compare_keyed(place, where, a, b);
    else
        compare_by_similarity(place, where, a, b);
}

/* Compare two values of any type. The path of an answer's member leaves out the kind of the query, since the name of
 * the query says it. */
static void compare_values(const cause_place *place, const char *where, json_t *a, json_t *b)
{
    cause_place within = *place;
    if (is_same(place, a, b))
        return;
    if (json_is_array(a ? a : b) && (!a || !b || json_is_array(b))) {
        compare_lists(place, where, a, b);
    } else if (json_is_object(a) && json_is_object(b) && !is_value(where, a)) {
        within.where = where;
        if (strcmp(where, "answers") == 0) {
            a = json_object_get(a, cause_kind_of(a));
            b = json_object_get(b, cause_kind_of(b));
        }
        cause_compare_members(&within, a, b);
    } else {
        add(place, where, CAUSE_OTHER, CAUSE_NO_ID, a, b);
    }
}

static void compare_member(const cause_place *place, const char *key, json_t *a, json_t *b)
{
    char where[sizeof((cause_group *)0)->where];
    snprintf(where, sizeof where, "%s%s%s", place->where, *place->where ? "." : "", key);
    compare_values(place, where, a, b);
}

void cause_compare_members(const cause_place *place, json_t *a, json_t *b)
{
    const char *key;
    json_t *value;
    json_object_foreach(b, key, value) compare_member(place, key, json_object_get(a, key), value);
    json_object_foreach(a, key, value) if (!json_object_get(b, key)) compare_member(place, key, value, NULL);
}
