/* element_words.c - see element_words.h. */
#include "element_words.h"
#include "element_ids.h"
#include "layer.h"
#include "number.h"
#include "text.h"
#include "velocity_layer.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* What is being told. */
typedef struct teller {
    const octree_game *game;
    const octree_tick *tick;
    const heat *heat;
    element_subject *subject;
    size_t length; /* of the text */
} teller;

static void say(teller *t, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(t->subject->text + t->length, sizeof t->subject->text - t->length, format, arguments);
    va_end(arguments);
    t->length += length > 0 ? (size_t)length : 0;
    if (t->length >= sizeof t->subject->text)
        t->length = sizeof t->subject->text - 1; /* cut */
}

static void say_number(teller *t, double value)
{
    char text[NUMBER_TEXT];
    number_print(value, text);
    say(t, "%s", text);
}

static void say_place(teller *t, const double place[3])
{
    for (int i = 0; i < 3; i++) {
        say(t, i ? ", " : "(");
        say_number(t, place[i]);
    }
    say(t, ")");
}

static void say_box(teller *t, const octree_box *box)
{
    say_place(t, box->min);
    say(t, " to ");
    say_place(t, box->max);
}

static void say_count(teller *t, size_t count, const char *of)
{
    say(t, "%zu %s%s", count, of, plural(count));
}

/* ---- Nodes and points --------------------------------------------------------------------------------------- */

static const char *path_of(octree_address address, char text[OCTREE_ADDRESS_TEXT])
{
    return octree_address_format(address, text);
}

static void take_node(teller *t, octree_address address)
{
    element_subject *subject = t->subject;
    const octree *tree = octree_game_tree(t->game);
    subject->has_node = true;
    subject->gone = octree_node_at(tree, address, &subject->node) != OCTREE_OK;
    if (subject->gone) {
        const octree_box world = octree_definition(tree).world;
        subject->node = (octree_node){
            .address = address, .depth = octree_address_depth(address), .box = octree_cell_box(&world, address)};
    }
}

static void say_node(teller *t, octree_address address)
{
    char path[OCTREE_ADDRESS_TEXT];
    const octree_node *node = &t->subject->node;
    take_node(t, address);
    say(t, "node %s: ", path_of(address, path));
    if (t->subject->gone) {
        say(t, "an empty cell at depth %u, which has no node any more", node->depth);
    } else {
        say(t, "%s at depth %u, ", node->leaf ? "leaf" : "inner node", node->depth);
        say_count(t, node->count, "point");
    }
    say(t, ", box ");
    say_box(t, &node->box);
}

static void say_point(teller *t, uint64_t id, const double position[3])
{
    t->subject->has_point = true;
    t->subject->point.id = id;
    memcpy(t->subject->point.position, position, sizeof t->subject->point.position);
    say(t, "point %" PRIu64 " at ", id);
    say_place(t, position);
}

/* ---- Answers ------------------------------------------------------------------------------------------------ */

static const octree_answer *answer_at(const teller *t, uint64_t place)
{
    return place < t->tick->answer_count ? &t->tick->answers[place] : NULL;
}

/* "the nearest query", "range query 2": numbered as in the tick's line, where it has several. */
static void say_query(teller *t, uint64_t place)
{
    const octree_answer *answer = answer_at(t, place);
    say(t, "%s query", answer ? octree_query_name(answer->kind) : "a");
    if (t->tick->answer_count > 1)
        say(t, " (answer %" PRIu64 " of %zu)", place + 1, t->tick->answer_count);
}

static void say_range(teller *t, const scene_box *box)
{
    const octree_answer *answer = answer_at(t, box->id);
    say(t, "the box of the ");
    say_query(t, box->id);
    say(t, ": ");
    say_box(t, &box->box);
    if (answer) {
        say(t, ", ");
        say_count(t, answer->count, "point");
        say(t, " found");
    }
}

static void say_ball(teller *t, uint64_t place)
{
    const octree_answer *answer = answer_at(t, place);
    say(t, "the ball of the ");
    say_query(t, place);
    if (!answer)
        return;
    say(t, ": radius ");
    say_number(t, answer->radius);
    say(t, " about ");
    say_place(t, answer->target);
    say(t, ", ");
    say_count(t, answer->count, "point");
    say(t, " found");
}

static void say_neighbor(teller *t, uint64_t place, uint64_t rank)
{
    const octree_answer *answer = answer_at(t, place);
    say(t, "the line of the ");
    say_query(t, place);
    if (!answer || rank >= answer->count)
        return;
    const octree_neighbor *neighbor = &answer->neighbors[rank];
    say(t, " to neighbour %" PRIu64 ": ", rank + 1);
    say_point(t, neighbor->point.id, neighbor->point.position);
    say(t, ", distance ");
    say_number(t, neighbor->distance);
}

/* ---- Kinds of elements -------------------------------------------------------------------------------------- */

static void say_own_box(teller *t, const scene_box *box)
{
    static const char *const names[WORLD_IDS] = {
        [WORLD_ID] = "the world, box ",
        [SLICE_ID] = "the slice that the view shows, box ",
        [REGION_ID] = "the region that the view shows, box ",
    };
    say(t, "%s", names[box->id < WORLD_IDS ? box->id : WORLD_ID]);
    say_box(t, &box->box);
}

/* What the session shows beside its points. */
static void say_shape(teller *t, uint64_t place)
{
    const octree_shape *shape = &t->tick->shapes[place];
    say(t, "shape %" PRIu64 " of the session, %s ", place, octree_shape_name(shape->kind));
    if (shape->kind == OCTREE_SHAPE_LABEL)
        say(t, "at ");
    say_place(t, shape->at);
    if (shape->kind == OCTREE_SHAPE_BOX || shape->kind == OCTREE_SHAPE_SEGMENT) {
        say(t, " to ");
        say_place(t, shape->to);
    }
}

static void say_collision_box(teller *t, const scene_box *box)
{
    const bool met = box->id == COLLISION_BOX_ID;
    say(t, met ? "the collision box where the step met something, " : "the player's collision box, ");
    say_box(t, &box->box);
}

static void box_words(teller *t, const scene_box *box)
{
    static const char *const ends[LAYER_DIAGRAM + 1] = {
        [LAYER_PRUNED] = "; the tick's questions left it out by its box",
        [LAYER_VISITED] = "; the tick's questions looked into it",
        [LAYER_HIT] = "; it holds what the tick's questions found",
        [LAYER_BROKEN] = "; an invariant is broken there",
    };
    switch (box->style.layer) {
    case LAYER_WORLD:
        say_own_box(t, box);
        break;
    case LAYER_RANGE:
        say_range(t, box);
        break;
    case LAYER_BOX:
        say_collision_box(t, box);
        break;
    case LAYER_SHAPES:
        say_shape(t, box->id);
        break;
    default:
        say_node(t, box->id);
        say(t, "%s", ends[box->style.layer] ? ends[box->style.layer] : "");
        break;
    }
}

static void say_axis(teller *t, uint64_t id)
{
    if (id < 3)
        say(t, "the %c axis", "xyz"[id]);
    else
        say(t, "a mark of an axis");
}

static void say_change(teller *t, uint64_t id, const char *what)
{
    say(t, "a plane of a node that %s at this tick, ", what);
    say_node(t, change_line_node(id));
}

static void say_tree_line(teller *t, const scene_segment *line)
{
    say(t, line->style.role == ROLE_PLAYER ? "in the diagram, the way to the player: " : "in the diagram, ");
    say(t, "the line from its parent to ");
    say_node(t, line->id);
}

static void say_velocity(teller *t, uint64_t id)
{
    for (size_t i = 0; i < t->tick->mover_count; i++) {
        const octree_body *body = &t->tick->movers[i];
        if (body->id != id)
            continue;
        say(t, "the velocity of ");
        say_point(t, id, body->position);
        say(t, ": ");
        say_place(t, body->velocity);
        say(t, " a tick, drawn for %u", velocity_ticks(t->game));
    }
}

static void segment_words(teller *t, const scene_segment *line)
{
    switch (line->style.layer) {
    case LAYER_WORLD:
        say_axis(t, line->id);
        break;
    case LAYER_SPLITS:
        say_change(t, line->id, "split");
        break;
    case LAYER_MERGES:
        say_change(t, line->id, "merged");
        break;
    case LAYER_VELOCITIES:
        say_velocity(t, line->id);
        break;
    case LAYER_RADIUS:
        say_ball(t, answer_part_place(line->id));
        break;
    case LAYER_KNEAREST:
        say_neighbor(t, answer_part_place(line->id), answer_part(line->id));
        break;
    case LAYER_NEAREST:
        say_neighbor(t, line->id, 0);
        break;
    case LAYER_PLAYER:
        say(t, "the line from the player down to the world's floor");
        break;
    case LAYER_BOX:
        say(t, line->id < CROSS_LINES ? "a line that crosses the collision out" : "a way of the swept collision test");
        break;
    case LAYER_BROKEN:
        say(t, "a line that crosses out where an invariant is broken");
        break;
    case LAYER_SHAPES:
        say_shape(t, line->id);
        break;
    case LAYER_DIAGRAM:
        say_tree_line(t, line);
        break;
    default:
        say(t, "a line");
        break;
    }
}

static void say_heat(teller *t, const scene_marker *mark)
{
    const heat_cell seen = heat_at(t->heat, mark->id);
    if (mark->style.layer == LAYER_VISIT_HEAT)
        say(t, "visited in %" PRIu64 " of %" PRIu64 " ticks, ", seen.visits, t->tick->number + 1);
    else
        say(t, "%" PRIu64 " points in all ticks together, ", seen.points);
    say_node(t, mark->id);
}

static void marker_words(teller *t, const scene_marker *mark)
{
    static const char *const ends[LAYER_DIAGRAM + 1] = {
        [LAYER_RANGE] = ", found by a range query",
        [LAYER_RADIUS] = ", found by a radius query",
        [LAYER_NEAREST] = ", found by a nearest query",
        [LAYER_BOX] = ", in the player's collision box",
    };
    if (mark->style.layer == LAYER_VISIT_HEAT || mark->style.layer == LAYER_POINT_HEAT) {
        say_heat(t, mark);
        return;
    }
    if (mark->style.layer == LAYER_SHAPES) {
        say_shape(t, mark->id);
        return;
    }
    if (mark->style.layer == LAYER_BOX && mark->id == octree_game_session(t->game)->player.id) {
        say(t, "a cross that crosses the collision out"); /* the player is none of its own hits */
        return;
    }
    if (mark->style.layer == LAYER_PLAYER)
        say(t, "the player, ");
    say_point(t, mark->id, mark->at);
    say(t, "%s", ends[mark->style.layer] ? ends[mark->style.layer] : "");
}

static void say_diagram(teller *t, uint64_t id)
{
    if (id == DIAGRAM_GROUND_ID) {
        say(t, "the ground of the diagram");
    } else if (diagram_is_bar(id)) {
        say(t, "in the diagram, a bar: nodes of depth %u that have no room there", diagram_bar_depth(id));
    } else if (diagram_is_way(id)) {
        say(t, "in the diagram, the way to the player");
    } else {
        say(t, "in the diagram, ");
        say_node(t, id);
    }
}

static void panel_words(teller *t, const scene_panel *panel)
{
    if (panel->style.layer == LAYER_DIAGRAM) {
        say_diagram(t, panel->id);
    } else if (panel->style.layer == LAYER_NODES) {
        say(t, "the ground of the path on ");
        say_node(t, panel->id);
    } else if (panel->style.layer == LAYER_WORLD) {
        say(t, "the ground of a number of an axis");
    } else {
        say(t, panel->style.role == ROLE_PANEL ? "the panel that the text is on" : "a sign in the panel");
    }
}

static void label_words(teller *t, const scene_label *label)
{
    say(t, "text \"%s\"", label->text + strspn(label->text, " "));
    switch (label->style.layer) {
    case LAYER_WORLD:
        say(t, " of an axis");
        break;
    case LAYER_NODES:
        say(t, " on ");
        say_node(t, label->id);
        break;
    case LAYER_KNEAREST:
        say(t, ", the rank of a neighbour");
        break;
    case LAYER_SHAPES:
        say(t, ", ");
        say_shape(t, label->id);
        break;
    case LAYER_DIAGRAM:
        say(t, " of the diagram");
        break;
    default:
        break;
    }
}

element_subject element_words(const octree_game *game, const heat *h, const scene *s, scene_element element)
{
    element_subject subject = {.text = ""};
    teller t = {game, octree_game_tick(game), h, &subject, 0};
    switch (element.kind) {
    case SCENE_BOX:
        box_words(&t, &s->boxes.items[element.index]);
        break;
    case SCENE_SEGMENT:
        segment_words(&t, &s->segments.items[element.index]);
        break;
    case SCENE_MARKER:
        marker_words(&t, &s->markers.items[element.index]);
        break;
    case SCENE_PANEL:
        panel_words(&t, &s->panels.items[element.index]);
        break;
    default:
        label_words(&t, &s->labels.items[element.index]);
        break;
    }
    return subject;
}

const char *element_layer(const scene *s, scene_element element)
{
    return view_layer_name((view_layer)scene_style_of(s, element).layer);
}
