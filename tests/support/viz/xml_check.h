/* SPDX-License-Identifier: MIT */
/* xml_check.h - whether a text is XML, by a small reader of its own: elements, attributes, text and references. */
#ifndef XML_CHECK_H
#define XML_CHECK_H

#include <stddef.h>

/* The test fails, with the place, where the text is not well-formed, or holds a character that XML 1.0 does not know.
 * Returns how many elements of this name there are. */
size_t xml_count(const char *text, const char *element);

/* The value of an attribute of the n-th such element (counted from 0), its references resolved; the caller frees it.
 * The test fails when there is none. */
char *xml_attribute(const char *text, const char *element, size_t n, const char *attribute);

#endif
