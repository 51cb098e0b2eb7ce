/* SPDX-License-Identifier: MIT */
/* inspect.c - prints the statistics and the nodes of the tree of a point cloud. */
#include "inspect.h"
#include "file.h"
#include "json_write.h"
#include "number.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- Statistics ----------------------------------------------------------------------------------------- */

/* One row of a histogram: the number of leaves that hold `from` to `to` points, or that lie at depths `from` to `to`.
 */
typedef struct histogram_row {
    size_t from, to, leaves;
} histogram_row;

/* Row 0 counts empty leaves, row r the leaves with 2^(r-1) to 2^r - 1 points. The last row ends with the number of
 * points in the fullest leaf. */
#define OCCUPANCY_ROWS 34

static octree_walk_order count_leaf(const octree_node *node, void *context)
{
    histogram_row *rows = context;
    unsigned row = 0;
    for (size_t count = node->count; count; count >>= 1)
        row++;
    rows[row].leaves += node->leaf;
    return OCTREE_WALK_ON;
}

/* Fill `rows` with the rows that count at least one leaf. Returns the number of rows. */
static size_t count_leaves_by_points(const octree *tree, size_t fullest, histogram_row rows[OCCUPANCY_ROWS])
{
    size_t used = 0;
    for (unsigned i = 0; i < OCCUPANCY_ROWS; i++)
        rows[i] = (histogram_row){i ? (size_t)1 << (i - 1) : 0, i ? ((size_t)1 << i) - 1 : 0, 0};
    octree_walk(tree, count_leaf, rows);
    for (unsigned i = 0; i < OCCUPANCY_ROWS; i++)
        if (rows[i].leaves)
            rows[used++] = rows[i];
    rows[used - 1].to = fullest;
    return used;
}

static void print_histogram(FILE *out, const char *title, const histogram_row *rows, size_t count)
{
    static const char bar[] = "########################################";
    const size_t longest = sizeof bar - 1;
    size_t largest = 1;
    for (size_t i = 0; i < count; i++)
        largest = rows[i].leaves > largest ? rows[i].leaves : largest;
    fprintf(out, "%s\n", title);
    for (size_t i = 0; i < count; i++) {
        char span[48];
        int length = snprintf(span, sizeof span, "%zu", rows[i].from);
        if (rows[i].from < rows[i].to)
            snprintf(span + length, sizeof span - (size_t)length, "-%zu", rows[i].to);
        length = (int)((rows[i].leaves * longest + largest - 1) / largest);
        fprintf(out, "  %10s  %10zu  %.*s\n", span, rows[i].leaves, length, bar);
    }
}

static void print_histograms(FILE *out, const octree *tree, const octree_stats *stats)
{
    histogram_row depths[OCTREE_MAX_DEPTH + 1], occupancy[OCCUPANCY_ROWS];
    for (unsigned depth = 0; depth <= stats->depth; depth++)
        depths[depth] = (histogram_row){depth, depth, stats->leaves_at_depth[depth]};
    print_histogram(out, "leaves by depth", depths, stats->depth + 1);
    print_histogram(out, "leaves by points", occupancy, count_leaves_by_points(tree, stats->largest_leaf, occupancy));
}

void inspect_print_name(const char *name, FILE *out)
{
    write_escaped(out, name, escape_nothing);
    fputc('\n', out);
}

void inspect_print_numbers(const double *values, size_t count, FILE *out)
{
    char text[NUMBER_TEXT];
    for (size_t i = 0; i < count; i++) {
        number_print(values[i], text);
        fprintf(out, " %s", text);
    }
}

void inspect_print_point(const octree_point *point, const char *name, const double *distance, FILE *out)
{
    fprintf(out, "  %" PRIu64 ":", point->id);
    inspect_print_numbers(point->position, 3, out);
    if (distance) {
        fprintf(out, "  %s", name);
        inspect_print_numbers(distance, 1, out);
    }
    fputc('\n', out);
}

void inspect_write_point(json_writer *w, const octree_point *point, const char *name, const double *distance)
{
    json_write_begin_object(w);
    json_write_integer_member(w, "id", point->id);
    json_write_vector_member(w, "position", point->position);
    if (distance)
        json_write_number_member(w, name, *distance);
    json_write_end_object(w);
}

static void print_box(FILE *out, const char *name, const octree_box *box)
{
    fputs(name, out);
    inspect_print_numbers(box->min, 3, out);
    fputs("  to ", out);
    inspect_print_numbers(box->max, 3, out);
    fputc('\n', out);
}

static octree_walk_order widen_bounds(const octree_node *node, void *context)
{
    octree_box *bounds = context;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double at = node->points[i].position[axis];
            bounds->min[axis] = at < bounds->min[axis] ? at : bounds->min[axis];
            bounds->max[axis] = at > bounds->max[axis] ? at : bounds->max[axis];
        }
    return OCTREE_WALK_ON;
}

/* Returns the smallest box around the points of a tree, which must not be empty. */
static octree_box find_bounds(const octree *tree)
{
    octree_box bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    octree_walk(tree, widen_bounds, &bounds);
    return bounds;
}

static void print_statistics(const inspection *i, const octree_stats *stats, const char *name, FILE *out)
{
    const octree_def def = octree_definition(i->tree);
    inspect_print_name(name, out);
    fprintf(out, "  points    %zu in the file, %zu in the tree, %zu refused, %zu outside the world\n",
            i->points + i->skipped, stats->points, i->refused, i->outside);
    if (i->skipped)
        fprintf(out, "  skipped   %zu %s\n", i->skipped, i->why_skipped);
    inspect_print_values(i, out);
    if (stats->points) {
        const octree_box bounds = find_bounds(i->tree);
        print_box(out, "  bounds   ", &bounds);
    }
    print_box(out, "  world    ", &def.world);
    fprintf(out, "  capacity  %zu, depth at most %zu\n", def.leaf_capacity, def.max_depth);
    fprintf(out, "  nodes     %zu (%zu %s); deepest %u; fullest leaf %zu point%s\n", stats->nodes, stats->leaves,
            stats->leaves == 1 ? "leaf" : "leaves", stats->depth, stats->largest_leaf,
            plural_ending(stats->largest_leaf));
    fprintf(out, "  memory    %zu bytes, %.1f a point\n", stats->memory,
            stats->points ? (double)stats->memory / (double)stats->points : 0.0);
    print_histograms(out, i->tree, stats);
}

static void write_occupancy(json_writer *w, const octree *tree, size_t fullest)
{
    histogram_row rows[OCCUPANCY_ROWS];
    const size_t count = count_leaves_by_points(tree, fullest, rows);
    json_begin_array_member(w, "leaves_by_points");
    for (size_t i = 0; i < count; i++) {
        json_write_begin_object(w);
        json_write_integer_member(w, "from", rows[i].from);
        json_write_integer_member(w, "to", rows[i].to);
        json_write_integer_member(w, "leaves", rows[i].leaves);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_depths(json_writer *w, const char *key, const size_t *counts, unsigned depth)
{
    json_begin_array_member(w, key);
    for (unsigned i = 0; i <= depth; i++)
        json_write_integer(w, counts[i]);
    json_write_end_array(w);
}

static void write_statistics(const inspection *i, const octree_stats *stats, const char *name, FILE *out)
{
    const octree_def def = octree_definition(i->tree);
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_text_member(w, "cloud", name);
    json_write_integer_member(w, "points", i->points);
    json_write_integer_member(w, "skipped", i->skipped);
    json_write_integer_member(w, "refused", i->refused);
    json_write_integer_member(w, "outside", i->outside);
    json_write_integer_member(w, "stored", stats->points);
    inspect_write_values(i, w);
    if (stats->points) {
        const octree_box bounds = find_bounds(i->tree);
        json_write_box_member(w, "bounds", &bounds);
    }
    json_write_box_member(w, "world", &def.world);
    json_write_integer_member(w, "capacity", def.leaf_capacity);
    json_write_integer_member(w, "max_depth", def.max_depth);
    json_write_integer_member(w, "nodes", stats->nodes);
    json_write_integer_member(w, "leaves", stats->leaves);
    json_write_integer_member(w, "depth", stats->depth);
    json_write_integer_member(w, "largest_leaf", stats->largest_leaf);
    json_write_integer_member(w, "memory", stats->memory);
    write_depths(w, "nodes_by_depth", stats->nodes_at_depth, stats->depth);
    write_depths(w, "leaves_by_depth", stats->leaves_at_depth, stats->depth);
    write_occupancy(w, i->tree, stats->largest_leaf);
    json_write_end_object(w);
    json_write_end_line(w);
}

void inspect_print(const inspection *i, const char *name, bool json, FILE *out)
{
    octree_stats stats;
    octree_statistics(i->tree, &stats);
    (json ? write_statistics : print_statistics)(i, &stats, name, out);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

static void print_node(const octree_node *node, const char *name, FILE *out)
{
    char address[OCTREE_ADDRESS_TEXT];
    inspect_print_name(name, out);
    fprintf(out, "%s: %s of %zu point%s at depth %u\n", octree_address_format(node->address, address),
            node->leaf ? "leaf" : "inner node", node->count, plural_ending(node->count), node->depth);
    print_box(out, "  box", &node->box);
    for (size_t i = 0; node->leaf && i < node->count && i < LIST_LINES; i++)
        inspect_print_point(&node->points[i], NULL, NULL, out);
    print_remaining_count(out, node->leaf ? node->count : 0, LIST_LINES, "--json lists all");
}

static void write_node(const octree_node *node, const char *name, FILE *out)
{
    char address[OCTREE_ADDRESS_TEXT];
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_text_member(w, "cloud", name);
    json_write_text_member(w, "node", octree_address_format(node->address, address));
    json_write_integer_member(w, "depth", node->depth);
    json_write_bool_member(w, "leaf", node->leaf);
    json_write_integer_member(w, "count", node->count);
    json_write_box_member(w, "box", &node->box);
    json_begin_array_member(w, "points");
    for (size_t i = 0; node->leaf && i < node->count; i++)
        inspect_write_point(w, &node->points[i], NULL, NULL);
    json_write_end_array(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error)
{
    octree_address parsed;
    if (!octree_address_parse(address, &parsed))
        return error_set(error,
                         "\"%s\" is not a node address: write the octants from the root down, such as 0/3/7, or root",
                         address);
    return octree_node_at(i->tree, parsed, node) == OCTREE_OK || error_set(error, "the tree has no node %s", address);
}

void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out)
{
    (json ? write_node : print_node)(node, name, out);
}

static octree_walk_order write_node_row(const octree_node *node, void *context)
{
    FILE *out = context;
    char text[OCTREE_ADDRESS_TEXT];
    fprintf(out, "%s,%u,%d,%zu", octree_address_format(node->address, text), node->depth, node->leaf, node->count);
    for (int i = 0; i < 6; i++) {
        number_print(i < 3 ? node->box.min[i] : node->box.max[i - 3], text);
        fprintf(out, ",%s", text);
    }
    fputc('\n', out);
    return ferror(out) ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

bool inspect_write_nodes(const inspection *i, const char *path, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open(&file, path, error))
        return false;
    fputs("address,depth,leaf,count,min_x,min_y,min_z,max_x,max_y,max_z\n", file.stream);
    octree_walk(i->tree, write_node_row, file.stream);
    return file_writer_close(&file, error);
}
