/* SPDX-License-Identifier: MIT */
/* test_session_text.c - session.txt agrees with the code: its examples parse, and it names every member and kind. */
#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "fixture.h"
#include "octree/sample.h"
#include "session_members.h"

#define INDENT "    "

static int read_text(void **state)
{
    *state = file_read(OCTREEL_SESSION_TEXT, NULL);
    return 0;
}

static int free_text(void **state)
{
    free(*state);
    return 0;
}

/* Find the next indented example from *at on, and advance *at beyond it. The caller frees it; null after the last. */
static char *next_example(const char **at)
{
    const char *begin = strstr(*at, "\n\n" INDENT);
    if (begin == NULL)
        return NULL;
    const char *end = strstr(begin + 2, "\n\n");
    assert_non_null(end);
    *at = end;
    return strndup(begin, (size_t)(end - begin));
}

static void session_text_examples_parse_as_sessions(void **state)
{
    const char *at = *state;
    session_file files[3] = {0};
    size_t count = 0;
    for (char *example; (example = next_example(&at)) != NULL; free(example)) {
        octreel_error error;
        assert_true(count < 3);
        if (!session_parse("session.txt", "", example, strlen(example), &files[count++], &error))
            fail_msg("%s", error.text);
    }
    assert_int_equal(count, 2);
    assert_int_equal(files[0].session.ticks, 100);
    const octree_session *s = &files[1].session;
    assert_true(s->body_count == 3 && s->edit_count == 3 && s->query_count == 2 && s->shape_count == 2 && s->keys);
    for (size_t i = 0; i < count; i++)
        session_release(&files[i]);
}

static void assert_names(const char *text, const char *name)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\"", name);
    if (strstr(text, quoted) == NULL)
        fail_msg("session.txt does not name %s", quoted);
}

static void assert_names_members(const char *text, const json_member *members)
{
    for (; members->name != NULL; members++) {
        assert_names(text, members->name);
        if (members->members != NULL)
            assert_names_members(text, members->members);
    }
}

static void session_text_names_every_member_and_kind(void **state)
{
    const char *text = *state;
    assert_names_members(text, session_header_members);
    assert_names_members(text, session_tick_members);
    assert_names_members(text, session_body_members);
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++)
        assert_names(text, octree_query_name((octree_query_kind)kind));
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++)
        assert_names(text, octree_query_member_at(i)->key);
    assert_names(text, "skip");
    assert_names(text, "coincident");
    assert_names(text, "epsilon");
    assert_names(text, "answer");
    assert_names(text, "mode");
    assert_names(text, "bounds");
    for (int bounds = 0; bounds < OCTREE_BOUNDS_KINDS; bounds++)
        assert_names(text, octree_bounds_name((octree_bounds)bounds));
    for (int precision = 0; precision < OCTREE_PRECISIONS; precision++)
        assert_names(text, octree_precision_name((octree_precision)precision));
    for (int kind = 0; kind < OCTREE_SHAPE_KINDS; kind++)
        assert_names(text, octree_shape_name((octree_shape_kind)kind));
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        assert_names(text, octree_sample_name((octree_sample_kind)kind));
}

/* `octreel help session` prints it on any terminal. */
static void session_text_is_ascii_in_lines_of_120(void **state)
{
    size_t column = 0;
    for (const char *at = *state; *at != 0; at++) {
        column = *at == '\n' ? 0 : column + 1;
        assert_true(*at == '\n' || (*at >= ' ' && *at <= '~'));
        assert_true(column <= 120);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(session_text_examples_parse_as_sessions),
        cmocka_unit_test(session_text_names_every_member_and_kind),
        cmocka_unit_test(session_text_is_ascii_in_lines_of_120),
    };
    return cmocka_run_group_tests(tests, read_text, free_text);
}
