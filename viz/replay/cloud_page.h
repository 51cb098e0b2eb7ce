/* SPDX-License-Identifier: MIT */
/* cloud_page.h - writes the page of a point cloud: one HTML file that shows the cloud's tree in a browser. */
#ifndef REPLAY_CLOUD_PAGE_H
#define REPLAY_CLOUD_PAGE_H

#include "inspect.h"
#include "octree/game.h"
#include "view.h"

/* The contents of the page. */
typedef struct cloud_page {
    const char *title;      /* the name of the cloud; at most 255 bytes are kept */
    octree_address node;    /* the node that is marked; 0: no node */
    const inspection *made; /* the cloud's tree and values */
    const view *view;       /* the view with which the page opens; a picture of the cloud has the same view */
    const octree_query *queries;
    size_t query_count;
} cloud_page;

/* Write the page. Points that are refused or outside the world are left out. The module in the page makes the same
 * tree, and draws the same picture as film_tree(), pixel for pixel. If this build has no WebAssembly, or the cloud has
 * more than POINT_BLOCK_MOST points, returns false with an error and writes nothing. Write errors are left to the
 * caller, who checks the stream. Cost: O(points), about 1.5 s for a million; memory: about 100 bytes for each point. */
bool cloud_page_write(const cloud_page *c, FILE *page, octreel_error *error);

#endif
