/* SPDX-License-Identifier: MIT */
/* filming.h - records a scene with one of the renderers that octreel-bench compares, each time in a new process. */
#ifndef BENCH_FILMING_H
#define BENCH_FILMING_H

#include "filmed_scenes.h"

typedef enum filming_who {
    FILM_NAIVE,    /* see naive.h: one process, one thread */
    FILM_OCTREEL,  /* film_session(), by as many processes as asked for */
    FILM_PARTS,    /* what Octreel does for a frame, part by part: one process */
    FILM_CHECKED,  /* the same, where OSMesa also draws the first, every 100th and the last frame */
    FILM_ASKED,    /* the same, with the scene's queries */
    FILM_ANSWERED, /* which a program has answered */
    FILM_PAGE,     /* the page of a recording, see page_timing.h: frames are drawn, and none is written */
    FILM_KINDS
} filming_who;

typedef struct filming_order {
    const filmed_scene *scene;
    filming_who who;
    uint64_t frames;
    unsigned jobs;       /* of FILM_OCTREEL */
    const char *folder;  /* where there is room for frames; what is put there is removed again */
    const char *browser; /* of FILM_PAGE */
} filming_order;

/* Milliseconds; what a kind does not measure is 0. */
typedef struct filming {
    double first_ms;           /* from the start of the process until its first frame is written; of FILM_CHECKED: the
                                  processor time of the first frame, in which Mesa is loaded */
    double frame_ms;           /* a frame, by the clock on the wall, start-up apart; in parts: of a processor */
    double draw_ms, encode_ms; /* of a processor, the two parts of a frame: all up to its pixels, and its file */
    double floor_ms;           /* of a processor: what the encoder alone takes for these pixels */
    double mib;                /* the most memory of the process, or of the largest where there are several */
    double scrub_ms, page_kb;  /* of a page: see page_timing.h */
    char trouble[512];         /* why it failed; "" when it did not */
} filming;

/* False with filming.trouble. */
bool film_scene(const filming_order *order, filming *result);

#endif
