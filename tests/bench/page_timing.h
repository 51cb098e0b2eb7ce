/* SPDX-License-Identifier: MIT */
/* page_timing.h - times the page of a recording in headless Chromium. */
#ifndef BENCH_PAGE_TIMING_H
#define BENCH_PAGE_TIMING_H

#include "filmed_scenes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Milliseconds, by the clock on the wall. */
typedef struct page_times {
    double first_ms; /* from opening the page until its first picture is drawn, in a browser that runs already */
    double frame_ms; /* a frame, until the browser takes the next */
    double draw_ms;  /* the part of it that the page takes: the tick, the scene, its pixels, the canvas */
    double scrub_ms; /* to another tick, at worst */
    page_turning turning[PAGE_SIZES];
    double mib; /* what the page holds: its objects and the memories of its modules */
    double kb;  /* 1000 bytes: the size of the file */
} page_times;

/* Play so many frames of FOLDER/index.html, which the script that does it is added to. The browser, a program's name or
 * path, keeps its files in the folder. False with the reason where that cannot be. */
bool page_time(const char *browser, const char *folder, uint64_t frames, page_times *times, char *why, size_t room);

#endif
