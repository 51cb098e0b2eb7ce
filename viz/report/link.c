/* SPDX-License-Identifier: MIT */
/* link.c - computes relative paths, and writes paths as parts of URLs. */
#include "link.h"
#include "file.h"
#include "folder.h"
#include "text.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Return the relative path from one absolute folder to another. */
static char *relative_path(const char *from, const char *to)
{
    size_t shared = 0;
    char *path = NULL;
    text_stream s;
    for (size_t i = 0;; i++) {
        if ((from[i] == 0 || from[i] == '/') && (to[i] == 0 || to[i] == '/'))
            shared = i;
        if (from[i] != to[i] || from[i] == 0)
            break;
    }
    if (!text_stream_begin(&s))
        return NULL;
    fputs("./", s.stream);
    for (const char *at = from + shared; *at; at++)
        if (*at == '/')
            fputs("../", s.stream);
    if (to[shared])
        fprintf(s.stream, "%s/", to + shared + 1);
    return text_stream_end(&s, &path) ? path : NULL;
}

/* Return the absolute path of a folder. The parts "." and "..", and double slashes, are resolved in the text, as a
 * browser does; symbolic links are not followed. Return null if memory runs out or the current folder is unknown. */
static char *absolute_path(const char *path)
{
    char here[PATH_MAX] = "";
    if (path[0] != '/' && !getcwd(here, sizeof here))
        return NULL;
    char *made = malloc(strlen(here) + strlen(path) + 2);
    size_t length = 0;
    const char *const parts[] = {here, path};
    for (int i = 0; made && i < 2; i++)
        for (const char *at = parts[i]; *at;) {
            const size_t size = strcspn(at, "/");
            if (size == 2 && at[0] == '.' && at[1] == '.') {
                while (length > 0 && made[--length] != '/')
                    continue;
            } else if (size > 1 || (size == 1 && *at != '.')) {
                made[length++] = '/';
                memcpy(made + length, at, size);
                length += size;
            }
            at += size + (at[size] == '/');
        }
    if (made)
        made[length] = 0;
    return made;
}

char *link_make_relative_path(const char *from, const char *to)
{
    char *here = absolute_path(from), *there = absolute_path(to);
    char *path = here && there ? relative_path(here, there) : NULL;
    free(here);
    free(there);
    return path;
}

bool link_has_page(const char *recording)
{
    return folder_contains(recording, "index.html");
}

void link_write_path(FILE *out, const char *path)
{
    for (; *path; path++)
        if (strchr("-._~/", *path) || (*path >= '0' && *path <= '9') || (*path >= 'A' && *path <= 'Z') ||
            (*path >= 'a' && *path <= 'z'))
            putc(*path, out);
        else
            fprintf(out, "%%%02X", (unsigned char)*path);
}
