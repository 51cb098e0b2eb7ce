/* film.h - a session becomes a recording: every tick played, drawn and written. */
#ifndef RECORD_FILM_H
#define RECORD_FILM_H

#include "draw.h"
#include "folder.h"
#include "octree/game.h"
#include "tick_scene.h"

typedef struct film_options {
    const char *folder;
    view view;
    renderer_choice renderer;
    uint64_t every; /* film ticks 0, every, 2 * every ...; at least 1. ticks.jsonl has all ticks */
    void (*progress)(uint64_t done, uint64_t total, void *context); /* after each tick; may be null */
    void *context;
} film_options;

typedef struct film_summary {
    uint64_t ticks; /* tick 0 included */
    uint64_t frames;
    uint64_t left_out; /* elements of all frames that could not be drawn: not finite, or too far off for doubles */
    uint64_t over_budget; /* frames that leave out what is beyond the view's budget */
    uint64_t events[OCTREE_EVENT_KINDS]; /* ticks that had each event */
} film_summary;

/* Film a session into a folder. On failure what is there is whole: frames are written by rename, and ticks.jsonl ends
 * with the last tick that was finished; index.html comes last. Nothing is made where the session or the size is refused. */
bool film_session(const octree_session *session, const film_options *options, film_summary *summary,
                  record_error *error);

/* Draw one tree, with the view and the renderer of the options, and write it as a PNG: the one frame of *summary. */
bool film_tree(const octree *tree, const tree_look *about, const film_options *options, const char *path,
               film_summary *summary, record_error *error);

#endif
