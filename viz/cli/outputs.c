/* SPDX-License-Identifier: MIT */
/* outputs.c - checks that the outputs of a command replace no file that the user may need. */
#define _XOPEN_SOURCE 700 /* declares realpath() */
#include "outputs.h"
#include "file_kind.h"
#include "folder.h"
#include "frame_file.h"
#include "options.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- Outputs among each other ------------------------------------------------------------------------------- */

static size_t count_standard_outputs(const output_file *outputs, size_t count)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        found += outputs[i].path && file_is_standard_output(outputs[i].path);
    return found;
}

bool is_standard_output_taken(const output_file *outputs, size_t count)
{
    return count_standard_outputs(outputs, count) > 0;
}

/* Returns whether two paths, which do not exist yet, would be the same file: their names and their folders are the
 * same. If the folders do not exist either, the paths are compared as text. */
static bool is_same_new_path(const char *a, const char *b)
{
    struct stat folders[2];
    if (!stat_parent_folder(a, &folders[0]) || !stat_parent_folder(b, &folders[1]))
        return strcmp(a, b) == 0;
    return is_same_file(&folders[0], &folders[1]) && strcmp(path_base_name(a), path_base_name(b)) == 0;
}

static bool is_same_path(const char *a, const char *b)
{
    struct stat files[2];
    if (file_is_standard_stream(a) || file_is_standard_stream(b))
        return false;
    const bool exists[2] = {stat(a, &files[0]) == 0, stat(b, &files[1]) == 0};
    if (exists[0] && exists[1])
        return S_ISREG(files[0].st_mode) && is_same_file(&files[0], &files[1]);
    return !exists[0] && !exists[1] && is_same_new_path(a, b);
}

static bool check_outputs_differ(const output_file *outputs, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (outputs[i].path && outputs[j].path && is_same_path(outputs[i].path, outputs[j].path))
                return print_refusal("%s %s is the same file as %s %s", outputs[i].option, outputs[i].path,
                                     outputs[j].option, outputs[j].path);
    return true;
}

/* ---- What an output would replace --------------------------------------------------------------------------- */

/* Prints an error: the output would replace a file. The texts `is`, `of` and `end` together describe the file, after
 * the option and the path, such as "-o p.png is". Returns false. */
static bool refuse_file(const output_file *output, const char *is, const char *of, const char *end)
{
    return print_refusal("%s %s is %s%s%s: name another file, or add --force to overwrite it", output->option,
                         output->path, is, of, end);
}

/* Checks that an output is not the input file. `status` is the result of stat() for the output. */
static bool check_differs_from_input_file(const output_file *output, const struct stat *status, const char *input)
{
    struct stat other;
    return stat(input, &other) != 0 || !is_same_file(status, &other) ||
           refuse_file(output, "the same file as ", input, ", which is read");
}

/* Checks that an output is none of the pictures and recording files in an input folder or its subfolders. `names` are
 * the names in the folder; this function frees them. Links to folders are not followed, because they could lead back to
 * the folder. Subfolders that cannot be listed are skipped, because --no-recursive may exclude them anyway. */
static bool check_differs_from_input_names(const output_file *output, const struct stat *status, const char *folder,
                                           char **names)
{
    bool ok = true;
    for (size_t i = 0; ok && names[i]; i++) {
        struct stat entry;
        octreel_error ignored;
        char *path = path_join(folder, names[i]);
        ok = path || print_refusal("out of memory");
        if (ok && lstat(path, &entry) == 0 && S_ISDIR(entry.st_mode)) {
            char **below = names[i][0] == '.' ? NULL : folder_names(path, &ignored);
            ok = !below || check_differs_from_input_names(output, status, path, below);
        } else if (ok && (folder_is_recording_file(names[i]) || file_has_ending(names[i], ".png")))
            ok = check_differs_from_input_file(output, status, path);
        free(path);
    }
    free(names);
    return ok;
}

static bool check_differs_from_input_folder(const output_file *output, const struct stat *status, const char *folder)
{
    octreel_error error;
    char **names = folder_names(folder, &error);
    return names ? check_differs_from_input_names(output, status, folder, names) : print_refusal("%s", error.text);
}

static bool check_differs_from_input(const output_file *output, const struct stat *status, const char *input)
{
    return file_is_standard_stream(input) ||
           (is_folder(input) ? check_differs_from_input_folder : check_differs_from_input_file)(output, status, input);
}

/* Checks that a path is not the path of a file in a recording. */
static bool check_not_in_recording(const output_file *output, const char *path)
{
    const char *name = path_base_name(path);
    char *folder = path_parent_folder(path);
    const bool ok =
        (folder || print_refusal("out of memory")) &&
        ((!folder_is_recording_file(name) && !folder_is_unfinished_file(name)) ||
         !folder_contains(folder, "recording.json") || refuse_file(output, "a file of the recording in ", folder, ""));
    free(folder);
    return ok;
}

/* Checks that an existing file is not, by its content, a file that the user may need. This check also finds a frame
 * that is reached by a link in another folder. */
static bool check_output_content(const output_file *output)
{
    uint64_t tick;
    octreel_error ignored;
    const file_kind kind = file_kind_of(output->path);
    if (1u << kind & (FILE_KIND(BASELINE) | FILE_KIND(SESSION) | FILE_KIND(PART) | FILE_KIND(CLOUD)))
        return refuse_file(output, file_kind_rows[kind].name, "", "");
    return kind != KIND_PNG || !frame_read_tick(output->path, &tick, &ignored) ||
           refuse_file(output, "a frame of a recording", "", "");
}

static bool check_output_file(const output_file *output, char *const *inputs, int input_count)
{
    struct stat status;
    bool ok = true;
    if (!output->path || file_is_standard_stream(output->path))
        return true;
    const bool exists = stat(output->path, &status) == 0;
    if (exists && !S_ISREG(status.st_mode))
        return true;
    for (int i = 0; ok && exists && i < input_count; i++)
        ok = check_differs_from_input(output, &status, inputs[i]);
    char *real = exists ? realpath(output->path, NULL) : NULL; /* realpath() resolves links */
    ok = ok && check_not_in_recording(output, output->path) && (!real || check_not_in_recording(output, real)) &&
         (!exists || check_output_content(output));
    free(real);
    return ok;
}

/* ---- Folders ------------------------------------------------------------------------------------------------ */

/* Returns whether a folder is the current folder or contains it. Files that are written there would mix with unrelated
 * files. */
static bool contains_current_folder(const char *folder)
{
    struct stat named, here, before = {0};
    char up[PATH_MAX] = ".";
    bool is = false, more = stat(folder, &named) == 0;
    for (size_t length = 1; more && !is && length + sizeof "/.." < sizeof up; before = here) {
        more = stat(up, &here) == 0 &&
               (length == 1 || !is_same_file(&here, &before)); /* stop at the root, which is its own parent directory */
        is = more && is_same_file(&named, &here);
        length += (size_t)snprintf(up + length, sizeof up - length, "/..");
    }
    return is;
}

static bool check_output_folder(const output_file *output)
{
    return !output->folder || !contains_current_folder(output->folder) ||
           file_kind_of(output->folder) == KIND_RECORDING ||
           print_refusal(
               "%s needs a folder of its own, but \"%s\" is or contains the current folder: name a new folder, or "
               "add --force to write into this one",
               output->option, output->folder);
}

bool check_outputs(const output_file *outputs, size_t count, char *const *inputs, int input_count, bool json,
                   bool force)
{
    bool ok = count_standard_outputs(outputs, count) + json <= 1 ||
              print_refusal("only one output can go to standard output; name files for the others");
    ok = ok && check_outputs_differ(outputs, count);
    for (size_t i = 0; ok && !force && i < count; i++)
        ok = check_output_folder(&outputs[i]) && check_output_file(&outputs[i], inputs, input_count);
    return ok;
}

bool check_page_output(const output_file *output, bool force)
{
    struct stat status;
    return force || file_is_standard_stream(output->path) || stat(output->path, &status) != 0 ||
           !S_ISREG(status.st_mode) || status.st_size == 0 || file_kind_of(output->path) == KIND_PAGE ||
           print_refusal("%s: exists and is not a page made by octreel: name another file with %s, or add --force to "
                         "overwrite it",
                         output->path, output->option);
}
