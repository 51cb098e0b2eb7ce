/* SPDX-License-Identifier: MIT */
/* help.h - prints --help and --version. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

#include "command.h"

/* Prints the help of a command. For command_octreel, also prints a list of all commands. Returns EXIT_DONE. */
int help_print(FILE *out, const command *c);

/* Prints the version and the available renderers. Returns EXIT_TROUBLE if no renderer can be opened. */
int version_print(void);

#endif
