/* SPDX-License-Identifier: MIT */
/* test_session_pairs.c - foreign pairs in session files survive the round trip, invalid ones are refused, and
 * ticks.jsonl has their judgement. */
#include "fixture.h"
#include "session_file.h"
#include "session_texts.h"
#include "ticks_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER                                                                                                         \
    "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[{\"id\":1,\"position\":[0,0,0],\"half\":"      \
    "[1,1,1]},[1,0,0,2],[9,0,0,3]],\n\"ticks\":3"
#define TICK_1 "}\n{\"tick\":1,\"pairs\":"

static void pairs_survive_the_round_trip(void **state)
{
    (void)state;
    session_file file = session_of_text(HEADER ",\"pairs\":true}\n{\"tick\":0,\"pairs\":[]}\n"
                                               "{\"tick\":2,\"pairs\":[[2,1],[9007199254740991,3]]}"),
                 copy;
    octreel_error error;
    assert_true(session_copy(&file.session, &copy, &error));
    char *text = text_of_session(&copy.session, NULL);
    session_release(&file);
    session_file again = session_of_text(text);
    const octree_session *s = &again.session;
    assert_true(s->pairs && s->foreign_pairs_count == 2 && s->foreign_pairs[0].tick == 0);
    assert_true(s->foreign_pairs[0].pair_count == 0 && s->foreign_pairs[1].tick == 2);
    const octree_foreign_pairs *list = &s->foreign_pairs[1];
    assert_true(list->pair_count == 2 && list->pairs[0].a == 2 && list->pairs[0].b == 1);
    assert_true(list->pairs[1].a == 9007199254740991 && list->pairs[1].b == 3);
    char *second = text_of_session(s, NULL);
    assert_string_equal(text, second);
    assert_non_null(strstr(text, "\n{\"tick\": 0, \"pairs\": []}\n"));
    assert_non_null(strstr(text, "\n{\"tick\": 2, \"pairs\": [[2, 1], [9007199254740991, 3]]}\n"));
    free(text);
    free(second);
    session_release(&copy);
    session_release(&again);
}

static void invalid_pairs_are_refused_with_line_and_member(void **state)
{
    (void)state;
    static const char list[] = "expected a list of pairs of ids, such as [[1, 2], [3, 4]], found ";
    char sentence[200];
    snprintf(sentence, sizeof sentence, "s.json:3: pairs: %strue", list);
    assert_session_refused(HEADER TICK_1 "true}", sentence);
    snprintf(sentence, sizeof sentence, "s.json:3: pairs: %san object", list);
    assert_session_refused(HEADER TICK_1 "{}}", sentence);
    assert_session_refused(HEADER TICK_1 "[1,2]}", "s.json:3: pairs[0]: expected two ids [a, b], found 1");
    assert_session_refused(HEADER TICK_1 "[[1,2],\n[3]]}",
                           "s.json:4: pairs[1]: expected two ids [a, b], found a list of 1");
    assert_session_refused(HEADER TICK_1 "[[1,2,3]]}",
                           "s.json:3: pairs[0]: expected two ids [a, b], found a list of 3");
    assert_session_refused(HEADER TICK_1 "[[1,2.5]]}",
                           "s.json:3: pairs[0][1]: expected a whole number from 0 to 9007199254740991, found 2.5");
    assert_session_refused(HEADER TICK_1 "[[\"1\",2]]}",
                           "s.json:3: pairs[0][0]: expected a whole number from 0 to 9007199254740991, found \"1\"");
    assert_session_refused(
        HEADER TICK_1 "[[1,9007199254740992]]}",
        "s.json:3: pairs[0][1]: expected a whole number from 0 to 9007199254740991, found 9007199254740992");
    assert_session_refused(HEADER TICK_1 "[[4,4]]}",
                           "s.json:3: pairs[0]: a pair must consist of two different ids, not twice 4");
    assert_session_refused(
        HEADER ",\"pairs\":[[1,2]]}",
        "s.json:2: pairs: the header has true or false here; the pairs that your index found at a tick "
        "belong in the object of that tick, such as {\"tick\": 0, \"pairs\": [[1, 2]]}");
    assert_session_refused(HEADER ",\"pairs\":1}", "s.json:2: pairs: expected true or false, found 1");
    assert_session_refused(HEADER TICK_1 "[],\"gap\":\"lost\"}",
                           "s.json:3: a tick with \"gap\" must have no other member but \"tick\"");
}

static char *write_tick(const octree_session *session)
{
    octree_game *game;
    char *text;
    size_t size;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
    assert_int_equal(fclose(out), 0);
    octree_game_destroy(game);
    return text;
}

static void assert_tick_has(const char *pairs, const char *expected)
{
    char text[400];
    snprintf(text, sizeof text, HEADER "}\n{\"tick\":0,\"pairs\":%s}", pairs);
    session_file file = session_of_text(text);
    char *line = write_tick(&file.session);
    if (!strstr(line, expected))
        fail_msg("%s", line);
    free(line);
    session_release(&file);
}

static void ticks_have_the_judgement_of_pairs(void **state)
{
    (void)state;
    assert_tick_has("[[2,1]]", "\"events\": [], ");
    assert_tick_has("[[2,1]]", ", \"foreign_pairs\": {\"given\": [[1, 2]], \"wrong\": \"none\", \"expected\": 1}, ");
    assert_tick_has("[[3,2]]", "\"events\": [\"wrong\"], ");
    assert_tick_has("[[3,2]]", "{\"given\": [[2, 3]], \"wrong\": \"missing\", \"expected\": 1, \"missing\": [[1, 2]], "
                               "\"extra\": [[2, 3]]}");
    assert_tick_has("[[1,2],[8,2]]", "{\"given\": [[1, 2], [2, 8]], \"wrong\": \"unknown\", \"wrong_pair\": [8, 2], "
                                     "\"expected\": 1}");
    assert_tick_has("[[1,2],[2,1]]", "\"wrong\": \"duplicate\", \"wrong_pair\": [1, 2], \"expected\": 1}");
}

/* More than 256 pairs are counted. */
static void long_lists_of_pairs_are_counted(void **state)
{
    (void)state;
    static octree_pair pairs[257];
    const octree_foreign_pairs list = {.pairs = pairs, .pair_count = 257};
    session_file file = session_of_text(HEADER "}");
    for (size_t i = 0; i < 257; i++)
        pairs[i] = (octree_pair){1, 2};
    octree_session session = file.session;
    session.foreign_pairs = &list;
    session.foreign_pairs_count = 1;
    char *line = write_tick(&session);
    assert_non_null(strstr(line, "\"foreign_pairs\": {\"given\": {\"count\": 257, \"digest\": \""));
    assert_non_null(strstr(line, "\"}, \"wrong\": \"duplicate\", \"wrong_pair\": [1, 2], \"expected\": 1}"));
    free(line);
    session_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_survive_the_round_trip),
        cmocka_unit_test(invalid_pairs_are_refused_with_line_and_member),
        cmocka_unit_test(ticks_have_the_judgement_of_pairs),
        cmocka_unit_test(long_lists_of_pairs_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
