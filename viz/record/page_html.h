/* SPDX-License-Identifier: MIT */
/* page_html.h - the bytes of viz/page/viewer/index.html with its style sheet and scripts, in two parts: the part before
 * the data of a recording, and the part after the data. CMake generates these bytes. */
#ifndef RECORD_PAGE_HTML_H
#define RECORD_PAGE_HTML_H

#include <stdbool.h>
#include <stddef.h>

extern const unsigned char page_html_head[], page_html_tail[];
extern const size_t page_html_head_size, page_html_tail_size;

/* true if the page contains the program as WebAssembly */
extern const bool page_html_plays;

#endif
