/* evidence.c - see evidence.h. */
#include "evidence.h"
#include "folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* What tells our folders from those of others, and people what they may do in them. */
#define MARKER "evidence.txt"
static const char marker_beginning[] = "octreel evidence 1\n";
static const char marker_text[] = "octreel evidence 1\n"
                                  "What octreel diff found: open " EVIDENCE_PAGE ".\n"
                                  "The next octreel diff -o into this folder removes the page and all pictures named\n"
                                  "*.expected.png, *.actual.png, *.difference.png and *.side.png.\n";

/* ---- The folder ---------------------------------------------------------------------------------------------- */

static bool check_apart(const char *folder, const diff_side *side, octreel_error *error)
{
    struct stat own, other;
    if (side->kind == DIFF_DIGESTS || stat(folder, &own) != 0)
        return true;
    const bool found = side->kind == DIFF_PICTURE ? stat_parent(side->path, &other) : stat(side->path, &other) == 0;
    return !found || !same_file(&own, &other) ||
           error_set(error, "%s: %s is compared, and would be removed: choose another folder for evidence", folder,
                     side->kind == DIFF_PICTURE ? "a picture in it" : "it");
}

static bool has_marker(const char *folder)
{
    char text[sizeof marker_beginning] = "", *path = path_join(folder, MARKER);
    FILE *file = path ? fopen(path, "rb") : NULL;
    free(path);
    if (!file)
        return false;
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    return size == sizeof text - 1 && memcmp(text, marker_beginning, size) == 0;
}

static bool is_ours(const char *name)
{
    return evidence_is_name(name) || strcmp(name, EVIDENCE_PAGE) == 0 || strcmp(name, EVIDENCE_PAGE ".part") == 0;
}

static bool remove_entry(const char *folder, const char *name, octreel_error *error)
{
    char *path = path_join(folder, name);
    if (!path)
        return error_no_memory(error);
    const bool ok = remove(path) == 0 || error_set(error, "%s: cannot be removed: %s", path, strerror(errno));
    free(path);
    return ok;
}

/* What does not belong to evidence stays in our folder, and keeps any other from becoming ours. */
static bool visit_entry(const char *folder, const char *name, bool marked, octreel_error *error)
{
    if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return true;
    if (marked)
        return !is_ours(name) || remove_entry(folder, name, error);
    return strcmp(name, MARKER ".part") == 0 ||
           error_set(error, "%s: holds %s, and no evidence of octreel diff: choose a new folder, or an empty one",
                     folder, name);
}

static bool clear(const char *folder, octreel_error *error)
{
    const bool marked = has_marker(folder);
    DIR *entries = opendir(folder);
    if (!entries)
        return error_set(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        ok = visit_entry(folder, entry->d_name, marked, error);
    closedir(entries);
    return ok;
}

bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error)
{
    return check_apart(folder, a, error) && check_apart(folder, b, error) && folder_make(folder, error) &&
           clear(folder, error) && folder_write(folder, MARKER, marker_text, sizeof marker_text - 1, error);
}

/* ---- The pictures -------------------------------------------------------------------------------------------- */

bool evidence_collect(evidence *e, const char *folder, const diff_result *result, const diff_options *options,
                      octreel_error *error)
{
    *e = (evidence){.folder = folder, .pictures = calloc(result->count, sizeof *e->pictures)};
    bool ok = e->pictures || error_set(error, "there is no memory for %zu frames", result->count);
    for (size_t i = 0; ok && i < result->count; i++)
        if (diff_finding_verdict(result->pairs[i].finding) != DIFF_SAME)
            ok = evidence_draw(&result->pairs[i], options, folder, &e->pictures[i], error);
    if (!ok)
        evidence_release(e);
    return ok;
}

void evidence_release(evidence *e)
{
    free(e->pictures);
    *e = (evidence){0};
}

char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture)
{
    if (!(e->pictures[i] & 1u << picture))
        return NULL;
    char *name = evidence_name(diff_pair_name(&result->pairs[i]), picture);
    char *path = name ? path_join(e->folder, name) : NULL;
    free(name);
    return path;
}
