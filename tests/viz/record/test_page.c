/* SPDX-License-Identifier: MIT */
/* test_page.c - index.html of a recording contains the facts of ticks.jsonl, loads no other file, and is written whole
 * or not at all. test_page_shown.c tests what it shows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "frame_file.h"
#include "recordings.h"
#include "page_facts.h"
#include "tick_lines.h"
#include "page.h"
#include "page_html.h"

/* A user without any permissions, for tests that run as root, to whom no permission applies. */
enum { NOBODY = 65534 };

static const char ABOUT[] = "{\"octreel\": \"recording\",\n\"size\": [160, 90], \"every\": 1\n}\n";
static const char TICK[] = "{\"tick\": 0, \"key\": null, \"events\": [], \"tree\": {\"nodes\": 1}}\n";

/* Write the files of a recording by hand. */
static place recording_of(void **state, const char *ticks)
{
    const place folder = place_in(*state, "film");
    assert_int_equal(mkdir(folder.path, 0777), 0);
    file_write_text(place_below(folder.path, "recording.json").path, ABOUT);
    file_write_text(place_below(folder.path, "ticks.jsonl").path, ticks);
    return folder;
}

static void assert_page_written(const char *folder)
{
    octreel_error error = {""};
    if (!page_write(NULL, folder, NULL, NULL, &error))
        fail_msg("%s", error.text);
}

/* The test fails unless writing the page fails with a sentence that contains both parts, and leaves no page and no part
 * of one. */
static void assert_no_page(const char *folder, const char *part, const char *reason)
{
    octreel_error error = {""};
    assert_false(page_write(NULL, folder, NULL, NULL, &error));
    if (strstr(error.text, part) == NULL || strstr(error.text, reason) == NULL)
        fail_msg("\"%s\" does not contain both \"%s\" and \"%s\"", error.text, part, reason);
    assert_false(file_exists(place_below(folder, "index.html").path));
    assert_false(file_exists(place_below(folder, "index.html.part").path));
}

static char *page_of(const char *folder)
{
    return file_read(place_below(folder, "index.html").path, NULL);
}

/* The facts that the page contains; the caller frees them. */
static char *facts_of(const char *folder)
{
    char *page = page_of(folder), *facts = page_facts(page);
    free(page);
    return facts;
}

/* The next line at *at; *at moves past it. */
static char *next_line(char **at)
{
    char *line = *at, *end = strchr(line, '\n');
    assert_non_null(end);
    *end = '\0';
    *at = end + 1;
    return line;
}

/* The ticks of a page's facts, read as the page reads them. */
typedef struct facts_reader {
    char *at;
    json_t *last; /* the last tick that has a line */
    uint64_t tick, repeated;
} facts_reader;

/* A tick without a line of its own: the last one with another number, and another frame or none. */
static json_t *repeat_tick(facts_reader *f)
{
    json_t *tick = json_copy(f->last);
    json_object_del(tick, "frame");
    json_object_del(tick, "scene");
    json_object_set_new(tick, "tick", json_real((double)f->tick));
    if (f->repeated == 0 && *f->at == '"') {
        char name[FRAME_NAME];
        json_object_set_new(tick, "frame", json_string(frame_print_name(f->tick, name)));
        json_object_set_new(tick, "scene", json_stringn(next_line(&f->at) + 1, 16));
        return tick;
    }
    if (f->repeated == 0)
        f->repeated = strtoull(next_line(&f->at), NULL, 10);
    assert_true(f->repeated-- > 0);
    return tick;
}

/* The next tick, which the caller releases. */
static json_t *next_tick(facts_reader *f)
{
    json_t *tick;
    if (f->repeated == 0 && *f->at == '{') {
        json_decref(f->last);
        f->last = json_read(next_line(&f->at));
        tick = json_incref(f->last);
    } else {
        tick = repeat_tick(f);
    }
    f->tick++;
    return tick;
}

static void assert_all_read(facts_reader *f)
{
    assert_string_equal(f->at, "");
    assert_int_equal(f->repeated, 0);
    json_decref(f->last);
}

static void assert_embedded(const char *line, size_t number, void *context)
{
    json_t *written = json_read(line), *embedded = next_tick(context);
    if (!json_equal(written, embedded))
        fail_msg("tick %zu: the page has other facts than %s", number, line);
    json_decref(written);
    json_decref(embedded);
}

static void page_has_the_facts_of_every_tick(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    options.every = 50;
    assert_filmed(&session, &options);
    char *facts = facts_of(folder.path), *at = facts;
    json_t *about = json_read(next_line(&at));
    assert_whole_number(json_array_get(json_member(about, "size"), 0), SMALL_WIDTH);
    assert_whole_number(json_member(about, "every"), 50);
    json_decref(about);
    facts_reader f = {.at = at};
    assert_int_equal(for_each_line(folder.path, assert_embedded, &f), 253);
    assert_all_read(&f);
    free(facts);
}

/* Record a session in which nothing happens, and check the facts of its page. Returns the length of the facts. */
static size_t record_idle_ticks(void **state, const char *name, uint64_t ticks, uint64_t every)
{
    const place folder = place_in(*state, name);
    octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    session.keys = NULL;
    session.ticks = ticks;
    options.every = every;
    assert_filmed(&session, &options);
    char *facts = facts_of(folder.path);
    const size_t length = strlen(facts); /* next_line() changes the text */
    facts_reader f = {.at = facts};
    next_line(&f.at); /* recording.json */
    assert_int_equal(for_each_line(folder.path, assert_embedded, &f), ticks + 1);
    assert_all_read(&f);
    free(facts);
    return length;
}

static void tick_in_which_nothing_happens_takes_no_room(void **state)
{
    const size_t one = record_idle_ticks(state, "1000", 1000, 0), nine = record_idle_ticks(state, "9000", 9000, 0);
    assert_true(nine <= one + strlen("9"));
    const size_t few = record_idle_ticks(state, "20", 20, 2), more = record_idle_ticks(state, "60", 60, 2);
    assert_int_equal(more - few, 20 * strlen("\"0123456789abcdef\"\n1\n"));
}

/* Lines that only look like a repetition are embedded as they are. */
static void other_ticks_are_embedded_as_they_are(void **state)
{
    static const char *const rows[] = {
        "{\"tick\": 0, \"a\": 1}",
        "{\"tick\": 2, \"a\": 1}",
        "{\"a\": 1, \"tick\": 2}",
        "{\"tick\": 3, \"a\": 1, \"frame\": \"frame_000004.png\", \"scene\": \"0123456789abcdef\"}",
        "{\"tick\": 4, \"a\": 1, \"frame\": \"frame_000004.png\", \"scene\": \"0123456789abcde\"}",
        "{\"tick\": 5, \"a\": 1, \"scene\": \"0123456789abcdef\", \"frame\": \"frame_000005.png\"}",
        "{\"tick\": 6, \"a\": 1, \"b\": {\"frame\": \"frame_000006.png\", \"scene\": \"0123456789abcdef\"}}",
        "{\"tick\": 7}",
        "{\"tick\": 8}",
        "{\"tick\": 9, \"a\": -0.0}",
        "{\"tick\": 10, \"a\": 0.0}",
        "{\"tick\": 11, \"a\": 0}",
    };
    enum { ROWS = sizeof rows / sizeof rows[0] };
    char ticks[2048] = "";
    for (int i = 0; i < ROWS; i++)
        strcat(strcat(ticks, rows[i]), "\n");
    const place folder = recording_of(state, ticks);
    assert_page_written(folder.path);
    char *facts = facts_of(folder.path), *at = facts;
    next_line(&at);
    for (int i = 0; i < ROWS; i++) {
        json_t *row = json_loads(rows[i], 0, NULL);
        char *expected = json_dumps(row, JSON_COMPACT);
        assert_string_equal(next_line(&at), expected);
        free(expected);
        json_decref(row);
    }
    assert_string_equal(at, "");
    free(facts);
}

/* From an existing recording the same bytes are written again. */
static void page_can_be_rewritten_later(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = octree_session_default();
    const film_options options = small_film(folder.path);
    assert_filmed(&session, &options);
    char *first = page_of(folder.path);
    file_write_text(place_below(folder.path, "index.html").path, "something else");
    assert_page_written(folder.path);
    char *second = page_of(folder.path);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

/* Remove words that are far longer than those of a text: encoded bytes may spell anything. */
static void blank_letters(char *page)
{
    enum { LONGEST = 10000 };
    for (char *at = page; *at;) {
        const size_t length = strcspn(at, " \"'\n");
        if (length > LONGEST)
            memset(at, ' ', length);
        at += length + (at[length] != '\0');
    }
}

/* The page contains no address and no import, and no file names except in the facts. */
static void page_loads_no_other_file(void **state)
{
    static const char *const foreign[] = {"http:", "https:", "//cdn", "src=\"", "@import", "url(", "import(", "fetch("};
    const place folder = recording_of(state, TICK);
    assert_page_written(folder.path);
    char *page = page_of(folder.path);
    blank_letters(page);
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        if (strstr(page, foreign[i]) != NULL)
            fail_msg("the page has %s", foreign[i]);
    assert_non_null(strstr(page, "default-src 'none'"));
    assert_null(strstr(page, "rel=\"stylesheet\""));
    assert_string_equal(page + strlen(page) - 8, "</html>\n");
    free(page);
}

/* A script that gets into the page, such as one in a label, does not run: its hash is not in the policy. */
static void page_runs_only_scripts_whose_hashes_it_lists(void **state)
{
    const place folder = recording_of(state, TICK);
    assert_page_written(folder.path);
    char *page = page_of(folder.path);
    assert_non_null(strstr(page, "style-src 'sha256-"));
    assert_non_null(strstr(page, "script-src 'wasm-unsafe-eval' 'sha256-"));
    assert_null(strstr(page, "unsafe-inline"));
    free(page);
}

static void text_in_a_tick_cannot_end_the_embedded_facts(void **state)
{
    const place folder = recording_of(state, "{\"tick\": 0, \"key\": \"</script><script>alert(1)</script>\"}\n"
                                             "{\"tick\": 1, \"key\": \"<!--\xe2\x80\xa8\"}\n");
    assert_page_written(folder.path);
    char *facts = facts_of(folder.path), *at = facts;
    next_line(&at);
    json_t *first = json_read(next_line(&at)), *second = json_read(next_line(&at));
    assert_string_equal(json_string_value(json_member(first, "key")), "</script><script>alert(1)</script>");
    assert_string_equal(json_string_value(json_member(second, "key")), "<!--\xe2\x80\xa8");
    assert_string_equal(at, "");
    json_decref(first);
    json_decref(second);
    free(facts);
    char *page = page_of(folder.path), *element = page_facts_element(page);
    assert_null(strchr(element, '<'));
    free(element);
    free(page);
}

static void torn_last_line_is_ignored(void **state)
{
    char ticks[256];
    snprintf(ticks, sizeof ticks, "%s{\"tick\": 1, \"key\": \"w", TICK);
    const place folder = recording_of(state, ticks);
    assert_page_written(folder.path);
    char *facts = facts_of(folder.path), *at = facts;
    next_line(&at);
    json_decref(json_read(next_line(&at)));
    assert_string_equal(at, "");
    free(facts);
}

static void recording_without_ticks_has_a_page(void **state)
{
    const place folder = recording_of(state, "{\"tick\": 0");
    assert_page_written(folder.path);
    char *facts = facts_of(folder.path), *at = facts;
    next_line(&at);
    assert_string_equal(at, "");
    free(facts);
}

/* A tick refused a million points: the page counts them and stays small. */
static void a_million_refusals_are_counted_and_not_embedded(void **state)
{
    enum { COUNT = 1000000 };
    const place folder = recording_of(state, "");
    FILE *ticks = fopen(place_below(folder.path, "ticks.jsonl").path, "w");
    fprintf(ticks, "{\"tick\": 0, \"refusals\": [");
    for (int i = 0; i < COUNT; i++)
        fprintf(ticks, "%s{\"id\": %d, \"position\": [1, 2, 3]}", i > 0 ? ", " : "", i);
    fprintf(ticks, "]}\n%s", TICK);
    assert_int_equal(fclose(ticks), 0);
    assert_page_written(folder.path);
    struct stat status;
    assert_int_equal(stat(place_below(folder.path, "index.html").path, &status), 0);
    assert_true((size_t)status.st_size < page_html_head_size + page_html_tail_size + 10000);
    char *facts = facts_of(folder.path), *at = facts;
    next_line(&at);
    json_t *tick = json_read(next_line(&at));
    const json_t *refusals = json_member(tick, "refusals");
    assert_int_equal(json_array_size(refusals), PAGE_LIST + 1);
    assert_whole_number(json_member(json_array_get(refusals, PAGE_LIST - 1), "id"), PAGE_LIST - 1);
    assert_whole_number(json_member(json_array_get(refusals, PAGE_LIST), "more"), COUNT - PAGE_LIST);
    json_decref(tick);
    free(facts);
}

static void unreadable_recording_gets_no_page(void **state)
{
    static const char *const ticks[][2] = {
        {"{\"tick\": 0}\n{\"tick\": 1\n", "ticks.jsonl:2: "},
        {"nonsense\n", "ticks.jsonl:1: "},
        {"[]\n", "ticks.jsonl:1: "},
        {"{\"tick\": 0} {}\n", "ticks.jsonl:1: "},
        {"{\"tick\": 0}\n\n{\"tick\": 1}\n", "ticks.jsonl:2: "},
        {"{\"tick\": 00}\n", "ticks.jsonl:1: "},
    };
    const place folder = recording_of(state, "");
    const place lines = place_below(folder.path, "ticks.jsonl"), about = place_below(folder.path, "recording.json");
    for (size_t i = 0; i < sizeof ticks / sizeof ticks[0]; i++) {
        file_write_text(lines.path, ticks[i][0]);
        assert_no_page(folder.path, ticks[i][1], "not a JSON object");
    }
    remove(lines.path);
    assert_no_page(folder.path, lines.path, "No such file or directory");
    assert_int_equal(mkdir(lines.path, 0777), 0);
    assert_no_page(folder.path, lines.path, "is not a regular file");
    file_write_text(about.path, "");
    assert_no_page(folder.path, about.path, "not a JSON object");
    remove(about.path);
    assert_no_page(folder.path, about.path, "No such file or directory");
    assert_no_page(place_in(*state, "nowhere").path, "nowhere/index.html", "No such file or directory");
}

static void failed_write_keeps_the_old_page(void **state)
{
    octreel_error error = {""};
    const place folder = recording_of(state, TICK), page = place_below(folder.path, "index.html");
    const place part = place_below(folder.path, "index.html.part");
    file_write_text(page.path, "mine");
    limit_file_size(1000);
    assert_false(page_write(NULL, folder.path, NULL, NULL, &error));
    limit_file_size(SIZE_MAX);
    assert_non_null(strstr(error.text, page.path));
    assert_non_null(strstr(error.text, "File too large"));
    assert_false(file_exists(part.path));
    char *text = page_of(folder.path);
    assert_string_equal(text, "mine");
    free(text);
}

static void unwritable_folder_is_named(void **state)
{
    const temp_folder *own = *state;
    const place folder = recording_of(state, TICK);
    assert_int_equal(chmod(folder.path, 0555), 0);
    assert_int_equal(chmod(own->name, 0755), 0);
    const bool root = geteuid() == 0;
    if (root && seteuid(NOBODY) != 0)
        skip(); /* root can write everything, and this container has no other user */
    octreel_error error = {""};
    const bool written = page_write(NULL, folder.path, NULL, NULL, &error);
    if (root)
        assert_int_equal(seteuid(0), 0);
    assert_int_equal(chmod(folder.path, 0755), 0);
    assert_false(written);
    assert_non_null(strstr(error.text, place_below(folder.path, "index.html").path));
    assert_non_null(strstr(error.text, "Permission denied"));
}

/* The page is written last: the recording is whole, and only the page is missing. */
static void record_reports_an_unwritable_page(void **state)
{
    const place folder = place_in(*state, "film"), part = place_below(folder.path, "index.html.part");
    assert_int_equal(mkdir(folder.path, 0777), 0);
    assert_int_equal(mkdir(part.path, 0777), 0);
    command_result result = run_octreel(NULL, "record --keys wd --size 160x90 -o %s", folder.path);
    assert_non_null(strstr(result.err, place_below(folder.path, "index.html").path));
    assert_trouble(&result, "Is a directory");
    assert_int_equal(rmdir(part.path), 0);
    assert_nothing_half_written(folder.path);
    assert_true(file_exists(place_below(folder.path, "frame_000002.png").path));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(page_has_the_facts_of_every_tick),
        IN_FOLDER(tick_in_which_nothing_happens_takes_no_room),
        IN_FOLDER(other_ticks_are_embedded_as_they_are),
        IN_FOLDER(page_can_be_rewritten_later),
        IN_FOLDER(page_loads_no_other_file),
        IN_FOLDER(page_runs_only_scripts_whose_hashes_it_lists),
        IN_FOLDER(text_in_a_tick_cannot_end_the_embedded_facts),
        IN_FOLDER(torn_last_line_is_ignored),
        IN_FOLDER(recording_without_ticks_has_a_page),
        IN_FOLDER(a_million_refusals_are_counted_and_not_embedded),
        IN_FOLDER(unreadable_recording_gets_no_page),
        IN_FOLDER(failed_write_keeps_the_old_page),
        IN_FOLDER(unwritable_folder_is_named),
        IN_FOLDER(record_reports_an_unwritable_page),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
