/* default_session.c - the paper's session, and a flight through it that meets everything a game can do. */
#include "octree/game.h"

/* Ids are the places in the paper's list; the sixth, (0, 0, 0), is the player. Three points share one cell of depth 5,
 * so one of them is refused at tick 0. */
static const octree_body bodies[] = {
    {.id = 1, .position = {-50, -50, 100}},    {.id = 2, .position = {900, -900, -900}},
    {.id = 3, .position = {900, 900, 900}},    {.id = 4, .position = {-100, -100, 100}},
    {.id = 5, .position = {-1, 2, 3}},         {.id = 7, .position = {750, 750, 750}},
    {.id = 8, .position = {800, 800, 800}},    {.id = 9, .position = {500, 500, 500}},
    {.id = 10, .position = {750, 750, 800}},   {.id = 11, .position = {975, 975, 1000}},
    {.id = 12, .position = {1000, 1000, 975}},
};

static const char keys[] = "n.eeasnassdn." /* three collisions near the origin */
                           "asfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasf" /* down to the lowest corner ... */
                           "sffffnasf."                                         /* ... and against its three faces */
                           "ddweddwedddddddddddddddddddddddddddddddddnddwddddn" /* point 2, and the face x = 1000 */
                           "ewaewaewaewaewaewaewaewaewaewa"                     /* up to point 9 */
                           "ewewewewewewewewewewewewewewewwwneee.n"
                           "dwedwedwedweddewn.en"   /* into the cell that is full */
                           "dwendweenaweeeen"       /* the face z = 1000 */
                           "wddnwaawwdnwfaffssn.."; /* point 11, the face y = 1000 */

#define CORNER(at)                                                                                                     \
    {                                                                                                                  \
        .tick = at, .kind = OCTREE_QUERY_RANGE, .box = { {700, 700, 700}, {1000, 1000, 1000} }                         \
    }

/* The crowded corner is asked for while the player is there. */
static const octree_query queries[] = {
    CORNER(212), CORNER(213), CORNER(214), CORNER(215), CORNER(216), CORNER(217),
    CORNER(218), CORNER(219), CORNER(220), CORNER(221), CORNER(222), CORNER(223),
};

octree_session octree_session_default(void)
{
    octree_session session = {
        .tree = octree_def_default(),
        .player = {.id = 6, .position = {0, 0, 0}, .step = 50, .box_size = 30},
        .bodies = bodies,
        .body_count = sizeof bodies / sizeof bodies[0],
        .keys = keys,
        .queries = queries,
        .query_count = sizeof queries / sizeof queries[0],
    };
    session.tree.leaf_capacity = 2;
    session.tree.max_depth = 5;
    return session;
}
