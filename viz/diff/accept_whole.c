/* SPDX-License-Identifier: MIT */
/* accept_whole.c - checks that a recording is complete before it is accepted.
 *
 * The problem: if a whole recording is accepted, each reference without a new frame is removed. The recording may
 * still be written, may have been interrupted, or may have lost a file. Accepting such a recording would silently
 * remove references that are still valid.
 *
 * The checks: (1) No process holds the lock of ticks.jsonl, or of a chunk's tick log, ticks_*.jsonl. (2) session.json
 * and ticks.jsonl exist. (3) Every tick that should have a frame has a frame, except in gaps. session.json gives the
 * number of ticks, and every interval-th tick should have a frame. (4) ticks.jsonl has one line for each tick. The
 * pixels of frames are not checked here, because the comparison reads them anyway.
 *
 * Cost: one file lookup for each frame and one pass over ticks.jsonl.
 */
#include "accepting.h"
#include "file.h"
#include "frame_file.h"
#include "hint.h"
#include "recording_file.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Refuse a recording that is still being written, because its later frames would not be accepted. A chunk of a
 * recording has its own tick log, ticks_*.jsonl. */
bool accept_check_ended(const diff_side *side, octreel_error *error)
{
    octreel_error ignored;
    char **names = side->kind == DIFF_RECORDING ? folder_names(side->path, &ignored) : NULL;
    bool ok = true;
    for (size_t i = 0; ok && names && names[i]; i++) {
        const char *end = strrchr(names[i], '.');
        if (strncmp(names[i], "ticks", 5) != 0 || !end || strcmp(end, ".jsonl") != 0)
            continue;
        char *path = path_join(side->path, names[i]);
        ok = path ? !file_is_locked(path) ||
                        error_set(error, "%s: is still being recorded; accept it when the recording has ended",
                                  side->path)
                  : error_no_memory(error);
        free(path);
    }
    free(names);
    return ok;
}

static bool report_damaged_recording(const char *folder, octreel_error *error, const char *format, ...)
{
    char lack[128];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(lack, sizeof lack, format, arguments);
    va_end(arguments);
    return error_set(
        error, "%s: %s; refusing to accept a damaged or incomplete recording: complete it with %s record --resume",
        folder, lack, hint_program_name());
}

static bool count_lines(const char *folder, uint64_t *lines, octreel_error *error)
{
    char block[1 << 14], reason[FILE_REASON], *path = path_join(folder, "ticks.jsonl");
    if (!path)
        return error_no_memory(error);
    FILE *in = file_open(path, NULL, reason);
    bool ok = in || error_set(error, "%s: %s", path, reason);
    *lines = 0;
    for (size_t size; in && (size = fread(block, 1, sizeof block, in)) > 0;)
        for (const char *at = block; (at = memchr(at, '\n', size - (size_t)(at - block))); at++)
            ++*lines;
    if (in) {
        ok = !ferror(in) || error_set(error, "%s: cannot be read: %s", path, strerror(errno));
        fclose(in);
    }
    free(path);
    return ok;
}

static bool check_tick_line_count(const char *folder, uint64_t ticks, octreel_error *error)
{
    uint64_t lines;
    if (!count_lines(folder, &lines, error))
        return false;
    return lines == ticks ||
           report_damaged_recording(folder, error, "its ticks.jsonl has %" PRIu64 " line%s for %" PRIu64 " tick%s",
                                    lines, plural_ending(lines), ticks, plural_ending(ticks));
}

static bool check_file(const char *folder, const char *name, octreel_error *error)
{
    return folder_contains(folder, name) || report_damaged_recording(folder, error, "%s is missing", name);
}

static bool check_frames(const char *folder, const octree_session *session, uint64_t every, octreel_error *error)
{
    char name[FRAME_NAME];
    const uint64_t last = octree_session_length(session);
    bool ok = true;
    for (uint64_t tick = 0; ok && every > 0 && tick <= last; tick += every)
        ok = octree_session_gap(session, tick) || check_file(folder, frame_print_name(tick, name), error);
    return ok;
}

bool accept_check_whole(const diff_side *side, octreel_error *error)
{
    session_file file;
    view ignored;
    uint64_t digest, every;
    const char *folder = side->path;
    if (side->kind != DIFF_RECORDING)
        return true;
    if (!accept_check_ended(side, error) || !recording_read(folder, &ignored, &every, error) ||
        !check_file(folder, "session.json", error) || !check_file(folder, "ticks.jsonl", error) ||
        !read_session_file(folder, &file, &digest, error))
        return false;
    const bool ok = check_frames(folder, &file.session, every, error) &&
                    check_tick_line_count(folder, octree_session_length(&file.session) + 1, error);
    session_release(&file);
    return ok;
}
