/* who_drew.c - see who_drew.h. */
#include "who_drew.h"
#include "folder.h"
#include "text.h"
#include "file.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

#define LONGEST 100 /* of each of the strings */

static void describe(const json_t *object, char *text, size_t size)
{
    static const char *const members[] = {"context", "renderer", "version"};
    size_t length = 0;
    snprintf(text, size, "an unknown renderer");
    for (size_t i = 0; i < sizeof members / sizeof members[0] && length < size; i++) {
        const char *value = json_string_value(json_object_get(object, members[i]));
        if (value)
            length += (size_t)snprintf(text + length, size - length, "%s%.*s", length ? ", " : "", LONGEST, value);
    }
    make_printable(text);
}

char *who_draws(const renderer_info *info, char *text, size_t size)
{
    json_t *object =
        json_pack("{s:s, s:s, s:s}", "context", info->context, "renderer", info->renderer, "version", info->version);
    describe(object, text, size);
    json_decref(object);
    return text;
}

char *who_drew(const char *folder, char *text, size_t size)
{
    char reason[FILE_REASON], *bytes = NULL, *path = path_join(folder, "renderer.json");
    size_t length;
    const bool there = path && file_read_whole(path, &bytes, &length, reason);
    json_t *object = there ? json_loadb(bytes, length, 0, NULL) : NULL;
    describe(object, text, size);
    json_decref(object);
    free(bytes);
    free(path);
    return text;
}
