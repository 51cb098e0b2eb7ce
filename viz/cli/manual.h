/* SPDX-License-Identifier: MIT */
/* manual.h - writes manuals for man(1) from the same tables as --help. */
#ifndef CLI_MANUAL_H
#define CLI_MANUAL_H

#include "command.h"

/* Writes the manual octreel-NAME(1) of a command, or octreel(1) for command_octreel. */
void manual_write(FILE *out, const command *c);

/* Writes the manual octreel-NAME(5) of a topic. */
void manual_write_topic(FILE *out, const help_topic *topic);

#endif
