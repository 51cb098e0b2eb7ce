/* inspect_output.c - see inspect_output.h. */
#include "inspect_output.h"
#include "file.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char *inspect_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *inspect_told_name(const char *cloud, char *const *clouds, size_t count)
{
    const char *name = inspect_base_name(cloud);
    for (size_t i = 0; i < count; i++)
        if (strcmp(clouds[i], cloud) != 0 && strcmp(inspect_base_name(clouds[i]), name) == 0)
            return cloud;
    return name;
}

static bool ends_in(const char *text, const char *ending)
{
    const size_t length = strlen(text), tail = strlen(ending);
    return length >= tail && strcmp(text + (length - tail), ending) == 0;
}

static bool is_there(const char *path, bool *folder)
{
    struct stat status;
    const bool there = stat(path, &status) == 0;
    *folder = there && S_ISDIR(status.st_mode);
    return there;
}

static bool check_names(const inspect_output *output, char *const *clouds, size_t count, octreel_error *error)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (strcmp(inspect_base_name(clouds[i]), inspect_base_name(clouds[j])) == 0)
                return error_set(error, "%s: %s and %s would be the same file in %s", output->option, clouds[j],
                                 clouds[i], output->given);
    return true;
}

bool inspect_output_check(inspect_output *output, char *const *clouds, size_t count, octreel_error *error)
{
    if (!output->given)
        return true;
    const bool there = is_there(output->given, &output->folder);
    output->folder = output->folder || ends_in(output->given, "/");
    if (count > 1 && !output->folder && (there || ends_in(output->given, output->ending)))
        return error_set(error, "%s %s is one file; for several clouds it takes a folder", output->option,
                         output->given);
    output->folder = output->folder || count > 1;
    return !output->folder || check_names(output, clouds, count, error);
}

static char *path_of(const inspect_output *output, const char *cloud, octreel_error *error)
{
    const char *name = inspect_base_name(cloud);
    const size_t size = strlen(output->given) + strlen(name) + strlen(output->ending) + 2;
    char *path = malloc(size);
    if (!path) {
        error_no_memory(error);
        return NULL;
    }
    if (!output->folder) {
        memcpy(path, output->given, strlen(output->given) + 1);
        return path;
    }
    const char *between = ends_in(output->given, "/") ? "" : "/";
    snprintf(path, size, "%s%s%s%s", output->given, between, name, output->ending);
    return path;
}

char *inspect_output_path(const inspect_output *output, const char *cloud, octreel_error *error)
{
    char *path = path_of(output, cloud, error);
    if (!path || !output->folder || folder_make(output->given, error))
        return path;
    free(path);
    return NULL;
}

/* The files of one cloud. Those of two have other names, or other endings. */
static bool files_spare(const output_file files[2], char *const *clouds, size_t count, octreel_error *error)
{
    bool ok = outputs_apart(files, 2, error);
    for (size_t i = 0; ok && i < count; i++)
        ok = output_spares(&files[0], clouds[i], error) && output_spares(&files[1], clouds[i], error);
    return ok;
}

bool inspect_outputs_spare(const inspect_output outputs[2], char *const *clouds, size_t count, octreel_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++) {
        char *paths[2] = {NULL, NULL};
        for (int k = 0; ok && k < 2; k++)
            ok = !outputs[k].given || (paths[k] = path_of(&outputs[k], clouds[i], error));
        const output_file files[2] = {{outputs[0].option, paths[0]}, {outputs[1].option, paths[1]}};
        ok = ok && files_spare(files, clouds, count, error);
        free(paths[0]);
        free(paths[1]);
    }
    return ok;
}
