/* session_errors.c - the sentences of the session reader: file, line, place and reason. */
#include "number.h"
#include "text.h"
#include "session_reader.h"

#include <stdarg.h>
#include <string.h>

const char *session_name_end(const char *name)
{
    enum { LONGEST_NAME = 160 };
    size_t length = strlen(name);
    return length > LONGEST_NAME ? name + (length - LONGEST_NAME) : name;
}

bool session_fail_line(session_reader *reader, size_t line, const char *where, const char *reason)
{
    char printable[340];
    snprintf(printable, sizeof printable, "%s%s%s", where, *where ? ": " : "", reason);
    make_printable(printable); /* what is quoted from the file must not reach a terminal as it is */
    snprintf(reader->error->text, sizeof reader->error->text, "%s:%zu: %s", session_name_end(reader->name), line,
             printable);
    return false;
}

size_t session_line(const session_reader *reader, const json_place *at)
{
    const char *found = json_place_find(at, reader->object, reader->limit);
    size_t line = reader->line;
    for (const char *c = reader->object; c < found; c++)
        line += *c == '\n';
    return line;
}

bool session_fail(session_reader *reader, const json_place *at, const char *format, ...)
{
    char where[96], reason[260];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    return session_fail_line(reader, session_line(reader, at), json_place_format(at, where, sizeof where), reason);
}

/* Name a value in a few words. */
static void describe(const json_t *value, char *text, size_t size)
{
    static const char *const types[] = {
        [JSON_OBJECT] = "an object", [JSON_TRUE] = "true", [JSON_FALSE] = "false", [JSON_NULL] = "null"};
    char number[NUMBER_TEXT];
    switch (json_typeof(value)) {
    case JSON_ARRAY:
        snprintf(text, size, "a list of %zu", json_array_size(value));
        break;
    case JSON_STRING:
        snprintf(text, size, "\"%.40s\"", json_string_value(value));
        break;
    case JSON_INTEGER:
    case JSON_REAL:
        number_print(json_number_value(value), number);
        snprintf(text, size, "%s", number);
        break;
    default:
        snprintf(text, size, "%s", types[json_typeof(value)]);
        break;
    }
}

bool session_expected(session_reader *reader, const json_t *value, const json_place *at, const char *what)
{
    char found[64];
    describe(value, found, sizeof found);
    return session_fail(reader, at, "expected %s, found %s", what, found);
}

bool session_fail_parsed(session_reader *reader, const json_error_t *parsed)
{
    static const char *const words[][2] = {
        {"'[' or '{' expected", "'{' expected"},
        {"\\u0000 is not allowed without JSON_ALLOW_NUL", "a text cannot hold \\u0000"},
    };
    char reason[sizeof parsed->text + 32];
    const char *rest = parsed->text, *ours = "";
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strncmp(parsed->text, words[i][0], strlen(words[i][0])) != 0)
            continue;
        ours = words[i][1];
        rest = parsed->text + strlen(words[i][0]);
    }
    snprintf(reason, sizeof reason, "%s%s", ours, rest);
    const size_t line = parsed->line > 1 ? (size_t)parsed->line - 1 : 0;
    return session_fail_line(reader, reader->line + line, "", reason);
}
