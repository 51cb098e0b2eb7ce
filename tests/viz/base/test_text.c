/* SPDX-License-Identifier: MIT */
/* test_text.c - foreign text made fit to be shown: all characters and all sequences of bytes that are none, streams
 * into memory, lists that are cut, and base64. */
#include "fixture.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* The bytes of a code point, by the definition of UTF-8. */
static size_t encode(uint32_t code, unsigned char to[8])
{
    memset(to, 0, 8);
    if (code < 0x800) {
        to[0] = (unsigned char)(0xc0 | code >> 6);
        to[1] = (unsigned char)(0x80 | (code & 0x3f));
        return 2;
    }
    if (code < 0x10000) {
        to[0] = (unsigned char)(0xe0 | code >> 12);
        to[1] = (unsigned char)(0x80 | (code >> 6 & 0x3f));
        to[2] = (unsigned char)(0x80 | (code & 0x3f));
        return 3;
    }
    to[0] = (unsigned char)(0xf0 | code >> 18);
    to[1] = (unsigned char)(0x80 | (code >> 12 & 0x3f));
    to[2] = (unsigned char)(0x80 | (code >> 6 & 0x3f));
    to[3] = (unsigned char)(0x80 | (code & 0x3f));
    return 4;
}

/* Control characters, marks of direction, ends of lines, and U+FFFE and U+FFFF. */
static bool is_one_of_the_unfit(uint32_t code)
{
    static const uint32_t ranges[][2] = {{0x80, 0x9f},     {0x61c, 0x61c},   {0x200e, 0x200f},
                                         {0x2028, 0x202e}, {0x2066, 0x2069}, {0xfffe, 0xffff}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (code >= ranges[i][0] && code <= ranges[i][1])
            return true;
    return false;
}

static void every_character_is_known_by_its_bytes(void **state)
{
    unsigned char bytes[8];
    (void)state;
    for (uint32_t code = 0x80; code < 0x120000; code++) {
        const bool is_none = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
        const size_t length = encode(code, bytes);
        assert_int_equal(utf8_sequence_length(bytes), is_none ? 0 : length);
        if (!is_none)
            assert_int_equal(utf8_is_unprintable(bytes), is_one_of_the_unfit(code));
    }
}

/* Longer than needed, cut short, or begun in the middle. */
static void what_is_no_utf8_is_no_character(void **state)
{
    static const char *const texts[] = {"\x80",         "\xbf",         "\xc0\x80",     "\xc1\xbf",
                                        "\xe0\x80\x80", "\xe0\x9f\xbf", "\xe2\x80",     "\xf0\x8f\xbf\xbf",
                                        "\xf0\x90",     "\xf0\x90\x80", "\xc2",         "\xc2 ",
                                        "\xe2\x80 ",    "\xff",         "\xe2\x80\xc0", "\xf5\x80\x80\x80"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_int_equal(utf8_sequence_length((const unsigned char *)texts[i]), 0);
}

static void assert_escaped(escape *how, const char *text, const char *expected)
{
    text_stream to;
    char *written;
    assert_true(text_stream_begin(&to));
    write_escaped(to.stream, text, how);
    assert_true(text_stream_end(&to, &written));
    assert_string_equal(written ? written : "", expected);
    free(written);
}

static void each_language_is_escaped_by_its_own_rules(void **state)
{
    (void)state;
    assert_escaped(escape_nothing, "a<b\n\x1b[0m\x7f\xff\xe2\x80\xaez",
                   "a<b" UTF8_REPLACEMENT UTF8_REPLACEMENT "[0m" UTF8_REPLACEMENT UTF8_REPLACEMENT UTF8_REPLACEMENT
                   "z");
    assert_escaped(escape_xml_character, "<a b=\"'&\n\">", "&#60;a b=&#34;&#39;&#38;&#10;&#34;&#62;");
    assert_escaped(escape_xml_text, "1 < 2\n\t", "1 &#60; 2\n&#9;");
    assert_escaped(escape_markdown_character, "a_b _c_ \xc3\xa4_\xc3\xa4 1_2 3_ _4\n*",
                   "a_b &#95;c&#95; \xc3\xa4_\xc3\xa4 1_2 "
                   "3&#95; &#95;4 &#42;");
    assert_escaped(escape_xml_character, "", "");
}

static void bytes_that_cannot_be_printed_are_question_marks(void **state)
{
    char text[] = " a~\x7f\x1f\xc3\xa4\xe7\x82\xb9\xc3"; /* two bytes, two characters and half of one */
    (void)state;
    assert_string_equal(make_printable(text), " a~?????");
}

static void a_list_that_is_cut_says_by_how_much(void **state)
{
    text_stream s;
    char *text;
    (void)state;
    assert_true(text_stream_begin(&s));
    print_remaining_count(s.stream, 7, 7, "--all shows them");
    print_remaining_count(s.stream, 9, 7, "--all shows them");
    print_remaining_count(s.stream, 8, 7, "");
    assert_true(text_stream_end(&s, &text));
    assert_string_equal(text, "  ... and 2 more; --all shows them\n  ... and 1 more\n");
    free(text);
}

/* The test vectors of RFC 4648. */
static void data_are_base64(void **state)
{
    static const char *const texts[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    (void)state;
    for (size_t length = 0; length < sizeof texts / sizeof *texts; length++) {
        char *text = NULL;
        size_t size;
        FILE *in = tmpfile(), *out = open_memstream(&text, &size);
        assert_true(in && out);
        assert_int_equal(fwrite("foobar", 1, length, in), length);
        rewind(in);
        base64_encode(in, out);
        assert_int_equal(fclose(out), 0);
        assert_string_equal(text, texts[length]);
        fclose(in);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_character_is_known_by_its_bytes),
        cmocka_unit_test(what_is_no_utf8_is_no_character),
        cmocka_unit_test(each_language_is_escaped_by_its_own_rules),
        cmocka_unit_test(bytes_that_cannot_be_printed_are_question_marks),
        cmocka_unit_test(a_list_that_is_cut_says_by_how_much),
        cmocka_unit_test(data_are_base64),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
