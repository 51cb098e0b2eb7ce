/* SPDX-License-Identifier: MIT */
/* manual.h - writes manuals for man(1) from the same tables as --help. */
#ifndef CLI_MANUAL_H
#define CLI_MANUAL_H

#include "command.h"

/* Write octreel-NAME(1) for a command, or octreel(1) for command_octreel. */
void manual_write(FILE *out, const command *c);

/* Write octreel-NAME(5) for a topic. */
void manual_write_topic(FILE *out, const help_topic *topic);

#endif
