/* SPDX-License-Identifier: MIT */
/* link.h - relative links from an HTML page to the folder of a recording. */
#ifndef REPORT_LINK_H
#define REPORT_LINK_H

#include <stdbool.h>
#include <stdio.h>

/* Return the relative path from one folder to another, such as "./../flight/". The parts "." and "..", and double
 * slashes, are resolved in the text, as a browser does; symbolic links are not followed. The caller frees the path.
 * Return null if memory runs out or the current folder is unknown. */
char *link_make_relative_path(const char *from, const char *to);

/* Return whether the folder of a recording has an index.html, the page that plays the recording. */
bool link_has_page(const char *recording);

/* Write a path as a part of a URL: all characters except letters, digits and "-._~/" are percent-encoded. */
void link_write_path(FILE *out, const char *path);

#endif
