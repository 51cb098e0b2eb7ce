/* SPDX-License-Identifier: MIT */
/* recorder.h - records a program from inside. Once per tick of its loop the program passes its points and its queries.
 * The points come from an octree. A program with an index of its own passes a list of points, or the changes of its
 * points. Queries may carry the program's own answers. Octreel then compares them with the exact answers; "octreel
 * audit" prints the result.
 *
 * The recorder writes a session. Point changes since the last tick become edits; the program's queries and shapes are
 * stored beside them. The result is a recording like any other: octreel can verify, join, compare and replay it, and
 * recording its session.json again gives the same bytes. A worker thread plays and draws beside the program's loop.
 * With `ring` nothing is recorded until the program requests its last ticks, for example after a failed assertion.
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
 *   - The program may use any floating-point mode; the files are the same. Each call restores the program's mode. The
 *     program's GL contexts are not touched: the recorder draws in its own thread, with all signals blocked.
 *   - A child of fork() must not use its parent's recorders.
 *   - Functions return a status. octreel_status_text() returns its text; octreel_recorder_error() returns the last
 *     error in full.
 *   - Each call of octreel_recorder_tick() is a tick. A refused tick keeps its number and becomes a gap in the
 *     recording: it has no frame, and ticks.jsonl holds only the reason. octreel_recorder_close() reports the number
 *     of gaps. No change is lost: the next accepted tick has all changes since the last accepted tick. After
 *     OCTREEL_BROKEN no more ticks are recorded; the earlier ticks are complete.
 *   - Every function accepts a null recorder, does nothing, and returns OCTREEL_OK.
 *   - n is the number of points.
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
    X(BAD_FOLDER, "the folder cannot be recorded into")                                                                \
    X(CANNOT_DRAW, "no renderer can draw this")                                                                        \
    X(OTHER_TREE, "the tree has another world or other options than the recorder was opened for")                      \
    X(TWO_SOURCES,                                                                                                     \
      "a tick has more than one of tree, points and changes, or a recorder of trees got points or changes")            \
    X(DUPLICATE_ID, "two points of the tree have one id")                                                              \
    X(BAD_POINT, "a point or a change has a NaN or an infinity, or a change has an unknown kind")                      \
    X(NO_POINT, "a change moves or removes a point that does not exist")                                               \
    X(BAD_ID, "an id is not below 2^53, as files need it")                                                             \
    X(BAD_QUERY,                                                                                                       \
      "a query has a NaN, an infinity, a negative size, a box whose min is above its max, or an unknown skip")         \
    X(BAD_SHAPE, "a shape has a NaN, an infinity, a box whose min is above its max, or an invalid text")               \
    X(BAD_NODE, "a foreign node has an invalid box, id, parent, kind or list of points")                               \
    X(BUSY, "the queue is full, and the recorder was told not to wait")                                                \
    X(BROKEN, "the recording failed at an earlier tick")                                                               \
    X(CLOSED, "the recorder is closed")                                                                                \
    X(NOTHING, "there is no tick to record")                                                                           \
    X(NO_RING, "the recorder has no ring")                                                                             \
    X(NO_MEMORY, "out of memory")                                                                                      \
    X(GAPS, "refused ticks are gaps in the recording")

typedef enum octreel_status {
#define OCTREEL_STATUS_ENUM(name, text) OCTREEL_##name,
    OCTREEL_STATUS_MAP(OCTREEL_STATUS_ENUM)
#undef OCTREEL_STATUS_ENUM
        OCTREEL_STATUS_COUNT
} octreel_status;

/* Returns the text of a status, without a final period. The text is never null and is static. */
const char *octreel_status_text(octreel_status status);

typedef struct octreel_recorder octreel_recorder;

/* The options of a recording. Start from octreel_recorder_def_default() and change what you need. "octreel record
 * --help" lists the values of the options that are names. */
typedef struct octreel_recorder_def {
    const char *folder; /* folder for the recording: a new folder, or one without a recording. Null with a ring */
    /* True: `folder` may hold a recording. The old recording is removed once tick 0 of the new one is filmed; if
     * tick 0 fails, it stays. Files that do not belong to a recording always stay. BAD_FOLDER if the folder holds
     * files that only look like a recording, or if a process is recording into it. */
    bool replace;
    /* The octree_definition() of the program's trees; its allocator is not used. For a program that passes lists or
     * changes: a world that should contain all points, and the capacity and depth of the tree that Octreel builds
     * to show them; full leaves of this tree grow. */
    octree_def tree;
    /* OCTREE_PLAYER_NONE, or OCTREE_PLAYER_BODY: the point with this id is the player, and its collisions are
     * found; box_size and sweep are used too. */
    octree_player player;
    int width, height;    /* size of a frame in pixels, 1 to 16384 */
    const char *camera;   /* the camera: "iso", "orbit", "follow" ... */
    const char *layers;   /* the layers to draw: "default", "all", "-text", "nodes,points,shapes" ... */
    const char *color_by; /* what the colours of nodes show: "depth", "occupancy", "plain" ... */
    /* The tree whose nodes are drawn: "own" is Octreel's, "foreign" is octreel_tick_info.foreign, "both" draws
     * both. "auto" draws Octreel's nodes until a tick has foreign nodes, and then the foreign nodes. */
    const char *show_tree;
    const char *color_points; /* what the colours of points show: "plain", "height", "leaf" ... */
    const char *shade;        /* shading of points: "bands", "edl", "none" */
    const char *diagram;      /* the tree drawn as a diagram: "none", "beside" the space, "only" the diagram */
    bool labels;              /* write the addresses of nodes, such as 0/3/7, on nodes where there is room */
    double lod;               /* leave out boxes smaller than this many pixels if an ancestor is drawn; 0: draw all */
    uint64_t budget;          /* maximum number of boxes, and of points, in a frame; 0: no limit */
    int aa;                   /* anti-aliasing: 1 (off), 2 or 4; a pixel has aa * aa samples */
    /* Film ticks 0, every, 2 * every ...; 0: no frames, because the page can draw every tick itself. ticks.jsonl
     * has all ticks in any case. */
    uint64_t every;
    /* The rasterizer: "integers", "checked" or "gl". All three draw the same pixels. "integers" is the cheapest,
     * because it never loads OpenGL, which takes 0.2 s of processor time and 85 MB. octreel verify can check its
     * frames later. "checked" compares the first frame, every 100th frame and the last frame with the pixels of
     * OSMesa, if OpenGL can be loaded. */
    const char *fill;
    const char *context; /* the OpenGL library to load: "auto", "osmesa", "egl" */
    /* True, with "egl": OpenGL may draw with any renderer, also a graphics card. Frames may then differ between
     * machines. */
    bool any_renderer;
    size_t queue_ticks; /* maximum number of ticks that wait for the worker thread, at least 1 */
    size_t queue_bytes; /* maximum memory of these ticks together, in bytes; a single tick may need more */
    /* True: if the queue is full, return OCTREEL_BUSY and do not wait; the tick is then a gap. Tick 0 always waits. */
    bool never_wait;
    /* Keep the last `ring` ticks in memory, and film them only in octreel_recorder_write(); 0: film every tick.
     * Memory: the points of the oldest tick, and the changes of the other ticks. */
    size_t ring;
} octreel_recorder_def;

/* Returns the default options: no player, 1280 x 720 pixels, camera "iso", the default layers, fill "integers", 16
 * ticks or 64 MiB in the queue, no ring. */
octreel_recorder_def octreel_recorder_def_default(void);

/* The queries and shapes of a program at one tick, and its points if it has no octree. All arrays are copied. The
 * member `tick` of their items is ignored.
 *
 * The recorder answers each query exactly, at the end of the tick, with the query's `skip` and `epsilon`. The program
 * gets the same answers if it makes its queries after its last change of the tick. To show a query that the program
 * made before a change, call octreel_recorder_tick() once before that change. If a query carries the program's own
 * answer, the answer is copied and checked.
 *
 * In one tick the points come from the tree, from `points` or from `changes`. A program may use lists at some ticks and
 * changes at others, but then it must not use trees. If a tick has none of the three, nothing has changed. The
 * exception is a program that passed a list before: then it has no points now, because the data pointer of an empty C++
 * vector may be null. A point outside the world is in no answer. The tick in which it enters or leaves the world has
 * the event "refused".
 *
 * Shapes are everything in a frame that is not a point or a node, such as walls and goals. */
typedef struct octreel_tick_info {
    /* In any order. All numbers must be finite. at_player may be true only if the recorder has a player. */
    const octree_query *queries;
    size_t query_count;
    const octree_shape *shapes;
    size_t shape_count;
    const octree_point *points; /* all points, in any order; each id occurs once */
    size_t point_count;
    const octree_edit *changes; /* point changes since the last call, in the order in which they were made. A point
                                   may change several times. Velocities are ignored */
    size_t change_count;
    /* The nodes of the program's own index, valid from this tick on. The queries' `visits` name nodes that were
     * visited, left out or hit. Null: the nodes have not changed. */
    const octree_foreign_tree *foreign;
} octreel_tick_info;

/* Open a recorder: copy the definition and create the folder. On failure *recorder is null and *error, which may be
 * null, has the text. Errors: NULL_ARGUMENT, BAD_OPTION, BAD_ID (the player's id), BAD_FOLDER, NO_MEMORY. Cost: one
 * thread; with a ring the thread exists only during octreel_recorder_write(). */
octreel_status octreel_recorder_open(const octreel_recorder_def *def, octreel_recorder **recorder,
                                     octreel_error *error);

/* Record a tick: the current points, the queries and the shapes. The ids of the points must be unique. `about` may be
 * null. The first call is tick 0. The points are those of the tree; if `tree` is null, they are those of `about`. After
 * a tick with a tree, a null tree is the error NULL_ARGUMENT. A tree under OCTREE_AUTO that has changed its capacity is
 * the error OTHER_TREE. The arguments are not used after the call returns. The call waits for the worker thread if the
 * queue is full, and at tick 0 until the recording has begun.
 *
 * If a tick is refused, its list of points is ignored. Its changes and foreign nodes stay valid: the next accepted tick
 * has them. Invalid changes are dropped: BAD_POINT (a NaN, an infinity, an unknown kind), BAD_ID, DUPLICATE_ID (an
 * insertion of an existing id) and NO_POINT (a move or removal of a missing point). The error names the first invalid
 * change. After NO_MEMORY no change is kept: pass the tick again.
 *
 * Errors: NULL_ARGUMENT, OTHER_TREE, TWO_SOURCES, DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, BAD_QUERY, BAD_SHAPE,
 * BAD_NODE, BUSY, CANNOT_DRAW and BAD_FOLDER (tick 0), BROKEN, CLOSED, NO_MEMORY.
 *
 * Cost by source of the points (q is the number of queries and shapes):
 *    - a tree of which at most an eighth changes in a tick: O(changes + q), some hundred nanoseconds per change. The
 *      tree then keeps its changes for the recorder (octree_changes_since), at 64 bytes each.
 *    - a tree of which more changes, or that is new to the recorder, or was tuned, compacted or cleared; and a list:
 *      O(nodes + n + q), and 96 bytes per point.
 *    - changes: O(changes log changes + q), and up to 128 bytes per point. The first changes after a list cost more.
 *    - in addition, m foreign nodes: O(m log m).
 * A tick's changes use memory until the tick is filmed. */
octreel_status octreel_recorder_tick(octreel_recorder *recorder, const octree *tree, const octreel_tick_info *about);

/* Record the ticks and gaps of the ring into a folder. Returns when the recording is complete. Tick 0 of the recording
 * is tick *first of the recorder; `first` may be null. The ring is kept and may be written again into another folder.
 * Errors: NULL_ARGUMENT, NO_RING, NOTHING, CLOSED, BAD_FOLDER, CANNOT_DRAW, BROKEN, NO_MEMORY. GAPS means that the
 * recording is complete but has gaps. */
octreel_status octreel_recorder_write(octreel_recorder *recorder, const char *folder, uint64_t *first);

/* Record the ticks that are still in the queue, and complete the recording with session.json and the page. A ring is
 * dropped. If a tick failed, the ticks before it are complete, and octreel record --resume continues after them.
 * Errors: BROKEN, the error of tick 0, NOTHING, CLOSED. GAPS means that the recording is complete but ticks were
 * refused. The error text then has the number of refused ticks, and the number and reason of the first. */
octreel_status octreel_recorder_close(octreel_recorder *recorder);

/* Close the recorder if it is open, and free it. */
void octreel_recorder_destroy(octreel_recorder *recorder);

/* Returns the error text of the last call that failed, or "". Valid until the next call. */
const char *octreel_recorder_error(const octreel_recorder *recorder);

#ifdef __cplusplus
}
#endif

#endif
