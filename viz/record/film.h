/* film.h - a session becomes a recording: every tick played, drawn and written. */
#ifndef RECORD_FILM_H
#define RECORD_FILM_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "tick_scene.h"

#define FILM_MOST_JOBS 256

typedef struct film_options {
    const char *folder;
    view view;
    renderer_choice renderer;
    uint64_t every; /* film ticks 0, every, 2 * every ...; at least 1. ticks.jsonl has all ticks */
    /* A part: the ticks [first, last) alone; last 0 is all of them, and beyond the end is the end. Parts of one
     * recording go into one folder, in any order or at the same time; see join.h for what makes it whole. */
    uint64_t first, last;
    /* Processes that film; 0 or 1 is this one alone, and the bytes are the same. More are started by fork(), which a
     * process may only ask for that has drawn nothing yet and has no threads. */
    unsigned jobs; /* at most FILM_MOST_JOBS, and one a frame */
    bool resume;   /* go on in a folder that holds a part of this recording: a frame that is there and right is kept */
    void (*progress)(uint64_t done, uint64_t total, void *context); /* after each tick; may be null */
    bool (*keep_going)(void *context); /* asked between ticks: false stops behind the last one; may be null */
    void *context;
} film_options;

typedef struct film_summary {
    uint64_t ticks; /* tick 0 included; of a part, its own */
    uint64_t frames;
    uint64_t left_out;    /* elements of all frames that could not be drawn: not finite, or too far off for doubles */
    uint64_t over_budget; /* frames that leave out what is beyond the view's budget */
    uint64_t events[OCTREE_EVENT_KINDS]; /* ticks that had each event */
    uint64_t total;                      /* ticks that were to be filmed: more than `ticks` where it was stopped */
} film_summary;

/* Film a session, or a part of it, into a folder. On failure what is there is whole: frames are written by rename, and
 * the lines of ticks.jsonl (of a part, ticks_A_B.jsonl) end with the last tick that was finished; index.html comes
 * last. A recording that broke off or was stopped can be resumed, and is then the same bytes as one that was not.
 * Nothing is made where the session, the size or the part is refused. */
bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  octreel_error *error);

/* As many processes as this machine has cores, but no more than have a few frames to film each. */
unsigned film_default_jobs(const octree_session *session, const film_options *options);

/* Draw one tree, with the view and the renderer of the options, and write it as a PNG: the one frame of *summary. */
bool film_tree(const octree *tree, const tree_subject *about, const film_options *options, const char *path,
               film_summary *summary, octreel_error *error);

#endif
