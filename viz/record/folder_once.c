/* folder_once.c - a file that several processes may write at the same time, all with the same bytes: see folder.h. */
#include "folder.h"
#include "file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool compare(const char *path, const char *bytes, size_t size, bool *same, octreel_error *error)
{
    char reason[FILE_REASON], *there;
    size_t there_size;
    if (!file_read_whole(path, &there, &there_size, reason))
        return error_set(error, "%s: %s", path, reason);
    *same = there_size == size && memcmp(there, bytes, size) == 0;
    free(there);
    return true;
}

/* A link, unlike a rename, does not put a file in the place of another one. Where there are no links the last one to
 * come stays, whole all the same. */
static bool put_in_place(const char *own, const char *path, octreel_error *error)
{
    if (link(own, path) == 0 || errno == EEXIST) {
        remove(own);
        return true;
    }
    if (rename(own, path) == 0)
        return true;
    error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    remove(own);
    return false;
}

static bool write_own(const char *folder, const char *name, const char *writer, const char *bytes, size_t size,
                      octreel_error *error)
{
    const size_t room = strlen(name) + strlen(writer) + 2;
    char *own_name = malloc(room);
    if (own_name)
        snprintf(own_name, room, "%s.%s", name, writer);
    char *own = own_name ? path_join(folder, own_name) : NULL, *path = path_join(folder, name);
    bool ok = own && path ? folder_write(folder, own_name, bytes, size, error) : error_no_memory(error);
    ok = ok && put_in_place(own, path, error);
    free(own_name);
    free(own);
    free(path);
    return ok;
}

bool folder_write_once(const char *folder, const char *name, const char *writer, const char *bytes, size_t size,
                       bool *same, octreel_error *error)
{
    char *path = path_join(folder, name);
    if (!path)
        return error_no_memory(error);
    bool ok = access(path, F_OK) == 0 || write_own(folder, name, writer, bytes, size, error);
    ok = ok && compare(path, bytes, size, same, error);
    free(path);
    return ok;
}

bool folder_compare(const char *folder, const char *name, const char *bytes, size_t size, bool *same,
                    octreel_error *error)
{
    char *path = path_join(folder, name);
    *same = true;
    if (!path)
        return error_no_memory(error);
    const bool ok = access(path, F_OK) != 0 || compare(path, bytes, size, same, error);
    free(path);
    return ok;
}
