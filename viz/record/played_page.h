/* SPDX-License-Identifier: MIT */
/* played_page.h - a session becomes a page that plays it, in one file: its ticks are played, and nothing is drawn. */
#ifndef RECORD_PLAYED_PAGE_H
#define RECORD_PLAYED_PAGE_H

#include "film_options.h"

#include <stdio.h>

/* Play a session and write its page. Of the options the view, progress, keep_going and context are read; of the summary
 * start, ticks and total are set: fewer ticks than the total where keep_going() stopped it, and the page is then not
 * whole. False, before anything is written, where the page could not play: the program is not in the pages of this
 * build, or the session is larger than a page holds. Errors of writing stay with the stream. */
bool write_played_page(const octree_session *session, const film_options *options, FILE *page, film_summary *summary,
                       octreel_error *error);

#endif
