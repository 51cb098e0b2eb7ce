/* SPDX-License-Identifier: MIT */
/* scripted_page.c - see scripted_page.h. */
#include "scripted_page.h"

#include <stdio.h>
#include <string.h>

bool write_scripted_page(const char *path, const char *text, const char *script)
{
    static const char policy[] = "script-src ";
    const char *found = strstr(text, policy), *behind = found ? found + strlen(policy) : text;
    FILE *file = fopen(path, "wb");
    if (!file)
        return false;
    fprintf(file, "%.*s%s%s<script src=\"%s\"></script>\n", (int)(behind - text), text, found ? "file: " : "", behind,
            script);
    return fclose(file) == 0;
}
