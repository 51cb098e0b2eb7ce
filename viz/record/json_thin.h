/* json_thin.h - JSON copied from stream to stream for a page to embed: without blanks, with long lists cut off.
 *
 * Of a list with more entries than are kept the first are copied, followed by {"more": how many are left out}. Inside a
 * script element of HTML the copy ends nothing: '<' and the separators U+2028 and U+2029 are written as escapes. Memory
 * does not grow with the text.
 */
#ifndef RECORD_JSON_THIN_H
#define RECORD_JSON_THIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Values may lie this deep in each other. */
#define JSON_THIN_DEPTH 64

/* Copy the value that comes next in `in`, blanks before it passed over. False when what is there is no JSON; a part of
 * it may then have been copied. Errors of the streams stay with them. */
bool json_thin(FILE *in, FILE *out, size_t kept);

#endif
