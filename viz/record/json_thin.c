/* json_thin.c - see json_thin.h. */
#include "json_thin.h"

#include <stdint.h>
#include <string.h>

/* No number or literal that is worth keeping is longer. */
#define WORD_MAX 400

typedef struct thinner {
    FILE *in, *out;
    size_t kept;
    unsigned depth;
    unsigned muted; /* lists cut off around here: nothing is copied */
} thinner;

static void put(thinner *t, int c)
{
    if (!t->muted)
        putc(c, t->out);
}

static void put_text(thinner *t, const char *text)
{
    if (!t->muted)
        fputs(text, t->out);
}

static int next_visible(thinner *t)
{
    int c;
    do
        c = getc(t->in);
    while (c == ' ' || c == '\t' || c == '\n' || c == '\r');
    return c;
}

static bool is_hexadecimal(int c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

static bool copy_escape(thinner *t)
{
    const int c = getc(t->in);
    if (c == EOF || c == 0 || !strchr("\"\\/bfnrtu", c))
        return false;
    put(t, '\\');
    put(t, c);
    for (int i = 0; c == 'u' && i < 4; i++) {
        const int digit = getc(t->in);
        if (!is_hexadecimal(digit))
            return false;
        put(t, digit);
    }
    return true;
}

/* What begins with 0xe2: U+2028 and U+2029, which end a line of a script, are 0xe2 0x80 0xa8 and 0xa9. */
static void copy_separator(thinner *t)
{
    const int second = getc(t->in);
    if (second != 0x80) {
        put(t, 0xe2);
        ungetc(second, t->in);
        return;
    }
    const int third = getc(t->in);
    if (third == 0xa8 || third == 0xa9) {
        put_text(t, third == 0xa8 ? "\\u2028" : "\\u2029");
        return;
    }
    put(t, 0xe2);
    put(t, 0x80);
    ungetc(third, t->in);
}

/* Behind its first quote. */
static bool copy_string(thinner *t)
{
    put(t, '"');
    for (;;) {
        const int c = getc(t->in);
        if (c == EOF || c < ' ')
            return false;
        if (c == '\\') {
            if (!copy_escape(t))
                return false;
        } else if (c == '<') {
            put_text(t, "\\u003c");
        } else if (c == 0xe2) {
            copy_separator(t);
        } else {
            put(t, c);
        }
        if (c == '"')
            return true;
    }
}

static const char *skip_digits(const char *at)
{
    return at + strspn(at, "0123456789");
}

static bool is_number(const char *text)
{
    const char *at = text + (*text == '-'), *end = skip_digits(at);
    if (end == at || (*at == '0' && end > at + 1))
        return false;
    if (*end == '.') {
        at = end + 1;
        end = skip_digits(at);
        if (end == at)
            return false;
    }
    if (*end == 'e' || *end == 'E') {
        at = end + 1 + (end[1] == '+' || end[1] == '-');
        end = skip_digits(at);
        if (end == at)
            return false;
    }
    return *end == 0;
}

static bool is_literal(const char *text)
{
    return strcmp(text, "true") == 0 || strcmp(text, "false") == 0 || strcmp(text, "null") == 0;
}

static bool belongs_to_word(int c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == 'E' || c == '+' || c == '-' || c == '.';
}

/* A number or a literal, of which `c` is the first character. */
static bool copy_word(thinner *t, int c)
{
    char word[WORD_MAX + 1];
    size_t length = 0;
    for (; belongs_to_word(c) && length < WORD_MAX; c = getc(t->in))
        word[length++] = (char)c;
    word[length] = 0;
    if (c != EOF)
        ungetc(c, t->in);
    put_text(t, word);
    return is_literal(word) || is_number(word);
}

static bool copy_value(thinner *t, int first);

static bool copy_member(thinner *t, int first)
{
    if (first != '"' || !copy_string(t) || next_visible(t) != ':')
        return false;
    put(t, ':');
    return copy_value(t, next_visible(t));
}

/* From the quote of the first to the closing brace. */
static bool copy_members(thinner *t, int first)
{
    for (int c = first; copy_member(t, c); c = next_visible(t)) {
        c = next_visible(t);
        if (c != ',')
            return c == '}';
        put(t, ',');
    }
    return false;
}

/* Behind its brace. */
static bool copy_object(thinner *t)
{
    const int first = next_visible(t);
    put(t, '{');
    if (first != '}' && !copy_members(t, first))
        return false;
    put(t, '}');
    return true;
}

static bool copy_entry(thinner *t, int first, bool cut)
{
    t->muted += cut;
    const bool ok = copy_value(t, first);
    t->muted -= cut;
    return ok;
}

static void put_left_out(thinner *t, uintmax_t count)
{
    if (!t->muted && count > t->kept)
        fprintf(t->out, "%s{\"more\":%ju}", t->kept ? "," : "", count - t->kept);
}

/* From the first character of the first to the closing bracket. What lies beyond those that are kept is read and not
 * copied. */
static bool copy_entries(thinner *t, int first)
{
    uintmax_t count = 0;
    for (int c = first; copy_entry(t, c, count >= t->kept); c = next_visible(t)) {
        count++;
        c = next_visible(t);
        if (c != ',') {
            put_left_out(t, count);
            return c == ']';
        }
        if (count < t->kept)
            put(t, ',');
    }
    return false;
}

/* Behind its bracket. */
static bool copy_array(thinner *t)
{
    const int first = next_visible(t);
    put(t, '[');
    if (first != ']' && !copy_entries(t, first))
        return false;
    put(t, ']');
    return true;
}

static bool copy_value(thinner *t, int first)
{
    if (first == '"')
        return copy_string(t);
    if (first != '{' && first != '[')
        return copy_word(t, first);
    if (t->depth == JSON_THIN_DEPTH)
        return false;
    t->depth++;
    const bool ok = first == '{' ? copy_object(t) : copy_array(t);
    t->depth--;
    return ok;
}

bool json_thin(FILE *in, FILE *out, size_t kept)
{
    thinner t = {.in = in, .out = out, .kept = kept};
    return copy_value(&t, next_visible(&t));
}
