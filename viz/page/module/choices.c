/* SPDX-License-Identifier: MIT */
#include "choices.h"
#include "json_write.h"
#include "layer.h"
#include "octree/game.h"
#include "theme.h"
#include "view_options.h"

static void write_names(json_writer *w, const char *key, json_name *names)
{
    json_begin_array_member(w, key);
    for (int i = 0; names(i); i++)
        json_write_string(w, names(i));
    json_write_end_array(w);
}

static void write_color(json_writer *w, theme_role role)
{
    char text[THEME_COLOR_TEXT];
    json_write_text_member(w, "color", theme_print_color(theme_color_at(theme_color_index(role, 0)), text));
}

JSON_NAMES(bounds_name, octree_bounds_name, octree_bounds)

/* Write the members of queries of one kind. The member after which the kind is named comes first. */
static void write_query_members(json_writer *w, const octree_query_traits *about)
{
    static const char *const types[] = {[OCTREE_MEMBER_BOX] = "box",
                                        [OCTREE_MEMBER_POSITION] = "position",
                                        [OCTREE_MEMBER_DIRECTION] = "position",
                                        [OCTREE_MEMBER_COUNT] = "number",
                                        [OCTREE_MEMBER_LENGTH] = "number",
                                        [OCTREE_MEMBER_BOUNDS] = "choice",
                                        [OCTREE_MEMBER_FRUSTUM] = "half-spaces",
                                        [OCTREE_MEMBER_EXTENTS] = "position"};
    json_begin_array_member(w, "members");
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
            const octree_query_member_traits *member = octree_query_member_at(i);
            if (!(about->members & member->bit) || (about->named_by == member->bit) == pass)
                continue;
            json_write_begin_object(w);
            json_write_text_member(w, "name", member->key);
            json_write_text_member(w, "type", types[member->type]);
            if (member->type == OCTREE_MEMBER_BOUNDS)
                write_names(w, "choices", bounds_name);
            json_write_end_object(w);
        }
    json_write_end_array(w);
}

static void write_query_kinds(json_writer *w)
{
    json_begin_array_member(w, "queries");
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
        json_write_begin_object(w);
        json_write_text_member(w, "name", about->name);
        json_write_text_member(w, "words", about->words);
        write_query_members(w, about);
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
        if (option->member.codec == &json_choice)
            write_names(w, option->member.name, option->member.names);
    }
    json_begin_array_member(w, "layers");
    for (int i = 0; i < LAYER_COUNT; i++) {
        json_write_begin_object(w);
        json_write_text_member(w, "name", layer_rows[i].name);
        json_write_text_member(w, "words", layer_rows[i].words);
        write_color(w, (theme_role)layer_rows[i].role);
        json_write_end_object(w);
    }
    json_write_end_array(w);
    write_query_kinds(w);
    json_write_end_object(w);
    return true;
}
