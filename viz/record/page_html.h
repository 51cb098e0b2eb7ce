/* SPDX-License-Identifier: MIT */
/* page_html.h - the page of page/index.html, its style and scripts inside, as CMake makes bytes of it: what comes
 * before a recording's facts, and what comes after them. */
#ifndef RECORD_PAGE_HTML_H
#define RECORD_PAGE_HTML_H

#include <stdbool.h>
#include <stddef.h>

extern const unsigned char page_html_head[], page_html_tail[];
extern const size_t page_html_head_size, page_html_tail_size;

/* Whether the program is in the page. */
extern const bool page_html_plays;

#endif
