/* parts.c - see parts.h. */
#include "parts.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

char *part_name(uint64_t first, uint64_t last, char name[PART_NAME])
{
    snprintf(name, PART_NAME, "ticks_%" PRIu64 "_%" PRIu64 ".jsonl", first, last);
    return name;
}

bool part_parse_name(const char *name, uint64_t *first, uint64_t *last)
{
    char again[PART_NAME], *end;
    if (strncmp(name, "ticks_", 6) != 0)
        return false;
    *first = strtoull(name + 6, &end, 10);
    if (*end != '_')
        return false;
    *last = strtoull(end + 1, NULL, 10);
    return *first < *last && strcmp(name, part_name(*first, *last, again)) == 0;
}

static bool count_lines(const char *folder, part *p, record_error *error)
{
    char block[16384], *path = folder_path(folder, p->name);
    FILE *stream = path ? fopen(path, "rb") : NULL;
    free(path);
    if (!stream)
        return record_fail(error, "%s/%s: cannot be read: %s", folder, p->name, strerror(errno));
    for (size_t size; (size = fread(block, 1, sizeof block, stream)) > 0;)
        for (const char *at = block; (at = memchr(at, '\n', (size_t)(block + size - at))); at++)
            p->lines++;
    const bool whole = !ferror(stream) || record_fail(error, "%s/%s: cannot be read", folder, p->name);
    fclose(stream);
    return whole;
}

static bool add(part_list *list, const char *folder, part p, uint64_t ticks, record_error *error)
{
    if (!count_lines(folder, &p, error))
        return false;
    if (p.last > ticks)
        return record_fail(error, "%s/%s: is no part of this session, whose last tick is %" PRIu64, folder, p.name,
                           ticks - 1);
    if (p.lines > p.last - p.first)
        return record_fail(error, "%s/%s: has more lines than ticks", folder, p.name);
    part *more = realloc(list->parts, (list->count + 1) * sizeof *more);
    if (!more)
        return record_fail(error, "there is no memory");
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

bool parts_find(const char *folder, uint64_t ticks, part_list *list, record_error *error)
{
    *list = (part_list){0};
    DIR *entries = opendir(folder);
    if (!entries)
        return record_fail(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));) {
        part p = {.last = ticks};
        if (part_parse_name(entry->d_name, &p.first, &p.last) || strcmp(entry->d_name, "ticks.jsonl") == 0) {
            snprintf(p.name, sizeof p.name, "%.*s", PART_NAME - 1, entry->d_name);
            ok = add(list, folder, p, ticks, error);
        }
    }
    closedir(entries);
    if (ok && list->count > 1)
        qsort(list->parts, list->count, sizeof *list->parts, compare);
    if (!ok)
        parts_release(list);
    return ok;
}

void parts_release(part_list *list)
{
    free(list->parts);
    *list = (part_list){0};
}
