/* SPDX-License-Identifier: MIT */
/* manual.h - manuals for man(1), from the text and the tables that --help prints. */
#ifndef CLI_MANUAL_H
#define CLI_MANUAL_H

#include "command.h"

/* Write octreel-NAME(1) of a command, octreel(1) of command_octreel. */
void manual_write(FILE *out, const command *c);

/* Write octreel-NAME(5) of a topic. */
void manual_write_topic(FILE *out, const help_topic *topic);

#endif
