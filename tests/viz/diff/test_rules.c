/* SPDX-License-Identifier: MIT */
/* test_rules.c - rules in baselines: read, matched with frames, applied to stored pictures, refused with the number of
 * the line that is wrong. */
#include "baseline_text.h"
#include "files.h"
#include "fixture.h"
#include "rule.h"

#include <stdlib.h>
#include <string.h>

#define HEAD BASELINE_HEAD
#define ACCEPTED "accepted 7f 2026-11-22 24x16 runs the first\n"
#define A "7f 0123456789abcdef a\n"

/* Write the baseline, and what the reader makes of it again: both are the expected text. */
static void assert_written_as(const char *text, const char *expected)
{
    diff_side side = assert_baseline_parsed(text);
    for (int i = 0; i < 2; i++) {
        char *written = write_baseline_text(&side);
        assert_string_equal(written, expected);
        diff_side_release(&side);
        side = assert_baseline_parsed(written);
        free(written);
    }
    diff_side_release(&side);
}

static void rules_and_comments_keep_their_bytes_and_order(void **state)
{
    (void)state;
#define NOTES                                                                                                          \
    "# what Mesa draws otherwise\nrule  b   antialias  reason=a = b\nrule a max-delta=2e-2 reason=x\n#\n# end\n"
    assert_written_as(HEAD NOTES ACCEPTED A, HEAD NOTES ACCEPTED A);
    assert_written_as(HEAD "# what Mesa draws otherwise\n" ACCEPTED "rule  b   antialias  reason=a = b\n" A
                           "rule a max-delta=2e-2 reason=x\r\n#\n# end",
                      HEAD NOTES ACCEPTED A);
    assert_written_as(HEAD NOTES, HEAD NOTES);
}

static void rule_has_what_its_line_says(void **state)
{
    (void)state;
    diff_side side =
        assert_baseline_parsed(HEAD "rule menu/\\*\\ 1 max-pixels=7 max-delta=.02 max-channel=3 antialias flip=0.01 "
                                    "pixels-per-degree=40 ignore=1,2,3,4 ignore=5,6,7,8 ignore-mask=a/the\\ mask.png "
                                    "ignore-layer=nodes,text date=2026-11-22 expires=2027-02-28 reason=a  b = c\n");
    const baseline_rule *rule = &side.rules[0];
    const image_tolerance *t = &rule->tolerance;
    assert_int_equal(side.rule_count, 1);
    assert_int_equal(rule->line, 3);
    assert_string_equal(rule->pattern, "menu/\\*\\ 1");
    assert_true(t->max_pixels == 7 && t->max_channel == 3 && t->max_delta > 0.0199 && t->max_delta < 0.0201 &&
                t->antialias && t->flip);
    assert_true(t->max_flip > 0.0099 && t->max_flip < 0.0101 && t->pixels_per_degree > 39.9);
    assert_int_equal(t->ignored_count, 2);
    assert_int_equal(t->ignored[1].height, 8);
    assert_string_equal(rule->mask, "a/the mask.png");
    assert_string_equal(rule->layers, "nodes,text");
    assert_string_equal(rule->date, "2026-11-22");
    assert_string_equal(rule->expires, "2027-02-28");
    assert_string_equal(rule->reason, "a  b = c");
    assert_non_null(rule_find(&side, "menu/* 1.png"));
    diff_side_release(&side);
}

/* The second example of baseline.txt begins at the last line "octreel-digests 2"; its lines are indented by four
 * blanks. */
static void example_of_the_manual_is_valid(void **state)
{
    (void)state;
    char *text = file_read(OCTREEL_BASELINE_TEXT, NULL), example[4000] = "", *at = NULL;
    for (char *next = text; (next = strstr(next, "    octreel-digests 2\n")); next++)
        at = next;
    assert_non_null(at);
    while (strncmp(at, "    ", 4) == 0) {
        const size_t length = strcspn(at, "\n") + 1;
        strncat(example, at + 4, length - 4);
        at += length;
    }
    diff_side side = assert_baseline_parsed(example);
    assert_int_equal(side.rule_count, 5);
    assert_int_equal(side.count, 5);
    for (size_t i = 0; i < side.count; i++)
        assert_non_null(rule_find(&side, side.frames[i].name));
    assert_string_equal(rule_find(&side, "menu/clock.png")->reason, "the clock and the build number");
    diff_side_release(&side);
    free(text);
}

/* ---- Which rule ---------------------------------------------------------------------------------------------- */

static void pattern_matches_whole_names_with_or_without_their_ending(void **state)
{
    (void)state;
    static const struct {
        const char *pattern, *name;
        bool matches;
    } cases[] = {
        {"a", "a.png", true},          {"a.png", "a.png", true}, {"a", "ab.png", false},
        {"a", "b/a.png", false},       {"*", "b/a.png", true},   {"b/*", "b/c/a.png", true},
        {"*/a", "b/c/a.png", true},    {"*/a", "a.png", false},  {"?", "a.png", true},
        {"??", "a.png", false},        {"a?", "a.png", false},   {"*b*d", "abcbd.png", true},
        {"*b*d", "abcbdx.png", false}, {"a**", "a.png", true},   {"[a]", "a.png", false},
        {"t[a]", "t[a].png", true},    {"\\*", "a.png", false},  {"\\*", "*.png", true},
        {"\\?", "?.png", true},        {"\\a", "a.png", true},   {"\\\\", "\\.png", true},
        {"a\\ b", "a b.png", true},    {"*.png", "a.png", true}, {"A", "a.png", false},
        {"*a", "aaaa.png", true},      {"a*a", "a.png", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[200];
        snprintf(text, sizeof text, HEAD "rule %s antialias reason=x\n", cases[i].pattern);
        diff_side side = assert_baseline_parsed(text);
        if ((rule_find(&side, cases[i].name) != NULL) != cases[i].matches)
            fail_msg("%s: %s", cases[i].pattern, cases[i].name);
        diff_side_release(&side);
    }
}

static void most_specific_rule_counts_in_any_order_of_lines(void **state)
{
    (void)state;
#define RULE(pattern) "rule " pattern " antialias reason=x\n"
    static const struct {
        const char *rules;
        const char *name;
        size_t line; /* of the rule that counts */
    } cases[] = {
        {RULE("menu/1") RULE("menu/*"), "menu/1.png", 3},
        {RULE("menu/*") RULE("menu/1"), "menu/1.png", 4},
        {RULE("*") RULE("m*") RULE("*/1"), "menu/1.png", 5},
        {RULE("*/1") RULE("m*") RULE("*"), "menu/1.png", 3},
        {RULE("menu/?") RULE("menu/*"), "menu/1.png", 4},
        {RULE("menu/*") RULE("menu/?"), "menu/1.png", 4},
        {RULE("m\\*") RULE("m*"), "m*.png", 3},
        {RULE("a") RULE("a") RULE("b"), "a.png", 4},
        {RULE("??????") RULE("a*"), "abcdef.png", 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[400];
        snprintf(text, sizeof text, HEAD "%s", cases[i].rules);
        diff_side side = assert_baseline_parsed(text);
        const baseline_rule *rule = rule_find(&side, cases[i].name);
        assert_non_null(rule);
        if (rule->line != cases[i].line)
            fail_msg("case %zu: line %zu counts", i, rule->line);
        diff_side_release(&side);
    }
}

/* A matcher that tries all stars again would not end. */
static void hostile_pattern_is_matched_quickly(void **state)
{
    (void)state;
    char text[800] = HEAD "rule ", name[3000];
    for (int i = 0; i < 120; i++)
        strcat(text, "*a");
    strcat(text, "b antialias reason=x\n");
    memset(name, 'a', sizeof name - 1);
    name[sizeof name - 1] = 0;
    diff_side side = assert_baseline_parsed(text);
    assert_null(rule_find(&side, name));
    diff_side_release(&side);
}

/* ---- What is refused ----------------------------------------------------------------------------------------- */

static void malformed_rule_is_refused_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *rule, *part;
    } cases[] = {
        {"a antialias", "file:3: expected a rule with a reason, as in \"rule menu/*"},
        {"", "file:3: expected a rule with a reason"},
        {"a", "file:3: expected a rule with a reason"},
        {"a reason=why", "file:3: the rule forgives nothing; add a tolerance"},
        {"a max-delta=0 reason=why", "file:3: the rule forgives nothing"},
        {"a antialias reason=", "file:3: reason takes a text"},
        {"a antialias reason=why ", "file:3: reason takes a text"},
        {"a antialias reason", "file:3: reason takes a text"},
        {"a antialias color=3 reason=why", "file:3: unknown key \"color\"; the keys of a rule are max-"},
        {"a antialias why", "file:3: unknown key \"why\""},
        {"a antialias=1 reason=why", "file:3: antialias takes no value"},
        {"a max-delta=-0.1 reason=why", "file:3: max-delta takes a number from 0 to 1, not \"-0.1\""},
        {"a max-delta=nan reason=why", "file:3: max-delta takes a number from 0 to 1"},
        {"a max-delta reason=why", "file:3: max-delta takes a number from 0 to 1, not \"\""},
        {"a max-pixels=-1 reason=why", "file:3: max-pixels takes a whole number"},
        {"a max-pixels=101% reason=why", "file:3: max-pixels takes a whole number"},
        {"a max-channel=-1 reason=why", "file:3: max-channel takes a whole number from 0 to 65535"},
        {"a flip=1.5 reason=why", "file:3: flip takes a number from 0 to 1"},
        {"a antialias pixels-per-degree=30 reason=why", "file:3: pixels-per-degree has no effect without flip"},
        {"a flip=0.1 pixels-per-degree=0 reason=why", "file:3: pixels-per-degree takes a number from 1 to 200"},
        {"a ignore=0,0,0,5 reason=why", "file:3: ignore takes left, top, width and height"},
        {"a ignore=-1,0,5,5 reason=why", "file:3: ignore takes left, top, width and height"},
        {"a ignore=1,2,3 reason=why", "file:3: ignore takes left, top, width and height"},
        {"a ignore=24,0,5,5 reason=why", "file:3: the rectangle 24,0,5,5 lies outside of the frame a.png of 24x16"},
        {"* ignore=0,0,5,5 ignore=0,16,1,1 reason=why", "file:3: the rectangle 0,16,1,1 lies outside"},
        {"a ignore-mask= reason=why", "file:3: ignore-mask takes the path of a PNG"},
        {"a ignore-mask=/etc/passwd reason=why", "file:3: ignore-mask takes the path of a PNG below the folder"},
        {"a ignore-mask=../a.png reason=why", "file:3: ignore-mask takes the path of a PNG below the folder"},
        {"a antialias date=2026-02-30 reason=why", "file:3: date takes an existing date such as 2026-11-22"},
        {"a antialias expires=2026-2-3 reason=why", "file:3: expires takes an existing date"},
        {"a antialias expires= reason=why", "file:3: expires takes an existing date"},
        {"a antialias date=2026-11-22 expires=2026-11-21 reason=why",
         "file:3: the rule expires on 2026-11-21, before its date 2026-11-22"},
        {"a antialias date=2026-11-22 date=2026-11-22 reason=why", "file:3: date is given twice"},
        {"a max-delta=1 max-delta=1 reason=why", "file:3: max-delta is given twice"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        diff_side side;
        octreel_error error = {""};
        char text[400];
        snprintf(text, sizeof text, HEAD "rule %s\n" ACCEPTED A, cases[i].rule);
        if (parse_baseline(text, &side, &error) || !strstr(error.text, cases[i].part))
            fail_msg("case %zu: \"%s\" does not contain \"%s\"", i, error.text, cases[i].part);
        diff_side_release(&side);
    }
}

static void rules_are_limited(void **state)
{
    (void)state;
    static char text[64 * (RULES_MOST + 1)];
    diff_side side;
    octreel_error error = {""};
    size_t length = (size_t)sprintf(text, HEAD);
    for (int i = 0; i < RULES_MOST; i++)
        length += (size_t)sprintf(text + length, "rule %d antialias reason=x\n", i);
    side = assert_baseline_parsed(text);
    diff_side_release(&side);
    strcat(text, "rule a antialias reason=x\n");
    assert_false(parse_baseline(text, &side, &error));
    assert_contains(error.text, "file:1003: a baseline has at most 1000 rules");
    diff_side_release(&side);
    length = (size_t)sprintf(text, HEAD "rule a");
    for (int i = 0; i <= RULE_RECTANGLES_MOST; i++)
        length += (size_t)sprintf(text + length, " ignore=0,0,1,1");
    sprintf(text + length, " reason=x\n");
    assert_false(parse_baseline(text, &side, &error));
    assert_contains(error.text, "file:3: a rule has at most 64 rectangles; use ignore-mask");
    diff_side_release(&side);
    sprintf(text, HEAD "rule %0256d antialias reason=x\n", 0);
    assert_false(parse_baseline(text, &side, &error));
    assert_contains(error.text, "file:3: the pattern is longer than 255 characters");
    diff_side_release(&side);
}

/* ---- Dates --------------------------------------------------------------------------------------------------- */

static void rule_forgives_on_its_last_day_and_not_after_it(void **state)
{
    (void)state;
    const baseline_rule rule = {.expires = "2026-12-31"}, endless = {0};
    assert_false(rule_has_expired(&rule, "2026-11-22"));
    assert_false(rule_has_expired(&rule, "2026-12-31"));
    assert_true(rule_has_expired(&rule, "2027-01-01"));
    assert_false(rule_has_expired(&rule, ""));
    assert_false(rule_has_expired(&endless, "9999-12-31"));
}

static void source_date_epoch_is_today_in_utc(void **state)
{
    (void)state;
    static const struct {
        const char *epoch, *date;
    } right[] = {{"0", "1970-01-01"},
                 {"1795737599", "2026-11-26"},
                 {"1795737600", "2026-11-27"},
                 {"253402300799", "9999-12-31"}};
    static const char *const wrong[] = {"", "-1", "tomorrow", "1795737600 ", "253402300800"};
    char today[11];
    octreel_error error;
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
        assert_int_equal(setenv("SOURCE_DATE_EPOCH", right[i].epoch, 1), 0);
        assert_true(rule_today(today, &error));
        assert_string_equal(today, right[i].date);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(setenv("SOURCE_DATE_EPOCH", wrong[i], 1), 0);
        assert_false(rule_today(today, &error));
        assert_contains(error.text, "SOURCE_DATE_EPOCH is \"");
    }
    assert_int_equal(unsetenv("SOURCE_DATE_EPOCH"), 0);
    assert_true(rule_today(today, &error) && baseline_is_date(today));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_and_comments_keep_their_bytes_and_order),
        cmocka_unit_test(rule_has_what_its_line_says),
        cmocka_unit_test(example_of_the_manual_is_valid),
        cmocka_unit_test(pattern_matches_whole_names_with_or_without_their_ending),
        cmocka_unit_test(most_specific_rule_counts_in_any_order_of_lines),
        cmocka_unit_test(hostile_pattern_is_matched_quickly),
        cmocka_unit_test(malformed_rule_is_refused_with_its_line),
        cmocka_unit_test(rules_are_limited),
        cmocka_unit_test(rule_forgives_on_its_last_day_and_not_after_it),
        cmocka_unit_test(source_date_epoch_is_today_in_utc),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
