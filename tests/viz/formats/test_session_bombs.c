/* SPDX-License-Identifier: MIT */
/* test_session_bombs.c - reading a session or a recording.json takes at most 100 times its size in memory, whatever
 * numbers it states. */
#include "fixture.h"
#include "recording_file.h"
#include "session_file.h"
#include "text_bomb.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_BYTES_A_BYTE = 100 };

static octreel_error error;

static void read_session(char *text, size_t size)
{
    session_file file;
    error.text[0] = 0;
    session_parse("bomb", "", text, size, &file, &error);
    session_release(&file);
}

static void read_recording(char *text, size_t size)
{
    view v;
    uint64_t every;
    error.text[0] = 0;
    recording_parse("bomb", text, size, &v, &every, &error);
}

#define HEAD "{\"octreel\": \"session\", \"version\": 2"
#define BEGIN HEAD ", \"ticks\": 0, "
#define BOX "\"box\":{\"min\":[0,0,0],\"max\":[1,1,1]}"

static const text_bomb sessions[] = {
    {"points", BEGIN "\"points\": [[0,0,0]", ",[0,0,0]", "]}"},
    {"points with ids", BEGIN "\"points\": [[0,0,0,1]", ",[0,0,0,@]", "]}"},
    {"points as objects", BEGIN "\"points\": [[0,0,0]", ",{\"position\":[0,0,0]}", "]}"},
    {"points with velocities", BEGIN "\"points\": [[0,0,0]", ",{\"position\":[0,0,0],\"velocity\":[1,1,1]}", "]}"},
    {"points with classes", BEGIN "\"columns\": [\"class\"], \"points\": [[0,0,0]", ",[0,0,0,@,2]", "]}"},
    {"empty lists", BEGIN "\"points\": [[]", ",[]", "]}"},
    {"empty objects", BEGIN "\"points\": [{}", ",{}", "]}"},
    {"objects of one member", BEGIN "\"points\": [{}", ",{\"\":0}", "]}"},
    {"lists of one number", BEGIN "\"points\": [[]", ",[0]", "]}"},
    {"empty texts", BEGIN "\"points\": [[]", ",\"\"", "]}"},
    {"numbers", BEGIN "\"points\": [0", ",0", "]}"},
    {"nulls", BEGIN "\"points\": [0", ",null", "]}"},
    {"members", HEAD, ",\"@\":0", "}"},
    {"objects of members", BEGIN "\"points\": [{}", ",{\"a\":0,\"b\":0,\"c\":0,\"d\":0,\"e\":0,\"f\":0}", "]}"},
    {"a long text", BEGIN "\"keys\": \"", "w", "\"}"},
    {"a long text of escapes", BEGIN "\"keys\": \"", "\\u0077", "\"}"},
    {"a long number", BEGIN "\"step\": ", "1", "}"},
    {"a text without end", BEGIN "\"keys\": \"", "w", ""},
    {"nested lists", "", "[", ""},
    {"nested objects", "", "{\"a\":", ""},
    {"nested points", BEGIN "\"points\": [", "[", ""},
    {"blanks", "", "\n", ""},
    {"velocities", BEGIN "\"points\": [[0,0,0]], \"velocities\": [[1,0,0,0]", ",[1,0,0,0]", "]}"},
    {"queries", BEGIN "\"queries\": [{\"nearest\":\"player\"}", ",{\"nearest\":\"player\"}", "]}"},
    {"queries of many", BEGIN "\"queries\": [{\"nearest\":\"player\"}", ",{\"knearest\":1e12,\"at\":[0,0,0]}", "]}"},
    {"queries with answers", BEGIN "\"queries\": [{\"nearest\":\"player\"}", ",{\"nearest\":\"player\",\"answer\":[]}",
     "]}"},
    {"an answer", BEGIN "\"queries\": [{\"nearest\":\"player\",\"answer\":[0", ",1", "]}]}"},
    {"shapes", BEGIN "\"shapes\": [{\"point\":[0,0,0]}", ",{\"point\":[0,0,0]}", "]}"},
    {"nodes", BEGIN "\"foreign_nodes\": [{\"id\":0," BOX "}", ",{\"id\":@," BOX "}", "]}"},
    {"points of a node", BEGIN "\"foreign_nodes\": [{\"id\":0," BOX ",\"points\":[0", ",1", "]}]}"},
    {"ticks", HEAD "}", "{\"tick\":@}", ""},
    {"edits", HEAD "}{\"tick\":1,\"edits\":[{\"remove\":1}", ",{\"remove\":1}", "]}"},
    {"edits that insert", HEAD "}{\"tick\":1,\"edits\":[{\"remove\":1}",
     ",{\"insert\":{\"id\":@,\"position\":[0,0,0]}}", "]}"},
    {"ticks of an edit", HEAD "}", "{\"tick\":@,\"edits\":[{\"remove\":1}]}", ""},
    {"ticks of a shape", HEAD "}", "{\"tick\":@,\"shapes\":[{\"point\":[0,0,0]}]}", ""},
    {"ticks of nodes", HEAD "}", "{\"tick\":@,\"foreign_nodes\":[]}", ""},
    {"pairs", HEAD "}{\"tick\":1,\"pairs\":[[0,1]", ",[0,1]", "]}"},
    {"empty pairs", HEAD "}{\"tick\":1,\"pairs\":[[0,1]", ",[]", "]}"},
    {"ticks of pairs", HEAD "}", "{\"tick\":@,\"pairs\":[]}", ""},
    {"gaps", HEAD "}", "{\"tick\":@,\"gap\":\"a\"}", ""},
};

static const text_bomb views[] = {
    {"layers", "{\"octreel\":\"recording\",\"layers\":[\"nodes\"", ",\"nodes\"", "]}"},
    {"depths", "{\"octreel\":\"recording\",\"depths\":[0", ",0", "]}"},
    {"objects", "{\"octreel\":\"recording\",\"fit\":[{}", ",{}", "]}"},
    {"members", "{\"octreel\":\"recording\"", ",\"@\":0", "}"},
    {"nested", "{\"fit\":", "[", ""},
};

static void measure(const text_bomb *bomb, text_bomb_reader *read)
{
    const double each = text_bomb_measure(bomb, read);
    print_message("%-24s %6.1f bytes a byte; %s\n", bomb->name, each, error.text);
    assert_true(each < MOST_BYTES_A_BYTE);
}

static void session_takes_at_most_100_bytes_of_memory_per_byte(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof sessions / sizeof sessions[0]; i++)
        measure(&sessions[i], read_session);
}

static void recording_json_takes_at_most_100_bytes_of_memory_per_byte(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++)
        measure(&views[i], read_recording);
}

/* A short text that asks for a huge amount is refused, with the name of the member, before memory is allocated. */
static void numbers_beyond_limits_are_refused(void **state)
{
    static const char *const rows[][2] = {
        {BEGIN "\"points\": {\"sample\": \"uniform\", \"count\": 1e12}}", "100000000"},
        {HEAD ", \"ticks\": 1e12}", "1000000000"},
        {HEAD "}{\"tick\": 1e12}", "1000000000"},
        {HEAD "}{\"tick\": 999999999}", "1000000"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *text = strdup(rows[i][0]);
        heap_peak_begin();
        read_session(text, strlen(text));
        assert_true(heap_peak() < 10000);
        if (!strstr(error.text, rows[i][1]))
            fail_msg("%s", error.text);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(session_takes_at_most_100_bytes_of_memory_per_byte),
        cmocka_unit_test(recording_json_takes_at_most_100_bytes_of_memory_per_byte),
        cmocka_unit_test(numbers_beyond_limits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
