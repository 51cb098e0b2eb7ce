/* page_html.h - the page of viewer/index.html, its style and scripts inside, as CMake made bytes of it: what comes
 * before a recording's facts, and what behind them. */
#ifndef RECORD_VIEWER_PAGE_H
#define RECORD_VIEWER_PAGE_H

#include <stddef.h>

extern const unsigned char page_html_head[], page_html_tail[];
extern const size_t page_html_head_size, page_html_tail_size;

#endif
