/* SPDX-License-Identifier: MIT */
/* test_cause_answers.c - two sessions with different answers of a foreign index: the number of additional wrong
 * answers, and the tick of the first. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cause_words.h"
#include "fixture.h"
#include "game_fixture.h"
#include "layer.h"
#include "text.h"
#include "recording_file.h"

enum { TICKS = 6 };

static const octree_game_body bodies[] = {{.id = 1, .position = {1, 0, 0}}, {.id = 2, .position = {2, 0, 0}}};

/* What a program answered in each tick to "what is nearest to the origin": one id, 1 is right. '-': it was not asked.
 */
typedef struct told {
    octree_query queries[TICKS];
    uint64_t answers[TICKS];
    octree_session session;
} told;

static void tell(told *t, const char *answers)
{
    size_t count = 0;
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        if (answers[tick] == '-')
            continue;
        t->answers[count] = (uint64_t)(answers[tick] - '0');
        t->queries[count] = (octree_query){.tick = tick,
                                           .kind = OCTREE_QUERY_NEAREST,
                                           .answered = true,
                                           .answer = &t->answers[count],
                                           .answer_count = 1};
        count++;
    }
    t->session = small_session(bodies, 2);
    t->session.player.kind = OCTREE_PLAYER_NONE;
    t->session.ticks = TICKS - 1;
    t->session.queries = t->queries;
    t->session.query_count = count;
}

static char *headline_of(const char *before, const char *now, cause *c)
{
    told a, b;
    octreel_error error;
    const cause_watcher watcher = {.first = 1};
    text_stream s;
    char *text;
    tell(&a, before);
    tell(&b, now);
    assert_true(cause_find(&(session_file){.session = a.session}, &(session_file){.session = b.session}, NULL, &watcher,
                           c, &error));
    assert_true(text_stream_begin(&s));
    cause_print_headline(s.stream, c);
    assert_true(text_stream_end(&s, &text));
    return text;
}

static void assert_headline(const char *before, const char *now, const char *expected)
{
    cause c;
    char *text = headline_of(before, now, &c);
    if (strncmp(text, expected, strlen(expected)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", text, expected);
    free(text);
    cause_release(&c);
}

static void assert_headline_ends(const char *before, const char *now, const char *expected)
{
    cause c;
    char *text = headline_of(before, now, &c);
    const size_t length = strlen(text), end = strlen(expected);
    if (length < end || strcmp(text + length - end, expected) != 0)
        fail_msg("\"%s\" does not end with \"%s\"", text, expected);
    free(text);
    cause_release(&c);
}

static void more_and_fewer_wrong_answers_are_counted_from_their_first_tick(void **state)
{
    (void)state;
    assert_headline("111111", "111121", "1 more wrong answer at tick 4; the foreign answer changed at tick 4");
    assert_headline("111111", "112212", "3 more wrong answers from tick 2 on; ");
    assert_headline("122222", "111111", "5 fewer wrong answers from tick 1 on; ");
    assert_headline("121111", "112212",
                    "1 fewer wrong answer at tick 1; 4 foreign answers changed, the first at tick 1");
    assert_headline_ends("121111", "112212", "; 3 more wrong answers from tick 2 on");
    assert_headline("1-----", "122---", "2 more wrong answers from tick 1 on; ");
}

static void equally_many_wrong_answers_with_other_errors_are_reported(void **state)
{
    (void)state;
    assert_headline("112111", "119111", "other wrong answers at tick 2; ");
    assert_headline("182182", "192122", "other wrong answers in 2 ticks from tick 1 on; ");
}

static void answers_with_unchanged_judgement_are_not_reported_as_wrong(void **state)
{
    (void)state;
    cause c;
    char *text = headline_of("111111", "1111--", &c);
    assert_null(strstr(text, "wrong"));
    assert_non_null(strstr(text, "fewer"));
    free(text);
    cause_release(&c);
    text = headline_of("122111", "122111", &c);
    assert_null(text); /* nothing to say */
    cause_release(&c);
}

/* ---- A layer that a recording of before does not name -------------------------------------------------------- */

static size_t view_groups(const char *answers)
{
    told t;
    cause c;
    octreel_error error;
    cause_view views[2] = {{view_make_default(), 1}, {view_make_default(), 1}};
    views[0].view.layers &= ~(1u << LAYER_WRONG);
    tell(&t, answers);
    assert_true(cause_find(&(session_file){.session = t.session}, &(session_file){.session = t.session}, views,
                           &(cause_watcher){.first = 0}, &c, &error));
    const size_t groups = c.view.count;
    cause_release(&c);
    return groups;
}

static void layer_that_is_empty_in_both_sessions_is_no_difference_of_the_view(void **state)
{
    (void)state;
    assert_int_equal(view_groups("------"), 0);
    assert_int_equal(view_groups("---1--"), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_and_fewer_wrong_answers_are_counted_from_their_first_tick),
        cmocka_unit_test(equally_many_wrong_answers_with_other_errors_are_reported),
        cmocka_unit_test(answers_with_unchanged_judgement_are_not_reported_as_wrong),
        cmocka_unit_test(layer_that_is_empty_in_both_sessions_is_no_difference_of_the_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
