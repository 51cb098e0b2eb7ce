/* inspect_report.c - what there is to say about the tree of a cloud: for people, as JSON, as CSV. */
#include "inspect.h"
#include "json_write.h"
#include "number.h"
#include "plural.h"

#include <inttypes.h>

/* Leaves by the points that they hold: bucket 0 holds empty leaves, bucket b those of 2^(b-1) .. 2^b - 1 points. */
#define BUCKETS 34

typedef struct occupancy {
    size_t leaves[BUCKETS];
} occupancy;

static octree_walk_order count_leaf(const octree_node *node, void *context)
{
    occupancy *o = context;
    unsigned bucket = 0;
    for (size_t count = node->count; count; count >>= 1)
        bucket++;
    o->leaves[bucket] += node->leaf;
    return OCTREE_WALK_ON;
}

static occupancy occupancy_of(const octree *tree)
{
    occupancy o = {{0}};
    octree_walk(tree, count_leaf, &o);
    return o;
}

static size_t bucket_low(unsigned bucket)
{
    return bucket ? (size_t)1 << (bucket - 1) : 0;
}

static size_t bucket_high(unsigned bucket)
{
    return bucket ? ((size_t)1 << bucket) - 1 : 0;
}

static void print_bar(FILE *out, size_t value, size_t largest)
{
    static const char bar[] = "########################################";
    const size_t most = sizeof bar - 1;
    const size_t length = largest ? (value * most + largest - 1) / largest : 0;
    fprintf(out, "  %10zu  %.*s\n", value, (int)length, bar);
}

static void print_depths(const octree_stats *stats, FILE *out)
{
    size_t largest = 0;
    for (unsigned depth = 0; depth <= stats->depth; depth++)
        largest = stats->leaves_at_depth[depth] > largest ? stats->leaves_at_depth[depth] : largest;
    fprintf(out, "leaves by depth\n");
    for (unsigned depth = 0; depth <= stats->depth; depth++) {
        fprintf(out, "  %10u", depth);
        print_bar(out, stats->leaves_at_depth[depth], largest);
    }
}

static void print_occupancy(const octree *tree, FILE *out)
{
    const occupancy o = occupancy_of(tree);
    size_t largest = 0;
    for (unsigned i = 0; i < BUCKETS; i++)
        largest = o.leaves[i] > largest ? o.leaves[i] : largest;
    fprintf(out, "leaves by points\n");
    for (unsigned i = 0; i < BUCKETS; i++) {
        char span[48];
        if (!o.leaves[i])
            continue;
        if (bucket_low(i) == bucket_high(i))
            snprintf(span, sizeof span, "%zu", bucket_low(i));
        else
            snprintf(span, sizeof span, "%zu-%zu", bucket_low(i), bucket_high(i));
        fprintf(out, "  %10s", span);
        print_bar(out, o.leaves[i], largest);
    }
}

static void print_position(FILE *out, const char *name, const double position[3])
{
    char text[NUMBER_TEXT];
    fprintf(out, "%s", name);
    for (int i = 0; i < 3; i++) {
        number_print(position[i], text);
        fprintf(out, " %s", text);
    }
}

static void print_box(FILE *out, const char *name, const octree_box *box)
{
    print_position(out, name, box->min);
    print_position(out, "  to ", box->max);
    fputc('\n', out);
}

void inspect_print(const inspection *i, const char *name, FILE *out)
{
    octree_stats stats;
    octree_statistics(i->tree, &stats);
    const octree_def def = octree_definition(i->tree);
    fprintf(out, "%s\n", name);
    fprintf(out, "  points    %zu in the file, %zu in the tree, %zu refused, %zu outside the world\n", i->points,
            stats.points, i->refused, i->outside);
    if (i->skipped)
        fprintf(out, "  skipped   %zu without finite coordinates\n", i->skipped);
    print_box(out, "  world    ", &def.world);
    fprintf(out, "  capacity  %zu, depth at most %zu\n", def.leaf_capacity, def.max_depth);
    fprintf(out, "  nodes     %zu, %zu of them leaves; deepest %u; fullest leaf %zu point%s\n", stats.nodes,
            stats.leaves, stats.depth, stats.largest_leaf, plural(stats.largest_leaf));
    fprintf(out, "  memory    %zu bytes, %.1f a point\n", stats.memory,
            stats.points ? (double)stats.memory / (double)stats.points : 0.0);
    print_depths(&stats, out);
    print_occupancy(i->tree, out);
}

static void write_occupancy(json_writer *w, const octree *tree)
{
    const occupancy o = occupancy_of(tree);
    json_write_key(w, "leaves_by_points");
    json_write_begin_array(w);
    for (unsigned i = 0; i < BUCKETS; i++) {
        if (!o.leaves[i])
            continue;
        json_write_begin_object(w);
        json_member_integer(w, "from", bucket_low(i));
        json_member_integer(w, "to", bucket_high(i));
        json_member_integer(w, "leaves", o.leaves[i]);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_depths(json_writer *w, const char *key, const size_t *counts, unsigned depth)
{
    json_write_key(w, key);
    json_write_begin_array(w);
    for (unsigned i = 0; i <= depth; i++)
        json_write_integer(w, counts[i]);
    json_write_end_array(w);
}

void inspect_print_json(const inspection *i, const char *name, FILE *out)
{
    octree_stats stats;
    octree_statistics(i->tree, &stats);
    const octree_def def = octree_definition(i->tree);
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_key(w, "cloud");
    json_write_string(w, name);
    json_member_integer(w, "points", i->points);
    json_member_integer(w, "skipped", i->skipped);
    json_member_integer(w, "refused", i->refused);
    json_member_integer(w, "outside", i->outside);
    json_member_integer(w, "stored", stats.points);
    json_member_box(w, "world", &def.world);
    json_member_integer(w, "capacity", def.leaf_capacity);
    json_member_integer(w, "max_depth", def.max_depth);
    json_member_integer(w, "nodes", stats.nodes);
    json_member_integer(w, "leaves", stats.leaves);
    json_member_integer(w, "depth", stats.depth);
    json_member_integer(w, "largest_leaf", stats.largest_leaf);
    json_member_integer(w, "memory", stats.memory);
    write_depths(w, "nodes_by_depth", stats.nodes_at_depth, stats.depth);
    write_depths(w, "leaves_by_depth", stats.leaves_at_depth, stats.depth);
    write_occupancy(w, i->tree);
    json_write_end_object(w);
    json_write_end_line(w);
}

static void print_node(const octree_node *node, const char *name, FILE *out)
{
    char address[OCTREE_ADDRESS_TEXT];
    fprintf(out, "%s\n", name);
    fprintf(out, "%s: %s of %zu points at depth %u\n", octree_address_format(node->address, address),
            node->leaf ? "leaf" : "inner node", node->count, node->depth);
    print_box(out, "  box", &node->box);
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        fprintf(out, "  %" PRIu64, node->points[i].id);
        print_position(out, ":", node->points[i].position);
        fputc('\n', out);
    }
}

static void write_node(const octree_node *node, const char *name, FILE *out)
{
    char address[OCTREE_ADDRESS_TEXT];
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_key(w, "cloud");
    json_write_string(w, name);
    json_write_key(w, "node");
    json_write_string(w, octree_address_format(node->address, address));
    json_member_integer(w, "depth", node->depth);
    json_write_key(w, "leaf");
    json_write_bool(w, node->leaf);
    json_member_integer(w, "count", node->count);
    json_member_box(w, "box", &node->box);
    json_write_key(w, "points");
    json_write_begin_array(w);
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        json_write_begin_object(w);
        json_write_key(w, "id");
        json_write_integer(w, node->points[i].id);
        json_write_key(w, "position");
        json_write_numbers(w, node->points[i].position, 3);
        json_write_end_object(w);
    }
    json_write_end_array(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

bool inspect_find_node(const inspection *i, const char *address, octree_node *node, octreel_error *error)
{
    octree_address parsed;
    if (!octree_address_parse(address, &parsed))
        return error_set(
            error, "\"%s\" is not a node's address; it is octants from the root down, as in 0/3/7, or root", address);
    return octree_node_at(i->tree, parsed, node) == OCTREE_OK ||
           error_set(error, "there is no node %s in this tree", address);
}

void inspect_print_node(const octree_node *node, const char *name, bool json, FILE *out)
{
    if (json)
        write_node(node, name, out);
    else
        print_node(node, name, out);
}

static octree_walk_order write_row(const octree_node *node, void *context)
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
    octree_walk(i->tree, write_row, file.stream);
    return file_writer_close(&file, error);
}
