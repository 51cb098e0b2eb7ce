/* SPDX-License-Identifier: MIT */
/* played_page.h - writes a page that plays a session in a browser. The ticks are played once for the page; no frame is
 * drawn. */
#ifndef RECORD_PLAYED_PAGE_H
#define RECORD_PLAYED_PAGE_H

#include "film_options.h"

#include <stdio.h>

/* Play a session and write its page. Only view, values and watch of the options are used. Only start, ticks and total
 * of the summary are set. If the watcher stops the playback, summary->ticks is less than summary->total and the page is
 * incomplete. If this build has no WebAssembly, or if the session is too large for a page, returns false with an error
 * and writes nothing. Write errors are left to the caller, who checks the stream. */
bool write_played_page(const octree_session *session, const film_options *options, FILE *page, film_summary *summary,
                       octreel_error *error);

#endif
