/* SPDX-License-Identifier: MIT */
/* xml_check.h - checks XML by xmllint (Debian: libxml2-utils). Where it is missing, the functions print a note and
 * check nothing. */
#ifndef XML_CHECK_H
#define XML_CHECK_H

#include <stddef.h>

/* The test fails unless the text is well-formed, begins with an XML declaration, and has this number of elements. */
void assert_xml_count(const char *text, const char *element, size_t count);

/* The test fails unless the attribute of the n-th such element, counted from 0, has the expected value. */
void assert_xml_attribute(const char *text, const char *element, size_t n, const char *attribute, const char *expected);

/* The same, for a value that contains a part. */
void assert_xml_attribute_contains(const char *text, const char *element, size_t n, const char *attribute,
                                   const char *part);

#endif
