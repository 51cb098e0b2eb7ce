/* SPDX-License-Identifier: MIT */
/* xml_check.c - see xml_check.h. */
#include "xml_check.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"

enum { DEEPEST = 16, NAME = 64 };

/* A text while it is read, and what is looked for in it. */
typedef struct reader {
    const char *at;
    char open[DEEPEST][NAME]; /* elements that have not ended */
    size_t depth;
    const char *element, *attribute; /* attribute may be null */
    size_t count, wanted;
    char *value;
} reader;

static void fail_at(const reader *r, const char *what)
{
    fail_msg("%s before \"%.40s\"", what, r->at);
}

static void read_name(reader *r, char name[NAME])
{
    size_t length = 0;
    while (isalnum((unsigned char)*r->at) || (*r->at && strchr("-_.:", *r->at))) {
        assert_true(length + 1 < NAME);
        name[length++] = *r->at++;
    }
    name[length] = '\0';
    if (length == 0)
        fail_at(r, "a name is missing");
}

/* A byte of text or of an attribute's value; of UTF-8 the two characters that XML does not know are looked for. */
static char read_character(reader *r)
{
    static const char *const named[][2] = {
        {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}, {"&quot;", "\""}, {"&apos;", "'"}};
    if (*r->at == '&') {
        for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
            if (strncmp(r->at, named[i][0], strlen(named[i][0])) == 0) {
                r->at += strlen(named[i][0]);
                return named[i][1][0];
            }
        char *end = NULL;
        const long code = strncmp(r->at, "&#", 2) == 0 ? strtol(r->at + 2, &end, 10) : 0;
        if (code == 0 || end == NULL || *end != ';' || (code < ' ' && !strchr("\t\n\r", (int)code)))
            fail_at(r, "a reference is none");
        r->at = end + 1;
        return (char)code;
    }
    if ((unsigned char)*r->at < ' ' && *r->at != '\n' && *r->at != '\t')
        fail_at(r, "a control character is there");
    if (memcmp(r->at, "\xef\xbf\xbe", 2) == 0 && (unsigned char)r->at[2] >= 0xbe)
        fail_at(r, "a character is there that XML does not know");
    return *r->at++;
}

static void read_attribute(reader *r, const char *element)
{
    char name[NAME], value[4096];
    size_t length = 0;
    read_name(r, name);
    if (strncmp(r->at, "=\"", 2) != 0)
        fail_at(r, "=\" is missing");
    for (r->at += 2; *r->at != '"';) {
        if (*r->at == '<' || *r->at == '\0')
            fail_at(r, "an attribute does not end");
        assert_true(length + 1 < sizeof value);
        value[length++] = read_character(r);
    }
    value[length] = '\0';
    r->at++;
    if (r->attribute && strcmp(element, r->element) == 0 && strcmp(name, r->attribute) == 0 && r->count == r->wanted)
        r->value = strdup(value);
}

/* What begins with <. */
static void read_tag(reader *r)
{
    char name[NAME];
    const bool ends = *++r->at == '/';
    r->at += ends;
    read_name(r, name);
    if (ends) {
        if (r->depth == 0 || strcmp(r->open[r->depth - 1], name) != 0)
            fail_at(r, "another element ends than began");
        r->depth--;
    } else {
        for (; *r->at == ' ' && r->at[1] != '/'; read_attribute(r, name))
            r->at++;
        r->count += strcmp(name, r->element) == 0;
        assert_true(r->depth < DEEPEST);
        strcpy(r->open[r->depth++], name);
        if (*r->at == '/') {
            r->depth--;
            r->at++;
        }
    }
    if (*r->at++ != '>')
        fail_at(r, "> is missing");
}

static void read_all(reader *r)
{
    static const char declaration[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    if (strncmp(r->at, declaration, sizeof declaration - 1) != 0)
        fail_at(r, "the declaration is missing");
    r->at += sizeof declaration - 1;
    do {
        read_tag(r);
        while (*r->at != '<' && *r->at != '\0')
            read_character(r);
    } while (*r->at != '\0' && r->depth > 0);
    if (r->depth > 0 || *r->at != '\0')
        fail_at(r, "there is not one element with all in it");
}

size_t xml_count(const char *text, const char *element)
{
    reader r = {.at = text, .element = element};
    read_all(&r);
    return r.count;
}

char *xml_attribute(const char *text, const char *element, size_t n, const char *attribute)
{
    reader r = {.at = text, .element = element, .attribute = attribute, .wanted = n};
    read_all(&r);
    if (!r.value)
        fail_msg("there is no %s of <%s> %zu", attribute, element, n);
    return r.value;
}
