/* missing.c - see missing.h. */
#include "missing.h"
#include "frame_file.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define RUNS_SHOWN 3

/* Numbers in ascending order as runs in words: the first runs, and how many numbers there are beyond. */
typedef struct runs {
    char text[MISSING_TEXT];
    char *(*name)(uint64_t number, char text[FRAME_NAME]);
    uint64_t step;        /* between neighbours of a run */
    uint64_t first, last; /* the run at hand, where there is a number at all */
    uint64_t count, shown;
    unsigned written; /* runs */
} runs;

static void append(runs *r, const char *text)
{
    const size_t used = strlen(r->text);
    snprintf(r->text + used, sizeof r->text - used, "%s", text);
}

/* Write the run at hand. */
static void end_run(runs *r)
{
    char name[FRAME_NAME];
    const uint64_t numbers = r->count ? (r->last - r->first) / r->step + 1 : 0;
    if (numbers == 0 || r->written == RUNS_SHOWN)
        return;
    append(r, r->written ? ", " : "");
    append(r, r->name(r->first, name));
    append(r, numbers == 1 ? "" : numbers == 2 ? ", " : " to ");
    append(r, numbers == 1 ? "" : r->name(r->last, name));
    r->shown += numbers;
    r->written++;
}

static void add_number(runs *r, uint64_t number)
{
    if (r->count == 0 || number != r->last + r->step) {
        end_run(r);
        r->first = number;
    }
    r->last = number;
    r->count++;
}

static void end_runs(runs *r)
{
    char more[40];
    end_run(r);
    snprintf(more, sizeof more, " and %" PRIu64 " more", r->count - r->shown);
    append(r, r->count > r->shown ? more : "");
}

static char *tick_name(uint64_t tick, char text[FRAME_NAME])
{
    snprintf(text, FRAME_NAME, "%" PRIu64, tick);
    return text;
}

/* Ascending parts with gaps between what they have. */
static bool miss_no_line(const char *folder, const chunk_list *list, uint64_t ticks, octreel_error *error)
{
    runs gaps = {.name = tick_name, .step = 1};
    uint64_t next = 0;
    for (size_t i = 0; i <= list->count; i++) {
        const part *p = list->parts + i;
        const uint64_t begin = i < list->count ? p->first : ticks;
        for (; next < begin; next++)
            add_number(&gaps, next);
        if (i < list->count && p->first + p->lines > next)
            next = p->first + p->lines;
    }
    end_runs(&gaps);
    return gaps.count == 0 || error_set(error,
                                        "%s: no part has the tick%s %s; octreel record --resume films what is "
                                        "missing",
                                        folder, gaps.count > 1 ? "s" : "", gaps.text);
}

static bool is_there(const char *folder, uint64_t tick)
{
    char name[FRAME_NAME];
    return folder_has(folder, frame_name(tick, name));
}

uint64_t missing_frames(const char *folder, uint64_t first, uint64_t last, uint64_t every, char text[MISSING_TEXT])
{
    runs gaps = {.name = frame_name, .step = every};
    for (uint64_t tick = first + (every - first % every) % every; tick < last; tick += every) {
        if (!is_there(folder, tick))
            add_number(&gaps, tick);
        if (last - tick <= every)
            break; /* an addition could overflow */
    }
    end_runs(&gaps);
    memcpy(text, gaps.text, MISSING_TEXT);
    return gaps.count;
}

static bool miss_no_frame(const char *folder, uint64_t ticks, uint64_t every, octreel_error *error)
{
    char text[MISSING_TEXT];
    const uint64_t count = missing_frames(folder, 0, ticks, every, text);
    return count == 0 || error_set(error, "%s: %s %s missing; octreel record --resume films what is missing", folder,
                                   text, count > 1 ? "are" : "is");
}

static bool hold_no_other_frame(const char *folder, uint64_t ticks, uint64_t every, octreel_error *error)
{
    DIR *entries = opendir(folder);
    if (!entries)
        return error_set(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    uint64_t tick;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        if (frame_parse_name(entry->d_name, &tick) && !frame_is_name(entry->d_name, ticks, every))
            ok = error_set(error, "%s/%s: is no frame of this recording", folder, entry->d_name);
    closedir(entries);
    return ok;
}

bool missing_nothing(const char *folder, const chunk_list *parts, uint64_t ticks, uint64_t every, octreel_error *error)
{
    return miss_no_line(folder, parts, ticks, error) && miss_no_frame(folder, ticks, every, error) &&
           hold_no_other_frame(folder, ticks, every, error);
}
