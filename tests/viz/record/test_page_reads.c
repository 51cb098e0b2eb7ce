/* SPDX-License-Identifier: MIT */
/* test_page_reads.c - the page reads sessions with the browser's JSON parser, octreel with jansson: both accept the
 * same texts, read the same numbers to the last bit, and report the same line of a text that they refuse. */
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "browser.h"
#include "driven_page.h"
#include "fixture.h"
#include "recordings.h"
#include "session_file.h"

#define HEADER "{\"octreel\": \"session\", \"version\": 2, "

/* Parts of a session after the start of its header: accepted ones first, then refused ones. */
static const char *const texts[] = {
    "\"keys\": \"ww\"}",
    "\"points\": [[1, -0, 0.5e-3], [1E+2, 123456789012345678901, 5e-324], [0.1, 2.2250738585072011e-308, "
    "179769313486231570000]]}",
    "\"points\": [[0.1000000000000000055511151231257827021181583404541015625, 9007199254740993, 1e-400, "
    "9007199254740991]]}",
    "\"keys\": \"w\\u0077\"}\n{\"tick\": 1, \"shapes\": [{\"label\": \"\\u0041\\\"\\\\\\/\", \"at\": [0, "
    "0, "
    "0]}]}\n\n{\"tick\": 2, \"gap\": \"\\u0061[{\"}",
    " \t\n\"player\" :null ,\"points\":[ ]\r\n}",
    "\"keys\": \"w\", \"keys\": \"w\"}",
    "\"__proto__\": 1}",
    "\"points\": [[1, 2, 1e999]]}",
    "\"points\": [[1, 2, -1e999]]}",
    "\"points\": [[1, 2, 9007199254740992, 9007199254740992]]}",
    "\"points\": [[1, 2, 3, -1]]}",
    "\"points\": [[01, 2, 3]]}",
    "\"points\": [[+1, 2, 3]]}",
    "\"points\": [[.5, 2, 3]]}",
    "\"points\": [[1., 2, 3]]}",
    "\"points\": [[0x1, 2, 3]]}",
    "\"points\": [[NaN, 2, 3]]}",
    "\"points\": [[1, 2, 3],]}",
    "\"points\": [[1, 2, 3]\n\n[1, 2, 3]]}",
    "\"points\": [[1, 2",
    "\"keys\": \"w",
    "\"keys\": \"w\\",
    "\"keys\": \"\xc3\xa4\\u00e4\\ud83d\\ude00\"}",
    "\"keys\": \"\\ud83d\"}",
    "\"keys\": \"\\ude00\"}",
    "\"keys\": \"\\u12\"}",
    "\"keys\": \"\\x\"}",
    "\"keys\": \"\\u0000\"}",
    "\"keys\": \"w\tw\"}",
    "\"keys\": tru}",
    "\"keys\": \"w\",}",
    "\"keys\" \"w\"}",
    "keys: \"w\"}",
    "\n\n\n\"point\": 1}",
    "\"keys\": \"w\"} x",
    "\"keys\": \"w\"}\n[]",
    "\"keys\": \"w\"}}",
    "\"keys\": \"w\"}\n{\"tick\": 1}\n{\"tick\": 2, \"edits\": [{\"remove\": 1},\n{\"remove\": \"x\"}]}",
};

enum { TEXTS = sizeof texts / sizeof texts[0], READ = 5, FAULTY = 1500, ALL = TEXTS + 2 + FAULTY };

static const char faultless[] = HEADER
    "\"world\": {\"min\": [-1e2, -1.5, 0], \"max\": [1, 2E3, 3]},\n"
    " \"points\": [[0, 1, 2], [0.25, -1, 2, 7], {\"id\": 9, \"position\": [0, 0, 0.1]}], \"keys\": \"ww\\u0064\",\n"
    " \"player\": null, \"velocities\": [[9, 1, 0, -1e-3]], \"queries\": []}\n"
    "{\"tick\": 1, \"edits\": [{\"remove\": 7}]}";

typedef struct reading {
    void *folder; /* a temp_folder */
    place page;
    json_t *given;
    char *said; /* null if the page cannot play */
} reading;

static void give(reading *r, const char *text, size_t size)
{
    assert_int_equal(json_array_append_new(r->given, json_stringn(text, size)), 0);
}

/* Write damaged sessions: some bytes are replaced, and some texts are truncated. */
static void give_faulty(reading *r)
{
    static const char bytes[] = "{}[],:\"\\ \n0129.-+eEutfn";
    char text[sizeof faultless];
    uint64_t random = 11;
    for (int i = 0; i < FAULTY; i++) {
        size_t size = sizeof faultless - 1;
        memcpy(text, faultless, size);
        for (uint64_t faults = random_below(&random, 3); faults > 0; faults--)
            text[random_below(&random, size)] = bytes[random_below(&random, sizeof bytes - 1)];
        if (random_below(&random, 8) == 0)
            size = (size_t)random_below(&random, size);
        give(r, text, size);
    }
}

static void give_nested(reading *r, size_t depth)
{
    char text[sizeof HEADER + 5000] = HEADER "\"points\": ";
    const size_t begin = strlen(text);
    memset(text + begin, '[', depth);
    memset(text + begin + depth, ']', depth);
    give(r, text, begin + 2 * depth);
}

static int read_by_page(void **state)
{
    reading *r = calloc(1, sizeof *r);
    *state = r;
    if (!r || temp_folder_make(&r->folder) != 0)
        return -1;
    const place film = place_in(r->folder, "film");
    const octree_session session = short_session("w");
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    r->page = place_below(film.path, "index.html");
    r->given = json_array();
    for (size_t i = 0; i < TEXTS; i++) {
        char text[sizeof HEADER + 400];
        give(r, text, (size_t)snprintf(text, sizeof text, "%s%s", HEADER, texts[i]));
    }
    give_nested(r, 100);
    give_nested(r, 2000);
    give_faulty(r);
    const place given = write_given_script(r->folder, r->given);
    r->said =
        run_scripts_in_playing_page(r->folder, r->page.path, (const char *const[]){given.path, "drive_reads.js", NULL});
    return 0;
}

static int forget_page(void **state)
{
    reading *r = *state;
    const int status = nested_folder_remove(&r->folder);
    json_decref(r->given);
    free(r->said);
    free(r);
    return status;
}

static const reading *need_reading(void **state)
{
    const reading *r = *state;
    skip_without_playing_page(r->page.path);
    return r;
}

static void assert_session_is(const octree_session *session, const char *said)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_true(session_write(session, NULL, out));
    assert_int_equal(fclose(out), 0);
    for (char *at = text; *at; at++)
        *at = *at == '\n' ? ' ' : *at;
    assert_string_equal(said, text);
    free(text);
}

/* Returns whether octreel accepts text i; the test fails unless the page agrees. The line of an error may be that of
 * the byte before: parsers differ there. */
static bool assert_read_alike(const reading *r, size_t i)
{
    octreel_error error;
    session_file file;
    char name[32];
    const json_t *text = json_array_get(r->given, i);
    snprintf(name, sizeof name, "text %zu", i);
    char *said = find_reported_value(r->said, name);
    const bool read =
        session_parse("the session", "", json_string_value(text), json_string_length(text), &file, &error);
    static const char refused[] = "refused: the session:", place[] = "the session:";
    if (read != (strncmp(said, refused, strlen(refused)) != 0))
        fail_msg("\"%s\" is %s, and the page says %s", json_string_value(text), read ? "read" : error.text, said);
    if (!read) {
        const long line = strtol(error.text + strlen(place), NULL, 10),
                   other = strtol(said + strlen(refused), NULL, 10);
        if (line != other && line != other + 1 && line + 1 != other)
            fail_msg("\"%s\": %s, and the page says %s", json_string_value(text), error.text, said);
    } else if (strncmp(said, "refused: ", strlen("refused: ")) != 0) {
        assert_session_is(&file.session, said);
    }
    free(said);
    session_release(&file);
    return read;
}

static void page_accepts_and_refuses_the_same_sessions_as_octreel(void **state)
{
    const reading *r = need_reading(state);
    for (size_t i = 0; i < TEXTS; i++)
        if (assert_read_alike(r, i) != (i < READ))
            fail_msg("%s is %s", texts[i], i < READ ? "refused" : "read");
    assert_reported_value(r->said, "errors", "");
}

static void page_and_octreel_agree_on_damaged_sessions(void **state)
{
    const reading *r = need_reading(state);
    size_t read = 0;
    for (size_t i = ALL - FAULTY; i < ALL; i++)
        read += assert_read_alike(r, i);
    assert_true(read > FAULTY / 8 && read < FAULTY * 7 / 8);
}

static void deep_nesting_is_refused_with_a_sentence(void **state)
{
    const reading *r = need_reading(state);
    char name[32];
    assert_false(assert_read_alike(r, TEXTS));
    snprintf(name, sizeof name, "text %d", TEXTS + 1);
    assert_reported_value(r->said, name, "refused: the session:1: lists and objects nest more than 200 deep");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_accepts_and_refuses_the_same_sessions_as_octreel),
        cmocka_unit_test(page_and_octreel_agree_on_damaged_sessions),
        cmocka_unit_test(deep_nesting_is_refused_with_a_sentence),
    };
    return cmocka_run_group_tests(tests, read_by_page, forget_page);
}
