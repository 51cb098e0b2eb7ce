/* SPDX-License-Identifier: MIT */
#include "edited_json.h"

#include <jansson.h>
#include <string.h>

enum { SLOTS = 4096 };

/* The place of a value: a name in an object, or an index in an array. */
typedef struct slot {
    json_t *in;
    const char *name;
    size_t at;
} slot;

typedef struct text {
    json_t *objects; /* an array of all objects of the text */
    slot slots[SLOTS];
    size_t count;
    uint64_t random;
} text;

static size_t choose(text *t, size_t count)
{
    t->random = t->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (size_t)(t->random >> 33) % count;
}

static json_t *value_of(const slot *s)
{
    return s->name ? json_object_get(s->in, s->name) : json_array_get(s->in, s->at);
}

static void collect(text *t, json_t *in)
{
    const char *name;
    size_t i;
    json_t *value;
    if (json_is_array(in))
        json_array_foreach(in, i, value)
        {
            if (t->count < SLOTS)
                t->slots[t->count++] = (slot){in, NULL, i};
            collect(t, value);
        }
    else
        json_object_foreach(in, name, value)
        {
            if (t->count < SLOTS)
                t->slots[t->count++] = (slot){in, name, 0};
            collect(t, value);
        }
}

static json_t *read_objects(const uint8_t *data, size_t size)
{
    json_t *all = json_array();
    for (size_t at = 0; at < size;) {
        json_error_t end;
        json_t *object = json_loadb((const char *)data + at, size - at, JSON_DISABLE_EOF_CHECK, &end);
        if (!object)
            break;
        json_array_append_new(all, object);
        at += (size_t)end.position;
    }
    return all;
}

static json_t *make_extreme(text *t)
{
    static const char *const values[] = {
        "0",     "-1",    "1",     "-0.0",       "1e308",      "-1.5e-320", "9007199254740991",
        "1e-30", "65535", "65536", "4294967295", "1000000000", "0.1",       "-9007199254740993",
        "null",  "true",  "false", "\"\"",       "\"player\"", "\"grow\"",  "\"q.wsdaefn\"",
        "[]",    "[[]]",  "{}",    "[0,0,0]",    "[1,2,3,4]",  "\"float\"", "\"\\u0000\""};
    return json_loads(values[choose(t, sizeof values / sizeof *values)], JSON_DECODE_ANY | JSON_ALLOW_NUL, NULL);
}

static json_t *make_near(text *t, const json_t *value)
{
    const json_int_t steps[] = {1, -1, 64, -64};
    if (json_is_integer(value))
        return json_integer((json_int_t)((uint64_t)json_integer_value(value) + (uint64_t)steps[choose(t, 4)]));
    return json_is_real(value) ? json_real(json_real_value(value) / 3) : make_extreme(t);
}

static void put(const slot *s, json_t *value)
{
    if (s->name)
        json_object_set_new(s->in, s->name, value);
    else
        json_array_set_new(s->in, s->at, value);
}

static void drop(const slot *s)
{
    if (s->name)
        json_object_del(s->in, s->name);
    else
        json_array_remove(s->in, s->at);
}

/* Add a copy of a value beside another one, under its own name. */
static void add_beside(const slot *s, const slot *from)
{
    json_t *copy = json_deep_copy(value_of(from));
    if (json_is_array(s->in))
        json_array_insert_new(s->in, s->at, copy);
    else
        json_object_set_new(s->in, from->name ? from->name : "points", copy);
}

static void edit(text *t)
{
    const slot *s = &t->slots[choose(t, t->count)], *other = &t->slots[choose(t, t->count)];
    switch (choose(t, 6)) {
    case 0:
        put(s, make_extreme(t));
        break;
    case 1:
        put(s, json_deep_copy(value_of(other)));
        break;
    case 2:
        drop(s);
        break;
    case 3:
    case 4:
        add_beside(s, other);
        break;
    default:
        put(s, make_near(t, value_of(s)));
    }
}

static size_t write_objects(const json_t *objects, uint8_t *data, size_t most)
{
    size_t size = 0, i;
    json_t *object;
    json_array_foreach((json_t *)objects, i, object)
    {
        const size_t got = json_dumpb(object, (char *)data + size, most - size,
                                      JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
        if (got == 0 || got >= most - size)
            return 0;
        size += got;
        data[size++] = '\n';
    }
    return size;
}

size_t edited_json(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    static text t; /* static, because it is large for a stack */
    t = (text){.objects = read_objects(data, size), .random = seed};
    for (size_t edits = choose(&t, 3) + 1; edits > 0; edits--) {
        t.count = 0;
        collect(&t, t.objects);
        if (t.count > 0)
            edit(&t);
    }
    const size_t made = write_objects(t.objects, data, most);
    json_decref(t.objects);
    return made;
}
