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
#include "../../../viz/page/module/json_subset.c"
#include "../../../viz/page/module/json_values.c"
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

#include "failing_memory.h"
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
        "[\"\\ud83d\\u0041\"]",
        "[\"\\ud83d\\uffff\"]",
        "[0.10000000000000000000000000000000000000000000000000000000000000000000000001]",
        "[thisWordIsLongerThanWhatTheReaderSaysOfIt]",
        "[this:Word]",
    };
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        read_both(texts[i], strlen(texts[i]), FLAGS);
        read_both(texts[i], strlen(texts[i]), FLAGS | JSON_DISABLE_EOF_CHECK);
        read_both(texts[i], strlen(texts[i]), FLAGS | JSON_DECODE_ANY | JSON_DISABLE_EOF_CHECK);
    }
}

/* What only looks for a place in a text that was read does not ask for that. */
static void names_that_are_there_twice_are_refused_where_that_is_asked_for(void **state)
{
    static const char text[] = "{\"a\": 1, \"b\": 2, \"a\": 3}";
    json_error_t error;
    (void)state;
    assert_false(read_both(text, sizeof text - 1, FLAGS));
    json_t *value = subset_loadb(text, sizeof text - 1, FLAGS & ~(size_t)JSON_REJECT_DUPLICATES, &error);
    assert_non_null(value);
    subset_delete(value);
}

static void zero_bytes_are_refused_as_by_jansson(void **state)
{
    static const char texts[][8] = {"\0[1]", "[\0]", "[1\0]", "[\"\\\0\"]", "[\"\0\"]", "[1]\0"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        assert_false(read_both(texts[i], sizeof texts[i] - 1, FLAGS));
}

/* Whoever asks a value for what it has not gets what jansson gives, and so does who has no value. */
static void values_of_other_types_answer_as_jansson_s(void **state)
{
    static const char text[] = "[{\"a\": 1}, [2], \"text\", 3, true, null]";
    json_error_t error;
    json_t *ours = subset_loadb(text, strlen(text), FLAGS, &error),
           *theirs = json_loadb(text, strlen(text), FLAGS, &error);
    (void)state;
    for (size_t i = 0; i <= json_array_size(theirs); i++) {
        json_t *a = subset_array_get(ours, i), *b = json_array_get(theirs, i);
        assert_int_equal(a == NULL, b == NULL);
        assert_int_equal(subset_array_size(a), json_array_size(b));
        assert_int_equal(subset_object_size(a), json_object_size(b));
        assert_int_equal(subset_string_length(a), json_string_length(b));
        assert_int_equal(subset_string_value(a) == NULL, json_string_value(b) == NULL);
        assert_true(subset_real_value(a) == json_real_value(b) && subset_number_value(a) == json_number_value(b));
        assert_int_equal(subset_array_get(a, 0) == NULL, json_array_get(b, 0) == NULL);
        assert_int_equal(subset_object_get(a, "a") == NULL, json_object_get(b, "a") == NULL);
        assert_int_equal(subset_object_iter(a) == NULL, json_object_iter(b) == NULL);
    }
    json_t *object = subset_array_get(ours, 0);
    void *first = subset_object_iter(object);
    assert_string_equal(subset_object_iter_key(first), "a");
    assert_ptr_equal(subset_object_key_to_iter(subset_object_iter_key(first)), first);
    assert_ptr_equal(subset_object_iter_value(first), subset_object_get(object, "a"));
    assert_null(subset_object_iter_next(object, first));
    assert_null(subset_object_iter_next(object, NULL));
    assert_null(subset_object_iter_key(NULL));
    assert_null(subset_object_iter_value(NULL));
    assert_null(subset_object_key_to_iter(NULL));
    subset_delete(ours);
    json_decref(theirs);
}

/* jansson's sign of it is a line of -1. */
static void a_text_without_memory_is_no_value(void **state)
{
    char *text = malloc(200000), *at = text;
    bool failed = true;
    long count = 0;
    (void)state;
    assert_non_null(text);
    at += sprintf(at, "[{\"name\": \"%0*d\"}", 5000, 7); /* longer than a piece of memory */
    for (int i = 0; i < 400; i++)
        at += sprintf(at, ", %d, \"%0*d\", {\"%d\": [true, 1%0*d.5]}", i, i, i, i, i % 3 ? 0 : 65, 0);
    at += sprintf(at, "]");
    for (; failed; count++) {
        json_error_t error;
        memory_fails_after(count);
        json_t *value = subset_loadb(text, (size_t)(at - text), FLAGS, &error);
        failed = memory_has_failed();
        assert_int_equal(value == NULL, failed);
        if (failed)
            assert_int_equal(error.line, -1);
        else
            subset_delete(value);
    }
    assert_true(count > 5);
    free(text);
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
        cmocka_unit_test(names_that_are_there_twice_are_refused_where_that_is_asked_for),
        cmocka_unit_test(zero_bytes_are_refused_as_by_jansson),
        cmocka_unit_test(values_of_other_types_answer_as_jansson_s),
        cmocka_unit_test(a_text_without_memory_is_no_value),
        cmocka_unit_test(lists_within_each_other_are_refused_beyond_a_depth),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    memory_fails_alone();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
