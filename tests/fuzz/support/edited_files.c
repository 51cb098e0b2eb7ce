/* SPDX-License-Identifier: MIT */
#undef _POSIX_C_SOURCE
#define _GNU_SOURCE /* for nftw() */
#include "edited_files.h"

#include <ctype.h>
#include <dirent.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static void check(bool done)
{
    if (!done)
        abort();
}

/* ---- Folders ------------------------------------------------------------------------------------------------ */

static const char *path_of(const char *folder, const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void read_bytes(edited_file *file, const char *path)
{
    FILE *in = fopen(path, "rb");
    check(in && (file->bytes = malloc(EDITED_LARGEST)));
    file->size = fread(file->bytes, 1, EDITED_LARGEST, in);
    check(file->size < EDITED_LARGEST);
    fclose(in);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const edited_file *)a)->name, ((const edited_file *)b)->name);
}

void edited_files_read(edited_files *files, const char *folder)
{
    DIR *entries = opendir(folder);
    check(entries);
    *files = (edited_files){.count = 0};
    for (struct dirent *entry; (entry = readdir(entries));) {
        edited_file *file = &files->files[files->count];
        if (*entry->d_name == '.')
            continue;
        check(files->count++ < EDITED_MOST && strlen(entry->d_name) < EDITED_NAME);
        strcpy(file->name, entry->d_name);
        read_bytes(file, path_of(folder, entry->d_name));
    }
    closedir(entries);
    qsort(files->files, files->count, sizeof files->files[0], by_name);
}

void edited_files_copy(edited_files *files, const edited_files *from)
{
    *files = *from;
    for (size_t i = 0; i < files->count; i++) {
        check((files->files[i].bytes = malloc(EDITED_LARGEST)));
        memcpy(files->files[i].bytes, from->files[i].bytes, from->files[i].size);
    }
}

void edited_files_release(edited_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->files[i].bytes);
    files->count = 0;
}

const edited_file *edited_files_find(const edited_files *files, const char *name)
{
    for (size_t i = 0; i < files->count; i++)
        if (strcmp(files->files[i].name, name) == 0)
            return &files->files[i];
    return NULL;
}

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *at)
{
    (void)status, (void)kind, (void)at;
    return remove(path);
}

void remove_folder(const char *folder)
{
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

static void write_file(const edited_files *files, const edited_file *file, const char *path)
{
    FILE *out;
    switch (file->kind) {
    case EDITED_FILE:
        check((out = fopen(path, "wb")) && fwrite(file->bytes, 1, file->size, out) == file->size && fclose(out) == 0);
        break;
    case EDITED_FOLDER:
        mkdir(path, 0777);
        break;
    case EDITED_LINK:
        check(symlink(files->files[file->other % files->count].name, path) == 0);
        break;
    case EDITED_PIPE:
        check(mkfifo(path, 0666) == 0);
        break;
    case EDITED_NONE:
        break;
    }
}

void edited_files_write(const edited_files *files, const char *folder)
{
    remove_folder(folder);
    check(mkdir(folder, 0777) == 0);
    for (size_t i = 0; i < files->count; i++) {
        const char *path = path_of(folder, files->files[i].name);
        struct stat status;
        if (lstat(path, &status) != 0) /* otherwise two files have the same name now */
            write_file(files, &files->files[i], path);
    }
}

/* ---- Values and lines --------------------------------------------------------------------------------------- */

typedef struct span {
    size_t at, end;
} span;

static bool is_word(uint8_t c)
{
    return isalnum(c) || c == '-' || c == '+' || c == '.' || c == '_' || c == '#';
}

/* The next token from `at` on: a text, a word or a number, or a character; empty at the end. */
static span next_token(const edited_file *f, size_t at)
{
    while (at < f->size && isspace(f->bytes[at]))
        at++;
    span s = {at, at};
    if (at == f->size)
        return s;
    const uint8_t first = f->bytes[s.end++];
    if (first == '"') {
        while (s.end < f->size && f->bytes[s.end] != '"')
            s.end += f->bytes[s.end] == '\\' && s.end + 1 < f->size ? 2 : 1;
        s.end += s.end < f->size;
    } else {
        while (is_word(first) && s.end < f->size && is_word(f->bytes[s.end]))
            s.end++;
    }
    return s;
}

static bool is_closer(uint8_t c)
{
    return c == '}' || c == ']';
}

/* The token of a number; or a whole list or object, if one begins here. */
static span value_at(const edited_file *f, size_t number)
{
    size_t count = 0, depth = 0;
    for (span s = next_token(f, 0); s.at < s.end; s = next_token(f, s.end))
        count++;
    span s = next_token(f, 0);
    for (number = count ? number % count : 0; number > 0; number--)
        s = next_token(f, s.end);
    for (span t = s; t.at < t.end; t = next_token(f, t.end)) {
        depth += f->bytes[t.at] == '{' || f->bytes[t.at] == '[';
        depth -= depth && is_closer(f->bytes[t.at]);
        if (depth == 0)
            return (span){s.at, t.end};
    }
    return s;
}

static span line_at(const edited_file *f, size_t number)
{
    size_t count = 1;
    for (size_t i = 0; i < f->size; i++)
        count += f->bytes[i] == '\n';
    span s = {0, 0};
    for (number %= count;; number--, s.at = s.end) {
        while (s.end < f->size && f->bytes[s.end++] != '\n')
            ;
        if (number == 0)
            return s;
    }
}

static void replace(edited_file *f, span s, const void *bytes, size_t size)
{
    const size_t rest = f->size - s.end;
    if (s.at + size + rest > EDITED_LARGEST)
        return;
    memmove(f->bytes + s.at + size, f->bytes + s.end, rest);
    if (size > 0)
        memcpy(f->bytes + s.at, bytes, size);
    f->size = s.at + size + rest;
}

/* Replace a span by bytes of the same file or of another one. */
static void replace_by(edited_file *f, span s, const edited_file *from, span t, const char *before)
{
    static uint8_t bytes[EDITED_LARGEST + 1];
    const size_t lead = strlen(before), size = t.end - t.at;
    if (lead + size > sizeof bytes)
        return;
    memcpy(bytes, before, lead);
    if (size > 0)
        memcpy(bytes + lead, from->bytes + t.at, size);
    replace(f, s, bytes, lead + size);
}

/* A value with the comma after or before it, and with its name if it has one. */
static span whole_member(const edited_file *f, span s)
{
    const span next = next_token(f, s.end);
    if (next.at < next.end && f->bytes[next.at] == ':')
        s.end = next_token(f, next.end).end;
    const span comma = next_token(f, s.end);
    if (comma.at < comma.end && f->bytes[comma.at] == ',')
        s.end = comma.end;
    return s;
}

/* ---- Edits -------------------------------------------------------------------------------------------------- */

static const char *const values[] = {"0",
                                     "1",
                                     "-1",
                                     "2",
                                     "3",
                                     "7",
                                     "64",
                                     "-0.0",
                                     "0.5",
                                     "1e12",
                                     "1e308",
                                     "-1e308",
                                     "1.7976931348623157e308",
                                     "5e-324",
                                     "1e-310",
                                     "1e999",
                                     "4294967295",
                                     "4294967296",
                                     "2147483648",
                                     "9007199254740991",
                                     "9007199254740992",
                                     "18446744073709551615",
                                     "1000000",
                                     "true",
                                     "false",
                                     "null",
                                     "[]",
                                     "{}",
                                     "\"\"",
                                     "\"player\"",
                                     "\"own\"",
                                     "\"both\"",
                                     "\"frame_000000.png\"",
                                     "\"frame_999999999.png\"",
                                     "\"0000000000000000\"",
                                     "\"ffffffffffffffff\"",
                                     "\"\\u0000\"",
                                     "\"\\u202e\\ud83d\\ude00\"",
                                     "\"\xff\"",
                                     "\"</script>\"",
                                     "\"wwwwddddnq\"",
                                     "[0, 0, 0]",
                                     "[1e308, -1e308, 5e-324]",
                                     "[[0, 0, 0]]",
                                     "{\"min\": [0, 0, 0], \"max\": [0, 0, 0]}",
                                     "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
                                     "\"coincident\"",
                                     "\"float\"",
                                     "3",
                                     "-9007199254740991",
                                     "{\"x\": 0}",
                                     "[0, 3]",
                                     "\"edl\"",
                                     "\"beside\"",
                                     "\"only\"",
                                     "\"orbit\"",
                                     "\"follow\"",
                                     "\"class\"",
                                     "\"runs\""};

typedef struct edit {
    uint8_t what, file;
    uint16_t a, b;
    uint8_t size;
    const uint8_t *text;
} edit;

enum {
    PUT_VALUE,
    PUT_TEXT,
    COPY_VALUE,
    INSERT_VALUE,
    REMOVE_VALUE,
    REMOVE_LINE,
    REPEAT_LINE,
    COPY_LINE,
    CUT,
    SET_BYTE,
    PUT_BYTES,
    PUT_FILE,
    COPY_FILE,
    RENAME,
    NAME_FRAME,
    BECOME,
    EDITS
};

static void apply_to_values(edited_file *f, const edited_file *other, const edit *e)
{
    const char *value = values[e->b % (sizeof values / sizeof values[0])];
    const span s = value_at(f, e->a);
    switch (e->what % EDITS) {
    case PUT_VALUE:
        replace(f, s, value, strlen(value));
        break;
    case PUT_TEXT:
        replace(f, s, e->text, e->size);
        break;
    case COPY_VALUE:
        replace_by(f, s, other, value_at(other, e->b), "");
        break;
    case INSERT_VALUE:
        replace_by(f, (span){s.end, s.end}, other, whole_member(other, value_at(other, e->b)), ", ");
        break;
    default:
        replace(f, whole_member(f, s), NULL, 0);
        break;
    }
}

static void apply_to_lines(edited_file *f, const edited_file *other, const edit *e)
{
    const span s = line_at(f, e->a);
    switch (e->what % EDITS) {
    case REMOVE_LINE:
        replace(f, s, NULL, 0);
        break;
    case REPEAT_LINE:
        for (int times = e->b % 64; times >= 0; times--)
            replace_by(f, (span){s.end, s.end}, f, s, "");
        break;
    default:
        replace_by(f, s, other, line_at(other, e->b), "");
        break;
    }
}

static void apply_to_bytes(edited_file *f, const edit *e)
{
    const size_t at = f->size ? (e->a | (size_t)(e->what / EDITS & 1) << 16) % f->size : 0;
    switch (e->what % EDITS) {
    case CUT:
        f->size = at;
        break;
    case SET_BYTE:
        if (f->size)
            f->bytes[at] = (uint8_t)e->b;
        break;
    default:
        replace(f, (span){at, at + e->b % 16 < f->size ? at + e->b % 16 : f->size}, e->text, e->size);
        break;
    }
    f->repaired = e->b & 256;
}

/* Rename a file to a name in the same folder. */
static void rename_to(edited_file *f, const uint8_t *text, size_t size)
{
    size = size < EDITED_NAME - 1 ? size : EDITED_NAME - 1;
    if (size == 0 || text[0] == '.' || memchr(text, '/', size) || memchr(text, 0, size))
        return;
    memcpy(f->name, text, size);
    f->name[size] = 0;
}

static void apply_to_files(edited_file *f, const edited_file *other, const edit *e)
{
    switch (e->what % EDITS) {
    case PUT_FILE:
        replace(f, (span){0, f->size}, e->text, e->size);
        break;
    case COPY_FILE:
        replace_by(f, (span){0, f->size}, other, (span){0, other->size}, "");
        break;
    case RENAME:
        rename_to(f, e->text, e->size);
        break;
    case NAME_FRAME:
        snprintf(f->name, sizeof f->name, "frame_%06u.png", e->a);
        break;
    default:
        f->kind = (edited_kind)(e->a % (EDITED_PIPE + 1));
        f->other = e->b;
        break;
    }
}

static void apply(edited_files *files, const edit *e)
{
    edited_file *f = &files->files[e->file % files->count];
    const edited_file *other = &files->files[(e->file / files->count + e->size) % files->count];
    const int what = e->what % EDITS;
    if (what <= REMOVE_VALUE)
        apply_to_values(f, other, e);
    else if (what <= COPY_LINE)
        apply_to_lines(f, other, e);
    else if (what <= PUT_BYTES)
        apply_to_bytes(f, e);
    else
        apply_to_files(f, other, e);
}

static void repair_checksums(edited_file *f)
{
    for (size_t at = 8; at + 12 <= f->size;) {
        uint8_t *chunk = f->bytes + at;
        const uint32_t size = (uint32_t)chunk[0] << 24 | (uint32_t)chunk[1] << 16 | (uint32_t)chunk[2] << 8 | chunk[3];
        if (size > f->size - at - 12)
            return;
        const uint32_t sum = (uint32_t)crc32(0, chunk + 4, size + 4);
        for (int i = 0; i < 4; i++)
            chunk[8 + size + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
        at += 12 + (size_t)size;
    }
}

void edited_files_apply(edited_files *files, const uint8_t *data, size_t size)
{
    while (size >= 7) {
        edit e = {data[0], data[1], (uint16_t)(data[2] | data[3] << 8), (uint16_t)(data[4] | data[5] << 8),
                  data[6], data + 7};
        data += 7, size -= 7;
        e.size = e.size < size ? e.size : (uint8_t)size;
        apply(files, &e);
        const int what = e.what % EDITS;
        const bool has_text = what == PUT_TEXT || what == PUT_BYTES || what == PUT_FILE || what == RENAME;
        data += has_text ? e.size : 0, size -= has_text ? e.size : 0;
    }
    for (size_t i = 0; i < files->count; i++)
        if (files->files[i].repaired)
            repair_checksums(&files->files[i]);
}
