/* SPDX-License-Identifier: MIT */
/* test_cli_inspect.c - octreel inspect: statistics, nodes and pictures agree with the cloud, and invalid arguments are
 * refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "clouds.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "images.h"
#include "octree/sample.h"
#include "recordings.h"
#include "tick_lines.h"
#include "ticks_write.h"
#include "view.h"
#include "png_by_hand.h"
#include "png_chunks.h"
#include "image_digest.h"

enum { POINTS = 500 };

/* Clustered points with whole coordinates, which text files hold exactly. */
static void make_positions(double positions[POINTS][3])
{
    const octree_box box = cube(-1000, 1000);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 7, &box, POINTS, positions), OCTREE_OK);
    for (size_t i = 0; i < POINTS * 3; i++)
        positions[i / 3][i % 3] = (double)(long)positions[i / 3][i % 3];
}

/* Write these points to a file, after a header. */
static place write_points(void **state, const char *name, const char *header)
{
    double positions[POINTS][3];
    const place file = place_in(*state, name);
    make_positions(positions);
    FILE *out = fopen(file.path, "wb");
    assert_non_null(out);
    fputs(header, out);
    for (size_t i = 0; i < POINTS; i++)
        fprintf(out, "%.17g %.17g %.17g\n", positions[i][0], positions[i][1], positions[i][2]);
    assert_int_equal(fclose(out), 0);
    return file;
}

/* The JSON output of octreel inspect; the caller releases it. */
static json_t *inspect_json(const char *path, const char *options)
{
    command_result result = run_octreel(NULL, "inspect %s --json %s", path, options);
    assert_done(&result);
    assert_ptr_equal(strchr(result.out, '\n'), result.out + strlen(result.out) - 1);
    json_t *object = json_read(result.out);
    command_release(&result);
    return object;
}

static size_t whole(const json_t *object, const char *name)
{
    const json_t *value = json_member(object, name);
    assert_true(json_is_real(value));
    return (size_t)json_real_value(value);
}

static size_t sum(const json_t *list)
{
    size_t total = 0;
    for (size_t i = 0; i < json_array_size(list); i++)
        total += (size_t)json_real_value(json_array_get(list, i));
    return total;
}

/* Buckets do not overlap, and together they count all leaves and bound the number of points. */
static void assert_occupancy(const json_t *object)
{
    const json_t *rows = json_member(object, "leaves_by_points");
    size_t leaves = 0, least = 0, most = 0, behind = 0;
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const json_t *row = json_array_get(rows, i);
        assert_members(row, "from to leaves");
        assert_true(i == 0 || whole(row, "from") > behind);
        assert_true(whole(row, "from") <= whole(row, "to"));
        behind = whole(row, "to");
        leaves += whole(row, "leaves");
        least += whole(row, "leaves") * whole(row, "from");
        most += whole(row, "leaves") * whole(row, "to");
    }
    assert_int_equal(leaves, whole(object, "leaves"));
    assert_int_equal(behind, whole(object, "largest_leaf"));
    assert_true(least <= whole(object, "stored") && whole(object, "stored") <= most);
}

static void assert_adds_up(const json_t *object)
{
    assert_members(object, whole(object, "stored")
                               ? "cloud points skipped refused outside stored bounds world capacity max_depth nodes "
                                 "leaves depth largest_leaf memory nodes_by_depth leaves_by_depth leaves_by_points"
                               : "cloud points skipped refused outside stored world capacity max_depth nodes leaves "
                                 "depth largest_leaf memory nodes_by_depth leaves_by_depth leaves_by_points");
    assert_int_equal(whole(object, "points"),
                     whole(object, "stored") + whole(object, "refused") + whole(object, "outside"));
    assert_int_equal(sum(json_member(object, "leaves_by_depth")), whole(object, "leaves"));
    assert_int_equal(sum(json_member(object, "nodes_by_depth")), whole(object, "nodes"));
    assert_int_equal(json_array_size(json_member(object, "nodes_by_depth")), whole(object, "depth") + 1);
    assert_occupancy(object);
}

static void statistics_add_up(void **state)
{
    static const char *const options[] = {"",
                                          "--capacity 1",
                                          "--capacity 4294967295",
                                          "--capacity 3 --depth 2 --full refuse",
                                          "--capacity 3 --depth 2 --full grow",
                                          "--depth 0",
                                          "--depth 21 --capacity 1 --full refuse",
                                          "--world=-100,-100,-100,100,100,100",
                                          "--world 5000,5000,5000,6000,6000,6000",
                                          "--world=-1e308,-1e308,-1e308,1e308,1e308,1e308"};
    const place points = write_points(state, "points.txt", "# made\n");
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        json_t *object = inspect_json(points.path, options[i]);
        assert_adds_up(object);
        assert_int_equal(whole(object, "points"), POINTS);
        assert_string_equal(json_string_value(json_member(object, "cloud")), "points.txt");
        json_decref(object);
    }
}

/* The bounds of the stored points, not of the world. */
static void bounds_enclose_the_points(void **state)
{
    const place points = place_in(*state, "points.txt");
    file_write_text(points.path, "1 2 3\n-4 5 6.5\n7 -8 9\n100 100 100\n");
    command_result result = run_octreel(NULL, "inspect %s --world=-10,-10,-10,10,10,10", points.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "\n  bounds    -4 -8 3  to  7 5 9\n"));
    command_release(&result);
    json_t *object = inspect_json(points.path, "--world=-10,-10,-10,10,10,10");
    const json_t *box = json_member(object, "bounds");
    static const double ends[2][3] = {{-4, -8, 3}, {7, 5, 9}};
    for (size_t i = 0; i < 6; i++)
        assert_true(json_real_value(json_array_get(json_member(box, i < 3 ? "min" : "max"), i % 3)) ==
                    ends[i / 3][i % 3]);
    json_decref(object);
}

static void text_and_json_have_the_same_statistics(void **state)
{
    const place points = write_points(state, "points.txt", "");
    char line[64];
    json_t *object = inspect_json(points.path, "--capacity 4");
    command_result result = run_octreel(NULL, "inspect %s --capacity 4", points.path);
    assert_done(&result);
    snprintf(line, sizeof line, "%zu (%zu leaves)", whole(object, "nodes"), whole(object, "leaves"));
    assert_non_null(strstr(result.out, line));
    snprintf(line, sizeof line, "%d in the file, %zu in the tree", POINTS, whole(object, "stored"));
    assert_non_null(strstr(result.out, line));
    command_release(&result);
    json_decref(object);
}

/* One line of the CSV. */
typedef struct row {
    char address[OCTREE_ADDRESS_TEXT];
    unsigned depth, leaf;
    size_t count;
    octree_box box;
} row;

static row read_row(const char *line)
{
    row r;
    int end = 0;
    assert_int_equal(sscanf(line, "%47[^,],%u,%u,%zu,%lf,%lf,%lf,%lf,%lf,%lf%n", r.address, &r.depth, &r.leaf, &r.count,
                            &r.box.min[0], &r.box.min[1], &r.box.min[2], &r.box.max[0], &r.box.max[1], &r.box.max[2],
                            &end),
                     10);
    assert_int_equal(line[end], '\n');
    return r;
}

/* The test fails unless the node's box is that of its cell and lies inside its parent, the row above it in `path`. */
static void assert_row(const row *r, row path[OCTREE_MAX_DEPTH + 1])
{
    octree_address address;
    assert_true(octree_address_parse(r->address, &address));
    assert_int_equal(octree_address_depth(address), r->depth);
    const octree_box cell = octree_cell_box(&path[0].box, address);
    assert_memory_equal(&cell, &r->box, sizeof cell);
    if (r->depth == 0)
        return;
    const row *parent = &path[r->depth - 1];
    assert_int_equal(parent->leaf, 0);
    assert_true(r->count <= parent->count && r->count > 0);
    assert_true(box_holds(&parent->box, r->box.min) && box_holds(&parent->box, r->box.max));
    assert_true(r->depth == 1 || strncmp(parent->address, r->address, strlen(parent->address)) == 0);
}

static void nodes_lie_within_their_parents_and_hold_all_points(void **state)
{
    static const char header[] = "address,depth,leaf,count,min_x,min_y,min_z,max_x,max_y,max_z\n";
    const place points = write_points(state, "points.txt", ""), csv = place_in(*state, "nodes.csv");
    row path[OCTREE_MAX_DEPTH + 1];
    size_t nodes = 0, leaves = 0, stored = 0;
    command_result result = run_octreel(NULL, "inspect %s --capacity 2 --json --nodes %s", points.path, csv.path);
    assert_done(&result);
    json_t *object = json_read(result.out);
    char *text = file_read(csv.path, NULL);
    assert_memory_equal(text, header, sizeof header - 1);
    for (const char *line = text + sizeof header - 1; *line != '\0'; line = strchr(line, '\n') + 1) {
        const row r = read_row(line);
        assert_true(r.depth <= OCTREE_MAX_DEPTH);
        path[r.depth] = r;
        assert_row(&r, path);
        nodes++;
        leaves += r.leaf;
        stored += r.leaf ? r.count : 0;
    }
    assert_int_equal(nodes, whole(object, "nodes"));
    assert_int_equal(leaves, whole(object, "leaves"));
    assert_int_equal(stored, whole(object, "stored"));
    json_decref(object);
    free(text);
    command_release(&result);
}

static void node_option_prints_box_and_points(void **state)
{
    const place points = place_in(*state, "points.txt");
    file_write_text(points.path, "0 0 0\n8 8 8\n1 1 1\n7 0.5 0.25\n");
    json_t *root = inspect_json(points.path, "--capacity 1 --node root");
    assert_members(root, "cloud node depth leaf count box points");
    assert_int_equal(whole(root, "count"), 4);
    assert_int_equal(json_array_size(json_member(root, "points")), 0);
    json_decref(root);
    json_t *leaf = inspect_json(points.path, "--capacity 1 --node 4");
    assert_true(json_is_true(json_member(leaf, "leaf")));
    assert_int_equal(whole(leaf, "depth"), 1);
    const json_t *point = json_array_get(json_member(leaf, "points"), 0);
    assert_whole_number(json_member(point, "id"), 3);
    assert_true(json_real_value(json_array_get(json_member(point, "position"), 2)) == 0.25);
    json_decref(leaf);
    json_t *deep = inspect_json(points.path, "--capacity 1 --node 0/0");
    assert_int_equal(whole(deep, "depth"), 2);
    json_decref(deep);
    command_result result = run_octreel(NULL, "inspect %s --capacity 1 --node 4", points.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "3: 7 0.5 0.25"));
    command_release(&result);
}

static void missing_node_is_refused_and_nothing_is_written(void **state)
{
    static const char *const addresses[] = {
        "nonsense", "8",         "0/8",    "0//3", "0/3/",
        "-1",       "7/7/7/7/7", "root/0", "03",   "0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0"};
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    const place csv = place_in(*state, "nodes.csv");
    file_write_text(points.path, "0 0 0\n8 8 8\n1 1 1\n");
    for (size_t i = 0; i < sizeof addresses / sizeof addresses[0]; i++) {
        command_result result = run_octreel(NULL, "inspect %s --node %s -o %s --nodes %s --size 64x64", points.path,
                                            addresses[i], picture.path, csv.path);
        assert_trouble(&result, addresses[i]);
        if (file_exists(picture.path) || file_exists(csv.path))
            fail_msg("--node %s is refused, but a file is written", addresses[i]);
    }
}

static void same_points_in_every_format_give_the_same_output(void **state)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 500\nproperty double x\nproperty double y\n"
                              "property double z\nend_header\n";
    static const char pcd[] = "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 500\nHEIGHT 1\n"
                              "POINTS 500\nDATA ascii\n";
    const place files[] = {write_points(state, "a.txt", ""), write_points(state, "a.ply", ply),
                           write_points(state, "a.pcd", pcd)};
    json_t *first = inspect_json(files[0].path, "--capacity 3");
    json_object_del(first, "cloud");
    for (size_t i = 1; i < sizeof files / sizeof files[0]; i++) {
        json_t *other = inspect_json(files[i].path, "--capacity 3");
        json_object_del(other, "cloud");
        assert_true(json_equal(first, other));
        json_decref(other);
    }
    json_decref(first);
}

static void million_equal_points_are_refused_or_fill_one_leaf(void **state)
{
    enum { COUNT = 1000000, SIZE = 6 };
    const place points = place_in(*state, "points.txt");
    char *text = malloc((size_t)COUNT * SIZE);
    assert_non_null(text);
    for (size_t i = 0; i < COUNT; i++)
        memcpy(text + i * SIZE, "1 2 3\n", SIZE);
    file_write(points.path, text, (size_t)COUNT * SIZE);
    free(text);
    json_t *refused = inspect_json(points.path, "--full refuse");
    assert_adds_up(refused);
    assert_int_equal(whole(refused, "stored"), 64);
    assert_int_equal(whole(refused, "refused"), COUNT - 64);
    json_decref(refused);
    json_t *grown = inspect_json(points.path, "");
    assert_adds_up(grown);
    assert_int_equal(whole(grown, "largest_leaf"), COUNT);
    assert_int_equal(whole(grown, "leaves"), 1);
    json_decref(grown);
}

static void picture_is_whole_and_carries_its_digests(void **state)
{
    const place points = write_points(state, "points.txt", ""), picture = place_in(*state, "tree.png");
    char text[64], digest[IMAGE_DIGEST_TEXT];
    command_result result =
        run_octreel(NULL, "inspect %s --size 320x180 --color-points plain -o %s", points.path, picture.path);
    assert_done(&result);
    command_release(&result);
    image frame = assert_whole_frame(picture.path, 320, 180);
    assert_true(image_read_text(picture.path, "octreel-pixels", text, sizeof text));
    assert_string_equal(text, image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&frame), digest));
    assert_true(image_read_text(picture.path, "octreel-scene", text, sizeof text));
    assert_int_equal(strlen(text), 16);
    assert_false(image_read_text(picture.path, "octreel-tick", text, sizeof text));
    image_release(&frame);
}

/* inspect chooses options that are not given, and reports them. The 500 points are far apart in the largest picture,
 * close surfaces in a smaller one, and more than the pixels of the smallest. There leaves are shown, unless they are
 * too small. */
static void output_names_the_view_options_that_inspect_chose(void **state)
{
    static const struct {
        const char *options, *said;
        int color_type; /* PNG colour type: 2 is RGB, 3 is indexed */
    } rows[] = {
        {"--size 1280x720 --zoom 20", "pixels; points by height (--color-points)\n", 2},
        {"--size 320x180", "points by height (--color-points), lit by eye-dome lighting (--shade)\n", 2},
        {"--size 16x9", "(--shade); leaves are too small to see: a larger --capacity makes them larger", 2},
        {"--size 16x9 --capacity 512", "by leaf (--color-points), because there are more points than pixels", 2},
        {"--size 16x9 --color-points id", "points by id (--color-points), lit by", 2},
        {"--size 320x180 --shade none", "points by height (--color-points)\n", 2},
        {"--size 320x180 --color-points id --shade none", "180 pixels\n", 2},
        {"--size 320x180 --layers -points", "180 pixels\n", 3},
        {"--size 320x180 --diagram only", "180 pixels\n", 3},
        {"--size 320x180 --color-points plain", "180 pixels\n", 3}};
    const place points = write_points(state, "points.txt", ""), picture = place_in(*state, "tree.png");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        static png_bytes file;
        command_result result = run_octreel(NULL, "inspect %s %s -o %s", points.path, rows[i].options, picture.path);
        assert_done(&result);
        if (!strstr(result.out, rows[i].said))
            fail_msg("%s: %s", rows[i].options, result.out);
        png_bytes_load(&file, picture.path);
        assert_int_equal(png_chunk_of(&file, "IHDR").data[9], rows[i].color_type);
        command_release(&result);
    }
}

static void invalid_options_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {
        {"--capacity 0", "--capacity"},
        {"--capacity -3", "-3"},
        {"--capacity 4294967296", "4294967296"},
        {"--capacity 2.5", "2.5"},
        {"--depth 22", "0 to 21"},
        {"--depth -1", "-1"},
        {"--full maybe", "maybe"},
        {"--world 0,0,0,1,1", "six"},
        {"--world 0,0,0,1,1,1,1", "six"},
        {"--world 0,0,0,1,0,1", "below"},
        {"--world 0,0,0,1,nan,1", "six"},
        {"--world 0,0,0,1,1e999,1", "six"},
        {"--world 3,0,0,1,1,1", "below"},
        {"--world=", "six"},
        {"--size 0x0", "1 to 16384"},
        {"--camera up", "up"},
        {"--layers walls", "walls"},
        {"--color-by rainbow", "depth, occupancy, plain"},
        {"--diagram up", "none, beside, only"},
        {"--slice z=99", "outside the world"},
        {"--region 9,9,9,10,10,10", "outside the world"},
        {"--depth 2:5", "--depths"},
        {"--depth 3 --depths 4", "the deepest level of the tree is 3"},
        {"second.txt third.txt", "inspect: unexpected argument \"second.txt\"; for several files: for f in *.pcd; do "},
        {"--node root --node 3", "--node can be given only once; found root and 3"},
    };
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    file_write_text(points.path, "1 2 3\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "inspect %s -o %s %s", points.path, picture.path, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_int_equal(temp_folder_count(*state), 1);
    }
    command_result result = run_octreel(NULL, "inspect -o %s", picture.path);
    assert_trouble(&result, "needs one point cloud");
}

static void picture_options_without_a_picture_are_refused(void **state)
{
    static const char *const rows[][2] = {
        {"--size 64x64", "--size changes the picture, but no picture is drawn: add -o"},
        {"--labels --camera top", "--camera changes the picture"},
        {"--depths 1:2 --json", "--depths changes the picture"},
        {"--camera-from nowhere", "--camera-from changes the picture"},
        {"--context egl", "--context changes the picture"},
        {"--context egl --any-renderer --nodes nodes.csv", "--any-renderer changes the picture"},
    };
    const place points = place_in(*state, "points.txt");
    file_write_text(points.path, "1 2 3\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "inspect %s %s", points.path, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
    }
    command_result result = run_octreel(NULL, "inspect %s", points.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "fullest leaf 1 point\n"));
    command_release(&result);
}

/* Clouds without extent are visible. */
static void degenerate_clouds_are_drawn(void **state)
{
    static const char *const clouds[] = {"1 2 3\n", "5 5 5\n5 5 5\n5 5 5\n5 5 5\n5 5 5\n",
                                         "0 7 7\n1 7 7\n2 7 7\n9 7 7\n"};
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    for (size_t i = 0; i < 3; i++) {
        file_write_text(points.path, clouds[i]);
        for (int camera = 0; camera < CAMERA_COUNT; camera++) {
            command_result result =
                run_octreel(NULL, "inspect %s --capacity 2 --size 160x90 --layers points --camera %s --fit %s -o %s",
                            points.path, view_camera_name(camera), camera % 2 ? "world" : "points", picture.path);
            assert_done(&result);
            command_release(&result);
            image drawn = assert_read(picture.path);
            const image_color ground = image_color_at(&drawn, 0, 0);
            size_t lit = 0;
            for (int at = 0; at < 160 * 90; at++) {
                const image_color color = image_color_at(&drawn, at % 160, at / 160);
                lit += memcmp(&color, &ground, sizeof color) != 0;
            }
            assert_true(lit >= 9); /* a mark of three pixels */
            image_release(&drawn);
        }
    }
}

/* A rename would replace a pipe or a device by a regular file. */
static void picture_replaces_only_regular_files(void **state)
{
    const place points = place_in(*state, "points.txt"), pipe = place_in(*state, "pipe");
    struct stat status;
    file_write_text(points.path, "1 2 3\n");
    assert_int_equal(mkfifo(pipe.path, 0666), 0);
    command_result result = run_octreel(NULL, "inspect %s --size 64x64 -o %s", points.path, pipe.path);
    assert_int_equal(lstat(pipe.path, &status), 0);
    assert_true(S_ISFIFO(status.st_mode));
    assert_trouble(&result, pipe.path);
}

/* Only a picture needs a renderer. */
static void statistics_need_no_renderer(void **state)
{
    static const command_setting other = {.environment = {"GALLIUM_DRIVER=softpipe"}};
    const place points = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    file_write_text(points.path, "1 2 3\n");
    command_result result = run_octreel(&other, "inspect %s", points.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(&other, "inspect %s -o %s", points.path, picture.path);
    assert_int_equal(result.status, 0); /* the integer rasterizer draws, and a note says why OSMesa checked nothing */
    assert_non_null(strstr(result.err, "softpipe"));
    assert_true(file_exists(picture.path));
    command_release(&result);
    result = run_octreel(&other, "inspect %s --fill gl -o %s.gl.png", points.path, picture.path);
    assert_trouble(&result, "softpipe");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(statistics_add_up),
        IN_FOLDER(text_and_json_have_the_same_statistics),
        IN_FOLDER(bounds_enclose_the_points),
        IN_FOLDER(nodes_lie_within_their_parents_and_hold_all_points),
        IN_FOLDER(node_option_prints_box_and_points),
        IN_FOLDER(missing_node_is_refused_and_nothing_is_written),
        IN_FOLDER(same_points_in_every_format_give_the_same_output),
        IN_FOLDER(million_equal_points_are_refused_or_fill_one_leaf),
        IN_FOLDER(picture_is_whole_and_carries_its_digests),
        IN_FOLDER(output_names_the_view_options_that_inspect_chose),
        IN_FOLDER(invalid_options_are_refused_in_one_sentence),
        IN_FOLDER(picture_options_without_a_picture_are_refused),
        IN_FOLDER(degenerate_clouds_are_drawn),
        IN_FOLDER(picture_replaces_only_regular_files),
        IN_FOLDER(statistics_need_no_renderer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
