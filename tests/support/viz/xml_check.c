/* SPDX-License-Identifier: MIT */
#include "xml_check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

/* What xmllint prints for an XPath expression, without the line end; null where xmllint is missing. The caller frees
 * it. The test fails where the text is not well-formed. */
static char *evaluate(const char *text, const char *expression)
{
    static const char declaration[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    if (strncmp(text, declaration, sizeof declaration - 1) != 0)
        fail_msg("the XML declaration is missing: %.60s", text);
    if (!is_program_installed("xmllint")) {
        puts("XML is not checked: xmllint is missing (Debian: libxml2-utils)");
        return NULL;
    }
    char path[] = "/tmp/octreel_xml_XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    file_write_text(path, text);
    command_result result = run_script("xmllint --nonet --xpath %s %s", shell_quote(expression).text, path);
    remove(path);
    if (result.status != 0)
        fail_msg("xmllint: %s%s", result.err, text);
    char *value = strdup(result.out);
    assert_non_null(value);
    if (*value && value[strlen(value) - 1] == '\n')
        value[strlen(value) - 1] = '\0';
    command_release(&result);
    return value;
}

void assert_xml_count(const char *text, const char *element, size_t count)
{
    char expression[256], expected[32];
    snprintf(expression, sizeof expression, "count(//%s)", element);
    snprintf(expected, sizeof expected, "%zu", count);
    char *value = evaluate(text, expression);
    if (value)
        assert_string_equal(value, expected);
    free(value);
}

static char *read_attribute(const char *text, const char *element, size_t n, const char *attribute)
{
    char expression[256];
    snprintf(expression, sizeof expression, "string((//%s)[%zu]/@%s)", element, n + 1, attribute);
    return evaluate(text, expression);
}

void assert_xml_attribute(const char *text, const char *element, size_t n, const char *attribute, const char *expected)
{
    char *value = read_attribute(text, element, n, attribute);
    if (value)
        assert_string_equal(value, expected);
    free(value);
}

void assert_xml_attribute_contains(const char *text, const char *element, size_t n, const char *attribute,
                                   const char *part)
{
    char *value = read_attribute(text, element, n, attribute);
    if (value && strstr(value, part) == NULL)
        fail_msg("%s of <%s> %zu is \"%s\", without \"%s\"", attribute, element, n, value, part);
    free(value);
}
