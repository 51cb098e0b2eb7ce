/* SPDX-License-Identifier: MIT */
/* file_kind.c - detects the kind of a file by its first bytes or by its first JSON member, and the kind of a folder
 * by the files in it. */
#include "file_kind.h"
#include "cloud.h"
#include "folder.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define FILE_KIND_ROW(kind, words, command, use) {words, command, use},
const file_kind_row file_kind_rows[] = {FILE_KIND_MAP(FILE_KIND_ROW)};

#define MAGIC(text) text, sizeof text - 1

static const struct {
    const char *bytes;
    size_t size;
    file_kind kind;
} beginnings[] = {
    {MAGIC("\x89PNG"), KIND_PNG},
    {MAGIC(DIGEST_FILE_BEGINNING), KIND_BASELINE},
    {MAGIC("\xff\xd8\xff"), KIND_OTHER_PICTURE},
    {MAGIC("GIF8"), KIND_OTHER_PICTURE},
    {MAGIC("II*\0"), KIND_OTHER_PICTURE},
    {MAGIC("\x1f\x8b"), KIND_PACKED},
    {MAGIC("PK\3\4"), KIND_PACKED},
    {MAGIC("\x28\xb5\x2f\xfd"), KIND_PACKED},
    {MAGIC("\xfd"
           "7zXZ"),
     KIND_PACKED},
};

/* Skips white space and then `word`. Returns the position after the word. Returns null if the text continues with
 * something else. */
static const char *skip_word(const char *at, const char *word)
{
    at += strspn(at, " \t\r\n");
    return strncmp(at, word, strlen(word)) == 0 ? at + strlen(word) : NULL;
}

/* Finds the kind of a JSON text that Octreel wrote: its first object has the member "octreel" or begins with "tick". */
static file_kind find_json_kind(const char *text)
{
    const char *at = skip_word(text, "{"), *name;
    if (!at)
        return KIND_UNKNOWN;
    if (skip_word(at, "\"tick\""))
        return KIND_PART;
    name = strstr(at, "\"octreel\"");
    at = name ? skip_word(name + strlen("\"octreel\""), ":") : NULL;
    return !at                              ? KIND_UNKNOWN
           : skip_word(at, "\"session\"")   ? KIND_SESSION
           : skip_word(at, "\"recording\"") ? KIND_PART
                                            : KIND_UNKNOWN;
}

static file_kind find_content_kind(const char *bytes, size_t size)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; i++)
        if (size >= beginnings[i].size && memcmp(bytes, beginnings[i].bytes, beginnings[i].size) == 0)
            return beginnings[i].kind;
    if (strstr(bytes, "<title>Octreel recording</title>"))
        return KIND_PAGE;
    const file_kind found = find_json_kind(strncmp(bytes, byte_order_mark, 3) == 0 ? bytes + 3 : bytes);
    return found != KIND_UNKNOWN || !cloud_is_recognised((const unsigned char *)bytes, size) ? found : KIND_CLOUD;
}

file_kind file_kind_of_input(const char *path)
{
    char first[4096], ignored[FILE_REASON];
    FILE *file = file_open(path, NULL, ignored);
    if (!file)
        return KIND_UNKNOWN;
    const size_t size = fread(first, 1, sizeof first - 1, file);
    fclose(file);
    first[size] = 0;
    return find_content_kind(first, size);
}

/* A folder that contains at least one file of a recording counts as a recording. The command that later reads the
 * recording reports missing files. */
static file_kind find_folder_kind(const char *path)
{
    for (size_t i = 0; recording_files[i]; i++)
        if (folder_contains(path, recording_files[i]))
            return KIND_RECORDING;
    return folder_contains(path, "session.json.live") ? KIND_RECORDING : KIND_FOLDER;
}

file_kind file_kind_of(const char *path)
{
    struct stat status;
    if (file_is_standard_stream(path))
        return KIND_UNKNOWN;
    if (stat(path, &status) != 0)
        return errno == ENOENT || errno == ENOTDIR ? KIND_MISSING : KIND_UNKNOWN;
    if (S_ISDIR(status.st_mode))
        return find_folder_kind(path);
    return S_ISREG(status.st_mode) ? file_kind_of_input(path) : KIND_UNKNOWN;
}

output_kind output_kind_of_name(const char *path)
{
    static const struct {
        const char *endings;
        output_kind kind;
    } rows[] = {
        {".png", NAME_PNG},
        {".jpg.jpeg.gif.bmp.webp.tif.tiff.svg", NAME_PICTURE},
        {".mp4.webm.mkv.avi.mov.apng", NAME_FILM},
        {".json.jsonl.xml.html.md.pdf.digests" CLOUD_ENDINGS, NAME_FILE},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (file_has_ending(path, rows[i].endings))
            return rows[i].kind;
    return NAME_OPEN;
}
