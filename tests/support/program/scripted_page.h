/* SPDX-License-Identifier: MIT */
/* scripted_page.h - pages that run a script of a test or a benchmark. */
#ifndef TESTS_SCRIPTED_PAGE_H
#define TESTS_SCRIPTED_PAGE_H

#include <stdbool.h>

/* Write the text of a page to `path`, and make the page run the file `script` of its folder at its end. A page's
 * security policy allows only its own scripts; the copy's policy also allows scripts from files. False with errno if
 * the file cannot be written. */
bool write_scripted_page(const char *path, const char *text, const char *script);

#endif
