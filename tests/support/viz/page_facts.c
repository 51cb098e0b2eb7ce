/* SPDX-License-Identifier: MIT */
/* page_facts.c - see page_facts.h. */
#include "fixture.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "page_facts.h"

static const char ends[] = "\" id=\"facts\">";

char *page_facts_element(const char *page)
{
    const char *from = strstr(page, ends);
    assert_non_null(from);
    from += strlen(ends);
    char *text = strdup(from);
    assert_non_null(text);
    char *end = strstr(text, "</script>");
    assert_non_null(end);
    *end = '\0';
    return text;
}

/* Decode letters in place; see write_letters(). Returns the number of bytes. */
static size_t decode_letters(char *text)
{
    static const char digits[] =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?,_>()[]{}~%$#";
    const size_t length = strlen(text), padding = (size_t)(text[0] - '0');
    size_t bytes = 0;
    assert_true(length % 5 == 1 && padding < 4);
    for (size_t at = 1; at < length; at += 5) {
        uint32_t word = 0;
        for (size_t i = at; i < at + 5; i++) {
            const char *digit = strchr(digits, text[i]);
            assert_non_null(digit);
            word = word * 85 + (uint32_t)(digit - digits);
        }
        for (int shift = 24; shift >= 0; shift -= 8)
            text[bytes++] = (char)(word >> shift & 0xff);
    }
    return bytes - padding;
}

static char *inflate_bytes(const char *bytes, size_t size)
{
    enum { GZIP = 16, FACTOR = 1100 }; /* deflate makes text at most 1032 times smaller */
    z_stream z = {.next_in = (unsigned char *)bytes, .avail_in = (unsigned)size};
    char *text = malloc(size * FACTOR + 1);
    assert_non_null(text);
    z.next_out = (unsigned char *)text;
    z.avail_out = (unsigned)(size * FACTOR);
    assert_int_equal(inflateInit2(&z, MAX_WBITS + GZIP), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    text[z.total_out] = '\0';
    inflateEnd(&z);
    return text;
}

char *page_facts(const char *page)
{
    char *element = page_facts_element(page);
    if (!strstr(page, "\"application/gzip;z85\" id=\"facts\">"))
        return element;
    char *text = inflate_bytes(element, decode_letters(element));
    free(element);
    return text;
}
