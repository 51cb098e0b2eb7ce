/* SPDX-License-Identifier: MIT */
/* test_json_subset.c - what stands for jansson in a page reads what jansson reads, refuses what it refuses, and says
 * the same line and place. */
#include <jansson.h>

/* The subset's functions under other names. */
#define json_loadb subset_loadb
#define json_delete subset_delete
#define json_array_size subset_array_size
#define json_array_get subset_array_get
#define json_object_size subset_object_size
#define json_object_iter subset_object_iter
#define json_object_iter_next subset_object_iter_next
#define json_object_iter_key subset_object_iter_key
#define json_object_iter_value subset_object_iter_value
#define json_object_key_to_iter subset_object_key_to_iter
#define json_object_get subset_object_get
#define json_string_value subset_string_value
#define json_string_length subset_string_length
#define json_real_value subset_real_value
#define json_number_value subset_number_value
json_t *json_loadb(const char *text, size_t size, size_t flags, json_error_t *error);
void json_delete(json_t *json);
#include "../../../viz/web/json_subset.c"
#include "../../../viz/web/json_values.c"
#undef json_loadb
#undef json_delete
#undef json_array_size
#undef json_array_get
#undef json_object_size
#undef json_object_iter
#undef json_object_iter_next
#undef json_object_iter_key
#undef json_object_iter_value
#undef json_object_key_to_iter
#undef json_object_get
#undef json_string_value
#undef json_string_length
#undef json_real_value
#undef json_number_value

#include "fixture.h"

static void assert_same(json_t *ours, const json_t *theirs)
{
    const char *name;
    json_t *member;
    assert_int_equal(json_typeof(ours), json_typeof(theirs));
    switch (json_typeof(theirs)) {
    case JSON_OBJECT:
        assert_int_equal(subset_object_size(ours), json_object_size(theirs));
        json_object_foreach((json_t *)(uintptr_t)theirs, name, member)
            assert_same(subset_object_get(ours, name), member);
        break;
    case JSON_ARRAY:
        assert_int_equal(subset_array_size(ours), json_array_size(theirs));
        for (size_t i = 0; i < json_array_size(theirs); i++)
            assert_same(subset_array_get(ours, i), json_array_get(theirs, i));
        break;
    case JSON_STRING:
        assert_string_equal(subset_string_value(ours), json_string_value(theirs));
        assert_int_equal(subset_string_length(ours), json_string_length(theirs));
        break;
    case JSON_REAL: {
        const double a = subset_real_value(ours), b = json_real_value(theirs);
        assert_memory_equal(&a, &b, sizeof a);
        break;
    }
    default:
        break;
    }
}

/* Whether both read it. Of what is refused, the line is the same, but that jansson counts a break that it has read in a
 * text. */
static bool read_both(const char *text, size_t size, size_t flags)
{
    json_error_t error, other;
    json_t *ours = subset_loadb(text, size, flags, &error), *theirs = json_loadb(text, size, flags, &other);
    const bool read = theirs != NULL;
    if (read != (ours != NULL))
        fail_msg("\"%.*s\": %s, and by jansson %s", (int)size, text, ours ? "read" : error.text,
                 theirs ? "read" : other.text);
    if (read) {
        assert_same(ours, theirs);
        if (flags & JSON_DISABLE_EOF_CHECK)
            assert_int_equal(error.position, other.position);
        subset_delete(ours);
    } else if (error.line != other.line && error.line + 1 != other.line) {
        fail_msg("\"%.*s\": line %d (%s), and by jansson %d (%s)", (int)size, text, error.line, error.text, other.line,
                 other.text);
    }
    json_decref(theirs);
    return read;
}

#define FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

static void texts_are_read_or_refused_as_by_jansson(void **state)
{
    static const char *const texts[] = {
        "{}",
        " [ ] ",
        "[1,-0,0.5e-3,1E+2,123456789012345678901234567890,5e-324]",
        "[01]",
        "[-]",
        "[1.]",
        "[.5]",
        "[1e]",
        "[1e999]",
        "[+1]",
        "[0x1]",
        "[NaN]",
        "[1,]",
        "[,1]",
        "[1 2]",
        "[",
        "]",
        "",
        "   ",
        "{\"a\":1,\"a\":2}",
        "{\"a\" 1}",
        "{\"a\":}",
        "{a:1}",
        "{\"a\":1,}",
        "{\"a\":{\"b\":[true,false,null]}}",
        "[tru]",
        "[nulll]",
        "[True]",
        "[\"\\u00e4\\ud83d\\ude00\\n\\\"\\\\\\/\\b\\f\\r\\t\"]",
        "[\"\\ud83d\"]",
        "[\"\\ude00\"]",
        "[\"\\ud83dx\"]",
        "[\"\\u12\"]",
        "[\"\\x\"]",
        "[\"\\u0000\"]",
        "[\"a\nb\"]",
        "[\"a",
        "[\"a\\",
        "[\"\xc3\xa4\"]",
        "{\n\"a\": 1,\n\"b\" 2}",
        "{} {}",
        "{}\n\nx",
        "[1]]",
        "7",
        "\"x\"",
        "true",
        "[\"\\u\"]",
        "{\"\":[]}",
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        read_both(texts[i], strlen(texts[i]), FLAGS);
        read_both(texts[i], strlen(texts[i]), FLAGS | JSON_DISABLE_EOF_CHECK);
        read_both(texts[i], strlen(texts[i]), FLAGS | JSON_DECODE_ANY | JSON_DISABLE_EOF_CHECK);
    }
}

/* Bytes of a session are changed, left out and doubled; what is not ASCII stays out, as the page has valid UTF-8. */
static void texts_with_faults_are_read_or_refused_as_by_jansson(void **state)
{
    static const char session[] =
        "{\"octreel\": \"session\", \"version\": 1, \"world\": {\"min\": [-1e2, -1.5, 0], \"max\": [1, 2E3, 3]},\n"
        " \"points\": [[1, 2, 3], [4.25, -5, 6, 7], {\"id\": 9, \"position\": [0, 0, 0]}], \"keys\": "
        "\"ww\\u0064\\n\",\n"
        " \"player\": null, \"sweep\": false, \"empty\": {}, \"none\": []}";
    static const char bytes[] = "{}[],:\"\\ \n0129.-+eEutfn";
    char text[sizeof session];
    uint64_t random = 11;
    size_t read = 0;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        size_t size = sizeof session - 1;
        memcpy(text, session, size);
        for (uint64_t faults = random_below(&random, 3); faults > 0; faults--)
            text[random_below(&random, size)] = bytes[random_below(&random, sizeof bytes - 1)];
        if (random_below(&random, 8) == 0)
            size = (size_t)random_below(&random, size);
        read += read_both(text, size, i % 2 ? FLAGS : FLAGS | JSON_DISABLE_EOF_CHECK);
    }
    assert_true(read > 5000 && read < 15000);
}

static void lists_within_each_other_are_refused_beyond_a_depth(void **state)
{
    char text[2000];
    json_error_t error;
    (void)state;
    memset(text, '[', 1000);
    memset(text + 1000, ']', 1000);
    assert_null(subset_loadb(text, 2000, FLAGS, &error));
    assert_string_equal(error.text, "maximum parsing depth reached");
    assert_true(read_both(text + 900, 200, FLAGS));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_read_or_refused_as_by_jansson),
        cmocka_unit_test(texts_with_faults_are_read_or_refused_as_by_jansson),
        cmocka_unit_test(lists_within_each_other_are_refused_beyond_a_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
