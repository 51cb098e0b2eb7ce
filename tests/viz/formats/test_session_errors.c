/* SPDX-License-Identifier: MIT */
/* test_session_errors.c - invalid session files, and the error that each one yields. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "session_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\":\"session\",\"version\":2,\n"

/* An invalid text and the beginning of its expected error, without the file's name. */
typedef struct refusal {
    const char *text, *sentence;
} refusal;

static void assert_refuses(const char *text, size_t size, const char *sentence)
{
    session_file file;
    octreel_error error = {""};
    char expected[512];
    snprintf(expected, sizeof expected, "s.json:%s", sentence);
    if (session_parse("s.json", "", text, size, &file, &error))
        fail_msg("accepted instead of: %s", expected);
    if (strncmp(error.text, expected, strlen(expected)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", error.text, expected);
    assert_null(file.session.bodies);
    assert_null(file.session.keys);
    assert_int_equal(file.session.edit_count + file.session.query_count, 0);
}

/* At most 1000000 ticks after the last object, or more if the header has "ticks". */
static void distant_ticks_are_read_if_keys_or_ticks_reach_them(void **state)
{
    static const char *const texts[] = {
        HEADER "\"points\":[]}{\"tick\":1000000}{\"tick\":2000000}",
        HEADER "\"points\":[],\"ticks\":900000000}{\"tick\":800000000}",
    };
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        session_file file;
        octreel_error error = {""};
        if (!session_parse("s.json", "", texts[i], strlen(texts[i]), &file, &error))
            fail_msg("%s", error.text);
        session_release(&file);
    }
}

static void assert_refuses_each(const refusal *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_refuses(rows[i].text, strlen(rows[i].text), rows[i].sentence);
}

static void text_that_is_not_a_stream_of_objects_is_refused(void **state)
{
    static const refusal rows[] = {
        {"", "1: holds no session"},
        {"\n \n", "3: holds no session"},
        {"hello", "1: '{' expected near 'hello'"},
        {"[1]", "1: expected an object, found a list of 1"},
        {"{}", "1: is not a session: the first object has no \"octreel\": \"session\""},
        {"\n{\"tick\":0}", "2: is not a session: "},
        {HEADER, "2: string or '}' expected near end of file"},
        {HEADER "\"keys\":\"ww", "2: premature end of input near '\"ww'"},
        {HEADER "\"points\":[[1,2,3],\n", "3: ']' expected near end of file"},
        {HEADER "\"ticks\":NaN}", "2: invalid token near 'NaN'"},
        {HEADER "\"ticks\":1,\n\"ticks\":2}", "3: duplicate object key near '\"ticks\"'"},
        {HEADER "\"ticks\":1}\n\n x", "4: '{' expected near 'x'"},
        {HEADER "\"ticks\":1}\n}", "3: '{' expected near '}'"},
        {HEADER "\"ticks\":1}\n[]", "3: expected an object, found a list of 0"},
        {HEADER "\"ticks\":1}\n" HEADER "\"ticks\":1}", "3: this is a second header; only objects of ticks may follow"},
        {HEADER "\"keys\":\"\\u0000\"}", "2: a text cannot contain \\u0000 near '"},
        {HEADER "\"keys\":\"\xff\"}", "2: unable to decode byte 0xff"},
        {HEADER "\x1b[31m", "2: string or '}' expected near '?'"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

static void answers_that_are_not_ids_are_refused(void **state)
{
    static const refusal rows[] = {
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\n\"answer\":17}]}", "3: queries[0].answer: expected a list of ids"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[]},{\"nearest\":[0,0,0],\n\"answer\":[1,\n-2]}]}",
         "4: queries[1].answer[1]: expected a whole number from 0 to"},
        {HEADER "\"ticks\":1}\n{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1,\"a\"]}]}",
         "3: queries[0].answer[1]: expected a whole number"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":null}]}", "2: queries[0].answer: expected a list of ids"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1.5]}]}", "2: queries[0].answer[0]: expected a whole"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[[1]]}]}", "2: queries[0].answer[0]: expected a whole"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[3,true]}]}",
         "2: queries[0].answer[1]: expected a whole"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[9007199254740992]}]}",
         "2: queries[0].answer[0]: expected a whole"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1],\"answer\":[2]}]}", "2: duplicate object key"},
        {HEADER "\"queries\":[{\"answer\":[1]}]}", "2: queries[0]: expected {\"range\": ...}"},
        {HEADER "\"shapes\":[{\"point\":[0,0,0],\"answer\":[1]}]}", "2: shapes[0]: unknown member \"answer\""},
        {HEADER "\"ticks\":1}\n{\"tick\":1,\"edits\":[{\"remove\":1,\"answer\":[1]}]}",
         "3: edits[0]: unknown member \"answer\""},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1],\"mode\":\"half\"}]}", "2: queries[0].mode: "},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"mode\":\"float\"}]}",
         "2: queries[0].mode: \"mode\" needs an \"answer\" or \"pruned\", and this query has neither"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1]}]}\n{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0],"
                "\"answer\":[1]}]}\n{\"tick\":1}",
         "4: tick: tick 1 follows tick 1"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

static void nul_bytes_are_refused(void **state)
{
    static const char text[] = HEADER "\"ticks\":1}\n\0\n";
    (void)state;
    assert_refuses(text, sizeof text - 1, "3: holds a NUL byte, so it is not text");
}

static void invalid_shapes_are_refused(void **state)
{
    static const refusal rows[] = {
        {HEADER "\"shapes\":{}}", "2: shapes: expected a list of shapes, found an object"},
        {HEADER "\"shapes\":[{\"ball\":1}]}", "2: shapes[0]: expected {\"box\": ...}, {\"segment\": ...}, "
                                              "{\"point\": ...} or {\"label\": ...}"},
        {HEADER "\"shapes\":[{\"point\":[1,2,3],\"label\":\"a\"}]}",
         "2: shapes[0]: expected one of {\"box\": ...}, {\"segment\": ...}, {\"point\": ...} or {\"label\": ...}, "
         "found "
         "\"point\" and \"label\" together"},
        {HEADER "\"shapes\":[{\"point\":[1,2]}]}", "2: shapes[0].point: expected"},
        {HEADER "\"shapes\":[{\"segment\":[1,2,3]}]}",
         "2: shapes[0].segment: expected two positions [[x, y, z], [x, y, z]], found a list of 3"},
        {HEADER "\"shapes\":[{\"box\":{\"min\":[0,0,5],\"max\":[0,0,4]}}]}",
         "2: shapes[0].box: min is above max on axis z"},
        {HEADER "\"shapes\":[{\"label\":\"a\"}]}", "2: shapes[0]: the member \"at\" is missing"},
        {HEADER "\"shapes\":[{\"label\":5,\"at\":[0,0,0]}]}", "2: shapes[0].label: expected a text, found 5"},
        {HEADER "\"shapes\":[{\"label\":\"\\u00e9\",\"at\":[0,0,0]}]}",
         "2: shapes[0].label: a label must be printable ASCII, but byte 1 is not"},
        {HEADER "\"shapes\":[{\"label\":\"a\\tb\",\"at\":[0,0,0]}]}",
         "2: shapes[0].label: a label must be printable ASCII, but byte 2 is not"},
        {HEADER "\"shapes\":[{\"segment\":[[0,0,0],[1,2]]}]}",
         "2: shapes[0].segment[1]: expected three numbers [x, y, z], found a list of 2"},
        {HEADER "\"shapes\":[{\"segment\":[[0,\"0\",0],[1,2,3]]}]}",
         "2: shapes[0].segment[0][1]: expected a number, found \"0\""},
        {HEADER "\"shapes\":[{\"segment\":5}]}", "2: shapes[0].segment: expected two positions"},
        {HEADER "\"shapes\":[{\"label\":\"12345678901234567890123456789012345678901234567\",\"at\":[0,0,0]}]}",
         "2: shapes[0].label: a label may have at most 46 characters, but has 47"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

static void every_truncated_session_is_refused(void **state)
{
    static const char text[] = HEADER "\"points\":[[1,2,3,4],{\"id\":5,\"position\":[1,1,1]}],\"keys\":\"w\","
                                      "\"queries\":[{\"nearest\":\"player\"}]}";
    (void)state;
    for (size_t size = 0; size < sizeof text - 1; size++) {
        char *copy = malloc(size + 1);
        assert_non_null(copy);
        memcpy(copy, text, size);
        assert_refuses(copy, size, "");
        free(copy);
    }
}

static void deep_nesting_is_refused(void **state)
{
    enum { DEPTH = 1000000 };
    char *text = malloc(DEPTH + sizeof HEADER + 16);
    (void)state;
    assert_non_null(text);
    size_t size = (size_t)sprintf(text, "%s\"points\":", HEADER);
    memset(text + size, '[', DEPTH);
    assert_refuses(text, size + DEPTH, "2: maximum parsing depth reached near '['");
    free(text);
}

static void header_with_bad_members_is_refused(void **state)
{
    static const refusal rows[] = {
        {"{\"octreel\":\"tick\",\"version\":1}", "1: octreel: expected \"session\", found \"tick\""},
        {"{\"octreel\":\"session\"}", "1: the member \"version\" is missing"},
        {"{\"octreel\":\"session\",\n\"version\":3}", "2: version: session version 3 is newer than version 2, "
                                                      "the newest that this Octreel reads; use a newer Octreel"},
        {"{\"octreel\":\"session\",\n\"version\":3, \"wind\": 3}", "2: version: session version"},
        {"{\"octreel\":\"session\",\"version\":1,\"nodes\":[]}",
         "1: version: session version 1 is not supported; rename \"nodes\" to \"foreign_nodes\" and set \"version\": "
         "2"},
        {"{\"octreel\":\"session\",\"version\":0}", "1: version: expected a whole number from 1"},
        {"{\"octreel\":\"session\",\"version\":1.5}", "1: version: expected a whole number from 1"},
        {HEADER "\"keyz\":1}",
         "2: unknown member \"keyz\", did you mean keys? known: octreel, version, world, tree, player, keys, ticks, "
         "unplayed, pairs, queries, shapes, foreign_nodes, sampled, columns, points, velocities"},
        {HEADER "\"\\u001b[0m\":1}", "2: unknown member \"?[0m\"; known: octreel"},
        {HEADER "\"world\":5}", "2: world: expected an object, found 5"},
        {HEADER "\"world\":{\"min\":[0,0,0]}}", "2: world: the member \"max\" is missing"},
        {HEADER "\"world\":{\"min\":[0,0,0],\n\"max\":[1,2]}}", "3: world.max: expected three numbers [x, y, z], "
                                                                "found a list of 2"},
        {HEADER "\"world\":{\"min\":[0,0,0],\"max\":[1,null,2]}}", "2: world.max[1]: expected a number, found null"},
        {HEADER "\"world\":{\"min\":[0,0,0],\"max\":[1,0,2]}}", "2: world: min must be below max on every axis, but "
                                                                "is not on y"},
        {HEADER "\"world\":{\"min\":[0,0,0],\"max\":[1,\n1e999,2]}}", "3: real number overflow near '1e999'"},
        {HEADER "\"tree\":{\"capacity\":0}}",
         "2: tree.capacity: expected a whole number from 1 to 4294967295, found 0"},
        {HEADER "\"tree\":{\"capacity\":1.5}}", "2: tree.capacity: expected a whole number from 1 to 4294967295, "
                                                "found 1.5"},
        {HEADER "\"tree\":{\"depth\":22}}", "2: tree.depth: expected a whole number from 0 to 21, found 22"},
        {HEADER "\"tree\":{\"full\":\"maybe\"}}", "2: tree.full: expected one of refuse, grow, found \"maybe\""},
        {HEADER "\"tree\":{\"full\":true}}", "2: tree.full: expected one of refuse, grow, found true"},
        {HEADER "\"player\":{\"stepp\":0}}",
         "2: player: unknown member \"stepp\", did you mean step? known: id, body, position, step, box_size, sweep"},
        {HEADER "\"player\":{\"body\":true,\"id\":1,\"position\":[500,0,0]}}",
         "2: player: unknown member \"position\"; known: id, body, box_size, sweep"},
        {HEADER "\"player\":{\"step\":5,\n\"body\":true}}",
         "2: player: unknown member \"step\"; known: id, body, box_size, sweep"},
        {HEADER "\"player\":{\"step\":-1}}", "2: player.step: expected a number that is not negative, found -1"},
        {HEADER "\"player\":{\"sweep\":1}}", "2: player.sweep: expected true or false, found 1"},
        {HEADER "\"player\":{\"box_size\":\"big\"}}", "2: player.box_size: expected a number that is not negative, "
                                                      "found \"big\""},
        {HEADER "\"player\":{\"position\":[0,0]}}", "2: player.position: expected three numbers [x, y, z]"},
        {HEADER "\"player\":{\"body\":3}}", "2: player.body: expected true or false, found 3"},
        {HEADER "\"player\":{\"position\":[0,0,-1001]}}",
         "2: player.position: the player is outside the world; correct its coordinate z"},
        {HEADER "\"player\":{\"id\":9007199254740992}}", "2: player.id: expected a whole number from 0 to "
                                                         "9007199254740991, found 9007199254740992"},
        {HEADER "\"player\":{\"id\":-1}}",
         "2: player.id: expected a whole number from 0 to 9007199254740991, found -1"},
        {HEADER "\"keys\":7}", "2: keys: expected a string of keys, found 7"},
        {HEADER "\"keys\":\"wasdx\"}", "2: keys: key 5, 'x', is not one of w a s d e f n q ."},
        {HEADER "\"keys\":\"w\\u0007\"}", "2: keys: key 2, byte 0x07, is not one of w a s d e f n q ."},
        {HEADER "\"ticks\":1000000001}", "2: ticks: expected a whole number from 0 to 1000000000, found 1000000001"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

static void bad_points_are_refused(void **state)
{
    static const refusal rows[] = {
        {HEADER "\"points\":7}",
         "2: points: expected a list of points, {\"file\": ...} or {\"sample\": ..., \"count\": "
         "..., \"seed\": ...}"},
        {HEADER "\"points\":{\"fle\":\"a\"}}", "2: points: expected a list of points, {\"file\""},
        {HEADER "\"points\":[\n[1,2,3],\n[1,2]]}", "4: points[1]: expected a point [x, y, z] or [x, y, z, id], found a "
                                                   "list of 2"},
        {HEADER "\"points\":[\n[1,2,3],\n\"p\"]}",
         "4: points[1]: expected a point [x, y, z], [x, y, z, id] or {\"id\""},
        {HEADER "\"points\":[[1,2,3,4.5]]}", "2: points[0][3]: expected a whole number from 0 to 9007199254740991, "
                                             "found 4.5"},
        {HEADER "\"points\":[[1,2,\"3\"]]}", "2: points[0][2]: expected a number, found \"3\""},
        {HEADER "\"points\":[{\"id\":1}]}", "2: points[0]: the member \"position\" is missing"},
        {HEADER "\"points\":[{\"id\":1,\"postion\":[]}]}",
         "2: points[0]: unknown member \"postion\", did you mean position? known: id, "
         "position, velocity"},
        {HEADER "\"points\":[{\"position\":[1,2,3],\n\"velocity\":5}]}",
         "3: points[0].velocity: expected three numbers "
         "[x, y, z], found 5"},
        {HEADER "\"points\":[{\"position\":[1,2,3],\n\"half\":[0,-1,0]}]}",
         "3: points[0].half: a half extent must not be negative; correct its coordinate y"},
        {HEADER "\"pairs\":1}", "2: pairs: expected true or false, found 1"},
        {HEADER "\"points\":[[1,2,3,9],\n[1,2,3,8],\n[4,5,6,9],\n[4,5,6,8]]}",
         "4: points[2]: id 9 already belongs to points[0] "
         "in line 2"},
        {HEADER "\"points\":[[1,2,3,2],\n[1,2,3]]}", "3: points[1]: id 2 already belongs to points[0] in line 2"},
        {HEADER "\"player\":{\"id\":6},\"points\":[[1,2,3],\n[1,2,3,6]]}",
         "3: points[1]: id 6 already belongs to the player"},
        {HEADER "\"points\":{\"sample\":\"odd\",\"count\":1}}", "2: points.sample: expected one of uniform, gaussian, "
                                                                "clustered, surface, lattice, found \"odd\""},
        {HEADER "\"points\":{\"sample\":\"uniform\"}}", "2: points: the member \"count\" is missing"},
        {HEADER "\"points\":{\"sample\":\"uniform\",\"count\":-1}}",
         "2: points.count: expected a whole number from 0 to "
         "100000000, found -1"},
        {HEADER "\"points\":{\"sample\":\"uniform\",\"count\":100000001}}", "2: points.count: expected a whole number"},
        {HEADER "\"points\":{\"file\":\"a\",\"count\":1}}", "2: points: unknown member \"count\"; known: file"},
        {HEADER "\"points\":{\"file\":\"\"}}", "2: points.file: expected the name of a file, found \"\""},
        {HEADER "\"points\":{\"file\":7}}", "2: points.file: expected the name of a file, found 7"},
        {HEADER "\"velocities\":3}", "2: velocities: expected a list of [id, vx, vy, vz] or {\"speed\": ..., \"seed\": "
                                     "...}, found 3"},
        {HEADER "\"velocities\":[[1,0,0,0],7]}", "2: velocities[0]: no point has the id 1"},
        {HEADER "\"points\":[[1,2,3]],\"velocities\":[7]}", "2: velocities[0]: expected [id, vx, vy, vz], found 7"},
        {HEADER "\"points\":[[1,2,3]],\"velocities\":[[-1,0,0,0]]}",
         "2: velocities[0][0]: expected a whole number from 0 to 9007199254740991, found -1"},
        {HEADER "\"points\":[[1,2,3]],\"velocities\":[[1,0,0,[]]]}",
         "2: velocities[0][3]: expected a number, found a list of 0"},
        {HEADER "\"columns\":[\"class\"],\"points\":[[1,2,3,4,-1]]}", "2: points[0][4]: "},
        {HEADER "\"velocities\":[[1,0,0,0]]}", "2: velocities[0]: no point has the id 1"},
        {HEADER "\"points\":[[1,2,3]],\"velocities\":[[1,0,0,0],\n[1,0,0,0]]}",
         "3: velocities[1]: the point with the id "
         "1 already has a velocity in this list"},
        {HEADER "\"points\":[[1,2,3]],\"velocities\":[[1,0,0]]}",
         "2: velocities[0]: expected [id, vx, vy, vz], found a "
         "list of 3"},
        {HEADER "\"velocities\":{\"speed\":-5}}",
         "2: velocities.speed: expected a number that is not negative, found -5"},
        {HEADER "\"velocities\":{\"speed\":5,\"seed\":0.5}}", "2: velocities.seed: expected a whole number from 0 to"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

#define START HEADER "\"ticks\":3}\n"

static void bad_ticks_are_refused(void **state)
{
    static const refusal rows[] = {
        {START "{\"tick\":3,\"gap\":7}", "3: gap: expected a text, found 7"},
        {START "{\"tick\":3,\"gap\":\"\"}", "3: gap: the reason of a gap must not be empty"},
        {START "{\"tick\":3,\"gap\":\"\\n\"}", "3: gap: the reason of a gap must be printable ASCII"},
        {START "{\"tick\":3,\"gap\":\"x\",\"queries\":[]}",
         "3: a tick with \"gap\" must have no other member but \"tick\""},
        {START "{}", "3: the member \"tick\" is missing"},
        {START "{\"tick\":1}\n{\"tick\":1}", "4: tick: tick 1 follows tick 1; ticks must ascend"},
        {HEADER "\"points\":[]}\n{\"tick\":1000001}",
         "3: tick: tick 1000001 is more than 1000000 ticks after the object before it"},
        {HEADER "\"points\":[]}\n{\"tick\":3}{\"tick\":1000004}",
         "3: tick: tick 1000004 is more than 1000000 ticks after"},
        {START "{\"tick\":4}{\"tick\":\n3}", "4: tick: tick 3 follows tick 4; ticks must ascend"},
        {START "{\"tick\":1000000001}", "3: tick: expected a whole number from 0 to 1000000000"},
        {START "{\"tick\":1,\"points\":[]}", "3: unknown member \"points\"; known: tick, edits, queries, shapes"},
        {START "{\"tick\":0,\"edits\":[{\"remove\":1}]}", "3: edits: edits are not allowed in tick 0"},
        {START "{\"tick\":1,\"edits\":{\"remove\":1}}", "3: edits: expected a list of edits, found an object"},
        {START "{\"tick\":1,\"edits\":[\n{}]}",
         "4: edits[0]: expected {\"insert\": ...}, {\"remove\": ...} or {\"move\": ...}"},
        {START "{\"tick\":1,\"edits\":[{\"remove\":1,\"move\":2}]}", "3: edits[0]: expected one of {\"insert\": ...}"},
        {START "{\"tick\":1,\"edits\":[{\"delete\":1}]}",
         "3: edits[0]: expected {\"insert\": ...}, {\"remove\": ...} or {\"move\": ...}"},
        {START "{\"tick\":1,\"edits\":[{\"move\":{\"id\":1,\"position\":[1,2,3],\"velocity\":[1,2,3]}}]}",
         "3: edits[0].move: unknown member \"velocity\"; known: id, position"},
        {START "{\"tick\":1,\"edits\":[{\"insert\":{\"position\":[1,2,3]}}]}",
         "3: edits[0].insert: the member \"id\" is missing"},
        {START "{\"tick\":1,\"edits\":[{\"insert\":{\"idd\":7,\"position\":[1,2,3]}}]}",
         "3: edits[0].insert: unknown member \"idd\", did you mean id?"},
        {START "{\"tick\":1,\"edits\":[{\"remove\":\"all\"}]}",
         "3: edits[0].remove: expected a whole number from 0 to"},
        {START "{\"tick\":1,\"queries\":[{\"rnge\":1}]}",
         "3: queries[0]: expected {\"range\": ...}, {\"nearest\": ...}, {\"knearest\": ...}, {\"radius\": ...}, "
         "{\"ray\": ...}, {\"frustum\": ...} or {\"sweep\": ...}"},
        {START "{\"tick\":1,\"queries\":[{\"radius\":1,\"knearest\":2,\"at\":\"player\"}]}",
         "3: queries[0]: expected one of {\"range\": ...}, {\"nearest\": ...}, {\"knearest\": ...}, {\"radius\": ...}, "
         "{\"ray\": ...}, {\"frustum\": ...} or {\"sweep\": "
         "...}, "
         "found \"knearest\" and \"radius\" together"},
        {START "{\"tick\":1,\"queries\":[{\"nearest\":1}]}",
         "3: queries[0].nearest: expected \"player\" or three numbers "
         "[x, y, z], found 1"},
        {START "{\"tick\":1,\"queries\":[{\"nearest\":\"player\",\"at\":\"player\"}]}",
         "3: queries[0]: unknown member \"at\"; known: nearest"},
        {HEADER "\"queries\":[{\"range\":{\"min\":[0,0,5],\"max\":[0,0,4]}}]}",
         "2: queries[0].range: min is above max on axis z"},
        {HEADER "\"queries\":[{\"range\":{\"min\":[0,0,5],\"max\":[0,0,6]},\"at\":\"home\"}]}",
         "2: queries[0].at: expected \"player\", found \"home\""},
        {HEADER "\"queries\":[{\"knearest\":1.5,\"at\":\"player\"}]}",
         "2: queries[0].knearest: expected a whole number from 0 to 4294967295, found 1.5"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"skip\":-1}]}",
         "2: queries[0].skip: expected a whole number from 0 to 9007199254740991, found -1"},
        {HEADER "\"queries\":[{\"nearest\":[0,0,0],\"skip\":\"me\"}]}",
         "2: queries[0].skip: expected an id or \"coincident\", found \"me\""},
        {HEADER "\"queries\":[{\"range\":{\"min\":[0,0,0],\"max\":[1,1,1]},\"skip\":\"coincident\"}]}",
         "2: queries[0].skip: a box has no target, so \"skip\" cannot be \"coincident\"; give an id"},
        {HEADER "\"queries\":[{\"radius\":8,\"at\":\"player\",\"epsilon\":-0.5}]}",
         "2: queries[0].epsilon: expected a number that is not negative, found -0.5"},
        {HEADER "\"queries\":[{\"ray\":[0,-0,0],\"at\":[1,2,3]}]}",
         "2: queries[0].ray: the direction of a ray must not be [0, 0, 0]"},
        {HEADER "\"queries\":[{\"frustum\":[]}]}", "2: queries[0].frustum: expected a list of 1 to 8 half-spaces"},
        {HEADER "\"queries\":[{\"frustum\":[[1,0,0,5],[0,1,0]]}]}",
         "2: queries[0].frustum[1]: expected a half-space [nx, ny, nz, offset]"},
        {HEADER "\"queries\":[{\"frustum\":[[0,0,0,5]]}]}",
         "2: queries[0].frustum[0]: the normal of a half-space must not be [0, 0, 0]"},
        {HEADER "\"queries\":[{\"sweep\":[1,0,0],\"at\":[0,0,0],\"half\":[1,-1,1]}]}",
         "2: queries[0].half: a half extent must not be negative"},
        {HEADER "\"queries\":[{\"ray\":[0,1],\"at\":[1,2,3]}]}", "2: queries[0].ray: expected"},
        {HEADER "\"queries\":[{\"ray\":[0,1,0]}]}", "2: queries[0]: the member \"at\" is missing"},
        {HEADER "\"queries\":[{\"ray\":[0,1,0],\"at\":[1,2,3],\"bounds\":\"open\"}]}",
         "2: queries[0]: unknown member \"bounds\"; known: ray, at, k, thickness, length"},
        {HEADER "\"queries\":[{\"ray\":[0,1,0],\"at\":[1,2,3],\"thickness\":-1}]}",
         "2: queries[0].thickness: expected a number that is not negative, found -1"},
        {HEADER "\"queries\":[{\"knearest\":8}]}", "2: queries[0]: the member \"at\" is missing"},
        {HEADER "\"queries\":[{\"knearest\":8,\"at\":\"home\"}]}",
         "2: queries[0].at: expected \"player\" or three numbers [x, y, z], found \"home\""},
        {HEADER "\"queries\":[{\"radius\":-1,\"at\":\"player\"}]}",
         "2: queries[0].radius: expected a number that is not negative, found -1"},
        {HEADER "\"queries\":[{\"knearest\":8,\n\"at\":\"player\"}],\"player\":null}",
         "3: queries[0].at: the session has no player: its \"player\" is null"},
        {HEADER "\"player\":null}\n{\"tick\":1,\"queries\":[{\"range\":{\"min\":[0,0,0],\"max\":[1,1,1]},"
                "\"at\":\"player\"}]}",
         "3: queries[0].at: the session has no player"},
        {HEADER "\"queries\":[{\"radius\":5}]}", "2: queries[0]: the member \"at\" is missing"},
        {HEADER "\"queries\":[{\"radius\":5,\"at\":[1,2]}]}",
         "2: queries[0].at: expected three numbers [x, y, z], found a list of 2"},
        {HEADER "\"queries\":[{\"radius\":5,\"at\":\"player\",\"k\":1}]}",
         "2: queries[0]: unknown member \"k\"; known: radius, at"},
        {HEADER "\"queries\":[{\"radius\":5,\"at\":\"player\",\"bounds\":\"half\"}]}",
         "2: queries[0].bounds: expected one of closed, open, either, found \"half\""},
        {HEADER "\"queries\":[{\"nearest\":\"player\",\"bounds\":\"open\"}]}",
         "2: queries[0]: unknown member \"bounds\"; known: nearest"},
    };
    (void)state;
    assert_refuses_each(rows, sizeof rows / sizeof *rows);
}

static void missing_cloud_is_reported_with_the_line_that_names_it(void **state)
{
    static const char text[] = HEADER "\"points\":{\"file\":\"missing.pcd\"}}";
    session_file file;
    octreel_error error;
    (void)state;
    assert_false(session_parse("s.json", "no/such/folder", text, strlen(text), &file, &error));
    assert_string_equal(error.text, "s.json:2: points.file: no/such/folder/missing.pcd: cannot be opened: No such "
                                    "file or directory");
}

static void error_keeps_the_end_of_a_long_name_and_the_reason(void **state)
{
    char name[1000];
    session_file file;
    octreel_error error;
    (void)state;
    memset(name, 'a', sizeof name);
    strcpy(name + sizeof name - 8, "/s.json");
    assert_false(session_parse(name, "", "", 0, &file, &error));
    assert_non_null(strstr(error.text, "aaa/s.json:1: holds no session"));
    assert_false(session_read(name, &file, &error));
    assert_non_null(strstr(error.text, "aaa/s.json: cannot be opened: "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distant_ticks_are_read_if_keys_or_ticks_reach_them),
        cmocka_unit_test(text_that_is_not_a_stream_of_objects_is_refused),
        cmocka_unit_test(answers_that_are_not_ids_are_refused),
        cmocka_unit_test(nul_bytes_are_refused),
        cmocka_unit_test(invalid_shapes_are_refused),
        cmocka_unit_test(every_truncated_session_is_refused),
        cmocka_unit_test(deep_nesting_is_refused),
        cmocka_unit_test(header_with_bad_members_is_refused),
        cmocka_unit_test(bad_points_are_refused),
        cmocka_unit_test(bad_ticks_are_refused),
        cmocka_unit_test(missing_cloud_is_reported_with_the_line_that_names_it),
        cmocka_unit_test(error_keeps_the_end_of_a_long_name_and_the_reason),
    };
    return cmocka_run_group_tests_name("session_errors", tests, NULL, NULL);
}
