/* SPDX-License-Identifier: MIT */
/* test_cli_audit_worst.c - octreel audit lists the worst answers first: those that no limit allows, then those beyond
 * the limits. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "fixture.h"
#include "recordings.h"

/* Balls around points 1 and 2: four answers that a limit of recall allows, then one error of each kind that no limit
 * allows. */
static void errors_that_no_limit_allows_come_first(void **state)
{
#define BALL(tick, answer) "{\"tick\":" tick ",\"queries\":[{\"radius\":1,\"at\":[1,0,0],\"answer\":" answer "}]}\n"
    static const char many[] = "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,"
                               "2],[0,3,0,3]]}\n" BALL("1", "[1]") BALL("2", "[1]") BALL("3", "[1]") BALL("4", "[1]")
                                   BALL("5", "[2,1]") BALL("6", "[1,2,4711]") BALL("7", "[2,1,2]");
    const place session = place_in(*state, "session.json");
    file_write_text(session.path, many);
    command_result result = run_octreel(NULL, "audit %s --allow recall=0.5", session.path);
    assert_int_equal(result.status, 1);
    const char *unknown = strstr(result.out, "\n  tick 6, answers[0]: names an id that no point has (4711)"),
               *twice = strstr(result.out, "\n  tick 7, answers[0]: names a point twice (2)"),
               *missing = strstr(result.out, "\n  tick 1, answers[0]: points are missing");
    assert_true(unknown && twice && missing && unknown < twice && twice < missing);
    assert_non_null(strstr(result.out,
                           "; first wrong at tick 1, beyond the allowed limits; 1 time: names an id that no "
                           "point has; 1 time: names a point twice; 4 times: points are missing; 4 times: "
                           "wrong only on the boundary of the ball\n"));
    command_release(&result);
#undef BALL
}

/* Three answers with neighbours twice as far, which ratio=2 allows; then one with a single neighbour, which only a
 * limit of recall would allow. */
static void errors_beyond_the_limits_come_before_errors_within(void **state)
{
#define PAIR(tick, answer) "{\"tick\":" tick ",\"queries\":[{\"knearest\":2,\"at\":[0,0,0],\"answer\":" answer "}]}\n"
    static const char many[] =
        "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,"
        "2],[0,4,0,3]]}\n" PAIR("1", "[2,3]") PAIR("2", "[2,3]") PAIR("3", "[2,3]") PAIR("4", "[1]");
    const place session = place_in(*state, "session.json");
    file_write_text(session.path, many);
    command_result result = run_octreel(NULL, "audit %s --allow ratio=2", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "4 wrong, beyond"));
    const char *few = strstr(result.out, "\n  tick 4, answers[0]: a wrong number"),
               *far = strstr(result.out, "\n  tick 1, answers[0]: a neighbour too far away");
    assert_true(few && far && few < far);
    command_release(&result);
#undef PAIR
}

/* Every report names the limits, if there are any, also for nodes and for right answers. */
static void every_report_names_the_limits(void **state)
{
#define WRONG "\"foreign_nodes\":[{\"id\":1,\"box\":{\"min\":[0,0,0],\"max\":[1,1,1]},\"points\":[1,9]}]"
#define ASKED(answer) "\"queries\":[{\"knearest\":2,\"at\":[0,0,0],\"answer\":" answer "}]"
    static const char *const sessions[] = {ASKED("[1,2]"), ASKED("[1]"), ASKED("[2,1,1]"), ASKED("[1,2]") "," WRONG};
    static const char *const limits[] = {"", "--allow ratio=4", "--allow recall=0.5", "--allow ratio=4,recall=0.5"};
    static const char *const reports[][2] = {
        {"", "allowed: "}, {"--json", "\"allowed\": {\"r"}, {"--html -", "Allowed: "}, {"--junit -", "; allowed: "}};
    const place session = place_in(*state, "session.json");
    for (int i = 0; i < 4 * 4 * 4; i++) {
        const char *limit = limits[i / 4 % 4], *const *report = reports[i % 4];
        const bool right = i / 16 == 0 || (i / 16 == 1 && strstr(limit, "recall"));
        char text[512];
        snprintf(text, sizeof text,
                 "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2]]}\n"
                 "{\"tick\":1,%s}\n",
                 sessions[i / 16]);
        file_write_text(session.path, text);
        command_result result = run_octreel(NULL, "audit %s %s %s", session.path, limit, report[0]);
        assert_int_equal(result.status, !right);
        if ((strstr(result.out, report[1]) != NULL) != (*limit != 0))
            fail_msg("%s %s %s: %s", text, limit, report[0], result.out);
        command_release(&result);
    }
#undef ASKED
#undef WRONG
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(errors_that_no_limit_allows_come_first),
        IN_FOLDER(errors_beyond_the_limits_come_before_errors_within),
        IN_FOLDER(every_report_names_the_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
