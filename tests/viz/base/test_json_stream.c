/* SPDX-License-Identifier: MIT */
/* test_json_stream.c - objects are taken out of a text as soon as they are whole, and not sooner. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fixture.h"
#include "json_stream.h"

/* A pipe, with the stream at its end. */
typedef struct piped {
    int write;
    json_stream stream;
    json_reader reader;
    octreel_error error;
    char compact[256]; /* of the object that was read last */
} piped;

static bool print_compact(json_reader *r, json_t *object)
{
    piped *p = r->context;
    char *text = json_dumps(object, JSON_COMPACT);
    snprintf(p->compact, sizeof p->compact, "%s", text);
    free(text);
    return true;
}

static void open_pipe(piped *p)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    *p = (piped){.write = ends[1], .stream = {.file = ends[0]}};
    p->reader = (json_reader){.name = "pipe", .line = 1, .context = p, .error = &p->error};
}

static void put(const piped *p, const char *text)
{
    assert_int_equal(write(p->write, text, strlen(text)), (ssize_t)strlen(text));
}

static void end_text(piped *p)
{
    close(p->write);
    p->write = -1;
}

static void close_pipe(piped *p)
{
    if (p->write >= 0)
        end_text(p);
    close(p->stream.file);
    json_stream_release(&p->stream);
}

/* More would be waited for without end: the pipe is still open. */
static void assert_next(piped *p, const char *object, size_t line)
{
    assert_int_equal(json_stream_read_object(&p->stream, &p->reader), JSON_STREAM_OBJECT);
    assert_int_equal(p->reader.line, line);
    assert_true(json_read_object(&p->reader, false, print_compact));
    assert_string_equal(p->compact, object);
}

static void an_object_comes_with_its_last_character(void **state)
{
    static const char *const objects[] = {"{}", "{\"a\":[{\"b\":\"}]{[\"},[]]}", "{\"\\\"}\\\\\":\"{\\\"\"}"};
    piped p;
    (void)state;
    open_pipe(&p);
    for (size_t i = 0; i < 3; i++) {
        put(&p, objects[i]);
        assert_next(&p, objects[i], 1);
    }
    put(&p, "\n {\n\"a\"\n: [1 ,\t2 ] }\n\n{ } {");
    assert_next(&p, "{\"a\":[1.0,2.0]}", 2);
    assert_next(&p, "{}", 6);
    put(&p, "}");
    assert_next(&p, "{}", 6);
    put(&p, " \n");
    end_text(&p);
    assert_int_equal(json_stream_read_object(&p.stream, &p.reader), JSON_STREAM_END);
    close_pipe(&p);
}

static void a_byte_order_mark_is_passed_over(void **state)
{
    piped p;
    (void)state;
    open_pipe(&p);
    put(&p, "\xef\xbb\xbf{}");
    assert_next(&p, "{}", 1);
    close_pipe(&p);
}

/* So that what is wrong is told while the text is still being written. */
static void what_can_be_no_object_is_handed_over_at_once(void **state)
{
    static const char *const texts[] = {"}",
                                        "{\"a\": [}",
                                        "{\"a\": 1\n{",
                                        "{\"a\": []\n{",
                                        "{\"a\": {}, {",
                                        "{\"a\": \"\n",
                                        "{\"a\": \1",
                                        "hello\n",
                                        "{\"a\": {}\n[",
                                        "{\"a\": \"b\"{",
                                        "{{",
                                        "{["};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        piped p;
        (void)state;
        open_pipe(&p);
        put(&p, "{}\n");
        assert_next(&p, "{}", 1);
        put(&p, texts[i]);
        if (strchr(texts[i], 1))
            end_text(&p); /* only a parser knows that this begins nothing */
        const json_stream_state found = json_stream_read_object(&p.stream, &p.reader);
        if (found == JSON_STREAM_OBJECT)
            assert_false(json_read_object(&p.reader, false, print_compact));
        else
            assert_int_equal(found, JSON_STREAM_BROKEN);
        assert_non_null(
            strstr(p.error.text, strstr(texts[i], "\n{") || strstr(texts[i], "\n[") ? "pipe:3: " : "pipe:2: "));
        close_pipe(&p);
    }
}

static void nothing_is_deeper_than_the_deepest(void **state)
{
    piped p;
    (void)state;
    open_pipe(&p);
    for (int i = 0; i <= JSON_DEEPEST; i++)
        put(&p, "[");
    assert_int_equal(json_stream_read_object(&p.stream, &p.reader), JSON_STREAM_OBJECT);
    assert_false(json_read_object(&p.reader, false, print_compact));
    close_pipe(&p);
}

static void a_text_that_stops_within_an_object_is_broken(void **state)
{
    piped p;
    (void)state;
    open_pipe(&p);
    put(&p, "{}\n\n{\"a\":\n");
    assert_next(&p, "{}", 1);
    end_text(&p);
    assert_int_equal(json_stream_read_object(&p.stream, &p.reader), JSON_STREAM_BROKEN);
    assert_string_equal(p.error.text, "pipe:3: the text ends inside the object that begins in this line");
    close_pipe(&p);
}

static bool count_down(void *context)
{
    int *left = context;
    return (*left)-- > 0;
}

static void a_wait_can_be_stopped(void **state)
{
    int left = 1;
    piped p;
    (void)state;
    open_pipe(&p);
    p.stream.keep_going = count_down;
    p.stream.context = &left;
    put(&p, "{\"a\":");
    assert_int_equal(json_stream_read_object(&p.stream, &p.reader), JSON_STREAM_STOPPED);
    close_pipe(&p);
}

/* Who writes faster than is read waits for it: what is in memory does not grow with the text. */
static void no_more_is_read_than_a_block(void **state)
{
    enum { MANY = 200000 };
    size_t written = 0, largest = 0;
    piped p;
    (void)state;
    open_pipe(&p);
    assert_int_equal(fcntl(p.write, F_SETFL, O_NONBLOCK), 0);
    for (int i = 0; i < MANY; i++) {
        while (write(p.write, "{}\n", 3) == 3)
            written++;
        assert_next(&p, "{}", (size_t)i + 1);
        largest = p.stream.size > largest ? p.stream.size : largest;
    }
    assert_true(written > MANY / 2 && largest <= 2 << 16);
    close_pipe(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_object_comes_with_its_last_character),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(what_can_be_no_object_is_handed_over_at_once),
        cmocka_unit_test(nothing_is_deeper_than_the_deepest),
        cmocka_unit_test(a_text_that_stops_within_an_object_is_broken),
        cmocka_unit_test(a_wait_can_be_stopped),
        cmocka_unit_test(no_more_is_read_than_a_block),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
