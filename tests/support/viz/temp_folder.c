/* SPDX-License-Identifier: MIT */
/* temp_folder.c - see temp_folder.h. */
#include "temp_folder.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int temp_folder_make(void **state)
{
    temp_folder *folder = calloc(1, sizeof *folder);
    if (folder == NULL)
        return -1;
    strcpy(folder->name, "test_XXXXXX");
    *state = folder;
    return mkdtemp(folder->name) == NULL ? -1 : 0;
}

const char *temp_file(temp_folder *folder, const char *name)
{
    snprintf(folder->path, sizeof folder->path, "%s/%s", folder->name, name);
    return folder->path;
}

static void remove_entry(const temp_folder *folder, const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder->name, name);
    remove(path);
}

static int visit_entries(const temp_folder *folder, void (*visit)(const temp_folder *folder, const char *name))
{
    DIR *listing = opendir(folder->name);
    if (listing == NULL)
        return -1;
    int count = 0;
    for (struct dirent *entry = readdir(listing); entry != NULL; entry = readdir(listing)) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        count++;
        if (visit != NULL)
            visit(folder, entry->d_name);
    }
    closedir(listing);
    return count;
}

int temp_folder_count(const temp_folder *folder)
{
    return visit_entries(folder, NULL);
}

int temp_folder_remove(void **state)
{
    temp_folder *folder = *state;
    visit_entries(folder, remove_entry);
    int status = rmdir(folder->name);
    free(folder);
    return status;
}
