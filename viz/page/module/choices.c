/* SPDX-License-Identifier: MIT */
#include "choices.h"
#include "json_write.h"
#include "layer.h"
#include "octree/game.h"
#include "theme.h"
#include "view_options.h"

static void write_names(json_writer *w, const char *key, json_name *names)
{
    json_member_begin_array(w, key);
    for (int i = 0; names(i); i++)
        json_write_string(w, names(i));
    json_write_end_array(w);
}

static void write_color(json_writer *w, theme_role role)
{
    char text[8];
    const theme_color c = theme_color_at(theme_index(role, 0));
    snprintf(text, sizeof text, "#%02x%02x%02x", c.r, c.g, c.b);
    json_member_text(w, "color", text);
}

/* Of the members that a kind reads, the one that bears its name in a session comes first. */
static void write_query_kinds(json_writer *w)
{
    static const struct {
        octree_query_member bit;
        const char *name;
    } members[] = {{OCTREE_QUERY_HAS_BOX, "box"},
                   {OCTREE_QUERY_HAS_K, "k"},
                   {OCTREE_QUERY_HAS_RADIUS, "radius"},
                   {OCTREE_QUERY_HAS_TARGET, "at"}};
    json_member_begin_array(w, "queries");
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
        json_write_begin_object(w);
        json_member_text(w, "name", about->name);
        json_member_text(w, "words", about->words);
        json_member_begin_array(w, "members");
        for (int pass = 0; pass < 2; pass++)
            for (size_t i = 0; i < sizeof members / sizeof members[0]; i++)
                if (about->members & members[i].bit && (about->named_by == members[i].bit) == !pass)
                    json_write_string(w, members[i].name);
        json_write_end_array(w);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

bool choices_write(FILE *out)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        if (option->member.codec == &json_choice || option->member.codec == &json_later_choice)
            write_names(w, option->member.name, option->member.names);
    }
    json_member_begin_array(w, "layers");
    for (int i = 0; i < LAYER_COUNT; i++) {
        json_write_begin_object(w);
        json_member_text(w, "name", layer_rows[i].name);
        json_member_text(w, "words", layer_rows[i].words);
        write_color(w, (theme_role)layer_rows[i].role);
        json_write_end_object(w);
    }
    json_write_end_array(w);
    write_query_kinds(w);
    json_write_end_object(w);
    return true;
}
