/* SPDX-License-Identifier: MIT */
/* cause_compare.c - compares two JSON objects member by member and reports each difference once, in the user's terms.
 *
 * The problem: two sessions or ticks differ in their JSON. The user should read "edit 17 was added". A textual diff
 * instead reports that element 3 of a list and all following elements differ, because one inserted element shifts the
 * rest of the list.
 *
 * The idea: objects are compared member by member. Lists are compared as sets: each element of one list is compared
 * with its partner in the other list. An element without a partner is reported as additional or missing.
 *
 * Some elements have a key: points have an id, edits an action and an id, events a word. Both lists are sorted by key
 * and merged, in O(n log n), so that elements with the same key are partners. If a key occurs several times, its n-th
 * elements in both lists are partners. Queries, shapes and answers have no key, so cause_pairs.h pairs the most
 * similar elements.
 *
 * If all elements are equal but their order differs, the different order is one fact. Two different values that are
 * compared as a whole, such as boxes or positions, are one fact, too.
 */
#include "cause_compare.h"
#include "cause_pairs.h"
#include "cause_places.h"

#include <stdlib.h>
#include <string.h>

static void compare_values(const cause_place *place, json_t *a, json_t *b);

/* Add a fact: the value `a` of the reference and the value `b` of the frames. A null pointer stands for a missing
 * value. */
static void add_fact(const cause_place *place, cause_change change, uint64_t id, json_t *a, json_t *b)
{
    cause_add_fact(place->facts, place->where, place->query, change,
                   (cause_fact){place->tick, id, json_incref(a), json_incref(b)});
}

bool cause_values_are_equal(const json_t *a, const json_t *b, bool exact)
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

static bool are_values_equal(const cause_place *place, const json_t *a, const json_t *b)
{
    return cause_values_are_equal(a, b, place->exact);
}

/* ---- Lists whose elements have a key ------------------------------------------------------------------------- */

typedef struct keyed {
    /* a key: the text of a text element, or the name of an object's only member, such as "insert"; else "" */
    const char *word;
    uint64_t id;  /* CAUSE_NO_ID if the element has no id */
    size_t place; /* the index of the element in its list */
    json_t *element;
} keyed;

static uint64_t read_id(json_t *element)
{
    const json_t *id = json_is_object(element) ? json_object_get(element, "id") : element;
    return json_is_real(id) ? (uint64_t)json_real_value(id) : CAUSE_NO_ID;
}

static keyed read_key(json_t *list, size_t i)
{
    json_t *element = json_array_get(list, i);
    keyed key = {.word = "", .id = read_id(element), .place = i, .element = element};
    if (json_is_string(element)) {
        key.word = json_string_value(element);
    } else if (key.id == CAUSE_NO_ID && json_object_size(element) == 1) {
        void *member = json_object_iter(element);
        key.word = json_object_iter_key(member);
        key.id = read_id(json_object_iter_value(member));
    }
    return key;
}

static int compare_by_key(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    if (x->id != y->id)
        return x->id < y->id ? -1 : 1;
    return strcmp(x->word, y->word);
}

static int compare_by_key_and_place(const void *a, const void *b)
{
    const int order = compare_by_key(a, b);
    return order ? order : (((const keyed *)a)->place > ((const keyed *)b)->place ? 1 : -1);
}

static keyed *sort_by_key(json_t *list, size_t count)
{
    keyed *sorted = malloc((count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < count; i++)
        sorted[i] = read_key(list, i);
    if (sorted)
        qsort(sorted, count, sizeof *sorted, compare_by_key_and_place);
    return sorted;
}

/* Compare two lists by merging them in the order of their keys. */
static void compare_lists_by_key(const cause_place *place, json_t *a, json_t *b)
{
    const size_t a_count = json_array_size(a), b_count = json_array_size(b);
    keyed *as = sort_by_key(a, a_count), *bs = sort_by_key(b, b_count);
    bool same = true, same_order = true;
    place->facts->out_of_memory |= !as || !bs;
    for (size_t i = 0, j = 0; as && bs && (i < a_count || j < b_count);) {
        const int order = i == a_count ? 1 : j == b_count ? -1 : compare_by_key(&as[i], &bs[j]);
        json_t *x = order <= 0 ? as[i].element : NULL, *y = order >= 0 ? bs[j].element : NULL;
        if (!are_values_equal(place, x, y)) {
            add_fact(place, !x ? CAUSE_MORE : !y ? CAUSE_LESS : CAUSE_OTHER, order <= 0 ? as[i].id : bs[j].id, x, y);
            same = false;
        }
        same_order = same_order && order == 0 && as[i].place == bs[j].place;
        i += order <= 0;
        j += order >= 0;
    }
    if (same && !same_order)
        add_fact(place, CAUSE_ORDER, CAUSE_NO_ID, NULL, NULL);
    free(as);
    free(bs);
}

/* ---- Lists whose elements are paired by similarity ------------------------------------------------------------ */

/* Return whether a member of an answer is a result and not a parameter of the query. */
static bool is_result_member(const char *key)
{
    static const char *const names[] = {"ids", "id", "position", "distance", "neighbors", "cost"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(key, names[i]) == 0)
            return true;
    return false;
}

/* Return the query of an answer: a new object with the kind and the parameters of the query. The caller releases the
 * object. */
static json_t *make_query_of_answer(json_t *answer)
{
    const char *kind = cause_kind_of(answer), *key;
    json_t *value, *asked = json_object();
    json_object_foreach(json_object_get(answer, kind), key, value) if (!is_result_member(key))
        json_object_set(asked, key, value);
    return json_pack("{so}", kind, asked);
}

/* Return a copy of a session's query without the answer and the visited nodes of the foreign index. The caller
 * releases the copy. */
static json_t *copy_query_without_answer(json_t *query)
{
    json_t *asked = json_copy(query);
    json_object_del(asked, "answer");
    for (int visit = 0; visit < OCTREE_NODE_VISITS; visit++)
        json_object_del(asked, octree_node_visit_name((octree_node_visit)visit));
    return asked;
}

/* Return the list of keys by which the elements of a list are paired. For answers, the keys are their queries. For
 * queries, the keys are the queries without the answers that the audited index gave. */
static json_t *make_pairing_keys(cause_rule rule, json_t *list)
{
    json_t *keys = json_array(), *element;
    size_t i;
    json_array_foreach(list, i, element)
    {
        json_t *key = rule == CAUSE_ANSWERS   ? make_query_of_answer(element)
                      : rule == CAUSE_QUERIES ? copy_query_without_answer(element)
                                              : json_incref(element);
        json_array_append_new(keys, key);
    }
    return keys;
}

/* Compare the answers of the foreign index. For the nodes that a query visited, only the counts are compared. */
static void compare_foreign_answers(cause_place place, json_t *a, json_t *b)
{
    json_t *counts[2] = {json_object(), json_object()};
    bool other = false, counted = false;
    for (int visit = 0; visit < OCTREE_NODE_VISITS; visit++) {
        const char *name = octree_node_visit_name((octree_node_visit)visit);
        json_t *const lists[2] = {json_object_get(a, name), json_object_get(b, name)};
        if (are_values_equal(&place, lists[0], lists[1]))
            continue;
        other = true;
        counted = counted || json_array_size(lists[0]) != json_array_size(lists[1]);
        for (int i = 0; i < 2; i++)
            json_object_set_new(counts[i], name, json_integer((json_int_t)json_array_size(lists[i])));
    }
    place.where = "queries.visits";
    if (other)
        add_fact(&place, CAUSE_OTHER, CAUSE_NO_ID, counted ? counts[0] : NULL, counted ? counts[1] : NULL);
    json_decref(counts[0]);
    json_decref(counts[1]);
    place.where = "queries.answer";
    json_t *const answers[2] = {json_object_get(a, "answer"), json_object_get(b, "answer")};
    if (!are_values_equal(&place, answers[0], answers[1]))
        add_fact(&place, CAUSE_OTHER, CAUSE_NO_ID, answers[0], answers[1]);
}

static void compare_queries(const cause_place *place, json_t *a, json_t *b)
{
    json_t *const asked[2] = {copy_query_without_answer(a), copy_query_without_answer(b)};
    if (!asked[0] || !asked[1])
        place->facts->out_of_memory = true;
    else if (are_values_equal(place, asked[0], asked[1]))
        compare_foreign_answers(*place, a, b);
    else
        add_fact(place, CAUSE_OTHER, CAUSE_NO_ID, a, b);
    json_decref(asked[0]);
    json_decref(asked[1]);
}

static void compare_pair(const cause_place *place, cause_rule rule, json_t *a, json_t *b)
{
    if (rule == CAUSE_ANSWERS)
        compare_values(place, a, b);
    else if (rule == CAUSE_QUERIES)
        compare_queries(place, a, b);
    else if (!are_values_equal(place, a, b))
        add_fact(place, CAUSE_OTHER, CAUSE_NO_ID, a, b);
}

/* Write the name of the query of an answer: "the range query". If the list has several range queries, write "query 3
 * (range)", where 3 is the query's position in the list, counted from 1. If the list holds no answers, write
 * nothing. */
static void format_query_name(cause_rule rule, json_t *list, size_t i, bool of_reference, char text[CAUSE_QUERY])
{
    if (rule != CAUSE_ANSWERS)
        return;
    const char *kind = cause_kind_of(json_array_get(list, i));
    size_t of_kind = 0;
    for (size_t j = 0; j < json_array_size(list); j++)
        of_kind += strcmp(cause_kind_of(json_array_get(list, j)), kind) == 0;
    if (of_kind == 1)
        snprintf(text, CAUSE_QUERY, "the %s query", kind);
    else
        snprintf(text, CAUSE_QUERY, "query %zu (%s)%s", i + 1, kind, of_reference ? " of the reference" : "");
}

/* Return whether paired elements have the same order in both lists. mates[j] is the index in `a` of the partner of
 * element j of `b`, or CAUSE_ALONE. */
static bool are_mates_in_order(const size_t *mates, size_t count)
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

/* Report the differences within pairs, then the elements that only one list has. `mates` is the result of
 * cause_pair_elements(). The function sets has_partner[i] to true for each element i of `a` that has a partner. Before
 * the call, all elements of has_partner must be false. */
static void compare_paired_lists(cause_place place, cause_rule rule, json_t *a, json_t *b, const size_t *mates,
                                 bool *has_partner)
{
    const size_t count = json_array_size(b);
    char query[CAUSE_QUERY] = "";
    if (rule == CAUSE_ANSWERS)
        place.query = query;
    for (size_t j = 0; j < count; j++) {
        if (mates[j] == CAUSE_ALONE)
            continue;
        format_query_name(rule, b, j, false, query);
        compare_pair(&place, rule, json_array_get(a, mates[j]), json_array_get(b, j));
        has_partner[mates[j]] = true;
    }
    for (size_t i = 0; i < json_array_size(a); i++) {
        if (has_partner[i])
            continue;
        format_query_name(rule, a, i, true, query);
        add_fact(&place, CAUSE_LESS, CAUSE_NO_ID, json_array_get(a, i), NULL);
    }
    for (size_t j = 0; j < count; j++) {
        if (mates[j] != CAUSE_ALONE)
            continue;
        format_query_name(rule, b, j, false, query);
        add_fact(&place, CAUSE_MORE, CAUSE_NO_ID, NULL, json_array_get(b, j));
    }
    query[0] = 0;
    if (!are_mates_in_order(mates, count))
        add_fact(&place, CAUSE_ORDER, CAUSE_NO_ID, NULL, NULL);
}

static void compare_lists_by_similarity(const cause_place *place, cause_rule rule, json_t *a, json_t *b)
{
    json_t *const keys[2] = {make_pairing_keys(rule, a), make_pairing_keys(rule, b)};
    size_t *mates = malloc((json_array_size(b) + 1) * sizeof *mates);
    bool *has_partner = calloc(json_array_size(a) + 1, sizeof *has_partner);
    const bool whole = json_array_size(keys[0]) == json_array_size(a) && json_array_size(keys[1]) == json_array_size(b);
    if (whole && mates && has_partner && cause_pair_elements(keys[0], keys[1], mates))
        compare_paired_lists(*place, rule, a, b, mates, has_partner);
    else
        place->facts->out_of_memory = true;
    free(mates);
    free(has_partner);
    json_decref(keys[0]);
    json_decref(keys[1]);
}

/* ---- Values -------------------------------------------------------------------------------------------------- */

static void compare_lists(const cause_place *place, cause_rule rule, json_t *a, json_t *b)
{
    const json_t *first = json_array_get(json_array_size(a) ? a : b, 0);
    if (rule == CAUSE_BY_KEY || json_is_string(first) || json_object_get(first, "id"))
        compare_lists_by_key(place, a, b);
    else if (json_is_number(first))
        add_fact(place, CAUSE_OTHER, CAUSE_NO_ID, a, b);
    else
        compare_lists_by_similarity(place, rule, a, b);
}

/* Compare two values of any type. The path of a member of an answer leaves out the kind of the query, because the
 * name of the query already contains the kind. */
static void compare_values(const cause_place *place, json_t *a, json_t *b)
{
    if (are_values_equal(place, a, b))
        return;
    const cause_rule rule = cause_rule_of(place->where);
    /* an empty list and a missing one differ, but have no elements to compare */
    const bool empty = json_array_size(a) == 0 && json_array_size(b) == 0;
    if (!empty && json_is_array(a ? a : b) && (!a || !b || json_is_array(b))) {
        compare_lists(place, rule, a, b);
    } else if (json_is_object(a) && json_is_object(b) && rule != CAUSE_WHOLE && !json_object_get(a, "min")) {
        if (rule == CAUSE_ANSWERS) {
            a = json_object_get(a, cause_kind_of(a));
            b = json_object_get(b, cause_kind_of(b));
        }
        cause_compare_members(place, a, b);
    } else {
        add_fact(place, CAUSE_OTHER, CAUSE_NO_ID, a, b);
    }
}

static void compare_member(const cause_place *place, const char *key, json_t *a, json_t *b)
{
    char where[sizeof((cause_group *)0)->where];
    cause_place member = *place;
    snprintf(where, sizeof where, "%s%s%s", place->where, *place->where ? "." : "", key);
    member.where = where;
    compare_values(&member, a, b);
}

void cause_compare_members(const cause_place *place, json_t *a, json_t *b)
{
    const char *key;
    json_t *value;
    json_object_foreach(b, key, value) compare_member(place, key, json_object_get(a, key), value);
    json_object_foreach(a, key, value) if (!json_object_get(b, key)) compare_member(place, key, value, NULL);
}
