/* SPDX-License-Identifier: MIT */
/* files.c - see files.h. */
#include "files.h"

#include <dirent.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "fixture.h"

place place_below(const char *folder, const char *name)
{
    place made;
    const int length = snprintf(made.path, sizeof made.path, "%s/%s", folder, name);
    assert_true(length > 0 && (size_t)length < sizeof made.path);
    return made;
}

place place_in(const temp_folder *folder, const char *name)
{
    return place_below(folder->name, name);
}

void limit_file_size(size_t bytes)
{
    struct rlimit limit;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes < SIZE_MAX ? bytes : limit.rlim_max;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

bool file_exists(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

bool is_real_folder(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

char *file_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        fail_msg("cannot read %s", path);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long length = ftell(file);
    assert_true(length >= 0);
    rewind(file);
    char *bytes = malloc((size_t)length + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)length, file), length);
    bytes[length] = '\0';
    fclose(file);
    if (size != NULL)
        *size = (size_t)length;
    return bytes;
}

void file_write(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        fail_msg("cannot write %s", path);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void file_write_text(const char *path, const char *text)
{
    file_write(path, text, strlen(text));
}

static int is_entry(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(a, b);
}

listing folder_list(const char *folder)
{
    listing names = {NULL, 0};
    struct dirent **entries;
    const int found = scandir(folder, &entries, is_entry, NULL);
    if (found < 0)
        fail_msg("cannot list %s", folder);
    const size_t count = found < 0 ? 0 : (size_t)found;
    names.names = calloc(count + 1, sizeof *names.names);
    assert_non_null(names.names);
    for (; names.count < count; names.count++) {
        snprintf(names.names[names.count], sizeof *names.names, "%s", entries[names.count]->d_name);
        free(entries[names.count]);
    }
    free(entries);
    qsort(names.names, names.count, sizeof *names.names, compare_names);
    return names;
}

void listing_release(listing *names)
{
    free(names->names);
    *names = (listing){NULL, 0};
}

static void remove_tree(const char *path)
{
    if (is_real_folder(path)) {
        listing inside = folder_list(path);
        for (size_t i = 0; i < inside.count; i++)
            remove_tree(place_below(path, inside.names[i]).path);
        listing_release(&inside);
    }
    remove(path);
}

int nested_folder_remove(void **state)
{
    const temp_folder *folder = *state;
    listing inside = folder_list(folder->name);
    for (size_t i = 0; i < inside.count; i++)
        remove_tree(place_in(folder, inside.names[i]).path);
    listing_release(&inside);
    return temp_folder_remove(state);
}

void copy_folder(const char *from, const char *to)
{
    assert_int_equal(mkdir(to, 0777), 0);
    listing names = folder_list(from);
    for (size_t i = 0; i < names.count; i++) {
        size_t size;
        char *bytes = file_read(place_below(from, names.names[i]).path, &size);
        file_write(place_below(to, names.names[i]).path, bytes, size);
        free(bytes);
    }
    listing_release(&names);
}

void assert_same_files(const char *a, const char *b)
{
    size_t size_a, size_b;
    char *bytes_a = file_read(a, &size_a), *bytes_b = file_read(b, &size_b);
    const bool same = size_a == size_b && memcmp(bytes_a, bytes_b, size_a) == 0;
    free(bytes_a);
    free(bytes_b);
    if (!same)
        fail_msg("%s and %s differ", a, b);
}

void assert_same_folders(const char *a, const char *b, const char *except)
{
    listing in_a = folder_list(a), in_b = folder_list(b);
    assert_int_equal(in_a.count, in_b.count);
    for (size_t i = 0; i < in_a.count; i++) {
        assert_string_equal(in_a.names[i], in_b.names[i]);
        if (except == NULL || strcmp(in_a.names[i], except) != 0)
            assert_same_files(place_below(a, in_a.names[i]).path, place_below(b, in_b.names[i]).path);
    }
    listing_release(&in_a);
    listing_release(&in_b);
}
