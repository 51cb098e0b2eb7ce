/* SPDX-License-Identifier: MIT */
/* json_schema.h - whether a JSON value fits a schema of octreel's: the part of draft 7 that these use. */
#ifndef JSON_SCHEMA_H
#define JSON_SCHEMA_H

#include <jansson.h>

/* The test fails, with the place and the word of the schema, where it does not; and where the schema has a word that
 * this does not know. */
void assert_fits_schema(const json_t *value, const json_t *schema);

#endif
