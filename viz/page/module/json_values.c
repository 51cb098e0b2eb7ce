/* SPDX-License-Identifier: MIT */
/* json_values.c - jansson's functions for the values that json_subset.c reads. */
#include "json_values.h"

#include <stdlib.h>
#include <string.h>

void json_free_arena(chunk *first)
{
    while (first) {
        chunk *next = first->next;
        free(first);
        first = next;
    }
}

/* Of values that json_loadb() has returned, and of these alone. */
void json_delete(json_t *json)
{
    json_free_arena((chunk *)((char *)json - offsetof(chunk, aligned)));
}

size_t json_array_size(const json_t *json)
{
    return json_is_array(json) ? ((const array *)json)->count : 0;
}

json_t *json_array_get(const json_t *json, size_t index)
{
    return index < json_array_size(json) ? ((const array *)json)->items[index] : NULL;
}

size_t json_object_size(const json_t *json)
{
    return json_is_object(json) ? ((const object *)json)->count : 0;
}

void *json_object_iter(json_t *json)
{
    return json_is_object(json) ? ((object *)json)->first : NULL;
}

void *json_object_iter_next(json_t *json, void *iter)
{
    (void)json;
    return iter ? ((entry *)iter)->next : NULL;
}

const char *json_object_iter_key(void *iter)
{
    return iter ? ((entry *)iter)->key : NULL;
}

json_t *json_object_iter_value(void *iter)
{
    return iter ? ((entry *)iter)->value : NULL;
}

void *json_object_key_to_iter(const char *key)
{
    return key ? (char *)key - offsetof(entry, key) : NULL;
}

json_t *json_object_get(const json_t *json, const char *key)
{
    for (entry *e = json_object_iter((json_t *)json); e; e = e->next)
        if (strcmp(e->key, key) == 0)
            return e->value;
    return NULL;
}

const char *json_string_value(const json_t *json)
{
    return json_is_string(json) ? ((const string *)json)->text : NULL;
}

size_t json_string_length(const json_t *json)
{
    return json_is_string(json) ? strlen(json_string_value(json)) : 0;
}

double json_real_value(const json_t *json)
{
    return json_is_real(json) ? ((const real *)json)->value : 0;
}

double json_number_value(const json_t *json)
{
    return json_real_value(json);
}
