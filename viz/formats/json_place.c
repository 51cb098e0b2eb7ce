/* json_place.c - see json_place.h. */
#include "json_place.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Returns the length so far. A place is as deep as the code that reads it, not as its input. */
static size_t format(const json_place *place, char *text, size_t size)
{
    if (!place)
        return 0;
    size_t length = format(place->parent, text, size);
    if (length + 1 >= size)
        return length;
    if (!place->member)
        snprintf(text + length, size - length, "[%zu]", place->index);
    else
        snprintf(text + length, size - length, "%s%s", length > 0 ? "." : "", place->member);
    return length + strlen(text + length);
}

const char *json_place_format(const json_place *place, char *text, size_t size)
{
    text[0] = '\0';
    format(place, text, size);
    return text;
}

static const char *skip_blanks(const char *at, const char *limit)
{
    while (at < limit && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r'))
        at++;
    return at;
}

/* From a string's opening quote to behind its closing one. */
static const char *skip_string(const char *at, const char *limit)
{
    for (at++; at < limit && *at != '"'; at++)
        if (*at == '\\' && at + 1 < limit)
            at++;
    return at < limit ? at + 1 : limit;
}

/* From a value to the comma or bracket behind it. */
static const char *skip_value(const char *at, const char *limit)
{
    size_t depth = 0;
    while (at < limit) {
        bool closing = *at == ']' || *at == '}';
        if (depth == 0 && (closing || *at == ','))
            return at;
        if (*at == '"') {
            at = skip_string(at, limit);
            continue;
        }
        if (*at == '[' || *at == '{')
            depth++;
        else if (closing)
            depth--;
        at++;
    }
    return at;
}

/* From where an element or member is due to its value; *found when it is the one that is looked for. */
static const char *enter(const char *at, const char *limit, const json_place *place, size_t index, bool *found)
{
    if (!place->member) {
        *found = index == place->index;
        return at;
    }
    const char *name = at + 1;
    at = skip_string(at, limit);
    size_t length = (size_t)(at - name) - 1;
    *found = length == strlen(place->member) && memcmp(name, place->member, length) == 0;
    at = skip_blanks(at, limit);
    return at < limit ? skip_blanks(at + 1, limit) : limit;
}

/* Find a place in the array or object at `at`; null when it is not there. */
static const char *find_child(const char *at, const char *limit, const json_place *place)
{
    char open = place->member ? '{' : '[';
    if (at == limit || *at != open)
        return NULL;
    at = skip_blanks(at + 1, limit);
    for (size_t index = 0; at < limit && *at != ']' && *at != '}'; index++) {
        bool found;
        at = enter(at, limit, place, index, &found);
        if (found)
            return at;
        at = skip_value(at, limit);
        if (at < limit && *at == ',')
            at = skip_blanks(at + 1, limit);
    }
    return NULL;
}

static const char *find(const json_place *place, const char *text, const char *limit)
{
    if (!place)
        return skip_blanks(text, limit);
    const char *parent = find(place->parent, text, limit);
    return parent ? find_child(parent, limit, place) : NULL;
}

const char *json_place_find(const json_place *place, const char *text, const char *limit)
{
    const char *found = find(place, text, limit);
    while (!found) {
        place = place->parent;
        found = find(place, text, limit);
    }
    return found;
}
