/* SPDX-License-Identifier: MIT */
/* recorded.c - reads the files of a recording and checks that they agree with its session. */
#include "recorded.h"
#include "array.h"
#include "frame_file.h"
#include "text.h"
#include "ticks_write.h"
#include "folder_files.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* The longest line of ticks.jsonl that is read, in bytes. */
#define LONGEST_LINE ((size_t)1 << 26)

static void add_warning(recorded *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (r->warning_count < RECORDED_WARNINGS)
        vsnprintf(r->warnings[r->warning_count++], sizeof *r->warnings, format, arguments);
    va_end(arguments);
}

/* ---- Opening ------------------------------------------------------------------------------------------------- */

/* Check that the first frame of the recording names the recording's session. */
static void check_session_digest(recorded *r)
{
    uint64_t tick;
    r->frames_session = r->replay.session_digest;
    if (r->side->count > 0 && frame_parse_name(r->side->frames[0].name, &tick) &&
        frame_read_session_digest(r->side->path, tick, &r->frames_session) &&
        r->frames_session != r->replay.session_digest)
        add_warning(r, "%s/session.json is not the session that was recorded", r->side->path);
}

bool recorded_open(recorded *r, const diff_side *side, octreel_error *error)
{
    *r = (recorded){.side = side};
    describe_recorded_renderer(side->path, r->drawn_by, sizeof r->drawn_by);
    if (!replay_read(&r->replay, side->path, side->max_ticks, error))
        return false;
    r->view = (cause_view){r->replay.film.view, r->replay.film.every};
    check_session_digest(r);
    r->reading = line_reader_open(&r->lines, side->path, error);
    return r->reading;
}

void recorded_close(recorded *r)
{
    line_reader_close(&r->lines);
    free(r->scenes);
    replay_close(&r->replay);
    *r = (recorded){0};
}

/* ---- Lines --------------------------------------------------------------------------------------------------- */

uint64_t recorded_scene_digest(const recorded *r, uint64_t tick)
{
    return tick < r->scene_count ? r->scenes[tick] : 0;
}

static bool read_line(recorded *r, uint64_t tick, octreel_error *error)
{
    static const char *const words[] = {
        [LINE_WHOLE] = "",
        [LINE_TORN] = "is incomplete: the file ends in the middle of",
        [LINE_LONG] = "has a line that is too long for",
        [LINE_NONE] = "ends before",
        [LINE_TROUBLE] = "cannot be read at",
    };
    if (!r->reading)
        return true;
    const line_state state = line_reader_next(&r->lines, LONGEST_LINE);
    r->reading = state == LINE_WHOLE;
    if (!r->reading) {
        add_warning(r, "%s/ticks.jsonl %s tick %" PRIu64, r->side->path, words[state], tick);
        return true;
    }
    uint64_t scene = 0;
    if (!array_grow(&r->scenes, r->scene_count + 1, &r->scene_room, sizeof *r->scenes))
        return error_no_memory(error);
    r->scenes[r->scene_count++] = tick_read_scene_digest(r->lines.line, r->lines.size, tick, &scene) ? scene : 0;
    return true;
}

/* Return the values of a line of ticks.jsonl that do not follow from the tick itself. `name` receives the name of the
 * tick's frame; the result points to `name`. This function does not build the scene. It therefore reads the digest of
 * the scene from the frame or, if the frame has none, from the line. */
static tick_extras make_tick_extras(const recorded *r, const octree_tick *tick, char name[FRAME_NAME])
{
    uint64_t scene = 0;
    if (tick->gap || !frame_is_due(tick->number, r->view.every))
        return (tick_extras){0};
    if (!frame_read_scene_digest(r->side->path, tick->number, &scene))
        scene = recorded_scene_digest(r, tick->number);
    return (tick_extras){.frame = frame_print_name(tick->number, name), .scene_digest = scene};
}

static bool check_line(recorded *r, const octree_game *game, octreel_error *error)
{
    const octree_tick *tick = octree_game_tick(game);
    verify_finding finding = {.kind = VERIFY_LINES};
    char name[FRAME_NAME], *text;
    text_stream s;
    if (!r->reading)
        return true;
    const tick_extras extras = make_tick_extras(r, tick, name);
    if (text_stream_begin(&s))
        tick_write(s.stream, tick, &extras);
    if (!text_stream_end(&s, &text))
        return error_no_memory(error);
    const expected_line expected = {text, s.size, tick, &extras};
    r->reading = line_matches(&r->lines, &expected, &finding);
    free(text);
    if (!r->reading)
        add_warning(r, "%s/ticks.jsonl at tick %" PRIu64 " differs from what its session gives: %s", r->side->path,
                    tick->number, finding.text);
    return true;
}

/* Compare the lines of both recordings' ticks.jsonl with the games. If the ticks are equal and the lines are equal,
 * nothing is checked: then either both lines are right or both are wrong. */
bool recorded_check_tick(recorded sides[2], const octree_game *const games[2], bool differs, octreel_error *error)
{
    const uint64_t tick = octree_game_tick(games[0])->number;
    if (!read_line(&sides[0], tick, error) || !read_line(&sides[1], tick, error))
        return false;
    const line_reader *x = &sides[0].lines, *y = &sides[1].lines;
    if (sides[0].reading && sides[1].reading && !differs && x->size == y->size &&
        memcmp(x->line, y->line, x->size) == 0)
        return true;
    return check_line(&sides[0], games[0], error) && check_line(&sides[1], games[1], error);
}
