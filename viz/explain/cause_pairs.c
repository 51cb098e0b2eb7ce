/* SPDX-License-Identifier: MIT */
/* cause_pairs.c - pairs the elements of two lists that have no keys, most similar first.
 *
 * First, equal elements are paired: both lists are sorted by the JSON text of their elements. Then the remaining
 * elements are paired in descending order of similarity. The similarity of two elements is the number of values that
 * are equal in both at the same path.
 *
 * A list may hold thousands of queries, and comparing each element with each other element would cost O(n^2). Each
 * element is therefore compared with only PAIR_CANDIDATES elements of the other list, at the indices around its own.
 */
#include "cause_pairs.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The number of candidates: elements of one list with which an element of the other list is compared. The indices of
 * the candidates lie around the index of the element. */
#define PAIR_CANDIDATES ((size_t)16)

typedef struct entry {
    json_t *element;
    char *text;   /* the JSON text of the element */
    size_t place; /* the index of the element in its list */
    bool paired;
} entry;

typedef struct entries {
    entry *all;   /* one entry for each element of the list, in the order of the list; owned */
    entry **left; /* all entries, sorted by text; later only the entries without a partner */
    size_t count, left_count;
} entries;

const char *cause_kind_of(json_t *element)
{
    const char *key = json_object_iter_key(json_object_iter(element));
    return key ? key : "";
}

static void release_entries(entries *e)
{
    for (size_t i = 0; e->all && i < e->count; i++)
        free(e->all[i].text);
    free(e->all);
    free(e->left);
}

static bool make_entries(entries *e, json_t *list)
{
    bool ok = true;
    e->count = json_array_size(list);
    e->all = calloc(e->count + 1, sizeof *e->all);
    e->left = calloc(e->count + 1, sizeof *e->left);
    for (size_t i = 0; e->all && i < e->count; i++) {
        json_t *element = json_array_get(list, i);
        char *text = json_dumps(element, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(17));
        e->all[i] = (entry){element, text, i, false};
        ok = ok && text;
    }
    return ok && e->all && e->left;
}

/* ---- Equal elements ------------------------------------------------------------------------------------------ */

static int compare_by_text(const void *a, const void *b)
{
    const entry *x = *(entry *const *)a, *y = *(entry *const *)b;
    const int order = strcmp(x->text, y->text);
    return order ? order : (x->place > y->place) - (x->place < y->place);
}

static void mark_pair(entry *a, entry *b, size_t *mates)
{
    mates[b->place] = a->place;
    a->paired = b->paired = true;
}

static void sort_by_text(entries *e)
{
    for (size_t i = 0; i < e->count; i++)
        e->left[i] = &e->all[i];
    qsort(e->left, e->count, sizeof *e->left, compare_by_text);
}

static void list_unpaired_entries(entries *e)
{
    for (size_t i = 0; i < e->count; i++)
        if (!e->all[i].paired)
            e->left[e->left_count++] = &e->all[i];
}

static void pair_equal_entries(entries *a, entries *b, size_t *mates)
{
    sort_by_text(a);
    sort_by_text(b);
    for (size_t i = 0, j = 0; i < a->count && j < b->count;) {
        const int order = strcmp(a->left[i]->text, b->left[j]->text);
        if (order == 0)
            mark_pair(a->left[i], b->left[j], mates);
        i += order <= 0;
        j += order >= 0;
    }
    list_unpaired_entries(a);
    list_unpaired_entries(b);
}

/* ---- Similar elements ---------------------------------------------------------------------------------------- */

/* Return the number of values (numbers, texts and booleans) that are equal in both elements at the same path. */
static unsigned count_common_members(json_t *a, json_t *b)
{
    unsigned common = 0;
    const char *key;
    json_t *value;
    size_t i;
    if (json_is_object(a))
        json_object_foreach(a, key, value) common += count_common_members(value, json_object_get(b, key));
    else if (json_is_array(a))
        json_array_foreach(a, i, value) common += count_common_members(value, json_array_get(b, i));
    else
        common = a && b && json_equal(a, b);
    return common;
}

/* Element j of one list is compared only with the PAIR_CANDIDATES elements around index j of the other list. Return the
 * index of the first of these. */
static size_t find_first_candidate(size_t j)
{
    return j < PAIR_CANDIDATES / 2 ? 0 : j - PAIR_CANDIDATES / 2;
}

/* Return the similarity of two elements without a partner, or 0 if their kinds differ. Elements of the same kind have
 * at least 1, and each equal value adds 2. Elements at the same distance from the beginning or from the end of their
 * lists get 1 more, which decides between pairs with the same number of equal values. */
static uint8_t find_similarity(const entries *a, size_t i, const entries *b, size_t j)
{
    json_t *x = a->left[i]->element, *y = b->left[j]->element;
    if (strcmp(cause_kind_of(x), cause_kind_of(y)) != 0)
        return 0;
    const bool same_place = i == j || a->left_count - i == b->left_count - j;
    const unsigned found = 1 + same_place + 2 * count_common_members(x, y);
    return found < UINT8_MAX ? (uint8_t)found : UINT8_MAX;
}

/* Pair the remaining elements in descending order of similarity. */
static bool pair_similar_entries(entries *a, entries *b, size_t *mates)
{
    uint8_t *table = calloc(b->left_count + 1, PAIR_CANDIDATES), most = 0;
    for (size_t j = 0; table && j < b->left_count; j++)
        for (size_t k = 0; k < PAIR_CANDIDATES && find_first_candidate(j) + k < a->left_count; k++) {
            const uint8_t found = find_similarity(a, find_first_candidate(j) + k, b, j);
            table[j * PAIR_CANDIDATES + k] = found;
            most = found > most ? found : most;
        }
    for (unsigned level = most; table && level > 0; level--)
        for (size_t n = 0; n < b->left_count * PAIR_CANDIDATES; n++) {
            if (table[n] != level)
                continue;
            entry *x = a->left[find_first_candidate(n / PAIR_CANDIDATES) + n % PAIR_CANDIDATES];
            entry *y = b->left[n / PAIR_CANDIDATES];
            if (!x->paired && !y->paired)
                mark_pair(x, y, mates);
        }
    const bool made = table;
    free(table);
    return made;
}

bool cause_pair_elements(json_t *a, json_t *b, size_t *mates)
{
    entries x = {0}, y = {0};
    for (size_t j = 0; j < json_array_size(b); j++)
        mates[j] = CAUSE_ALONE;
    bool ok = make_entries(&x, a) && make_entries(&y, b);
    if (ok) {
        pair_equal_entries(&x, &y, mates);
        ok = pair_similar_entries(&x, &y, mates);
    }
    release_entries(&x);
    release_entries(&y);
    return ok;
}
