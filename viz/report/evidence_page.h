/* SPDX-License-Identifier: MIT */
/* evidence_page.h - the template of report.html, with its style and scripts. CMake embeds it as two strings: the
 * HTML before the facts and pictures of a comparison, and the HTML after them. */
#ifndef REPORT_EVIDENCE_PAGE_H
#define REPORT_EVIDENCE_PAGE_H

#include <stddef.h>

extern const unsigned char evidence_page_head[], evidence_page_tail[];
extern const size_t evidence_page_head_size, evidence_page_tail_size;

#endif
