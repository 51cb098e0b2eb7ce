/* SPDX-License-Identifier: MIT */
/* test_action_comment.c - the action posts its verdict as one comment on the pull request, and updates it. gh is played
 * by gh_stand_in.py. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"
#include "workflow.h"

/* A pull request, and a checkout in which the action runs. */
typedef struct request {
    void *folder; /* a temp_folder */
    workflow run;
} request;

static void in_folder(const request *r, const char *line)
{
    command_result result =
        run_script("cd %s && PATH=\"$PWD/bin:$PATH\" && %s", ((temp_folder *)r->folder)->name, line);
    assert_done(&result);
    command_release(&result);
}

static int open_request(void **state)
{
    char line[4096];
    request *r = calloc(1, sizeof *r);
    *state = r;
    if (r == NULL || temp_folder_make(&r->folder) != 0)
        return -1;
    workflow_open(&r->run, r->folder, OCTREEL_ROOT "/.github/actions");
    workflow_set(&r->run, "github.token", "secret");
    workflow_set(&r->run, "github.workflow", "image tests");
    workflow_set(&r->run, "github.event.pull_request.number", "5");
    snprintf(line, sizeof line,
             "mkdir bin server && ln -s %s bin/octreel && cp %s bin/gh && chmod +x bin/gh && "
             "echo '[]' >server/comments.json && : >server/calls",
             octreel_program(), shell_quote(OCTREEL_ROOT "/tests/support/viz/gh_stand_in.py").text);
    in_folder(r, line);
    gallery_make(r->folder, "golden", "1.png 2.png");
    const place frames = gallery_make(r->folder, "frames", "1.png 2.png");
    gallery_write(place_below(frames.path, "2.png").path, 1, 5);
    return 0;
}

static int close_request(void **state)
{
    request *r = *state;
    workflow_close(&r->run);
    const int status = nested_folder_remove(&r->folder);
    free(r);
    return status;
}

/* Run the action, with more inputs if `more` is not null. The function releases `more`. */
static int run_with(request *r, const char *frames, json_t *more)
{
    json_t *inputs = json_pack("{s:s, s:s}", "reference", "golden", "frames", frames);
    if (more)
        json_object_update_new(inputs, more);
    const int status = workflow_run_action(&r->run, "diff", inputs, "it");
    json_decref(inputs);
    return status;
}

static json_t *read_comments(const request *r)
{
    char *text = file_read(place_in(r->folder, "server/comments.json").path, NULL);
    json_t *comments = json_loads(text, 0, NULL);
    free(text);
    assert_non_null(comments);
    return comments;
}

/* The test fails unless there are so many comments. Returns the text of the last one, which the caller frees. */
static char *last_comment(const request *r, size_t count)
{
    json_t *comments = read_comments(r);
    if (json_array_size(comments) != count)
        fail_msg("%zu comments, expected %zu", json_array_size(comments), count);
    const json_t *last = json_array_get(comments, count - 1);
    char *body = strdup(count ? json_string_value(json_object_get(last, "body")) : "");
    json_decref(comments);
    return body;
}

static void assert_comment_has(const request *r, size_t count, const char *part)
{
    char *body = last_comment(r, count);
    assert_contains(body, part);
    free(body);
}

static void assert_comment_lacks(const request *r, size_t count, const char *part)
{
    char *body = last_comment(r, count);
    if (strstr(body, part))
        fail_msg("\"%s\" in %s", part, body);
    free(body);
}

static size_t count_calls(const request *r, const char *part)
{
    char *calls = file_read(place_in(r->folder, "server/calls").path, NULL);
    size_t count = 0;
    for (const char *at = calls; (at = strstr(at, part)); at++)
        count++;
    free(calls);
    return count;
}

static void server_is(const request *r, const char *what)
{
    file_write_text(place_below(place_in(r->folder, "server").path, what).path, "");
}

/* ---- Posting and updating ------------------------------------------------------------------------------------ */

static void first_run_posts_a_comment_with_pictures(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_string_equal(r->run.err, "");
    assert_comment_has(r, 1, "<!-- octreel: image_tests/octreel_evidence, ");
    assert_comment_has(r, 1, "\n### octreel diff: different: 1 of 2 frames");
    assert_comment_has(r, 1, "| ![expected](https://github.test/attached/1.expected.png) |");
    assert_comment_has(r, 1, "octreel accept golden frames 2.png\n");
    assert_comment_has(r, 1, "[Pictures and report.html](https://github.test/artifact)\n");
    assert_int_equal(count_calls(r, "\"--attach\""), 3);
}

static void next_run_replaces_the_comment(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "frames", NULL), 1);
    in_folder(r, "cp golden/1.png frames/3.png");
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_comment_has(r, 1, "different: 2 of 3 frames");
    assert_comment_has(r, 1, "(https://github.test/attached/2.actual.png)");
}

static void equal_frames_update_a_comment_and_create_none(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "golden", NULL), 0);
    free(last_comment(r, 0));
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_int_equal(run_with(r, "golden", NULL), 0);
    assert_comment_has(r, 1, "### octreel diff: same: 2 frames");
    assert_comment_has(r, 1, "[The run](https://github.test/o/r/actions/runs/7)");
    assert_int_equal(count_calls(r, "\"PATCH\""), 1);
}

static void errors_update_a_comment_and_create_none(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "nothing", NULL), 2);
    free(last_comment(r, 0));
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_int_equal(run_with(r, "nothing", NULL), 2);
    assert_comment_has(r, 1, "### octreel diff: error\n\n    octreel: nothing: ");
}

/* ---- Whose comment it is ------------------------------------------------------------------------------------- */

static void comments_of_others_are_left_alone(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "frames", NULL), 1);
    /* another person quotes the marker, and this bot has another comment */
    in_folder(r, "python3 -c 'import json; c = json.load(open(\"server/comments.json\")); "
                 "c[0][\"viewerDidAuthor\"] = False; "
                 "c.append({\"url\": \"https://github.test/o/r/pull/5#issuecomment-2\", \"body\": \"coverage\", "
                 "\"viewerDidAuthor\": True}); json.dump(c, open(\"server/comments.json\", \"w\"))'");
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_int_equal(run_with(r, "frames", NULL), 1);
    free(last_comment(r, 3));
    assert_int_equal(count_calls(r, "\"DELETE\""), 1); /* of the second run's comment */
}

static void each_workflow_and_artifact_has_its_comment(void **state)
{
    request *r = *state;
    static const char *const workflows[] = {"a -->", "a ==>", "\"; touch owned; \"", "$(touch owned)"};
    for (int round = 0; round < 2; round++)
        for (size_t i = 0; i < sizeof workflows / sizeof *workflows; i++) {
            workflow_set(&r->run, "github.workflow", workflows[i]);
            assert_int_equal(run_with(r, "frames", NULL), 1);
        }
    assert_int_equal(run_with(r, "frames", json_pack("{s:s}", "artifact", "other")), 1);
    free(last_comment(r, 5));
    assert_string_equal(r->run.err, "");
    assert_false(file_exists(place_in(r->folder, "owned").path));
}

/* ---- Where pictures cannot be attached ----------------------------------------------------------------------- */

static void comment_without_pictures(request *r, const char *server)
{
    server_is(r, server);
    for (int round = 0; round < 2; round++) {
        assert_int_equal(run_with(r, "frames", NULL), 1);
        assert_comment_has(r, 1, "5 of 384 pixels differ");
        assert_comment_lacks(r, 1, "![");
        assert_comment_lacks(r, 1, "| expected");
        assert_comment_has(r, 1, "[Pictures and report.html](https://github.test/artifact)\n");
    }
    assert_int_equal(count_calls(r, "\"PATCH\""), 1);
}

static void old_gh_posts_without_pictures(void **state)
{
    comment_without_pictures(*state, "no-attach");
    assert_int_equal(count_calls(*state, "\"--attach\""), 0);
}

/* github.token is such a token. */
static void token_that_cannot_attach_posts_without_pictures(void **state)
{
    request *r = *state;
    comment_without_pictures(r, "token-refused");
    assert_contains(r->run.out, "The comment has no pictures: unsupported authentication type\n");
}

static void comment_counts_if_a_picture_fails(void **state)
{
    request *r = *state;
    server_is(r, "partial");
    for (int round = 0; round < 2; round++) {
        assert_int_equal(run_with(r, "frames", NULL), 1);
        assert_comment_has(r, 1, "![expected](https://");
    }
}

/* ---- Where no comment is possible ---------------------------------------------------------------------------- */

static void assert_notice(request *r, const char *notice, size_t comments)
{
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_contains(r->run.out, notice);
    assert_contains(r->run.out, "\n::error file=frames/2.png,title=octreel diff%3A ");
    assert_string_equal(r->run.err, "");
    free(last_comment(r, comments));
}

static void fork_without_a_token_keeps_annotations_and_artifact(void **state)
{
    request *r = *state;
    workflow_set(&r->run, "github.token", "");
    assert_notice(r, "::notice title=octreel diff::No comment on the pull request: there is no token. The summary", 0);
    assert_int_equal(json_array_size(r->run.used), 1); /* the upload */
}

static void read_only_token_keeps_annotations_and_artifact(void **state)
{
    request *r = *state;
    server_is(r, "read-only");
    assert_notice(r, "The comment cannot be posted: GraphQL: Resource not accessible by integration (addComment). ", 0);
}

static void failing_update_is_a_notice(void **state)
{
    request *r = *state;
    server_is(r, "no-attach");
    assert_int_equal(run_with(r, "frames", NULL), 1);
    server_is(r, "read-only");
    assert_notice(r, "The comment cannot be updated: gh: Resource not accessible by integration (HTTP 403). ", 1);
}

static void failing_gh_is_a_notice(void **state)
{
    request *r = *state;
    server_is(r, "down");
    assert_notice(r, "The comments of the pull request cannot be read: error connecting to github.test. ", 0);
}

static void missing_gh_is_a_notice(void **state)
{
    request *r = *state;
    if (is_program_installed("gh"))
        skip();
    in_folder(r, "rm bin/gh");
    assert_notice(r, "No comment on the pull request: gh is not installed. ", 0);
}

static void push_and_opted_out_runs_do_not_call_gh(void **state)
{
    request *r = *state;
    assert_int_equal(run_with(r, "frames", json_pack("{s:s}", "comment", "false")), 1);
    workflow_set(&r->run, "github.event.pull_request.number", "");
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_int_equal(count_calls(r, "["), 0);
}

/* A name that is a workflow command, or ends the table, in the log and in the comment. */
static void any_file_name_is_posted(void **state)
{
    request *r = *state;
    in_folder(
        r, "cp golden/1.png 'frames/<!-- _pictures -->.png' && cp golden/2.png 'frames/a|](x) $(touch owned).png' && "
           "cp golden/2.png 'frames/::add-mask::b.png'");
    assert_int_equal(run_with(r, "frames", NULL), 1);
    assert_comment_has(r, 1, "#### 4. ");
    assert_int_equal(count_calls(r, "\"--attach\""), 6);
    assert_false(file_exists(place_in(r->folder, "owned").path));
    assert_string_equal(r->run.err, "");
}

#define REQUEST(test) cmocka_unit_test_setup_teardown(test, open_request, close_request)

int main(void)
{
    skip_without_yaml();
    const struct CMUnitTest tests[] = {
        REQUEST(first_run_posts_a_comment_with_pictures),
        REQUEST(next_run_replaces_the_comment),
        REQUEST(equal_frames_update_a_comment_and_create_none),
        REQUEST(errors_update_a_comment_and_create_none),
        REQUEST(comments_of_others_are_left_alone),
        REQUEST(each_workflow_and_artifact_has_its_comment),
        REQUEST(old_gh_posts_without_pictures),
        REQUEST(token_that_cannot_attach_posts_without_pictures),
        REQUEST(comment_counts_if_a_picture_fails),
        REQUEST(fork_without_a_token_keeps_annotations_and_artifact),
        REQUEST(read_only_token_keeps_annotations_and_artifact),
        REQUEST(failing_update_is_a_notice),
        REQUEST(failing_gh_is_a_notice),
        REQUEST(missing_gh_is_a_notice),
        REQUEST(push_and_opted_out_runs_do_not_call_gh),
        REQUEST(any_file_name_is_posted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
