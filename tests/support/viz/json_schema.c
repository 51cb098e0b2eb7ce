/* SPDX-License-Identifier: MIT */
#include "json_schema.h"
#include "fixture.h"

#include <stdio.h>
#include <string.h>

/* The schema as a whole, for its definitions. */
typedef struct checking {
    const json_t *root;
} checking;

static void check(const checking *c, const json_t *value, const json_t *schema, const char *at);

static void require(bool fits, const char *at, const char *word)
{
    if (!fits)
        fail_msg("%s does not fit \"%s\"", at, word);
}

static bool is_type(const json_t *value, const char *type)
{
    static const char *const names[] = {
        [JSON_OBJECT] = "object", [JSON_ARRAY] = "array", [JSON_STRING] = "string", [JSON_TRUE] = "boolean",
        [JSON_FALSE] = "boolean", [JSON_NULL] = "null",   [JSON_REAL] = "number",   [JSON_INTEGER] = "number"};
    if (strcmp(type, "integer") == 0) /* 1.0 is one, too */
        return json_is_number(value) && json_number_value(value) == (double)(int64_t)json_number_value(value);
    return strcmp(names[json_typeof(value)], type) == 0;
}

static bool is_among(const json_t *value, const json_t *list)
{
    size_t i;
    json_t *one;
    json_array_foreach(list, i, one) if (json_equal(one, value) ||
                                         (json_is_number(one) && json_is_number(value) &&
                                          json_number_value(one) == json_number_value(value))) return true;
    return false;
}

static void check_members(const checking *c, const json_t *value, const json_t *schema, const char *at)
{
    const json_t *properties = json_object_get(schema, "properties"),
                 *more = json_object_get(schema, "additionalProperties");
    const char *name;
    json_t *member;
    json_object_foreach((json_t *)value, name, member)
    {
        char place[512];
        const json_t *known = json_object_get(properties, name);
        snprintf(place, sizeof place, "%s.%s", at, name);
        require(known || !json_is_false(more), place, "additionalProperties");
        if (known || json_is_object(more))
            check(c, member, known ? known : more, place);
    }
}

static void check_items(const checking *c, const json_t *value, const json_t *items, const char *at)
{
    size_t i;
    json_t *item;
    json_array_foreach(value, i, item)
    {
        char place[512];
        snprintf(place, sizeof place, "%s[%zu]", at, i);
        check(c, item, items, place);
    }
}

static void check_required(const json_t *value, const json_t *names, const char *at)
{
    size_t i;
    json_t *name;
    json_array_foreach(names, i, name) if (!json_object_get(value, json_string_value(name)))
        fail_msg("%s has no \"%s\"", at, json_string_value(name));
}

static void check_word(const checking *c, const json_t *value, const json_t *schema, const char *word, const json_t *by,
                       const char *at)
{
    const char *text = json_string_value(by);
    if (strcmp(word, "$ref") == 0)
        check(c, value, json_object_get(json_object_get(c->root, "definitions"), strrchr(text, '/') + 1), at);
    else if (strcmp(word, "type") == 0)
        require(is_type(value, text), at, text);
    else if (strcmp(word, "const") == 0)
        require(json_equal(value, by) || json_number_value(value) == json_number_value(by), at, word);
    else if (strcmp(word, "enum") == 0)
        require(is_among(value, by), at, word);
    else if (strcmp(word, "required") == 0)
        check_required(value, by, at);
    else if (strcmp(word, "items") == 0)
        check_items(c, value, by, at);
    else if (strcmp(word, "minItems") == 0)
        require((double)json_array_size(value) >= json_number_value(by), at, word);
    else if (strcmp(word, "maxItems") == 0)
        require((double)json_array_size(value) <= json_number_value(by), at, word);
    else if (strcmp(word, "minimum") == 0)
        require(json_number_value(value) >= json_number_value(by), at, word);
    else if (strcmp(word, "maximum") == 0)
        require(json_number_value(value) <= json_number_value(by), at, word);
    else if (strcmp(word, "properties") == 0 || strcmp(word, "additionalProperties") == 0)
        check_members(c, value, schema, at);
    else if (strcmp(word, "description") != 0 && strcmp(word, "title") != 0 && strcmp(word, "$schema") != 0 &&
             strcmp(word, "definitions") != 0)
        fail_msg("nobody checks the word \"%s\" of a schema", word);
}

static void check(const checking *c, const json_t *value, const json_t *schema, const char *at)
{
    const char *word;
    json_t *by;
    assert_true(json_is_object(schema));
    json_object_foreach((json_t *)schema, word, by) check_word(c, value, schema, word, by, at);
}

void assert_fits_schema(const json_t *value, const json_t *schema)
{
    check(&(checking){schema}, value, schema, "it");
}
