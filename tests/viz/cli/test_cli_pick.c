/* SPDX-License-Identifier: MIT */
/* test_cli_pick.c - octreel pick names the elements at a pixel, which the test computes from the camera, and refuses
 * other files. */
#include "commands.h"
#include "edits.h"
#include "recordings.h"
#include "replay.h"
#include "scenes.h"
#include "tick_lines.h"
#include "verified.h"
#include "png_chunks.h"
#include "png_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A recording, one of its ticks, and that tick's scene. */
typedef struct shown {
    place folder, frame;
    replay replay;
    const scene *scene;
} shown;

static void show(shown *what, const temp_folder *own, const char *arguments, uint64_t tick)
{
    octreel_error error = {""};
    what->folder = place_in(own, "film");
    command_result result =
        run_octreel(NULL, "record --keys wwdn --size 320x180 --diagram none %s -o %s", arguments, what->folder.path);
    assert_done(&result);
    command_release(&result);
    what->frame = frame_place(what->folder.path, tick);
    if (!replay_open(&what->replay, what->folder.path, 0, &error) || !replay_play_up_to(&what->replay, tick, &error) ||
        !playback_compose_scene(&what->replay.playback, &error))
        fail_msg("%s", error.text);
    what->scene = &what->replay.playback.scene;
}

static json_t *pick_json(const shown *what, int x, int y, int radius)
{
    command_result result = run_octreel(NULL, "pick %s %d %d --radius %d --json", what->frame.path, x, y, radius);
    assert_done(&result);
    assert_ptr_equal(strchr(result.out, '\n'), result.out + strlen(result.out) - 1);
    json_t *said = json_read(result.out);
    command_release(&result);
    return said;
}

/* The first element of a pixel that has this whole number or text in the member `name` of its member `object`. */
static const json_t *element_with(const json_t *said, const char *object, const char *name, const json_t *value)
{
    size_t i;
    json_t *element;
    json_array_foreach(json_member(said, "elements"), i, element)
    {
        const json_t *inner = json_object_get(element, object);
        if (inner && json_equal(json_object_get(inner, name), value))
            return element;
    }
    return NULL;
}

/* ---- What is there ------------------------------------------------------------------------------------------ */

static void every_point_is_named_at_its_pixel(void **state)
{
    shown what;
    show(&what, *state, "--camera iso", 4);
    size_t points = 0;
    for (size_t i = 0; i < what.scene->markers.count; i++) {
        const scene_marker *marker = &what.scene->markers.items[i];
        double pixel[2];
        if (marker->style.layer != LAYER_POINTS)
            continue;
        pixel_of(what.scene, marker->at, pixel);
        json_t *said = pick_json(&what, (int)floor(pixel[0]), (int)floor(pixel[1]), 0);
        json_t *id = json_real((double)marker->id); /* json_read() turns numbers into reals */
        assert_non_null(element_with(said, "point", "id", id));
        json_decref(id);
        json_decref(said);
        points++;
    }
    assert_true(points > 8);
    replay_close(&what.replay);
}

/* Whether pick names a node within a pixel of the middle of one of its edges. */
static bool names_node(const shown *what, const scene_box *box)
{
    const double middle[3] = {box->box.min[0] / 2 + box->box.max[0] / 2, box->box.min[1], box->box.max[2]};
    char path[OCTREE_ADDRESS_TEXT];
    double pixel[2];
    bool found = false;
    json_t *name = json_string(octree_address_format(box->id, path));
    pixel_of(what->scene, middle, pixel);
    for (int i = 0; i < 9 && !found; i++) {
        const int place = (i + 4) % 9; /* starts with the pixel in the middle */
        json_t *said = pick_json(what, (int)floor(pixel[0]) + place % 3 - 1, (int)floor(pixel[1]) + place / 3 - 1, 0);
        found = element_with(said, "node", "path", name) != NULL;
        json_decref(said);
    }
    json_decref(name);
    return found;
}

/* Most shared edges are painted for another node. */
static void nodes_are_named_at_their_edges(void **state)
{
    shown what;
    show(&what, *state, "--camera iso --layers nodes", 4);
    size_t nodes = 0;
    for (size_t i = 0; i < what.scene->boxes.count; i += 2, nodes++)
        if (!names_node(&what, &what.scene->boxes.items[i]))
            fail_msg("box %zu is not named", i);
    assert_true(nodes >= 5);
    replay_close(&what.replay);
}

static void panel_is_listed_below_its_text(void **state)
{
    shown what;
    show(&what, *state, "", 4);
    const scene_label *title = NULL;
    for (size_t i = 0; i < what.scene->labels.count; i++)
        if (strcmp(what.scene->labels.items[i].text, "tick 4") == 0)
            title = &what.scene->labels.items[i];
    assert_non_null(title);
    bool text = false;
    for (int i = 0; i < 64 && !text; i++) {
        command_result result =
            run_octreel(NULL, "pick %s %d %d", what.frame.path, (int)title->at[0] + i % 8, (int)title->at[1] + i / 8);
        assert_done(&result);
        text = strstr(result.out, "  text \"tick 4\"\n    over the background of the panel\n") != NULL;
        command_release(&result);
    }
    assert_true(text);
    replay_close(&what.replay);
}

static void samples_of_a_pixel_add_up(void **state)
{
    shown what;
    show(&what, *state, "--aa 4 --camera orbit --layers world,nodes,points", 2);
    double pixel[2];
    pixel_of(what.scene, what.scene->markers.items[0].at, pixel);
    json_t *said = pick_json(&what, (int)floor(pixel[0]), (int)floor(pixel[1]), 0), *element;
    size_t i;
    int shown = 0;
    assert_whole_number(json_member(said, "samples"), 16);
    json_array_foreach(json_member(said, "elements"), i, element) shown +=
        (int)json_number_value(json_member(element, "shown"));
    assert_true(shown > 1 && shown <= 16);
    json_decref(said);
    replay_close(&what.replay);
}

/* ---- Where nothing is --------------------------------------------------------------------------------------- */

/* The squared distance to the nearest pixel of another colour, ignoring cut dashes. */
static int nearest_other(const image *frame, int x, int y)
{
    int best = INT32_MAX;
    for (int i = 0; i < frame->width * frame->height; i++) {
        const int dx = i % frame->width - x, dy = i / frame->width - y;
        if (frame->pixels[i] != 0 && dx * dx + dy * dy < best)
            best = dx * dx + dy * dy;
    }
    return best;
}

static void nearest_drawn_pixel_is_used_if_nothing_is_drawn(void **state)
{
    shown what;
    show(&what, *state, "--camera iso --layers nodes,points", 4);
    image frame = assert_whole_frame(what.frame.path, 320, 180);
    int told = 0, none = 0;
    for (int at = 700; at < 320 * 180 && told + none < 12; at += 4801) {
        const int x = at % 320, y = at / 320, nearest = nearest_other(&frame, x, y);
        json_t *said = pick_json(&what, x, y, 20);
        if (nearest > 20 * 20) {
            assert_true(json_is_null(json_member(said, "pixel")));
            assert_int_equal(json_array_size(json_member(said, "elements")), 0);
            none++;
        } else {
            const json_t *pixel = json_member(said, "pixel");
            const int dx = (int)json_number_value(json_array_get(pixel, 0)) - x;
            const int dy = (int)json_number_value(json_array_get(pixel, 1)) - y;
            assert_int_equal(dx * dx + dy * dy, nearest);
            assert_true(json_array_size(json_member(said, "elements")) > 0);
            told++;
        }
        json_decref(said);
    }
    assert_true(told > 2 && none > 2);
    command_result result = run_octreel(NULL, "pick %s 0 0", what.frame.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "tick 4, pixel (0, 0): nothing is drawn there, nor within 8 pixels\n"));
    command_release(&result);
    image_release(&frame);
    replay_close(&what.replay);
}

/* ---- Trouble ------------------------------------------------------------------------------------------------ */

static void assert_refused(const char *path, const char *rest, const char *part)
{
    command_result result = run_octreel(NULL, "pick %s %s", path, rest);
    assert_trouble(&result, part);
}

static void pixel_outside_the_frame_is_refused(void **state)
{
    const place folder = film_short(*state), frame = frame_place(folder.path, 3);
    assert_refused(frame.path, "160 10", "160 x 90 pixels");
    assert_refused(frame.path, "10 90", "160 x 90 pixels");
    assert_refused(frame.path, "x 10", "not \"x\"");
    assert_refused(frame.path, "10 1.5", "not \"1.5\"");
    assert_refused(frame.path, "-1 10", "pixel coordinates start at (0, 0)");
    assert_refused(frame.path, "10", "two coordinates");
    assert_refused(frame.path, "1 2 3", "two coordinates");
    assert_refused(frame.path, "1 2 --radius -3", "--radius");
}

static void file_that_is_not_a_frame_is_refused(void **state)
{
    const place folder = film_short(*state), points = place_in(*state, "points.xyz"), tree = place_in(*state, "t.png");
    const place text = place_in(*state, "text.png"), bare = place_in(*state, "bare.png");
    image picture;
    octreel_error unwritten;
    assert_true(image_create(&picture, 8, 8, 3));
    assert_true(image_write_png(&picture, bare.path, NULL, 0, &unwritten));
    image_release(&picture);
    file_write_text(points.path, "0 0 0\n1 1 1\n");
    file_write_text(text.path, "no picture\n");
    command_result result = run_octreel(NULL, "inspect %s -o %s --size 64x64", points.path, tree.path);
    assert_done(&result);
    command_release(&result);
    assert_refused(tree.path, "1 1", "octreel inspect");
    assert_refused(text.path, "1 1", "text.png");
    assert_refused(bare.path, "1 1", "it has no PNG text octreel-tick; give the file as octreel record wrote it");
    assert_refused(place_in(*state, "nothing.png").path, "1 1", "nothing.png");
    assert_refused(folder.path, "1 1", "film");
}

static void frame_without_its_recording_is_refused(void **state)
{
    const place folder = film_short(*state), alone = place_in(*state, "alone.png");
    size_t size;
    char *bytes = file_read(frame_place(folder.path, 3).path, &size);
    file_write(alone.path, bytes, size);
    assert_refused(alone.path, "1 1",
                   "not a frame of a recording: its folder has no recording.json; give the frame in the folder that "
                   "octreel record wrote");
    free(bytes);
}

static void frame_of_another_recording_is_refused(void **state)
{
    const place folder = film_short(*state), frame = frame_place(folder.path, 3);
    edit_file(folder.path, "recording.json", "\"camera\": \"iso\"", "\"camera\": \"top\"");
    assert_refused(frame.path, "1 1", "another view, or by another version");
    edit_file(folder.path, "recording.json", "\"camera\": \"top\"", "\"camera\": \"iso\"");
    command_result result = run_octreel(NULL, "pick %s 1 1", frame.path);
    assert_done(&result);
    command_release(&result);
    edit_file(folder.path, "session.json", "\"step\": 50", "\"step\": 40");
    assert_refused(frame.path, "1 1", "another session");
}

/* The PNG has the texts of this frame, but the pixels of another. */
static void edited_frame_is_refused(void **state)
{
    const place folder = film_short(*state), frame = frame_place(folder.path, 3);
    static const char *const keywords[] = {"octreel-tick", "octreel-session", "octreel-scene", "octreel-pixels"};
    char values[4][32];
    image_text texts[4];
    octreel_error ignored;
    image picture;
    for (size_t i = 0; i < 4; i++) {
        assert_true(image_read_text(frame.path, keywords[i], values[i], sizeof values[i]));
        texts[i] = (image_text){keywords[i], values[i]};
    }
    assert_true(image_read_png(frame.path, &picture, &ignored));
    picture.pixels[100] ^= 16;
    assert_true(image_write_png(&picture, frame.path, texts, 4, &ignored));
    assert_refused(frame.path, "1 1", "its pixels do not match its PNG text octreel-pixels");
    picture.pixels[100] ^= 16;
    texts[0].text = "4x";
    assert_true(image_write_png(&picture, frame.path, texts, 4, &ignored));
    assert_refused(frame.path, "1 1", "not the number of a tick");
    texts[0].text = "400";
    assert_true(image_write_png(&picture, frame.path, texts, 4, &ignored));
    assert_refused(frame.path, "1 1", "ends with tick 13");
    image_release(&picture);
}

static void help_describes_the_command(void **state)
{
    (void)state;
    command_result result = run_octreel(NULL, "pick --help");
    assert_done(&result);
    assert_non_null(strstr(result.out, "usage: octreel pick FRAME X Y"));
    assert_non_null(strstr(result.out, "octreel pick flight/frame_000219.png"));
    command_release(&result);
    result = run_octreel(NULL, "--help");
    assert_non_null(strstr(result.out, "  pick"));
    command_release(&result);
}

/* A session with foreign nodes: a leaf reaches outside its parent's box and lists a point that does not exist. */
static void foreign_nodes_are_named_with_their_errors(void **state)
{
    const place session = place_in(*state, "s.json"), film = place_in(*state, "film");
    file_write_text(
        session.path,
        "{\"octreel\": \"session\", \"version\": 2, \"player\": null, \"points\": [[1, 1, 1, 1]], \"world\": "
        "{\"min\": [0, 0, 0], \"max\": [8, 8, 8]}, \"ticks\": 1}\n{\"tick\": 1, \"foreign_nodes\": [{\"id\": 7, "
        "\"box\": {\"min\": [0, 0, 0], \"max\": [4, 4, 4]}}, {\"id\": 9, \"parent\": 7, \"kind\": \"leaf\", "
        "\"box\": {\"min\": [0, 0, 0], \"max\": [6, 4, 4]}, \"points\": [1, 5]}]}\n");
    command_result result =
        run_octreel(NULL, "record -q %s --size 64x48 --camera top --layers nodes -o %s", session.path, film.path);
    assert_done(&result);
    command_release(&result);
    const json_t *node = NULL;
    json_t *said = NULL;
    for (int x = 0; x < 64 && !node; x++) {
        json_decref(said);
        result = run_octreel(NULL, "pick %s %d 36 --radius 0 --json", frame_place(film.path, 1).path, x);
        assert_done(&result);
        said = json_read(result.out);
        command_release(&result);
        json_t *id = json_real(9);
        const json_t *element = element_with(said, "foreign_node", "id", id);
        node = json_object_get(element, "foreign_node");
        json_decref(id);
    }
    assert_non_null(node);
    assert_true(json_number_value(json_object_get(node, "parent")) == 7);
    assert_string_equal(json_string_value(json_object_get(node, "kind")), "leaf");
    const json_t *wrong = json_object_get(node, "wrong");
    assert_int_equal(json_array_size(wrong), 2);
    assert_string_equal(json_string_value(json_array_get(wrong, 0)), "outside_parent");
    json_decref(said);
}

/* The frame's path needs no folder if the current folder is the recording. At an edge of two nodes both are listed. */
static void pick_works_inside_the_recording_folder(void **state)
{
    shown what;
    show(&what, *state, "--aa 2 --camera top --layers nodes", 4);
    bool shared = false, samples = false;
    for (int x = 100; x < 220 && !(shared && samples); x++) {
        command_result result = run_script("cd %s && exec %s pick frame_000004.png %d 90 --radius 0", what.folder.path,
                                           octreel_program(), x);
        assert_done(&result);
        shared = shared || strstr(result.out, "\n      it shares this edge with node ");
        samples = samples || strstr(result.out, " of 4 samples: node ");
        command_release(&result);
    }
    assert_true(shared && samples);
    replay_close(&what.replay);
}

/* The player is in the middle of the close-up, whose frame has a name, too. Without a close-up, nothing is drawn there.
 */
static void elements_of_the_close_up_are_named(void **state)
{
    shown what;
    show(&what, *state, "--size 640x360", 3);
    const scene *close = what.scene->closeup;
    assert_true(what.scene->has_closeup);
    const int x = close->place[0] + close->view.width / 2, y = close->place[1] + close->view.height / 2;
    json_t *said = pick_json(&what, x, y, 0);
    const json_t *top = json_array_get(json_member(said, "elements"), 0);
    assert_string_equal(json_string_value(json_object_get(top, "layer")), "player");
    assert_true(json_is_true(json_object_get(top, "closeup")));
    json_decref(said);
    command_result result = run_octreel(NULL, "pick %s %d %d", what.frame.path, x, y);
    assert_non_null(strstr(result.out, "the player, point 6 at "));
    assert_non_null(strstr(result.out, " (in the close-up)\n"));
    assert_non_null(strstr(result.out, "over the background of the close-up\n"));
    command_release(&result);
    replay_close(&what.replay);
    result = run_octreel(NULL, "verify %s", what.folder.path);
    assert_done(&result);
    command_release(&result);
}

/* A recording with --no-closeup also verifies. */
static void recording_without_close_up_has_no_close_up_elements(void **state)
{
    shown what;
    show(&what, *state, "--size 640x360 --no-closeup", 0);
    assert_false(what.scene->has_closeup);
    replay_close(&what.replay);
    command_result result = run_octreel(NULL, "verify %s", what.folder.path);
    assert_done(&result);
    command_release(&result);
}

/* The test fails unless pick says a text about a node of a tick, at some pixel of row 20. */
static void assert_explained(const char *film, uint64_t tick, const char *path, const char *text)
{
    json_t *node = json_string(path);
    bool found = false;
    for (int x = 0; x < 64 && !found; x++) {
        command_result result = run_octreel(NULL, "pick %s %d 20 --json", frame_place(film, tick).path, x);
        assert_done(&result);
        json_t *said = json_read(result.out);
        command_release(&result);
        const json_t *element = element_with(said, "node", "path", node);
        found = element;
        if (element)
            assert_contains(json_string_value(json_object_get(element, "text")), text);
        json_decref(said);
    }
    assert_true(found);
    json_decref(node);
}

static void leaf_and_split_node_are_explained(void **state)
{
    static const char session[] =
        "{\"octreel\": \"session\", \"version\": 2, \"player\": null, \"ticks\": 4, \"tree\": {\"capacity\": 2}, "
        "\"points\": [[1, 1, 1, 1], [7, 7, 7, 2]], \"world\": {\"min\": [0, 0, 0], \"max\": [8, 8, 8]}}\n"
        "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 5, \"position\": [7, 1, 1]}}]}\n"
        "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 6, \"position\": [1, 1, 2]}}]}\n"
        "{\"tick\": 4, \"edits\": [{\"remove\": 5}, {\"remove\": 6}]}\n";
    static const struct {
        uint64_t tick;
        const char *path, *text;
    } rows[] = {
        {0, "root", "; capacity 2; its cell exists since tick 0"},
        {1, "root",
         "; capacity 2, so it split at this tick, when it held 3 points; point 5 arrived at this tick; its cell exists "
         "since tick 0"},
        {1, "0",
         "; capacity 2; no point arrived or left at this tick; its cell was made by the split of node root at tick 1, "
         "when that node held 3 points"},
        {2, "0",
         "; capacity 2; point 6 arrived at this tick; its cell was made by the split of node root at tick 1, when that "
         "node held 3 points"},
        {3, "0", "; no point arrived or left at this tick; its cell was made by the split of node root at tick 1"},
        {4, "root",
         "; capacity 2; points 5, 6 left at this tick; its cell was made by a merge at tick 4, when it held 2 points"},
    };
    const place source = place_in(*state, "s.json"), film = place_in(*state, "film");
    file_write_text(source.path, session);
    command_result result =
        run_octreel(NULL, "record -q %s --size 64x48 --camera top --layers nodes -o %s", source.path, film.path);
    assert_done(&result);
    command_release(&result);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_explained(film.path, rows[i].tick, rows[i].path, rows[i].text);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_point_is_named_at_its_pixel),
        IN_FOLDER(nodes_are_named_at_their_edges),
        IN_FOLDER(foreign_nodes_are_named_with_their_errors),
        IN_FOLDER(leaf_and_split_node_are_explained),
        IN_FOLDER(pick_works_inside_the_recording_folder),
        IN_FOLDER(elements_of_the_close_up_are_named),
        IN_FOLDER(recording_without_close_up_has_no_close_up_elements),
        IN_FOLDER(panel_is_listed_below_its_text),
        IN_FOLDER(samples_of_a_pixel_add_up),
        IN_FOLDER(nearest_drawn_pixel_is_used_if_nothing_is_drawn),
        IN_FOLDER(pixel_outside_the_frame_is_refused),
        IN_FOLDER(file_that_is_not_a_frame_is_refused),
        IN_FOLDER(frame_without_its_recording_is_refused),
        IN_FOLDER(frame_of_another_recording_is_refused),
        IN_FOLDER(edited_frame_is_refused),
        cmocka_unit_test(help_describes_the_command),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
