/* SPDX-License-Identifier: MIT */
/* audit_page.h - the template of the HTML page that octreel audit writes. CMake embeds it as two strings: the HTML
 * before the contents and the HTML after them. */
#ifndef REPORT_AUDIT_PAGE_H
#define REPORT_AUDIT_PAGE_H

#include <stddef.h>

extern const unsigned char audit_page_head[], audit_page_tail[];
extern const size_t audit_page_head_size, audit_page_tail_size;

#endif
