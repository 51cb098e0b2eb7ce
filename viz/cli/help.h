/* SPDX-License-Identifier: MIT */
/* help.h - what is printed about commands by --help and --version. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

#include "command.h"

/* Print all about a command, or about octreel with its commands. Returns EXIT_DONE. */
int help_print(FILE *out, const command *c);

/* Print the version, and who would draw; returns EXIT_TROUBLE where nobody can. */
int version_print(void);

#endif
