/* viewer_page.h - the page of viewer/index.html, its style and scripts inside, as CMake made bytes of it: what comes
 * before a recording's facts, and what behind them. */
#ifndef RECORD_VIEWER_PAGE_H
#define RECORD_VIEWER_PAGE_H

#include <stddef.h>

extern const unsigned char viewer_page_head[], viewer_page_tail[];
extern const size_t viewer_page_head_size, viewer_page_tail_size;

#endif
