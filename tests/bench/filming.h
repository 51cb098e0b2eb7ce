/* SPDX-License-Identifier: MIT */
/* filming.h - records a scene with one of the renderers that octreel-bench compares, each time in a new process. */
#ifndef BENCH_FILMING_H
#define BENCH_FILMING_H

#include "filmed_scenes.h"

typedef enum filming_who {
    FILM_NAIVE,    /* see naive.h: one process, one thread */
    FILM_OCTREEL,  /* film_session(), with `jobs` processes */
    FILM_PARTS,    /* the parts of a frame one after the other: one process */
    FILM_CHECKED,  /* FILM_PARTS, with the checks of --fill checked */
    FILM_ASKED,    /* FILM_PARTS, with the scene's queries */
    FILM_ANSWERED, /* FILM_ASKED, with the answers of a program */
    FILM_PAGE,     /* the page of a recording, see page_timing.h: frames are drawn, but not written */
    FILM_KINDS
} filming_who;

typedef struct filming_order {
    const filmed_scene *scene;
    filming_who who;
    uint64_t frames;
    unsigned jobs;       /* number of processes of FILM_OCTREEL */
    const char *folder;  /* folder for the frames, which are removed again */
    const char *browser; /* the browser of FILM_PAGE */
} filming_order;

/* Milliseconds; 0: not measured by this kind. */
typedef struct filming {
    double first_ms;           /* from the start of the process until its first frame is written; of FILM_CHECKED: the
                                  processor time of the first frame, in which Mesa is loaded */
    double frame_ms;           /* wall-clock time of a frame without start-up; of FILM_PARTS: processor time */
    double draw_ms, encode_ms; /* processor time of the two parts of a frame: until its pixels, and its file */
    double floor_ms;           /* processor time of the encoder alone for these pixels */
    double mib;                /* peak memory of the process, or of the largest one */
    double scrub_ms, page_kb;  /* see page_timing.h */
    page_turning turning[PAGE_SIZES];
    char trouble[512]; /* reason of a failure; "" if there is none */
} filming;

/* False: failed, see filming.trouble. */
bool film_scene(const filming_order *order, filming *result);

#endif
