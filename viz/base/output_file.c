/* output_file.c - see output_file.h. */
#include "output_file.h"

#include <stdlib.h>
#include <string.h>

bool same_file(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

bool stat_parent(const char *path, struct stat *status)
{
    char *parent = strdup(path), *slash = parent ? strrchr(parent, '/') : NULL;
    if (slash)
        slash[slash == parent ? 1 : 0] = 0;
    const bool is = parent && stat(slash ? parent : ".", status) == 0;
    free(parent);
    return is;
}

/* Two files of which neither is there: one name in one folder. Folders that are not there either are told by name. */
static bool same_name(const char *a, const char *b)
{
    struct stat folders[2];
    const char *slashes[2] = {strrchr(a, '/'), strrchr(b, '/')};
    if (!stat_parent(a, &folders[0]) || !stat_parent(b, &folders[1]))
        return strcmp(a, b) == 0;
    return same_file(&folders[0], &folders[1]) &&
           strcmp(slashes[0] ? slashes[0] + 1 : a, slashes[1] ? slashes[1] + 1 : b) == 0;
}

static bool are_one(const char *a, const char *b)
{
    struct stat files[2];
    const bool there[2] = {stat(a, &files[0]) == 0, stat(b, &files[1]) == 0};
    if (there[0] && there[1])
        return S_ISREG(files[0].st_mode) && same_file(&files[0], &files[1]);
    return !there[0] && !there[1] && same_name(a, b);
}

bool output_spares(const output_file *output, const char *input, record_error *error)
{
    return !output->path || !are_one(output->path, input) ||
           record_fail(error, "%s %s is the same file as %s, which is read", output->option, output->path, input);
}

bool outputs_apart(const output_file *outputs, size_t count, record_error *error)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (outputs[i].path && outputs[j].path && are_one(outputs[i].path, outputs[j].path))
                return record_fail(error, "%s %s is the same file as %s %s", outputs[i].option, outputs[i].path,
                                   outputs[j].option, outputs[j].path);
    return true;
}
