/* SPDX-License-Identifier: MIT */
/* yaml.h - the part of YAML that workflows of GitHub are written in here. */
#ifndef YAML_H
#define YAML_H

#include <jansson.h>

/* What a text says: mappings are objects, sequences arrays, and every scalar is a string. Of YAML it knows blocks, flow
 * mappings and sequences within a line, quoted and plain scalars, `|` and comments; the test fails at anything else. */
json_t *yaml_read(const char *text);

/* The same of a file. */
json_t *yaml_read_file(const char *path);

#endif
