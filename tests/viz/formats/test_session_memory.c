/* SPDX-License-Identifier: MIT */
/* test_session_memory.c - if the n-th allocation fails, for n = 0, 1, 2 ..., a session is read whole, or not at all
 * with an error. */
#include "fixture.h"

#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "failing_memory.h"
#include "files.h"
#include "foreign_session.h"
#include "json_read.h"
#include "scenes.h"
#include "session_stream.h"
#include "session_texts.h"
#include "temp_folder.h"

#define HEADER "{\"octreel\": \"session\", \"version\": 2, "

/* Between them, the texts have most members of a session. */
static const char *const texts[] = {
    HEADER
    "\"columns\": [\"class\", \"color\", \"intensity\"], \"player\": {\"id\": 7, \"position\": [1, 1, 1]}, "
    "\"points\": [[1, 2, 3, 4, 2, \"#123456\", 5], {\"id\": 9, \"position\": [5, 6, 7], \"velocity\": [1, 0, 0], "
    "\"class\": 3}, [3, 2, 1, 12, null, null, 6], [9, 9, 9, 100, 1, null, null]], \"keys\": \"wdn\"}\n"
    "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 20, \"position\": [3, 3, 3], \"color\": \"#ff0000\"}}, "
    "{\"remove\": 4}, {\"insert\": {\"id\": 21, \"position\": [3, 4, 3]}}]}\n"
    "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 4, \"position\": [1, 2, 3], \"class\": 2, \"color\": "
    "\"#123456\", \"intensity\": 5}}, {\"move\": {\"id\": 9, \"position\": [5, 5, 5]}}]}\n",
    HEADER "\"points\": {\"sample\": \"clustered\", \"count\": 20, \"seed\": 3}, \"velocities\": {\"speed\": 5, "
           "\"seed\": 2}, \"ticks\": 3}\n",
    HEADER
    "\"points\": [[1, 2, 3], [4, 5, 6], [7, 8, 9]], \"velocities\": [[1, 1, 0, 0], [3, 0, 0.5, 0]], \"ticks\": 4, "
    "\"shapes\": [{\"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1]}}], "
    "\"queries\": [{\"knearest\": 2, \"at\": [0, 0, 0]}]}\n"
    "{\"tick\": 2, \"queries\": [{\"radius\": 3, \"at\": [1, 1, 1], \"answer\": [0, 1], \"visited\": [1], "
    "\"pruned\": [2, 3]}, {\"range\": {\"min\": [0, 0, 0], \"max\": [5, 5, 5]}, \"answer\": []}]}\n",
    HEADER
    "\"points\": [[1, 2, 3], [1, 2, 3]]}\n{\"tick\": 0, \"pairs\": []}\n{\"tick\": 1, \"pairs\": [[2, 1], [5, 6]]}\n",
};

enum { TEXTS = sizeof texts / sizeof texts[0], CASES = TEXTS + 2 };

/* The i-th text, or the text of a session with every layer or with foreign nodes. The caller frees it. */
static char *make_text(size_t i)
{
    const octree_session asking = session_with_all_layers(), foreign = foreign_session();
    if (i >= TEXTS)
        return text_of_session(i == TEXTS ? &asking : &foreign, NULL);
    char *copy = malloc(strlen(texts[i]) + 1);
    assert_non_null(copy);
    return strcpy(copy, texts[i]);
}

/* If jansson has no memory, its message may wrongly be about the text. */
static bool jansson_fails;

static bool is_about_memory(const octreel_error *error)
{
    return jansson_fails ? *error->text != 0
                         : strstr(error->text, "memory") || strstr(error->text, octree_status_text(OCTREE_NO_MEMORY));
}

typedef bool attempt(const char *text, session_file *out, octreel_error *error);

static void assert_whole_or_refused(attempt *read, const char *text)
{
    octreel_error error = {""};
    session_file file;
    if (!read(text, &file, &error))
        fail_msg("%s", error.text);
    char *expected = text_of_session(&file.session, &file.values);
    session_release(&file);
    bool failed = true;
    long count = 0;
    for (; failed; count++) {
        fail_allocations_after(count);
        const bool done = read(text, &file, &error);
        failed = memory_has_failed();
        if (done) {
            char *again = text_of_session(&file.session, &file.values);
            assert_string_equal(again, expected);
            free(again);
        } else if (!failed || !is_about_memory(&error))
            fail_msg("after %ld allocations: %s", count, error.text);
        session_release(&file);
    }
    assert_true(count > 1);
    free(expected);
}

static bool read_text(const char *text, session_file *out, octreel_error *error)
{
    return session_parse("s.json", "", text, strlen(text), out, error);
}

/* Copying a session, without reading it. */
static session_file original;

static bool copy_original(const char *text, session_file *out, octreel_error *error)
{
    (void)text;
    return session_copy(&original.session, out, error);
}

static void session_is_read_whole_or_not_at_all_if_an_allocation_fails(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        char *text = make_text(i);
        assert_whole_or_refused(read_text, text);
        free(text);
    }
}

static void session_is_read_whole_or_not_at_all_if_jansson_fails(void **state)
{
    json_malloc_t allocate;
    json_free_t release;
    json_get_alloc_funcs(&allocate, &release);
    jansson_fails = true;
    json_set_alloc_funcs(malloc, free);
    json_detect_failed_allocations();
    session_is_read_whole_or_not_at_all_if_an_allocation_fails(state);
    json_set_alloc_funcs(allocate, release);
    jansson_fails = false;
}

static void session_is_copied_whole_or_not_at_all_if_an_allocation_fails(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        char *text = make_text(i);
        original = session_of_text(text);
        assert_whole_or_refused(copy_original, text);
        session_release(&original);
        free(text);
    }
}

/* Read a whole stream, and count the items of tick 0 and the ticks. */
static session_stream_state read_stream(const char *path, size_t *count, octreel_error *error)
{
    const int file = open(path, O_RDONLY);
    session_stream_tick tick;
    session_stream *s = session_stream_open(file, "s.json", NULL, NULL);
    session_stream_state state = s ? session_stream_read_start(s, NULL, error) : SESSION_STREAM_BROKEN;
    *count = 0;
    if (!s)
        strcpy(error->text, "out of memory");
    else if (state == SESSION_STREAM_TICK)
        for (*count = session_stream_first_session(s)->body_count; state == SESSION_STREAM_TICK; ++*count)
            state = session_stream_read_tick(s, &tick, error);
    if (s)
        session_stream_close(s);
    close(file);
    return state;
}

static void stream_is_read_whole_or_fails_with_the_reason(void **state)
{
    const temp_folder *own = *state;
    const place path = place_in(own, "s.json");
    for (size_t i = 0; i < CASES; i++) {
        char *text = make_text(i);
        size_t all, some;
        octreel_error error = {""};
        file_write_text(path.path, text);
        assert_int_equal(read_stream(path.path, &all, &error), SESSION_STREAM_END);
        bool failed = true;
        for (long count = 0; failed; count++) {
            fail_allocations_after(count);
            const session_stream_state end = read_stream(path.path, &some, &error);
            failed = memory_has_failed();
            if (end == SESSION_STREAM_END)
                assert_int_equal(some, all);
            else if (!failed || !is_about_memory(&error))
                fail_msg("text %zu after %ld allocations: %s", i, count, error.text);
        }
        free(text);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(session_is_read_whole_or_not_at_all_if_an_allocation_fails),
        TEST(session_is_copied_whole_or_not_at_all_if_an_allocation_fails),
        TEST(stream_is_read_whole_or_fails_with_the_reason),
        TEST(session_is_read_whole_or_not_at_all_if_jansson_fails),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fail_one_allocation();
    return failed + cmocka_run_group_tests(tests, NULL, NULL);
}
