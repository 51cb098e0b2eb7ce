/* SPDX-License-Identifier: MIT */
/* page_html.h - viz/page/viewer/index.html with its style and scripts, as bytes made by CMake: the part before the data
 * of a recording, and the part after it. */
#ifndef RECORD_PAGE_HTML_H
#define RECORD_PAGE_HTML_H

#include <stdbool.h>
#include <stddef.h>

extern const unsigned char page_html_head[], page_html_tail[];
extern const size_t page_html_head_size, page_html_tail_size;

/* Whether the page contains the program as WebAssembly. */
extern const bool page_html_plays;

#endif
