/* SPDX-License-Identifier: MIT */
/* played_page.h - writes a page that plays a session in a browser. Ticks are played; nothing is drawn. */
#ifndef RECORD_PLAYED_PAGE_H
#define RECORD_PLAYED_PAGE_H

#include "film_options.h"

#include <stdio.h>

/* Play a session and write its page. Of the options only view, values and watch are read; of the summary only start,
 * ticks and total are set. If the watcher stops it, ticks is below total and the page is
 * incomplete. False with an error, before anything is written, where this build has no WebAssembly or the session is
 * too large for a page. Write errors stay with the stream. */
bool write_played_page(const octree_session *session, const film_options *options, FILE *page, film_summary *summary,
                       octreel_error *error);

#endif
