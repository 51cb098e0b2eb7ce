/* SPDX-License-Identifier: MIT */
/* film_again.c - see film_again.h. */
#include "film_again.h"
#include "frame_file.h"

#include <jansson.h>
#include <stdlib.h>

#include "fixture.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"
#include "verified.h"
#include "recording_file.h"

static void film_session_of(const place *folder, const place *again)
{
    const place path = place_below(folder->path, "session.json");
    film_options options = {.folder = again->path};
    octreel_error error = {""};
    octreel_error unread = {""};
    session_file file;
    if (!recording_read(folder->path, &options.view, &options.every, &error))
        fail_msg("%s", error.text);
    if (!session_read(path.path, &file, &unread))
        fail_msg("%s", unread.text);
    assert_filmed(&file.session, &options);
    session_release(&file);
}

typedef struct frame_count {
    uint64_t every, frames;
} frame_count;

/* Gaps have none. */
static void count_frame(const char *line, size_t number, void *context)
{
    frame_count *c = context;
    json_t *tick = json_read(line);
    c->frames += frame_is_due(number, c->every) && !json_object_get(tick, "gap");
    json_decref(tick);
}

static uint64_t frames_of(const place *folder)
{
    octreel_error error;
    frame_count c = {0};
    view ignored;
    assert_true(recording_read(folder->path, &ignored, &c.every, &error));
    for_each_line(folder->path, count_frame, &c);
    return c.frames;
}

void assert_films_again(const place *folder, const place *again, uint64_t ticks)
{
    assert_identical(folder, ticks, frames_of(folder));
    film_session_of(folder, again);
    assert_same_folders(folder->path, again->path, NULL);
}

typedef struct digest_list {
    uint64_t *digests;
    size_t room, count;
} digest_list;

static void take_digest(const char *line, size_t number, void *context)
{
    digest_list *list = context;
    json_t *tick = json_read(line);
    assert_true(number < list->room);
    if (json_object_get(tick, "gap")) {
        list->digests[list->count++] = 0;
        json_decref(tick);
        return;
    }
    assert_int_equal(json_array_size(json_member(tick, "refusals")), 0);
    list->digests[list->count++] =
        strtoull(json_string_value(json_member(json_member(tick, "tree"), "digest")), NULL, 16);
    json_decref(tick);
}

size_t tree_digests(const char *folder, uint64_t *digests, size_t room)
{
    digest_list list = {digests, room, 0};
    for_each_line(folder, take_digest, &list);
    return list.count;
}
