/* SPDX-License-Identifier: MIT */
/* evidence_page.h - the page of evidence/report.html, its style and scripts inside, as CMake made bytes of it: what
 * comes before the facts and pictures of a comparison, and what comes after. */
#ifndef REPORT_EVIDENCE_PAGE_H
#define REPORT_EVIDENCE_PAGE_H

#include <stddef.h>

extern const unsigned char evidence_page_head[], evidence_page_tail[];
extern const size_t evidence_page_head_size, evidence_page_tail_size;

#endif
