/* SPDX-License-Identifier: MIT */
/* test_cloud_values.c - colours, intensities and classes of text, PLY and PCD; test_cloud_las.c has those of LAS. */
#include "clouds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Read a cloud of values and say what each point has: "#rrggbb intensity class", "-" for none. */
static void say(const cloud *c, char *text, size_t size)
{
    size_t length = 0;
    text[0] = 0;
    for (size_t i = 0; i < c->count; i++) {
        const point_value v = point_values_get(&c->values, cloud_row_number(c, i));
        char color[8] = "-", intensity[16] = "-", class[8] = "-";
        if (v.has[POINT_COLOR])
            snprintf(color, sizeof color, "#%02x%02x%02x", v.color[0], v.color[1], v.color[2]);
        if (v.has[POINT_INTENSITY])
            snprintf(intensity, sizeof intensity, "%g", (double)v.intensity);
        if (v.has[POINT_CLASS])
            snprintf(class, sizeof class, "%u", (unsigned)v.class);
        length += (size_t)snprintf(text + length, size - length, "%s%s %s %s", i ? ", " : "", color, intensity, class);
    }
}

static void assert_values(const char *name, const void *data, size_t size, const char *values, unsigned full,
                          const char *note)
{
    cloud c;
    octreel_error error;
    char said[256];
    if (!cloud_parse(name, data, size, &c, &error))
        fail_msg("%s", error.text);
    say(&c, said, sizeof said);
    if (strcmp(said, values) != 0)
        print_error("%.*s\n", (int)size, (const char *)data);
    assert_string_equal(said, values);
    assert_int_equal(c.color_full, full);
    assert_string_equal(c.column_note, note ? note : "");
    cloud_release(&c);
}

typedef struct reading {
    const char *text, *values;
    unsigned full;
    const char *note;
} reading;

static void assert_reads_each(const char *name, const reading *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        assert_values(name, rows[i].text, strlen(rows[i].text), rows[i].values, rows[i].full, rows[i].note);
}

#define ASSERT_READS_EACH(name, rows) assert_reads_each(name, rows, sizeof rows / sizeof rows[0])

/* ---- Text --------------------------------------------------------------------------------------------------- */

#define IGNORES "these values are ignored: "

static void text_values_follow_the_names_in_its_first_line(void **state)
{
    static const reading rows[] = {
        {"x y z r g b\n1 2 3 255 0 16\n", "#ff0010 - -", 255, NULL},
        {"X,Y,Z,Red,Green,Blue,Intensity,Classification\n1,2,3,1,2,300,0.5,6\n4,5,6,65535,256,255,7,2\n",
         "#000001 0.5 6, #ff0100 7 2", 65535, NULL},
        {"x y z red green blue\n1 2 3 0 0.5 1\n4 5 6 1 1 1\n", "#0080ff - -, #ffffff - -", 1, NULL},
        {"x y z red green blue\n1 2 3 0 0.5 1\n4 5 6 1 1 200\n", "#000101 - -, #0101c8 - -", 255, NULL},
        {"//X Y Z B G R Scalar_Intensity\n1 2 3 9 8 7 -2.5\n", "#070809 -2.5 -", 255, NULL},
        {"# x y z label\n1 2 3 40\n4 5 6\n7 8 9 1.5\n1 1 1 70000\n1 1 1 none\n", "- - 40, - - -, - - -, - - -, - - -",
         0, NULL},
        {"x [m], y [m], z [m], id, \"intensity\" [dB]\n1,2,3,17,-4\n4,5,6,,\n7,8,9,18,\"5\"\n", "- -4 -, - - -, - 5 -",
         0, IGNORES "'id'"},
        {"# x y z r g b\nx;y;z;class\n1;2;3;4\n", "- - 4", 0, NULL},
        {"# x y z class\n# x y z intensity\n1 2 3 4\n", "- - 4", 0, NULL},
        {"x (m), y (m), z (m), {, intensity (dB)\n1,2,3,4,5\n", "- 5 -", 0, IGNORES "'{'"},
        {"x y z red\n1 2 3 255\n", "- - -", 0, IGNORES "'red'"},
        {"x,y,z,r,g,b\n1,2,3, 4 ,5\t, 6\n", "#040506 - -", 255, NULL},
        {"x y z r g b r\n1 2 3 4 5 6 7\n", "#040506 - -", 255, IGNORES "'r'"},
        {"x y z rgb r g b\n1 2 3 4 5 6 7\n", "#050607 - -", 255, IGNORES "'rgb'"},
        {"# x y z nx\nx y z b ny r\n1 2 3 4 5 6\n", "- - -", 0, IGNORES "'ny', 'r', 'b'"},
        {"x y z intensity\n1 2 3 1e39\n4 5 6 nan\n7 8 9 1\n", "- - -, - - -, - 1 -", 0, NULL},
        {"x y z r g b\n1 2 3 -1 0 0\n4 5 6 0 0 65536\n7 8 9 1 2 3 # here\n", "- - -, - - -, #010203 - -", 255, NULL},
    };
    (void)state;
    ASSERT_READS_EACH("a.xyz", rows);
}

#define THREE_READ "columns 4 to 6 have no names and are read as r g b"
#define FOUR_READ "columns 4 to 7 have no names and are read as intensity r g b"
#define FOUR_IGNORED                                                                                                   \
    "columns 4 to 7 have no names and are ignored: they may be r g b and another value, or intensity r g b; add a "    \
    "first line with names, such as x y z intensity r g b"

#define IGNORED                                                                                                        \
    "the columns from the fourth on have no names and are ignored; add a first line with the names of all columns, "   \
    "such as x y z r g b"

static void unnamed_columns_are_colours_if_every_line_agrees(void **state)
{
    static const reading rows[] = {
        {"1 2 3 255 0 16\n4 5 6 0 0 0\n", "#ff0010 - -, #000000 - -", 255, THREE_READ},
        {"1;2;3;255;0;16\n", "#ff0010 - -", 255, THREE_READ},
        {"1 2 3 128 0 16\n", "#800010 - -", 255, THREE_READ},
        {"1 2 3 127 0 16\n", "- - -", 0, IGNORED}, /* none is bright */
        {"1 2 3 0 0.25 0.5\n", "#004080 - -", 1, THREE_READ ", from 0 to 1"},
        {"1 2 3 -1340 49 51 201\n4 5 6 7 1 1 1\n", "#3133c9 -1340 -, #010101 7 -", 255, FOUR_READ},
        {"1 2 3 0.25 49 51 201\n", "#3133c9 0.25 -", 255, FOUR_READ},
        {"1 2 3 7 49 51 201\n", "- - -", 0, FOUR_IGNORED},
        {"1 2 3 0 0 1\n4 5 6 0 1 0\n", "- - -, - - -", 0, IGNORED},      /* normals */
        {"1 2 3 255 0 16\n4 5 6 0 0 0.5\n", "- - -, - - -", 0, IGNORED}, /* one line that is not */
        {"1 2 3 255 0 16\n4 5 6 0 0 256\n", "- - -, - - -", 0, IGNORED},
        {"1 2 3 255 0 16\n4 5 6 0 0\n", "- - -, - - -", 0, IGNORED},
        {"1 2 3 255 0 16\n4 5 6 0 0 0 0\n", "- - -, - - -", 0, IGNORED},
        {"1 2 3 255 0\n", "- - -", 0, IGNORED},
        {"1 2 3 255 0 16 7 8\n", "- - -", 0, IGNORED},
        {"1 2 3 0 0.5 1\n4 5 6 0.25 0 0\n", "#0080ff - -, #400000 - -", 1, THREE_READ ", from 0 to 1"},
        {"1 2 3 9 0 0.5 1\n4 5 6 9 0 0 0\n", "#0080ff 9 -, #000000 9 -", 1, FOUR_READ ", from 0 to 1"},
        {"1 2 3 0.5 0 0.5 1\n", "- - -", 0, FOUR_IGNORED},
        {"1 2 3 1 1 0\n4 5 6 1 0 200\n", "#010100 - -, #0100c8 - -", 255, THREE_READ},
        {"1 2 3 0.6 0.8 0\n4 5 6 0 0.6 0.8\n", "- - -, - - -", 0, IGNORED}, /* normals */
        {"1 2 3 0 0.5 1\n4 5 6 0 0.5 1.5\n", "- - -, - - -", 0, IGNORED},
        {"1 2 3 0 0.25 0.3\n", "- - -", 0, IGNORED},
        {"1 2 3 255 0 name\n", "- - -", 0, IGNORED},
        {"nan nan nan\n1 2 3 255 0 16\nnan nan nan 0.5 nan nan\n4 5 6 0 0 0\n", "#ff0010 - -, #000000 - -", 255,
         THREE_READ},
    };
    (void)state;
    ASSERT_READS_EACH("a.xyz", rows);
}

/* The ending of the name declares columns, and in .pts files the count of points: dark colours are colours. */
static void columns_are_declared_by_the_ending(void **state)
{
    static const reading counted[] = {
        {"2\n1 2 3 0 255 0 16\n4 5 6 0 9 8 7\n", "#ff0010 0 -, #090807 0 -", 255, NULL}, /* as Open3D writes it */
        {"1\n1 2 3 0 0 0 0\n", "#000000 0 -", 255, NULL},
        {"# scan\n1\n1 2 3 -1340 1 0 1\n", "#010001 -1340 -", 255, NULL},
        {"1\n1 2 3 1 0 1\n", "#010001 - -", 255, NULL},
        {"1\n1 2 3 7\n", "- 7 -", 0, NULL},
        {"1\n1 2 3\n", "- - -", 0, NULL},
        {"1\n1 2 3 255 0\n", "- - -", 0, IGNORED},
        {"# x y z label\n1\n1 2 3 255\n", "- - 255", 0, NULL},
        {"1 2 3 0 0 0\n", "- - -", 0, IGNORED}, /* without a count */
    };
    static const reading colors[] = {
        {"1 2 3 0 0 0\n", "#000000 - -", 1, NULL},
        {"1 2 3 0.02 0 0.004\n", "#050001 - -", 1, NULL},
        {"1 2 3 1 0 0\n4 5 6 0.6 0.8 0\n", "#ff0000 - -, #99cc00 - -", 1, NULL},
        {"1 2 3 7 0 255\n", "#0700ff - -", 255, NULL},
        {"1 2 3 nan 0 0\n4 5 6\n", "- - -, - - -", 0, NULL},
        {"x y z b g r\n1 2 3 1 0 0\n", "#0000ff - -", 1, NULL},
        {"1 2 3 0 0\n", "- - -", 0, IGNORED},
    };
    static const reading normals[] = {
        {"1 2 3 0.5 0.5 0.9\n", "- - -", 0, IGNORES "'nx', 'ny', 'nz'"},
        {"1 2 3 255 0 16\n", "- - -", 0, IGNORES "'nx', 'ny', 'nz'"},
    };
    (void)state;
    ASSERT_READS_EACH("a.pts", counted);
    ASSERT_READS_EACH("a.XYZRGB", colors);
    ASSERT_READS_EACH("a.xyzn", normals);
    assert_values("a.xyz", counted[0].text, strlen(counted[0].text), "- - -, - - -", 0, FOUR_IGNORED);
}

static void values_out_of_range_are_counted_and_described(void **state)
{
    static const struct {
        const char *text, *told;
    } rows[] = {
        {"x y z r g b\n1 2 3 -1 0 0\n4 5 6 0 0 65536\n7 8 9 1 2 3\n", "2 colours beyond 0 to 65535 are left out"},
        {"x y z r g b\n1 2 3 1 2\n4 5 6 1 2 3\n", ""}, /* none is said */
        {"x y z intensity label\n1 2 3 1e39 1.5\n4 5 6 1 -1\n7 8 9 nan 4\n",
         "1 intensity beyond a float, 2 classes that are not integers from 0 to 65535 are left out"},
        {"x y z label\n1 2 3 70000\n", "1 class that is not an integer from 0 to 65535 is left out"},
        {"1 2 3 255 0 16\n4 5 6 0 0 256\n", ""}, /* not read at all, which is said */
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        cloud c;
        octreel_error error;
        char told[CLOUD_OUT_OF_RANGE_TEXT];
        assert_true(cloud_parse("a.xyz", (const unsigned char *)rows[i].text, strlen(rows[i].text), &c, &error));
        assert_string_equal(cloud_describe_out_of_range(c.out_of_range, told), rows[i].told);
        cloud_release(&c);
    }
}

/* ---- PLY ---------------------------------------------------------------------------------------------------- */

#define PLY(properties, lines)                                                                                         \
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n" properties       \
    "end_header\n" lines

static void ply_has_colours_of_every_type(void **state)
{
    static const reading rows[] = {
        {PLY("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
             "1 2 3 255 1 2 9\n4 5 6 0 0 1 9\n"),
         "#ff0102 - -, #000001 - -", 255, IGNORES "'alpha'"},
        {PLY("property ushort red\nproperty ushort green\nproperty ushort blue\n",
             "1 2 3 65535 256 255\n4 5 6 0 0 1\n"),
         "#ff0100 - -, #000000 - -", 65535, NULL},
        {PLY("property ushort r\nproperty ushort g\nproperty ushort b\n", "1 2 3 255 1 2\n4 5 6 0 0 1\n"),
         "#ff0102 - -, #000001 - -", 255, NULL},
        {PLY("property float red\nproperty float green\nproperty float blue\n", "1 2 3 1 0.2 0\n4 5 6 0 nan 1\n"),
         "#ff3300 - -, - - -", 1, NULL},
        {PLY("property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\nproperty double "
             "scalar_Intensity\nproperty int label\n",
             "1 2 3 1 2 3 0.5 -1\n4 5 6 4 5 6 1e300 65535\n"),
         "#010203 0.5 -, #040506 - 65535", 255, NULL},
        {PLY("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar red\n",
             "1 2 3 1 2 3 4\n4 5 6 4 5 6 7\n"),
         "#010203 - -, #040506 - -", 255, IGNORES "'red'"},
        {PLY("property uchar red\nproperty list uchar uchar green\nproperty uchar blue\n",
             "1 2 3 1 1 2 3\n4 5 6 4 0 6\n"),
         "- - -, - - -", 0, IGNORES "'green', 'red', 'blue'"},
        {PLY("property float nx\nproperty float ny\nproperty float nz\n", "1 2 3 1 0 0\n4 5 6 0 0 1\n"), "- - -, - - -",
         0, IGNORES "'nx', 'ny', 'nz'"},
    };
    (void)state;
    ASSERT_READS_EACH("a.ply", rows);
}

static void binary_ply_has_values_in_both_byte_orders(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        bytes file = {.size = 0};
        put_text(&file, big ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
        put_text(&file, "element vertex 1\nproperty ushort red\nproperty float x\nproperty float y\nproperty float z\n"
                        "property ushort green\nproperty ushort blue\nproperty float intensity\nproperty uchar class\n"
                        "end_header\n");
        put_bits(&file, 0x1234, 2, big);
        for (int i = 0; i < 3; i++)
            put_float(&file, 1, big);
        put_bits(&file, 0xff00, 2, big);
        put_bits(&file, 7, 2, big);
        put_float(&file, 0.25F, big);
        put_bits(&file, 31, 1, big);
        assert_values("a.ply", file.data, file.size, "#12ff00 0.25 31", 65535, NULL);
    }
}

/* ---- PCD ---------------------------------------------------------------------------------------------------- */

#define PCD(fields, sizes, types, lines)                                                                               \
    "VERSION 0.7\nFIELDS x y z " fields "\nSIZE 4 4 4 " sizes "\nTYPE F F F " types "\nWIDTH 2\nHEIGHT 1\nDATA "       \
    "ascii\n" lines

static void pcd_has_packed_colours_as_integers_and_floats(void **state)
{
    static const reading rows[] = {
        {PCD("rgb", "4", "F", "1 2 3 2.34180529e-38\n4 5 6 nan\n"), "#ff0001 - -, - - -", 255, NULL},
        {PCD("rgb", "4", "F", "1 2 3 4278190335\n4 5 6 16711680\n"), "#0000ff - -, #ff0000 - -", 255, NULL},
        {PCD("rgba", "4", "U", "1 2 3 4278255361\n4 5 6 0\n"), "#00ff01 - -, #000000 - -", 255, NULL},
        {PCD("r g b intensity label", "1 1 1 4 4", "U U U F U", "1 2 3 255 0 1 0.5 2\n4 5 6 9 8 7 -1 70000\n"),
         "#ff0001 0.5 2, #090807 -1 -", 255, NULL},
        {PCD("rgb", "8", "F", "1 2 3 1\n4 5 6 2\n"), "- - -, - - -", 0, IGNORES "'rgb'"},
        {PCD("rgb rgb", "4 4", "U U", "1 2 3 255 7\n4 5 6 256 7\n"), "#0000ff - -, #000100 - -", 255, IGNORES "'rgb'"},
        {PCD("_ curvature", "1 4", "U F", "1 2 3 0 9\n4 5 6 0 9\n"), "- - -, - - -", 0, IGNORES "'curvature'"},
        {PCD("r g b", "4 4 4", "F F F", "1 2 3 0 0.2 1\n4 5 6 1 1 1\n"), "#0033ff - -, #ffffff - -", 1, NULL},
        {PCD("label", "4", "U\nCOUNT 1 1 1 2", "1 2 3 7 8\n4 5 6 7 8\n"), "- - -, - - -", 0, IGNORES "'label'"},
    };
    (void)state;
    ASSERT_READS_EACH("a.pcd", rows);
}

static void a_long_list_of_ignored_values_is_cut(void **state)
{
    char text[2000] = "x y z";
    cloud c;
    octreel_error error;
    (void)state;
    for (int i = 0; i < 99; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " return_number_%02d", i);
    strcat(text, "\n1 2 3\n");
    assert_true(cloud_parse("a.xyz", (const unsigned char *)text, strlen(text), &c, &error));
    assert_string_equal(c.column_note,
                        IGNORES "'return_number_00', 'return_number_01', 'return_number_02', 'return_number_03', "
                                "'return_number_04', 'return_number_05', 'return_number_06', 'return_number_07', "
                                "'return_number_08', ...");
    cloud_release(&c);
}

static void binary_pcd_has_packed_colours_in_the_bits_of_a_float(void **state)
{
    bytes file = {.size = 0};
    (void)state;
    put_text(&file,
             "VERSION 0.7\nFIELDS rgb x y z label\nSIZE 4 4 4 4 4\nTYPE F F F F U\nWIDTH 3\nHEIGHT 1\nDATA binary\n");
    for (unsigned i = 0; i < 3; i++) {
        put_bits(&file, 0xff0a0b00 + i, 4, false); /* a NaN */
        for (int axis = 0; axis < 3; axis++)
            put_float(&file, i == 1 ? NAN : 1, false);
        put_bits(&file, i, 4, false);
    }
    assert_values("a.pcd", file.data, file.size, "#0a0b00 - 0, #0a0b02 - 2", 255, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_values_follow_the_names_in_its_first_line),
        cmocka_unit_test(unnamed_columns_are_colours_if_every_line_agrees),
        cmocka_unit_test(columns_are_declared_by_the_ending),
        cmocka_unit_test(values_out_of_range_are_counted_and_described),
        cmocka_unit_test(ply_has_colours_of_every_type),
        cmocka_unit_test(binary_ply_has_values_in_both_byte_orders),
        cmocka_unit_test(pcd_has_packed_colours_as_integers_and_floats),
        cmocka_unit_test(a_long_list_of_ignored_values_is_cut),
        cmocka_unit_test(binary_pcd_has_packed_colours_in_the_bits_of_a_float),
    };
    return cmocka_run_group_tests_name("cloud values", tests, NULL, NULL);
}
