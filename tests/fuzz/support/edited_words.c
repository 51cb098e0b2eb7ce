/* SPDX-License-Identifier: MIT */
#include "edited_words.h"

#include <stdbool.h>
#include <string.h>

enum { LARGEST = 1 << 16 };

static const char *const numbers[] = {
    "0",          "1",          "-1",   "2",     "3",    "8",    "255",     "256", "65536",
    "2147483648", "4294967295", "1e30", "1e308", "1e39", "-0.0", "1e-320",  "nan", "4294967296",
    "inf",        "0x10",       "1.5",  ".",     "-",    "1e",   "1000000", ";",   "18446744073709551615",
};
enum { NUMBERS = sizeof numbers / sizeof numbers[0] };

typedef struct text {
    uint8_t bytes[LARGEST];
    size_t size, most;
    uint64_t random;
} text;

/* A line with its line end, or a word. */
typedef struct piece {
    size_t begin, size;
} piece;

static size_t choose(text *t, size_t count)
{
    t->random = t->random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (size_t)(t->random >> 33) % count;
}

static bool ends(uint8_t byte, bool line)
{
    return byte == '\n' || (!line && (byte == ' ' || byte == ',' || byte == '\t'));
}

/* Half of the pieces are near the beginning, where headers are. */
static piece choose_piece(text *t, bool line)
{
    const size_t near = t->size < 256 ? t->size : 256;
    size_t begin = choose(t, choose(t, 2) ? near : t->size), end = begin;
    while (begin > 0 && !ends(t->bytes[begin - 1], line))
        begin--;
    while (end < t->size && !ends(t->bytes[end], line))
        end++;
    return (piece){begin, end - begin + (line && end < t->size)};
}

/* The rest of a line after its first word. */
static piece rest_of(const text *t, piece line)
{
    size_t begin = line.begin, end = line.begin + line.size;
    while (begin < end && !ends(t->bytes[begin], false))
        begin++;
    return (piece){begin, end - begin - (end > begin && t->bytes[end - 1] == '\n')};
}

/* Replace `old` by these bytes, if there is room. */
static void replace(text *t, piece old, const void *bytes, size_t size)
{
    const size_t after = old.begin + old.size;
    if (t->size - old.size + size > t->most)
        return;
    memmove(t->bytes + old.begin + size, t->bytes + after, t->size - after);
    memcpy(t->bytes + old.begin, bytes, size);
    t->size += size - old.size;
}

static void swap(text *t, piece a, piece b, const uint8_t *copy)
{
    const piece first = a.begin < b.begin ? a : b, last = a.begin < b.begin ? b : a;
    if (first.begin + first.size > last.begin)
        return;
    replace(t, last, copy + first.begin, first.size);
    replace(t, first, copy + last.begin, last.size);
}

static void put_word(text *t, piece at, const char *const *words, size_t word_count)
{
    const size_t i = choose(t, NUMBERS + word_count);
    const char *word = i < NUMBERS ? numbers[i] : words[i - NUMBERS];
    replace(t, at, word, strlen(word));
}

static void edit(text *t, const char *const *words, size_t word_count)
{
    static uint8_t copy[LARGEST];
    const bool line = choose(t, 2);
    const piece at = choose_piece(t, line), other = choose_piece(t, line);
    memcpy(copy, t->bytes, t->size);
    switch (choose(t, 7)) {
    case 0:
        replace(t, at, "", 0);
        break;
    case 1:
        replace(t, (piece){at.begin, 0}, copy + other.begin, other.size);
        break;
    case 2:
        replace(t, at, copy + other.begin, other.size);
        break;
    case 3:
        swap(t, at, other, copy);
        break;
    case 4:
        replace(t, (piece){at.begin, 0}, line ? "\n" : " ", 1);
        break;
    case 5:
        replace(t, rest_of(t, at), "", 0);
        break;
    default:
        put_word(t, line ? choose_piece(t, false) : at, words, word_count);
    }
}

size_t edited_words(uint8_t *data, size_t size, size_t most, unsigned seed, const char *const *words, size_t word_count)
{
    static text t; /* static, because it is large for a stack */
    t.size = size;
    t.most = most < LARGEST ? most : LARGEST;
    t.random = seed;
    if (size > t.most)
        return 0;
    memcpy(t.bytes, data, size);
    for (size_t edits = choose(&t, 4) + 1; edits > 0 && t.size > 0; edits--)
        edit(&t, words, word_count);
    memcpy(data, t.bytes, t.size);
    return t.size;
}
