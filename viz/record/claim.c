/* claim.c - see claim.h. */
#include "claim.h"
#include "folder_files.h"
#include "frame_file.h"
#include "playback.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* What is in a folder, as far as a recording could replace it. */
typedef struct findings {
    char stranger[NAME_MAX + 1]; /* the first file that is none of a recording that has just begun; else "" */
    uint64_t frames;             /* one more than the last tick that has a frame; 0: there is none */
} findings;

static bool is_empty(const char *folder, const char *name)
{
    struct stat status;
    char *path = path_join(folder, name);
    const bool empty = path && stat(path, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0;
    free(path);
    return empty;
}

/* Empty lines are what a recording leaves that was killed in its first moments. */
static bool is_stranger(const char *folder, const char *name)
{
    return folder_is_name(name) && strcmp(name, "recording.json") != 0 && strcmp(name, "session.json") != 0 &&
           !(strcmp(name, "ticks.jsonl") == 0 && is_empty(folder, name));
}

static bool look_at(findings *f, const char *folder, const char *name, uint64_t ticks, uint64_t every,
                    octreel_error *error)
{
    uint64_t tick;
    if (folder_is_unfinished(name))
        return true;
    if (strncmp(name, "frame_", 6) == 0 && !frame_is_name(name, ticks, every))
        return error_set(error, "%s/%s: is no frame of this recording: remove it, or choose another folder", folder,
                         name);
    if (frame_parse_name(name, &tick) && tick >= f->frames)
        f->frames = tick + 1;
    if (is_stranger(folder, name) && (!*f->stranger || strcmp(name, f->stranger) < 0))
        snprintf(f->stranger, sizeof f->stranger, "%s", name);
    return true;
}

static bool look(findings *f, const char *folder, uint64_t ticks, uint64_t every, octreel_error *error)
{
    DIR *entries = opendir(folder);
    bool ok = true;
    *f = (findings){0};
    if (!entries)
        return error_set(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        ok = look_at(f, folder, entry->d_name, ticks, every, error);
    closedir(entries);
    return ok;
}

static bool pass_over(void *context, const film_step *step, octreel_error *error)
{
    (void)context;
    (void)step;
    (void)error;
    return true;
}

/* Nothing is written before all of it is known, so it is not stopped either. */
static bool claim_frames(const octree_session *session, uint64_t session_digest, const film_options *options,
                         uint64_t frames, octreel_error *error)
{
    take t;
    film_options own = *options;
    const film_share share = {.last = frames};
    own.keep_going = NULL;
    bool ok = take_open(&t, session, &own, FRAMES_CLAIM, error);
    t.session_digest = session_digest;
    ok = ok && film_ticks(&t, &share, pass_over, NULL, error);
    take_close(&t);
    return ok;
}

/* Both files are asked for behind the look around: a recording has them before it has anything else, so that what
 * another process is filming into this folder at the same time is no stranger. */
bool claim_folder(const octree_session *session, uint64_t session_digest, const film_options *options,
                  octreel_error *error)
{
    findings f;
    const char *folder = options->folder;
    if (!look(&f, folder, octree_session_length(session) + 1, options->every, error))
        return false;
    const bool view = folder_has(folder, "recording.json"), played = folder_has(folder, "session.json");
    if (*f.stranger && !view && !played)
        return error_set(error, "%s: holds %s, and no recording that could be completed: choose another folder", folder,
                         f.stranger);
    return (view && played) || f.frames == 0 || claim_frames(session, session_digest, options, f.frames, error);
}
