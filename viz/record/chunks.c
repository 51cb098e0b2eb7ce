/* parts.c - see parts.h. */
#include "chunks.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static bool count_lines(const char *folder, part *p, octreel_error *error)
{
    char block[16384], *path = path_join(folder, p->name);
    FILE *stream = path ? fopen(path, "rb") : NULL;
    free(path);
    if (!stream)
        return error_set(error, "%s/%s: cannot be read: %s", folder, p->name, strerror(errno));
    for (size_t size; (size = fread(block, 1, sizeof block, stream)) > 0;)
        for (const char *at = block; (at = memchr(at, '\n', (size_t)(block + size - at))); at++)
            p->lines++;
    const bool whole = !ferror(stream) || error_set(error, "%s/%s: cannot be read", folder, p->name);
    fclose(stream);
    return whole;
}

static bool add(chunk_list *list, const char *folder, part p, uint64_t ticks, octreel_error *error)
{
    if (!count_lines(folder, &p, error))
        return false;
    if (p.last > ticks)
        return error_set(error, "%s/%s: is no part of this session, whose last tick is %" PRIu64, folder, p.name,
                         ticks - 1);
    if (p.lines > p.last - p.first)
        return error_set(error, "%s/%s: has more lines than ticks", folder, p.name);
    part *more = realloc(list->parts, (list->count + 1) * sizeof *more);
    if (!more)
        return error_no_memory(error);
    list->parts = more;
    list->parts[list->count++] = p;
    return true;
}

static int compare(const void *a, const void *b)
{
    const part *p = a, *q = b;
    if (p->first != q->first)
        return p->first < q->first ? -1 : 1;
    return p->last == q->last ? 0 : p->last > q->last ? -1 : 1;
}

bool chunks_find(const char *folder, uint64_t ticks, chunk_list *list, octreel_error *error)
{
    *list = (chunk_list){0};
    DIR *entries = opendir(folder);
    if (!entries)
        return error_set(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));) {
        part p = {.last = ticks};
        if (chunk_parse_name(entry->d_name, &p.first, &p.last) || strcmp(entry->d_name, "ticks.jsonl") == 0) {
            snprintf(p.name, sizeof p.name, "%.*s", CHUNK_NAME - 1, entry->d_name);
            ok = add(list, folder, p, ticks, error);
        }
    }
    closedir(entries);
    if (ok && list->count > 1)
        qsort(list->parts, list->count, sizeof *list->parts, compare);
    if (!ok)
        chunks_release(list);
    return ok;
}

void chunks_release(chunk_list *list)
{
    free(list->parts);
    *list = (chunk_list){0};
}
