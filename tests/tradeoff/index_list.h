/* SPDX-License-Identifier: MIT */
/* index_list.h - the libraries of this build in words. */
#ifndef TRADEOFF_INDEX_LIST_H
#define TRADEOFF_INDEX_LIST_H

/* The names and versions of all indexes, such as "octreel 0.1.0, ann 1.1.2". Must be freed. */
char *list_libraries(void);

#endif
