/* SPDX-License-Identifier: MIT */
/* recorder.h - records a program from inside. In each tick of its loop the program passes its points and its queries. A
 * program that uses the octree library passes its octree or its set of bodies. A program with an index of its own
 * passes a list of points or bodies, or their changes. A query may carry the program's own answer. Octreel then
 * compares this answer with the exact answer, and "octreel audit" prints the result.
 *
 * The recorder writes a session. Point changes since the last tick become edits; the program's queries and shapes are
 * stored beside them. The result is an ordinary recording: octreel can verify, join, compare and replay it. Recording
 * the written session.json again gives the same bytes. A worker thread plays the session and draws the frames while the
 * program's loop runs. With `ring` nothing is recorded until the program requests its last ticks, for example after a
 * failed assertion.
 *
 *     octreel_recorder_def def = octreel_recorder_def_default();
 *     def.folder = "my-flight";
 *     def.tree = octree_definition(tree);
 *     if (octreel_recorder_open(&def, &recorder, &why))
 *         puts(why.text); // the program goes on: recorder is null, and calls with it do nothing
 *     while (...)
 *         octreel_recorder_tick(recorder, tree, NULL);
 *     if (octreel_recorder_close(recorder))
 *         puts(octreel_recorder_error(recorder));
 *     octreel_recorder_destroy(recorder);
 *
 * Without an octree, for example with a k-d tree that found point 17:
 *
 *     octree_query asked = {.kind = OCTREE_QUERY_NEAREST, .target = {1, 2, 3}, .answered = true,
 *                           .answer = (uint64_t[]){17}, .answer_count = 1};
 *     octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.points = all, .point_count = n,
 *                                                                .queries = &asked, .query_count = 1});
 *     octree_edit moved = {.kind = OCTREE_EDIT_MOVE, .body = {.id = 17, .position = {4, 5, 6}}};
 *     octreel_recorder_tick(recorder, NULL, &(octreel_tick_info){.changes = &moved, .change_count = 1});
 *
 * Conventions
 *   - The recorder never ends the process, never handles signals and has no global variables. Any thread may use it,
 *     but only one thread at a time.
 *   - The program may use any floating-point mode: the files are the same in every mode, and each call restores the
 *     program's mode. The program's GL contexts are not touched: the recorder draws in its own thread, with all
 *     signals blocked.
 *   - A child of fork() must not use its parent's recorders.
 *   - Functions return a status. octreel_status_text() returns its text; octreel_recorder_error() returns the last
 *     error in full.
 *   - Each call of octreel_recorder_tick() is a tick. A refused tick keeps its number and becomes a gap in the
 *     recording: it has no frame, and ticks.jsonl holds only the reason. octreel_recorder_close() reports the number
 *     of gaps. No change is lost: the next accepted tick has all changes since the last accepted tick. After
 *     OCTREEL_BROKEN no more ticks are recorded; the earlier ticks are complete.
 *   - Every function accepts a null recorder, does nothing, and returns OCTREEL_OK.
 *   - n is the number of points or bodies. A point is a body without extents, and "points" means bodies, too.
 *   - During recording the session is in FOLDER/session.json.live, one tick per line. After a crash of the program
 *     "octreel record --resume -o FOLDER" completes the recording; only ticks in the queue are lost.
 *   - Files are not synced to the disk. A power cut may damage a file; "octreel verify" finds this.
 */
#ifndef OCTREEL_RECORDER_H
#define OCTREEL_RECORDER_H

#include "octree/game.h"
#include "octreel/error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Every status: its name and its text. */
#define OCTREEL_STATUS_MAP(X)                                                                                          \
    X(OK, "done")                                                                                                      \
    X(NULL_ARGUMENT, "a required pointer is null")                                                                     \
    X(BAD_OPTION, "an option of the recorder has an invalid value")                                                    \
    X(BAD_FOLDER, "no recording can be written into the folder")                                                       \
    X(CANNOT_DRAW, "no renderer can draw the frames")                                                                  \
    X(OTHER_TREE, "the tree's world or options differ from the definition with which the recorder was opened")         \
    X(TWO_SOURCES, "a tick has points from more than one source, or only some of the ticks have a tree")               \
    X(DUPLICATE_ID, "two points have the same id")                                                                     \
    X(BAD_POINT, "a point or a change has a NaN, an infinity, a negative half extent or an unknown kind")              \
    X(NO_POINT, "a change moves or removes a point that does not exist")                                               \
    X(BAD_ID, "an id is 2^53 or larger, which session files cannot store")                                             \
    X(BAD_QUERY,                                                                                                       \
      "a query has a NaN, an infinity, a negative size, a box whose min is above its max, or an invalid skip")         \
    X(BAD_SHAPE, "a shape has a NaN, an infinity, a box whose min is above its max, or an invalid text")               \
    X(BAD_NODE, "a foreign node has an invalid box, id, parent, kind or list of points")                               \
    X(BUSY, "the queue is full, and never_wait is set")                                                                \
    X(BROKEN, "the recording failed at an earlier tick")                                                               \
    X(CLOSED, "the recorder is closed")                                                                                \
    X(NOTHING, "there is no tick to record")                                                                           \
    X(NO_RING, "the recorder has no ring")                                                                             \
    X(NO_MEMORY, "out of memory")                                                                                      \
    X(GAPS, "the recording is complete, but refused ticks are gaps in it")                                             \
    X(BAD_PAIR, "a foreign pair has one id twice")

typedef enum octreel_status {
#define OCTREEL_STATUS_ENUM(name, text) OCTREEL_##name,
    OCTREEL_STATUS_MAP(OCTREEL_STATUS_ENUM)
#undef OCTREEL_STATUS_ENUM
        OCTREEL_STATUS_COUNT
} octreel_status;

/* Returns the text of a status, without a final period. The text is static and never null. */
const char *octreel_status_text(octreel_status status);

typedef struct octreel_recorder octreel_recorder;

/* The options of a recording. Start from octreel_recorder_def_default() and change what you need. "octreel record
 * --help" lists the values of the options that are names. */
typedef struct octreel_recorder_def {
    /* folder of the recording: a new folder, or a folder without a recording. Must be null with a ring */
    const char *folder;
    /* True: `folder` may hold an old recording. The old recording is removed once tick 0 of the new recording is
     * filmed; if tick 0 fails, the old recording stays. Files that do not belong to a recording always stay. The error
     * is BAD_FOLDER if the folder holds files that only look like a recording, or if a process is recording into the
     * folder. */
    bool replace;
    /* The octree_definition() of the program's trees; its allocator is not used. A program that passes lists, sets or
     * changes sets a world that should contain all positions, and the capacity and depth of the tree that Octreel
     * builds to show the points. Full leaves of Octreel's tree grow. */
    octree_def tree;
    /* `kind` is OCTREE_PLAYER_NONE or OCTREE_PLAYER_BODY. With OCTREE_PLAYER_BODY the point with the player's id is the
     * player, and Octreel finds its collisions, with the player's box_size and sweep. The half extents of this body do
     * not change its collisions. */
    octree_player player;
    int width, height;    /* size of a frame in pixels, 1 to 16384 */
    const char *camera;   /* the camera: "iso", "orbit", "follow" ... */
    const char *layers;   /* the layers to draw: "default", "all", "-text", "nodes,points,shapes" ... */
    const char *color_by; /* what the colours of nodes show: "depth", "occupancy", "plain" ... */
    /* The tree whose nodes are drawn. "own": Octreel's tree. "foreign": octreel_tick_info.foreign. "both": both trees.
     * "auto": Octreel's tree until a tick has foreign nodes, and from then on the foreign nodes. */
    const char *show_tree;
    const char *color_points; /* what the colours of points show: "plain", "height", "leaf" ... */
    const char *shade;        /* shading of points: "bands", "edl", "none" */
    /* where the tree is drawn as a diagram: "none": nowhere; "beside": beside the space; "only": without the space */
    const char *diagram;
    bool labels; /* true: write the addresses of nodes, such as 0/3/7, on nodes that have room for them */
    double lod;  /* leave out boxes smaller than this many pixels if an ancestor is drawn; 0: draw all */
    /* maximum number of boxes in a frame, and maximum number of points in a frame; 0: no limit */
    uint64_t budget;
    int aa; /* anti-aliasing: 1 (off), 2 or 4; a pixel has aa * aa samples */
    /* Film ticks 0, every, 2 * every ... With 0, film no frames: the recording's page can draw every tick itself.
     * ticks.jsonl contains all ticks in any case. */
    uint64_t every;
    /* The rasterizer: "integers", "checked" or "gl". All three draw the same pixels. "integers" is the cheapest,
     * because it never loads OpenGL, which takes 0.2 s of processor time and 85 MB. octreel verify can check such
     * frames later. "checked" compares the first frame, every 100th frame and the last frame with the pixels of OSMesa,
     * if OpenGL can be loaded. */
    const char *fill;
    const char *context; /* the OpenGL library to load: "auto", "osmesa", "egl" */
    /* True, with "egl": OpenGL may draw with any renderer, also a graphics card. Frames may then differ between
     * machines. */
    bool any_renderer;
    size_t queue_ticks; /* maximum number of ticks that wait for the worker thread, at least 1 */
    size_t queue_bytes; /* maximum memory of all waiting ticks together, in bytes; a single tick may need more */
    /* True: if the queue is full, octreel_recorder_tick() does not wait but returns OCTREEL_BUSY, and the tick becomes
     * a gap. */
    bool never_wait;
    /* Keep the last `ring` ticks in memory, and film them only when octreel_recorder_write() is called. 0: film every
     * tick. The ring needs memory for the points of its oldest tick and the changes of its other ticks. */
    size_t ring;
} octreel_recorder_def;

/* Returns the default options: no player, 1280 x 720 pixels, camera "iso", the default layers, fill "integers", 16
 * ticks or 64 MiB in the queue, no ring. */
octreel_recorder_def octreel_recorder_def_default(void);

/* The queries and shapes of a program at one tick, and its points if it has no octree. octreel_recorder_tick() copies
 * all arrays. The member `tick` of an array's items is ignored.
 *
 * The recorder answers each query exactly, at the end of the tick, with the query's `skip` and `epsilon`. The program
 * gets the same answers if it makes its queries after its last change of the tick. To show a query that the program
 * made before a change, call octreel_recorder_tick() once before that change. If a query carries the program's own
 * answer, the answer is copied and checked.
 *
 * In one tick the points come from the tree or from one of `points`, `bodies`, `body_set` and `changes`. A program may
 * use lists or sets at some ticks and changes at others, but then it must not use trees. If a program passes no points
 * at a tick, the tick before decides. After changes, no point has changed. After a list, the list is empty: the data
 * pointer of an empty C++ vector may be null. After a set, a null set is the error NULL_ARGUMENT. A point outside the
 * world is in no answer. A tick in which a point is inserted outside the world, moves out of the world, or moves
 * outside the world has the event "refused".
 *
 * A body may reach beyond the world; only its position must lie in it. In a session a move keeps a body's extents.
 * A body whose extents change is therefore removed and inserted again where it is, and then moved.
 *
 * Shapes are everything in a frame that is not a point or a node, such as walls and goals. */
typedef struct octreel_tick_info {
    /* The queries, in any order. All numbers must be finite. at_player may be true only if the recorder has a
     * player. */
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_point *points; /* all points, in any order; each id occurs once */
    size_t point_count;
    const octree_body *bodies; /* all bodies, in any order; each id occurs once */
    size_t body_count;
    /* The program's set of bodies. Its ids must be unique. Frames show Octreel's tree of their positions, with the
     * options of octreel_recorder_def.tree, and not the levels of the set. */
    const octree_bodies *body_set;
    /* Point changes since the last call, in the order in which they were made. A point may change several times. An
     * insertion has the half extents of its body; a move keeps them. To change the extents of a body, remove it and
     * insert it again. Velocities are ignored. */
    const octree_edit *changes;
    size_t change_count;
    /* The nodes of the program's own index, valid from this tick on. Null: the nodes are the same as at the previous
     * tick. The queries' `visits` name the nodes that a query visited, left out or found points in. */
    const octree_foreign_tree *foreign;
    /* The pairs that the program's own index found at this tick, to be compared with the exact pairs. Null: no pairs
     * are compared at this tick. */
    const octree_foreign_pairs *foreign_pairs;
} octreel_tick_info;

/* Open a recorder: copy the definition and create the folder. On failure *recorder is null and *error, which may be
 * null, has the text. Errors: NULL_ARGUMENT, BAD_OPTION, BAD_ID (the player's id), BAD_FOLDER, NO_MEMORY. Cost: one
 * thread; with a ring the thread exists only during octreel_recorder_write(). */
octreel_status octreel_recorder_open(const octreel_recorder_def *def, octreel_recorder **recorder,
                                     octreel_error *error);

/* Record a tick: the current points, the queries and the shapes. The ids of the points must be unique. `about` may be
 * null. The first call is tick 0. The points are the tree's points, or `about` has them if `tree` is null. After a tick
 * with a tree, a null tree is the error NULL_ARGUMENT. A tree under OCTREE_AUTO that has changed its capacity is the
 * error OTHER_TREE. The arguments are not used after the call returns.
 *
 * The worker thread begins the recording and draws the frames. If it is slower than the program, ticks wait in the
 * queue. If the queue is full, the call waits until the worker has finished a tick, or returns BUSY under never_wait.
 * An error of the worker is returned by a later tick or by octreel_recorder_close().
 *
 * If a tick is refused, its list or set is ignored. Its changes and foreign nodes become part of the next accepted
 * tick. Invalid changes are dropped: BAD_POINT (a NaN, an infinity, a negative half extent, an unknown kind), BAD_ID,
 * DUPLICATE_ID (an insertion of an existing id) and NO_POINT (a move or removal of a missing point). The error names
 * the first invalid change. After NO_MEMORY no change is kept: pass the tick again.
 *
 * Errors: NULL_ARGUMENT, OTHER_TREE, TWO_SOURCES, DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, BAD_QUERY, BAD_SHAPE,
 * BAD_NODE, BAD_PAIR, BUSY, CLOSED, NO_MEMORY; of the worker: CANNOT_DRAW, BAD_FOLDER (the folder is no longer as it
 * was when the recorder was opened), BROKEN.
 *
 * Cost by source of the points (q is the number of queries and shapes):
 *    - a tree of which at most an eighth changes in a tick: O(changes + q), some hundred nanoseconds per change. The
 *      tree then keeps its changes for the recorder (octree_changes_since), at 64 bytes each.
 *    - a tree of which more than an eighth changes, or that is new to the recorder, or was tuned, compacted or
 *      cleared; and a list or a set: O(nodes + n + q), and 96 bytes per point.
 *    - changes: O(changes log changes + q), and up to 128 bytes per point. The first changes after a list cost more.
 *    - in addition, half extents: 64 bytes per body of a list or a set, or up to 128 bytes per body with extents of
 *      changes, and up to 128 bytes per body with extents for the worker thread.
 *    - in addition, m foreign nodes or pairs: O(m log m).
 * A tick's changes use memory until the tick is filmed. */
octreel_status octreel_recorder_tick(octreel_recorder *recorder, const octree *tree, const octreel_tick_info *about);

/* Record the ticks and gaps of the ring into a folder. Returns when the recording is complete. Tick 0 of the recording
 * is tick *first of the recorder; `first` may be null. The ring is kept and may be written again into another folder.
 * Errors: NULL_ARGUMENT, NO_RING, NOTHING, CLOSED, BAD_FOLDER, CANNOT_DRAW, BROKEN, NO_MEMORY. GAPS means that the
 * recording is complete but has gaps. */
octreel_status octreel_recorder_write(octreel_recorder *recorder, const char *folder, uint64_t *first);

/* Record the ticks that are still in the queue, and complete the recording with session.json and the page. A ring is
 * dropped. If a tick failed, the ticks before it are complete, and octreel record --resume continues after them.
 * Errors: BROKEN, CANNOT_DRAW, BAD_FOLDER, NOTHING, CLOSED. GAPS means that the recording is complete but ticks were
 * refused. The error text then has the number of refused ticks, and the tick number and the reason of the first refused
 * tick. */
octreel_status octreel_recorder_close(octreel_recorder *recorder);

/* Close the recorder if it is open, and free it. */
void octreel_recorder_destroy(octreel_recorder *recorder);

/* Returns the error text of the last call that failed, or "". Valid until the next call. */
const char *octreel_recorder_error(const octreel_recorder *recorder);

#ifdef __cplusplus
}
#endif

#endif
