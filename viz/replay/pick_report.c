/* pick_report.c - what is drawn at a pixel, for people and as JSON; see pick.h. */
#include "json_write.h"
#include "pick.h"

#include <inttypes.h>
#include <math.h>

#define COLOR_TEXT 8

static char *print_color(const pick *p, char text[COLOR_TEXT])
{
    snprintf(text, COLOR_TEXT, "#%02x%02x%02x", p->color.r, p->color.g, p->color.b);
    return text;
}

static double distance(const pick *p)
{
    const double dx = p->pixel[0] - p->asked[0], dy = p->pixel[1] - p->asked[1];
    return sqrt(dx * dx + dy * dy);
}

/* It is in the gaps between dashes, which are painted too. */
static bool is_gap(const pick_element *e)
{
    return e->touch.painted > 0 && e->touch.color == 0 && e->kind != DRAW_PANEL;
}

/* ---- For people --------------------------------------------------------------------------------------------- */

static void print_heading(FILE *out, const pick *p)
{
    char color[COLOR_TEXT];
    fprintf(out, "%s: tick %" PRIu64 ", pixel (%d, %d)", p->path, p->tick, p->asked[0], p->asked[1]);
    if (p->count == 0)
        fprintf(out, ": nothing is drawn there, nor within %d pixels\n", p->radius);
    else if (distance(p) > 0)
        fprintf(out, ": nothing is drawn there; %.1f pixels away, at (%d, %d), %s:\n", distance(p), p->pixel[0],
                p->pixel[1], print_color(p, color));
    else
        fprintf(out, ", %s:\n", print_color(p, color));
}

/* What an element has to do with the pixel. */
static void print_element(FILE *out, const pick *p, const pick_element *e)
{
    if (e->touch.painted == 0) {
        fprintf(out, "      %s %s\n",
                e->kind == DRAW_BOX ? "its edge is also that of" : "on the same pixel:", e->subject.text);
        return;
    }
    fputs(e->touch.shown ? "  " : "    over ", out);
    if (e->touch.shown && p->samples > 1)
        fprintf(out, "%d of %d samples: ", e->touch.shown, p->samples);
    fprintf(out, "%s%s\n", e->subject.text, is_gap(e) ? " (between two of its dashes)" : "");
}

static void print_people(FILE *out, const pick *p)
{
    print_heading(out, p);
    for (size_t i = 0; i < p->count; i++)
        print_element(out, p, &p->elements[i]);
}

/* ---- JSON --------------------------------------------------------------------------------------------------- */

static void write_pair(json_writer *w, const char *key, int first, int second)
{
    json_write_key(w, key);
    json_write_begin_array(w);
    json_write_integer(w, (uint64_t)first);
    json_write_integer(w, (uint64_t)second);
    json_write_end_array(w);
}

static void write_node(json_writer *w, const element_subject *subject)
{
    char path[OCTREE_ADDRESS_TEXT];
    const octree_node *node = &subject->node;
    json_write_key(w, "node");
    json_write_begin_object(w);
    json_member_text(w, "path", octree_address_format(node->address, path));
    json_member_integer(w, "depth", node->depth);
    if (!subject->gone) {
        json_write_key(w, "leaf");
        json_write_bool(w, node->leaf);
        json_member_integer(w, "points", node->count);
    }
    json_member_box(w, "box", &node->box);
    json_write_end_object(w);
}

static void write_point(json_writer *w, const octree_point *point)
{
    json_write_key(w, "point");
    json_write_begin_object(w);
    json_member_integer(w, "id", point->id);
    json_member_vector(w, "position", point->position);
    json_write_end_object(w);
}

static void write_element(json_writer *w, const pick_element *e)
{
    json_write_begin_object(w);
    json_member_text(w, "kind", draw_kind_name(e->kind));
    json_member_text(w, "layer", e->layer);
    json_member_integer(w, "shown", (uint64_t)e->touch.shown);
    json_member_integer(w, "painted", (uint64_t)e->touch.painted);
    if (is_gap(e)) {
        json_write_key(w, "gap");
        json_write_bool(w, true);
    }
    if (e->subject.has_node)
        write_node(w, &e->subject);
    if (e->subject.has_point)
        write_point(w, &e->subject.point);
    json_member_text(w, "text", e->subject.text);
    json_write_end_object(w);
}

static void print_json(FILE *out, const pick *p)
{
    json_writer writer = {.out = out}, *w = &writer;
    char color[COLOR_TEXT];
    json_write_begin_object(w);
    json_member_text(w, "frame", p->path);
    json_member_integer(w, "tick", p->tick);
    write_pair(w, "size", p->width, p->height);
    write_pair(w, "asked", p->asked[0], p->asked[1]);
    json_member_integer(w, "radius", (uint64_t)p->radius);
    json_write_key(w, "pixel");
    if (p->count) {
        json_write_begin_array(w);
        json_write_integer(w, (uint64_t)p->pixel[0]);
        json_write_integer(w, (uint64_t)p->pixel[1]);
        json_write_end_array(w);
    } else {
        json_write_null(w);
    }
    json_member_text(w, "color", print_color(p, color));
    json_member_integer(w, "samples", (uint64_t)p->samples);
    json_write_key(w, "elements");
    json_write_begin_array(w);
    for (size_t i = 0; i < p->count; i++)
        write_element(w, &p->elements[i]);
    json_write_end_array(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

void pick_print(FILE *out, const pick *p, bool json)
{
    (json ? print_json : print_people)(out, p);
}
