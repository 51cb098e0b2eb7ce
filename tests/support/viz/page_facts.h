/* SPDX-License-Identifier: MIT */
/* page_facts.h - reads the facts of a page: the line of recording.json, and those of the ticks. */
#ifndef PAGE_FACTS_H
#define PAGE_FACTS_H

/* The text of the element of a page that has the facts. The caller frees it. */
char *page_facts_element(const char *page);

/* The facts of a page, unpacked if they are packed. The caller frees them. */
char *page_facts(const char *page);

#endif
